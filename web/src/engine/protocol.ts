// What the page and the engine's worker say to one another. All of it survives structured cloning; arrays are
// transferred, not copied.

export type Vec3 = [number, number, number];

/** Triangles as they came from a file: metres, y up. */
export interface LevelMesh {
  name: string;
  /** The file that a baked file remembers; left out: `name`. */
  sourceName?: string;
  positions: Float32Array;
  indices: Uint32Array;
}

export type Partition = 'watershed' | 'monotone' | 'layers';
export type PolygonMethod = 'classic' | 'optimal' | 'delaunay';

/** Triangles of a level whose backs are see-through: for that each is drawn twice, which larger levels are spared. */
export const MOST_OPEN = 500_000;

/** tl_nav_def: names, units and defaults are those of include/talus/nav_bake.h. */
export interface BakeSettings {
  cellSize: number;
  cellHeight: number;
  agentHeight: number;
  agentRadius: number;
  agentMaxClimb: number;
  agentMaxSlope: number;
  regionMinSize: number;
  regionMergeSize: number;
  edgeMaxLen: number;
  edgeMaxError: number;
  maxVertsPerPoly: number;
  detailSampleDist: number;
  detailSampleMaxError: number;
  partition: Partition;
  polygonMethod: PolygonMethod;
  filterLowHangingObstacles: boolean;
  filterLedgeSpans: boolean;
  filterWalkableLowHeightSpans: boolean;
  tileSize: number;
  tileHeight: number;
}

export interface LevelInfo {
  name: string;
  triangles: number;
  degenerate: number;
  min: Vec3;
  max: Vec3;
  soupMilliseconds: number;
  pairs: number;
  depth: number;
  soupBytes: number;
  /** Settings that a .talus file was baked with. */
  settings?: BakeSettings;
  /** The navmesh that a .talus file holds is shown as it is. */
  baked?: BakeInfo;
}

export interface StageTime {
  stage: string;
  milliseconds: number;
}

export interface BakeInfo {
  milliseconds: number;
  /** That it ran on, and why on no more. */
  threads: { count: number; reason: string | null };
  stages: StageTime[];
  /** How many tiles the stages were timed on; null: all. */
  measuredTiles: number | null;
  tilesX: number;
  tilesZ: number;
  tiles: number;
  polygons: number;
  vertices: number;
  detailTriangles: number;
  regions: number;
  contours: number;
  spans: number;
  floors: number;
  area: number;
  filteredRegions: number;
  bytes: number;
}

export interface Progress {
  stage: string;
  done: number;
  total: number;
}

export interface Legend {
  colour: number;
  text: string;
}

/** Triangles with a colour a corner, 3 bytes each. */
export interface TriangleData {
  positions: Float32Array;
  colours: Uint8Array;
}
/** Segments, two points each. */
export interface LineData {
  positions: Float32Array;
  colours: Uint8Array;
}
/** Columns of voxels: x, z in cells, bottom and top in cell heights; drawn as boxes, or as squares where they are equal. */
export interface CellData {
  origin: Vec3;
  cellSize: number;
  cellHeight: number;
  cells: Float32Array; // 4 a cell: x, z, bottom, top
  colours: Uint8Array; // 4 a cell
}

/** One layer, ready for the graphics card. Positions are relative to the level's centre, `anchor`. */
export interface LayerData {
  anchor: Vec3;
  triangles?: TriangleData;
  lines?: LineData;
  cells?: CellData;
  summary: string;
  legends: Legend[];
}

export const LAYERS = [
  'triangles', 'pairs', 'boxes', 'spans', 'floors', 'distance', 'regions', 'contours', 'merging',
  'polygons', 'detail', 'tiles', 'links', 'hull',
] as const;
export type LayerName = (typeof LAYERS)[number];

export interface LayerOptions {
  depth?: number;
}

export interface RayHit {
  point: Vec3;
  normal: Vec3;
  t: number;
  triangle: number;
  back: boolean;
}

/** A box of the tree that a ray looks into, in the order of the visit. */
export interface WalkStep {
  min: Vec3;
  max: Vec3;
  depth: number;
  leaf: boolean;
  hit: boolean;
  /** Distance along the ray where it enters the box. */
  enter: number;
}

export interface RayWalk {
  hit: RayHit | null;
  steps: WalkStep[];
  boxes: number;
  leaves: number;
}

export interface Reason {
  cause: string;
  stage: string;
  text: string;
  measured: string;
  parameter: keyof BakeSettings | null;
  rawParameter: string | null;
  value: number;
  needed: number;
}

export interface WhyAnswer {
  walkable: boolean;
  floor: Vec3;
  reasons: Reason[];
  proven: boolean;
  bakes: number;
  apart: boolean;
  islandArea: number;
  largestIslandArea: number;
}

export interface PathAnswer {
  status: 'complete' | 'unreachable' | 'start blocked' | 'goal blocked' | 'out of nodes' | 'no start' | 'no goal';
  corners: Vec3[];
  polygons: number;
  /** Metres in the plane, and in space. */
  length: number;
  surfaceLength: number;
  /** No path is shorter, in the plane. */
  lowerBound: number;
  /** Length and lower bound are the same: no shorter path exists. */
  exact: boolean;
  /** Metres of the plain line. */
  straight: number;
  clearance: number | null;
  nodes: number;
  milliseconds: number;
  nearest?: Vec3;
}

export interface Obstacle {
  id: number;
  shape: 'cylinder' | 'box';
  base: Vec3;
  radius: number;
  height: number;
}

export interface ObstacleUpdate {
  tiles: number;
  milliseconds: number;
}

export interface OffmeshLink {
  start: Vec3;
  end: Vec3;
  bothWays: boolean;
}

export interface LinksAnswer {
  count: number;
  drops: number;
  jumps: number;
  climbs: number;
  tried: number;
  milliseconds: number;
}

export interface Finding {
  kind: string;
  point: Vec3;
  contact: Vec3;
  depth: number;
  area: number;
  count: number;
  triangle: number;
}

export interface AuditAnswer {
  findings: Finding[];
  paths: number;
  pathMetres: number;
  polygons: number;
  portals: number;
  steps: number;
  samples: number;
  contradictions: number;
  milliseconds: number;
}

/** What an eye sees: where rays in a fan around it end. */
export interface SightAnswer {
  eye: Vec3;
  rim: Vec3[];
  area: number;
  milliseconds: number;
}

/** A climb of the support function: the vertices from the start to the answer. */
export interface ClimbAnswer {
  path: Vec3[];
  neighbours: Vec3[][];
  heights: number[];
  answer: Vec3;
  vertices: number;
  faces: number;
}

/** One step of dividing a contour (polygon.h): corners in world coordinates, relative to no anchor. */
export interface PolygonStep {
  kind: 'cut' | 'merge';
  corners: Vec3[];
  partitions: Vec3[];
  outline: Vec3[];
}

export interface StepsAnswer {
  contour: number;
  contours: number;
  cuts: number;
  merges: number;
  steps: PolygonStep[];
  outline: Vec3[];
}

export interface SampleInfo {
  name: string;
  description: string;
  triangles: number;
}
