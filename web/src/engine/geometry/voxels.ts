// Voxel layers: solid spans, and open floors by area, distance or region. Borders of tiles, which belong to the
// neighbours, are left out.

import type { BakeStages, CompactStage, HeightfieldStage, StageGrid } from 'talus';
import type { CellData, LayerData, Legend, Vec3 } from '../protocol';
import { colourOfArea, colourOfDistance, colourOfId, INK } from '../../scene/palette';

class CellWriter {
  private cells: Float32Array;
  private colours: Uint8Array;
  private used = 0;
  private first: StageGrid;

  constructor(grids: readonly (StageGrid & { spanCount: number })[]) {
    this.first = grids[0]!;
    const room = grids.reduce((sum, grid) => sum + grid.spanCount, 0);
    this.cells = new Float32Array(4 * room);
    this.colours = new Uint8Array(4 * room);
  }

  /** Columns of all tiles count from the first tile's corner: they share one lattice. */
  shiftOf(grid: StageGrid): [number, number] {
    const size = this.first.cellSize;
    return [
      Math.round((grid.bounds.min[0] - this.first.bounds.min[0]) / size),
      Math.round((grid.bounds.min[2] - this.first.bounds.min[2]) / size),
    ];
  }

  add(x: number, z: number, bottom: number, top: number, colour: number): void {
    const at = this.used;
    this.cells[at] = x;
    this.cells[at + 1] = z;
    this.cells[at + 2] = bottom;
    this.cells[at + 3] = top;
    this.colours[at] = colour >> 16;
    this.colours[at + 1] = (colour >> 8) & 255;
    this.colours[at + 2] = colour & 255;
    this.colours[at + 3] = 255;
    this.used = at + 4;
  }

  get count(): number {
    return this.used / 4;
  }

  take(): CellData {
    return {
      origin: [...this.first.bounds.min] as Vec3,
      cellSize: this.first.cellSize,
      cellHeight: this.first.cellHeight,
      cells: this.cells.slice(0, this.used),
      colours: this.colours.slice(0, this.used),
    };
  }
}

/** Calls `visit` with each column inside the tile, and its spans. */
function forColumns(
  grid: StageGrid & { firstSpan: Uint32Array }, visit: (x: number, z: number, from: number, to: number) => void,
): void {
  const border = grid.borderSize;
  for (let z = border; z < grid.height - border; z++) {
    for (let x = border; x < grid.width - border; x++) {
      const column = z * grid.width + x;
      visit(x, z, grid.firstSpan[column]!, grid.firstSpan[column + 1]!);
    }
  }
}

function areaLegends(used: ReadonlySet<number>): Legend[] {
  return [...used].filter((area) => area > 0).sort((a, b) => (b === 63 ? 1 : 0) - (a === 63 ? 1 : 0) || a - b).slice(0, 8)
    .map((area) => ({ colour: colourOfArea(area, 0), text: area === 63 ? 'walkable' : `area ${area}` }));
}

export function spanLayer(stages: readonly BakeStages[], anchor: Vec3): LayerData {
  const fields: HeightfieldStage[] = stages.map((stage) => stage.heightfield);
  const writer = new CellWriter(fields);
  const used = new Set<number>();
  let walkable = 0;
  for (const field of fields) {
    const [shiftX, shiftZ] = writer.shiftOf(field);
    forColumns(field, (x, z, from, to) => {
      for (let i = from; i < to; i++) {
        const area = field.area[i]!;
        if (area !== 0) {
          walkable++;
          used.add(area);
        }
        // A span of one voxel is still a box: flat cells are floors.
        writer.add(x + shiftX, z + shiftZ, field.min[i]!, field.max[i]!, area === 0 ? INK.solid : colourOfArea(area, 0));
      }
    });
  }
  return {
    anchor,
    cells: writer.take(),
    summary: `${writer.count.toLocaleString('en')} solid spans, ${walkable.toLocaleString('en')} of them walkable on top`,
    legends: [{ colour: INK.solid, text: 'solid' }, ...areaLegends(used)],
  };
}

export type FloorColour = 'floors' | 'distance' | 'regions';

function colourOfFloor(compact: CompactStage, i: number, kind: FloorColour, largest: number): number {
  const area = compact.area[i]!;
  if (area === 0) return INK.closed;
  if (kind === 'distance') return compact.distance.length === 0 ? INK.none : colourOfDistance(compact.distance[i]! / largest);
  if (kind === 'regions') {
    const region = compact.region[i]!;
    return region >= 0x80000000 ? INK.border : region === 0 ? INK.none : colourOfId(region);
  }
  return colourOfArea(area, 0);
}

export function floorLayer(stages: readonly BakeStages[], anchor: Vec3, kind: FloorColour): LayerData {
  const fields = stages.map((stage) => stage.compact);
  const writer = new CellWriter(fields);
  const largest = Math.max(1, ...fields.map((field) => field.maxDistance));
  const used = new Set<number>();
  let walkable = 0;
  for (const field of fields) {
    const [shiftX, shiftZ] = writer.shiftOf(field);
    forColumns(field, (x, z, from, to) => {
      for (let i = from; i < to; i++) {
        const floor = field.floor[i]!;
        if (field.area[i] !== 0) {
          walkable++;
          used.add(field.area[i]!);
        }
        writer.add(x + shiftX, z + shiftZ, floor, floor, colourOfFloor(field, i, kind, largest));
      }
    });
  }
  const legends: Record<FloorColour, Legend[]> = {
    floors: [...areaLegends(used), { colour: INK.closed, text: 'not walkable: steep, low, at a ledge or near a wall' }],
    distance: [
      { colour: colourOfDistance(0), text: 'at the border' }, { colour: colourOfDistance(0.5), text: 'half way' },
      { colour: colourOfDistance(1), text: 'farthest' }, { colour: INK.closed, text: 'not walkable' },
    ],
    regions: [
      { colour: colourOfId(1), text: 'a hue each region' }, { colour: INK.none, text: 'no region: too small an island' },
      { colour: INK.closed, text: 'not walkable' },
    ],
  };
  const regions = stages.reduce((sum, stage) => sum + new Set(stage.polygons.region).size, 0);
  const hasField = fields.some((field) => field.distance.length > 0);
  const summaries: Record<FloorColour, string> = {
    floors: `${writer.count.toLocaleString('en')} open floors, ${walkable.toLocaleString('en')} of them walkable`,
    distance: hasField ? `at most ${(0.5 * largest * fields[0]!.cellSize).toFixed(1)} m from a wall or ledge`
      : 'only the watershed partition computes it',
    regions: `${regions} regions with polygons`,
  };
  return { anchor, cells: writer.take(), summary: summaries[kind], legends: legends[kind] };
}
