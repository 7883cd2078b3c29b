// Layers of the level itself and of what rays use: triangles, pairs, boxes of the tree, and the hull.

import type { Hull, Mesh, Soup } from 'talus';
import type { LayerData, Vec3 } from '../protocol';
import { plural } from '../../plural';
import { colourOfId, INK, mix } from '../../scene/palette';
import { Writer } from './writer';

const FLAT = 0xdedad0;
const STEEP = 0xc6c1b7;

/** Flat colours by slope, so that what is too steep to walk can be told at a glance. */
export function triangleLayer(mesh: Mesh, anchor: Vec3, maxSlope: number): LayerData {
  const { vertices, indices, triangleCount } = mesh;
  const writer = new Writer(anchor, 0, triangleCount);
  const limit = Math.cos((maxSlope * Math.PI) / 180);
  let steep = 0;
  for (let i = 0; i < 3 * triangleCount; i += 3) {
    const a = 3 * indices[i]!;
    const b = 3 * indices[i + 1]!;
    const c = 3 * indices[i + 2]!;
    const ux = vertices[b]! - vertices[a]!;
    const uy = vertices[b + 1]! - vertices[a + 1]!;
    const uz = vertices[b + 2]! - vertices[a + 2]!;
    const vx = vertices[c]! - vertices[a]!;
    const vy = vertices[c + 1]! - vertices[a + 1]!;
    const vz = vertices[c + 2]! - vertices[a + 2]!;
    const ny = uz * vx - ux * vz;
    const walkable = ny > limit * Math.hypot(uy * vz - uz * vy, ny, ux * vy - uy * vx);
    if (!walkable) steep++;
    writer.triangle(vertices, a, b, c, walkable ? FLAT : STEEP);
  }
  return {
    anchor,
    triangles: writer.triangles(),
    summary: `${plural(triangleCount, 'triangle')}, ${(triangleCount - steep).toLocaleString('en')} less steep than ${maxSlope}°`,
    legends: [{ colour: FLAT, text: 'less steep than the limit' }, { colour: STEEP, text: 'too steep' }],
  };
}

export function pairLayer(soup: Soup, anchor: Vec3): LayerData {
  const pairs = soup.pairs();
  const stats = soup.stats();
  const writer = new Writer(anchor, 0, 2 * pairs.count);
  for (let i = 0; i < pairs.count; i++) {
    const at = 12 * i;
    if (pairs.triangles[2 * i + 1] === 0xffffffff) {
      writer.triangle(pairs.corners, at, at + 3, at + 6, INK.single);
    } else {
      const hue = colourOfId(i + 1);
      writer.triangle(pairs.corners, at, at + 3, at + 6, mix(hue, 0xffffff, 0.5));
      writer.triangle(pairs.corners, at, at + 6, at + 9, mix(hue, 0x8a8a90, 0.35));
    }
  }
  const share = ((200 * stats.pairCount) / stats.triangleCount).toFixed(1);
  return {
    anchor,
    triangles: writer.triangles(),
    summary: `${share}% of the triangles in ${plural(stats.pairCount, 'pair')}; ${plural(stats.nodeCount, 'node')}, ` +
      `${(stats.size / stats.triangleCount).toFixed(1)} bytes a triangle`,
    legends: [
      { colour: mix(colourOfId(2), 0xffffff, 0.5), text: 'pair: first triangle' },
      { colour: mix(colourOfId(2), 0x8a8a90, 0.35), text: 'second triangle' },
      { colour: INK.single, text: 'single' },
    ],
  };
}

const DEPTHS = [0xd1495b, 0xedae49, 0x00798c, 0x30638e, 0x6a4c93, 0x66a182];

export function boxLayer(soup: Soup, anchor: Vec3, depth: number): LayerData {
  const boxes = soup.boxes(depth);
  const writer = new Writer(anchor, 0, 0, 12 * boxes.count);
  const used = new Set<number>();
  for (let i = 0; i < boxes.count; i++) {
    const level = boxes.depth[i]!;
    used.add(level);
    writer.box(boxes.boxes, 6 * i, DEPTHS[level % DEPTHS.length]!);
  }
  return {
    anchor,
    lines: writer.lines(),
    summary: `${plural(boxes.count, 'box', 'boxes')} down to depth ${depth} of ${soup.stats().depth}`,
    legends: [...used].sort((a, b) => a - b).slice(-6)
      .map((level) => ({ colour: DEPTHS[level % DEPTHS.length]!, text: `depth ${level}` })),
  };
}

export function hullLayer(hull: Hull, anchor: Vec3): LayerData {
  const vertices = hull.vertices();
  const triangles = hull.triangles();
  const edges = hull.edges();
  const writer = new Writer(anchor, 0, triangles.length / 3, edges.length / 2);
  for (let i = 0; i < triangles.length; i += 3) {
    writer.triangle(vertices, 3 * triangles[i]!, 3 * triangles[i + 1]!, 3 * triangles[i + 2]!, 0x6a8caf);
  }
  for (let i = 0; i < edges.length; i += 2) writer.line(vertices, 3 * edges[i]!, 3 * edges[i + 1]!, INK.wall);
  return {
    anchor,
    triangles: writer.triangles(),
    lines: writer.lines(),
    summary: `${plural(hull.vertexCount, 'vertex', 'vertices')}, ${plural(hull.faceCount, 'face')}, ` +
      `${plural(edges.length / 2, 'edge')}; ${Number(hull.mass().volume.toPrecision(4)).toLocaleString('en')} m³`,
    legends: [{ colour: 0x6a8caf, text: 'face' }, { colour: INK.wall, text: 'edge' }],
  };
}
