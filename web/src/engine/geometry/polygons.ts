// Layers from contours to tiles.

import type { BakeStages, NavPolygons, NavTileInfo, OutlineStage, PolygonStage } from 'talus';
import type { LayerData, Vec3 } from '../protocol';
import { colourOfArea, colourOfId, INK, mix } from '../../scene/palette';
import { plural } from '../../plural';
import { Writer } from './writer';

const WALL = 0xffffffff;

function addOutlines(writer: Writer, outlines: OutlineStage, colourOf: (i: number) => number, lift: number): number {
  let edges = 0;
  for (let i = 0; i < outlines.count; i++) {
    const first = outlines.firstVertex[i]!;
    const end = outlines.firstVertex[i + 1]!;
    const colour = colourOf(i);
    for (let v = first; v < end; v++) {
      writer.line(outlines.vertices, 3 * v, 3 * (v + 1 < end ? v + 1 : first), colour, lift);
      edges++;
    }
  }
  return edges;
}

export function contourLayer(stages: readonly BakeStages[], anchor: Vec3): LayerData {
  const lift = stages[0]?.compact.cellHeight ?? 0.2;
  const writer = new Writer(anchor, lift);
  let raw = 0;
  let simple = 0;
  let outlines = 0;
  for (const { contours } of stages) {
    raw += addOutlines(writer, contours.raw, () => 0x8d99a6, lift);
    simple += addOutlines(writer, contours.simplified, (i) => mix(colourOfId(contours.simplified.region[i]!), 0, 0.15), 1.5 * lift);
    outlines += contours.simplified.count;
  }
  return {
    anchor,
    lines: writer.lines(),
    summary: `${outlines} outlines: ${raw.toLocaleString('en')} traced edges, ${simple.toLocaleString('en')} simplified`,
    legends: [{ colour: 0x8d99a6, text: 'traced' }, { colour: mix(colourOfId(1), 0, 0.15), text: 'simplified, a hue each region' }],
  };
}

function addPolygons(writer: Writer, stage: PolygonStage): number {
  let links = 0;
  for (let p = 0; p < stage.count; p++) {
    const first = stage.first[p]!;
    const end = stage.first[p + 1]!;
    // Neighbours of one region differ a little, so that the partition shows.
    const colour = mix(colourOfId(stage.region[p] || p + 1), 0xffffff, 0.12 * (p % 3));
    const at = (k: number): number => 3 * stage.indices[k]!;
    for (let k = first + 2; k < end; k++) writer.triangle(stage.vertices, at(first), at(k - 1), at(k), colour);
    for (let k = first; k < end; k++) {
      const wall = stage.neighbours[k] === WALL;
      if (!wall) links++;
      writer.line(stage.vertices, at(k), at(k + 1 < end ? k + 1 : first), wall ? INK.wall : INK.inner, writer.lift * 1.2);
    }
  }
  return links;
}

/** Polygons of the bake, or with three corners at most: the triangles before merging. */
export function polygonLayer(stages: readonly PolygonStage[], anchor: Vec3, lift: number, what: string): LayerData {
  const writer = new Writer(anchor, lift);
  let count = 0;
  let links = 0;
  for (const stage of stages) {
    links += addPolygons(writer, stage);
    count += stage.count;
  }
  return {
    anchor,
    triangles: writer.triangles(),
    lines: writer.lines(),
    summary: `${plural(count, what)}, ${plural(Math.floor(links / 2), 'link')}`,
    legends: [
      { colour: colourOfId(1), text: 'a hue each region' }, { colour: INK.wall, text: 'wall or ledge' },
      { colour: 0xc8c8c8, text: 'edge between neighbours' },
    ],
  };
}

export function detailLayer(stages: readonly BakeStages[], anchor: Vec3): LayerData {
  const writer = new Writer(anchor, 0.02);
  let triangles = 0;
  let worst = 0;
  for (const { detail } of stages) {
    for (let i = 0; i < detail.triangles.length; i += 3) {
      const [a, b, c] = [3 * detail.triangles[i]!, 3 * detail.triangles[i + 1]!, 3 * detail.triangles[i + 2]!];
      writer.triangle(detail.vertices, a, b, c, mix(colourOfId(detail.polygons[i / 3]! + 1), 0xffffff, 0.25));
      writer.line(detail.vertices, a, b, INK.wall, 0.04);
      writer.line(detail.vertices, b, c, INK.wall, 0.04);
      writer.line(detail.vertices, c, a, INK.wall, 0.04);
    }
    triangles += detail.triangles.length / 3;
    worst = Math.max(worst, detail.maxError);
  }
  return {
    anchor,
    triangles: writer.triangles(),
    lines: writer.lines(),
    summary: `${triangles.toLocaleString('en')} triangles; heights are at most ${worst.toFixed(2)} m off`,
    legends: [{ colour: mix(colourOfId(1), 0xffffff, 0.25), text: 'a hue each polygon' }],
  };
}

export function tileLayer(polygons: NavPolygons, tiles: readonly NavTileInfo[], anchor: Vec3): LayerData {
  const writer = new Writer(anchor, 0.05);
  const used = new Set<number>();
  for (let p = 0; p < polygons.count; p++) {
    const first = polygons.first[p]!;
    const end = polygons.first[p + 1]!;
    const colour = colourOfArea(polygons.area[p]!, p % 2);
    used.add(polygons.area[p]!);
    for (let k = first + 2; k < end; k++) writer.triangle(polygons.corners, 3 * first, 3 * (k - 1), 3 * k, colour);
    for (let k = first; k < end; k++) {
      const wall = polygons.links[k] === WALL;
      writer.line(polygons.corners, 3 * k, 3 * (k + 1 < end ? k + 1 : first), wall ? INK.wall : INK.inner, 0.08);
    }
  }
  if (tiles.length > 1) {
    for (const tile of tiles) writer.box([...tile.bounds.min, ...tile.bounds.max], 0, 0x7d5ba6);
  }
  const area = tiles.reduce((sum, tile) => sum + tile.area, 0);
  return {
    anchor,
    triangles: writer.triangles(),
    lines: writer.lines(),
    summary: `${plural(polygons.count, 'polygon')} in ${plural(tiles.length, 'tile')}, ` +
      `${Number(area.toPrecision(6)).toLocaleString('en')} m²`,
    legends: [
      ...[...used].sort((a, b) => a - b).slice(0, 8)
        .map((one) => ({ colour: colourOfArea(one, 0), text: one === 63 ? 'walkable' : `area ${one}` })),
      { colour: INK.wall, text: 'wall or ledge' },
      ...(tiles.length > 1 ? [{ colour: 0x7d5ba6, text: 'tile' }] : []),
    ],
  };
}
