// Every bake parameter: what it means, its unit, and what a slider offers. Names, defaults and units are those of
// tl_nav_def in include/talus/nav_bake.h; `option` is the command's.

import type { BakeSettings } from '../engine/protocol';

export interface NumberParameter {
  kind: 'number';
  key: keyof BakeSettings;
  label: string;
  unit: string;
  min: number;
  max: number;
  step: number;
  whole?: boolean;
  /** The slider moves in equal ratios instead of equal steps. */
  ratio?: boolean;
  group: string;
  help: string;
  option: string;
}

export interface ChoiceParameter {
  kind: 'choice';
  key: keyof BakeSettings;
  label: string;
  choices: readonly string[];
  group: string;
  help: string;
  option: string;
}

export interface FlagParameter {
  kind: 'flag';
  key: keyof BakeSettings;
  label: string;
  group: string;
  help: string;
  /** Given when the flag is off. */
  option: string;
}

export type Parameter = NumberParameter | ChoiceParameter | FlagParameter;

export const DEFAULTS: Readonly<BakeSettings> = {
  cellSize: 0.3,
  cellHeight: 0.2,
  agentHeight: 2,
  agentRadius: 0.6,
  agentMaxClimb: 0.9,
  agentMaxSlope: 45,
  regionMinSize: 8,
  regionMergeSize: 20,
  edgeMaxLen: 12,
  edgeMaxError: 1.3,
  maxVertsPerPoly: 6,
  detailSampleDist: 6,
  detailSampleMaxError: 1,
  partition: 'watershed',
  polygonMethod: 'classic',
  filterLowHangingObstacles: true,
  filterLedgeSpans: true,
  filterWalkableLowHeightSpans: true,
  tileSize: 0,
  tileHeight: 0,
};

const number = (
  key: keyof BakeSettings,
  label: string,
  unit: string,
  range: [number, number, number],
  group: string,
  option: string,
  help: string,
  more: Partial<NumberParameter> = {},
): NumberParameter => ({
  kind: 'number', key, label, unit, min: range[0], max: range[1], step: range[2], group, option, help, ...more,
});

export const PARAMETERS: readonly Parameter[] = [
  number('agentRadius', 'Radius', 'm', [0, 5, 0.05], 'Agent', 'agent-radius',
    'The walkable area keeps this far from walls and ledges, rounded up to whole cells.'),
  number('agentHeight', 'Height', 'm', [0.1, 10, 0.1], 'Agent', 'agent-height',
    'Free height that the agent needs, rounded up to whole voxels.'),
  number('agentMaxClimb', 'Max climb', 'm', [0, 5, 0.05], 'Agent', 'agent-max-climb',
    'The highest step that it takes, rounded down to whole voxels.'),
  number('agentMaxSlope', 'Max slope', '°', [0, 89, 1], 'Agent', 'agent-max-slope',
    'Floors less steep than this are walkable.'),
  number('cellSize', 'Cell size', 'm', [0.02, 4, 0.01], 'Voxels', 'cell-size',
    'Edge of a voxel on x and z. Half of it is twice as sharp, and four times the work.', { ratio: true }),
  number('cellHeight', 'Cell height', 'm', [0.02, 4, 0.01], 'Voxels', 'cell-height',
    'Height of a voxel: steps and heights are rounded to it.', { ratio: true }),
  { kind: 'flag', key: 'filterLowHangingObstacles', label: 'Low obstacles walkable', group: 'Filters',
    option: 'no-filter-low-hanging-obstacles',
    help: 'Kerbs, stairs and low obstacles above walkable floor, no higher than a step, become walkable.' },
  { kind: 'flag', key: 'filterLedgeSpans', label: 'Ledges closed', group: 'Filters', option: 'no-filter-ledge-spans',
    help: 'Floor beside a drop of more than a step, or on too steep a stair, is not walkable.' },
  { kind: 'flag', key: 'filterWalkableLowHeightSpans', label: 'Low ceilings closed', group: 'Filters',
    option: 'no-filter-walkable-low-height-spans', help: 'Floor without room for the agent above is not walkable.' },
  { kind: 'choice', key: 'partition', label: 'Partition', choices: ['watershed', 'monotone', 'layers'],
    group: 'Regions', option: 'partition',
    help: 'Watershed: best shapes. Monotone: fastest, long thin polygons. Layers: fast, no overlaps, good for tiles.' },
  number('regionMinSize', 'Min size', 'cells', [0, 150, 1], 'Regions', 'region-min-size',
    'Islands of fewer cells than its square are left out.'),
  number('regionMergeSize', 'Merge size', 'cells', [0, 150, 1], 'Regions', 'region-merge-size',
    'Regions of fewer cells than its square join a neighbour.'),
  number('edgeMaxError', 'Edge max error', 'cells', [0, 5, 0.1], 'Contours', 'edge-max-error',
    'How far a simplified contour may leave the traced one.'),
  number('edgeMaxLen', 'Edge max length', 'm', [0, 50, 0.5], 'Contours', 'edge-max-len',
    'The longest edge along a wall. 0: no limit.'),
  { kind: 'choice', key: 'polygonMethod', label: 'Method', choices: ['classic', 'optimal', 'delaunay'],
    group: 'Polygons', option: 'polygons',
    help: 'Classic: shortest cut first, then merging. Optimal: the fewest polygons. Delaunay: well-shaped polygons.' },
  number('maxVertsPerPoly', 'Max corners', '', [3, 64, 1], 'Polygons', 'max-verts-per-poly',
    'The most corners of a polygon.', { whole: true }),
  number('detailSampleDist', 'Sample distance', 'cells', [0, 16, 0.1], 'Detail', 'detail-sample-dist',
    'Spacing of height samples inside polygons. Below 0.9: none.'),
  number('detailSampleMaxError', 'Sample max error', 'voxels', [0, 16, 0.1], 'Detail', 'detail-sample-max-error',
    'How far the detail mesh may leave the floor, in cell heights.'),
  number('tileSize', 'Tile size', 'cells', [0, 512, 16], 'Tiles', 'tile-size',
    'Cells along a side of a tile. 0: the whole level is one tile. Obstacles rebake only the tiles that they touch.',
    { whole: true }),
  number('tileHeight', 'Layer height', 'm', [0, 50, 0.5], 'Tiles', 'tile-height',
    'Floors of one place are divided into layers of this height, each a tile. 0: no layers.'),
];

export function parameterOf(key: keyof BakeSettings): Parameter {
  const found = PARAMETERS.find((parameter) => parameter.key === key);
  if (!found) throw new Error(`no parameter ${key}`);
  return found;
}

/** `agent_radius` is what C says, `agentRadius` what the page says. */
export function keyOfField(field: string): keyof BakeSettings | null {
  const key = field.replace(/_(.)/g, (_, letter: string) => letter.toUpperCase());
  return key in DEFAULTS ? (key as keyof BakeSettings) : null;
}

export function showNumber(value: number): string {
  return String(Number(value.toPrecision(6)));
}
