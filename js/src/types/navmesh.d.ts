// SPDX-License-Identifier: MIT

import type { Aabb, BakeHooks, Freeable, Pose, Vec3, Vec3Like } from './base.js';
import type { Shape } from './convex.js';
import type { Mesh } from './mesh.js';
import type { Soup } from './soup.js';
import type { NavBakeOptions, NavBakeReport, NavInput, NavOptions } from './nav_bake.js';
import type { Audit, AuditOptions, JumpLink, LinkOptions, LinksReport, WhyAnswer } from './nav_tools.js';

/** A reference to a polygon or an off-mesh link: 64 bits. It goes stale when its tile leaves. */
export type NavRef = bigint;

/** A point on a polygon. */
export interface NavLocation {
  polygon: NavRef;
  point: Vec3;
}

/** Which polygons may be entered, and what a metre in them costs. */
export interface NavFilter {
  /** Bits of flags; a polygon passes with one of these. Default all. */
  includeFlags?: bigint;
  /** ... and none of these. Default none. */
  excludeFlags?: bigint;
  /** Cost of a metre by area, > 0. Default 1. */
  areaCost?: Record<number, number> | ReadonlyMap<number, number>;
  /** By what share a path may be longer than the shortest one, 0 to 1; it is then found sooner. Default 0. */
  slack?: number;
}

export interface NearestOptions {
  /** Metres, half the size of the box around the point. Default [2, 4, 2]. */
  halfExtents?: Vec3Like;
  filter?: NavFilter | null;
}

export type PathStatus = 'complete' | 'unreachable' | 'out of nodes';

/** A path along the surface. Its arrays are plain ones: they take a fraction of the time of short typed arrays. */
export interface NavPath {
  /** 'unreachable' is proven; 'out of nodes': raise `maxNodes`. In both cases there are no corners. */
  status: PathStatus;
  /** x, y, z of each corner, from start to goal, metres. */
  corners: number[];
  /** The polygon that is entered at each corner. */
  cornerPolygons: bigint[];
  /** TL_NAV_CORNER_... of each: 1 start, 2 end, 4 left, 8 right, 16 takes an off-mesh link. */
  cornerFlags: number[];
  /** The polygons of the path, off-mesh links between them. Empty unless asked for. */
  polygons: bigint[];
  /** Metres in the plane. */
  length: number;
  /** Metres in the plane: no path is shorter. */
  lowerBound: number;
  /** Metres in space. */
  surfaceLength: number;
  /** Where start and goal were found on the navmesh. */
  start: NavLocation;
  goal: NavLocation;
  /** Nodes that the search used. */
  nodeCount: number;
}

export interface PathOptions extends NearestOptions {
  /** Write `polygons` too. Default false. */
  polygons?: boolean;
}

export interface WidePath {
  status: 'complete' | 'unreachable' | 'out of nodes' | 'start blocked' | 'goal blocked';
  corners: number[];
  cornerPolygons: bigint[];
  /** Metres in the plane that the path keeps from walls. */
  wallDistance: number;
  /** Metres in the plane. */
  length: number;
  /** Metres in space. */
  surfaceLength: number;
  start: NavLocation;
  goal: NavLocation;
}

export interface SurfaceRayHit {
  /** False: the end was reached. */
  hit: boolean;
  /** [0, 1] of the way in the plane. */
  t: number;
  point: Vec3;
  /** Of the wall, in the plane; zero without a hit. */
  normal: Vec3;
  polygon: NavRef;
}

export interface NavWall {
  /** Metres in the plane. */
  distance: number;
  point: Vec3;
  normal: Vec3;
  polygon: NavRef;
}

/** The polygons of all tiles, for drawing. */
export interface NavPolygons {
  count: number;
  refs: BigUint64Array;
  /** Polygon p has the corners first[p] to first[p + 1] - 1. */
  first: Uint32Array;
  /** x, y, z of each corner, metres. */
  corners: Float32Array;
  /** Of the edge that begins at each corner: the polygon across in this tile, 0xffffffff: a wall, else a portal. */
  links: Uint32Array;
  area: Uint8Array;
  flags: BigUint64Array;
  /** The tile, an index into `tiles()`. */
  tile: Uint32Array;
  /** The connected component. Between two there is no path. */
  island: Uint32Array;
}

/** The surface of all tiles, for drawing. */
export interface NavSurface {
  vertices: Float32Array;
  triangles: Uint32Array;
  /** The polygon of each triangle, an index into `polygons()`. */
  polygons: Uint32Array;
}

/** Links between polygons: the stretch of edge that both share. */
export interface NavPortals {
  count: number;
  /** Indices into `polygons()`: from, to. */
  polygons: Uint32Array;
  /** x, y, z of the left and right end, six numbers each. */
  ends: Float32Array;
}

export interface NavTileInfo {
  x: number;
  z: number;
  layer: number;
  polygonCount: number;
  /** Square metres in the plane. */
  area: number;
  /** Bytes. */
  size: number;
  bounds: Aabb;
}

/** An off-mesh link: a jump, a ladder, a door, a lift. */
export interface OffMeshLink {
  start: Vec3Like;
  end: Vec3Like;
  /** Metres: how near a polygon must be to each end. Default 0.5. */
  radius?: number;
  /** The cost is fixedCost + costFactor * its length. Defaults 1 and 0. */
  costFactor?: number;
  fixedCost?: number;
  /** Not 0. Default 1. */
  flags?: bigint;
  /** 1 to 255. Default 63. */
  area?: number;
  /** Default false: from start to end only. */
  bothWays?: boolean;
  /** The caller's own, 64 bits. Default 0. */
  user?: bigint;
}

export interface OffMeshLinkState extends Required<OffMeshLink> {
  ref: NavRef;
  /** Both ends lie at polygons: paths may use it. */
  anchored: boolean;
  /** Where they are; null: nowhere now. */
  ends: [NavLocation | null, NavLocation | null];
  /** Metres, and the cost of the link; 0 unless anchored. */
  length: number;
  cost: number;
}

/** A temporary obstacle. `area` 0 (the default) is a solid body, another one gives floors inside that area. */
export type Obstacle = { area?: number } & (
  | ({ base: Vec3Like; height: number } & (
      | { type: 'cylinder'; radius: number }
      /** Turned about y by `angle` radians, from +x towards -z. */
      | { type: 'box'; halfX: number; halfZ: number; angle?: number }
      /** A convex outline around `base`, x and z of each point, at most 16. */
      | { type: 'prism'; outline: ArrayLike<number>; angle?: number }
    ))
  /** Any shape but 'points' at any pose, null or none for the identity: a hull, a tilted box, a fallen log. A hull that is
   * freed meanwhile gives its memory back when the obstacle is gone. */
  | { type: 'convex'; shape: Exclude<Shape, { type: 'points' }>; pose?: Pose | null }
);

/** How much a navmesh is prepared. */
export interface PrepareOptions {
  /** Bytes for a table of distances. Default 32 MiB. */
  tableBytes?: number;
}

export interface Prepared {
  kind: 'none' | 'graph' | 'table';
  cornerVertexCount: number;
  edgeCount: number;
  bytes: number;
}

/** What sees what: baked from a navmesh and the soup that blocks sight. */
export interface SightOptions extends BakeHooks {
  /** Metres above the surface. Default 1.6. */
  eyeHeight?: number;
  /** Metres. Default Infinity. */
  maxDistance?: number;
}

/** The potentially visible set of each polygon. It fits its navmesh until a tile is added or removed. */
export class Sight implements Freeable {
  /** @throws TalusError TL_ERR_EMPTY (no polygon), TL_ERR_LIMIT (2^18 polygons), TL_ERR_MEMORY, TL_ERR_CANCELLED */
  static bake(navmesh: Navmesh, soup: Soup, options?: SightOptions): Sight;
  private constructor();
  readonly freed: boolean;
  free(): void;
  [Symbol.dispose](): void;
  /** Pairs of different polygons that see each other. */
  readonly pairCount: number;
  /** @throws TalusError TL_ERR_STALE */
  sees(a: NavRef, b: NavRef): boolean;
  /** The polygons that one sees, itself included. */
  seenFrom(polygon: NavRef): BigUint64Array;
}

/**
 * A navigation mesh with its tiles, its links, the memory of a search, and where it was asked for the obstacles.
 *
 * Where a point is given it is moved to the nearest polygon in the box `halfExtents` around it; a location is taken as
 * it is. The guarantees are those of `talus/nav_query.h`.
 */
export class Navmesh implements Freeable {
  /**
   * @throws TalusError TL_ERR_ARGUMENT (names the option), TL_ERR_EMPTY, TL_ERR_NOT_FINITE, TL_ERR_RANGE, TL_ERR_INDEX,
   * TL_ERR_LIMIT, TL_ERR_MEMORY, TL_ERR_CANCELLED
   */
  static bake(mesh: Mesh, options?: NavBakeOptions): Navmesh;
  /** Copies and checks tiles. `options`: what they were baked with; needed by `why`, `audit`, `rebake` and `savePack`. */
  static fromTiles(tiles: readonly Uint8Array[], options?: NavOptions): Navmesh;
  private constructor();
  readonly freed: boolean;
  free(): void;
  [Symbol.dispose](): void;

  /** What it was baked with; `bounds` are those that were baked. */
  readonly options: Required<NavOptions>;
  /** Null where it was not baked here. */
  report: NavBakeReport | null;
  /**
   * Nodes that a search may use, 2 to 2^30, 236 bytes each. Default 2^30: memory grows with need, and a search ends by
   * `'out of nodes'` only where there is none left. `linkCount() + 2` finds a path wherever there is one, and may miss the
   * shortest.
   */
  maxNodes: number;

  readonly tileCount: number;
  readonly polygonCount: number;
  tiles(): NavTileInfo[];
  /** A copy of a tile's bytes, in the order of `tiles()`: the same as natively. */
  tileBytes(index: number): Uint8Array;
  polygons(): NavPolygons;
  surface(): NavSurface;
  portals(): NavPortals;
  linkCount(): number;

  findNearest(point: Vec3Like, options?: NearestOptions): NavLocation | null;
  /** The point nearest to `point` that can be reached from `from`: on the same island. */
  findNearestReachable(from: NavLocation | Vec3Like, point: Vec3Like, options?: NearestOptions): NavLocation | null;
  /** The closest point of a polygon. @throws TalusError TL_ERR_STALE */
  closestPoint(polygon: NavRef, point: Vec3Like): { point: Vec3; inside: boolean };
  /** Metres. @throws TalusError TL_ERR_STALE */
  height(polygon: NavRef, x: number, z: number): number;
  /** The number of the polygon's connected component. @throws TalusError TL_ERR_STALE */
  island(polygon: NavRef): number;
  /** False: no path leads from start to goal, proven. @throws TalusError TL_ERR_NODES */
  isReachable(start: NavLocation | Vec3Like, goal: NavLocation | Vec3Like, options?: NearestOptions): boolean;
  /** A uniformly random point of the surface, or around a place. `random` gives [0, 1), by default Math.random. */
  randomPoint(options?: { around?: NavLocation | Vec3Like; radius?: number; filter?: NavFilter | null; random?: () => number }): NavLocation | null;

  /**
   * The shortest path in the plane, with its proof. Null: no polygon near start or goal.
   * @throws TalusError TL_ERR_STALE, TL_ERR_NOT_FINITE, TL_ERR_ARGUMENT
   */
  findPath(start: NavLocation | Vec3Like, goal: NavLocation | Vec3Like, options?: PathOptions): NavPath | null;
  /**
   * The cheapest path by area costs (A*), with its corners; where no path leads to the goal, one as near to it as any.
   */
  findRoute(start: Vec3Like, goal: Vec3Like, options?: PathOptions): NavPath & { cost: number } | null;
  /** A path for an agent of any radius from the mesh's own upwards. */
  findWidePath(start: NavLocation | Vec3Like, goal: NavLocation | Vec3Like, agentRadius: number, options?: NearestOptions): WidePath | null;
  /** The place nearest to a point where an agent of this radius may stand. */
  findWidePlace(center: NavLocation | Vec3Like, agentRadius: number, options?: NearestOptions & { radius?: number }): NavLocation | null;
  /** Makes `findPath` fast until a tile or link changes. */
  prepare(options?: PrepareOptions): Prepared;

  castRay(start: NavLocation | Vec3Like, end: Vec3Like, options?: NearestOptions): SurfaceRayHit | null;
  moveAlongSurface(start: NavLocation | Vec3Like, target: Vec3Like, options?: NearestOptions): NavLocation | null;
  findWall(center: NavLocation | Vec3Like, radius: number, options?: NearestOptions): NavWall | null;

  /** @throws TalusError TL_ERR_ARGUMENT, TL_ERR_NOT_FINITE, TL_ERR_LIMIT */
  addOffMeshLink(link: OffMeshLink): NavRef;
  /** @throws TalusError TL_ERR_STALE */
  removeOffMeshLink(ref: NavRef): void;
  offMeshLinks(): OffMeshLinkState[];

  /**
   * Adds an obstacle; `updateObstacles` makes it count. The navmesh was baked with `obstacles: true`.
   * @returns its id
   * @throws TalusError TL_ERR_ARGUMENT, TL_ERR_NOT_FINITE, TL_ERR_UNSUPPORTED (baked without obstacles)
   */
  addObstacle(obstacle: Obstacle): bigint;
  moveObstacle(id: bigint, obstacle: Obstacle): void;
  removeObstacle(id: bigint): void;
  /** Rebakes up to `maxTiles` waiting tiles, by default all. @returns how many wait still */
  updateObstacles(maxTiles?: number): number;

  /**
   * Bakes the tiles again that a change inside `changed` can have touched; `mesh` is the level as it is now.
   * @returns the number of tiles that were baked
   * @throws TalusError as `bake` does
   */
  rebake(mesh: Mesh, changed: Aabb, options?: NavInput & BakeHooks): number;

  /** Finds drops, jumps and climbs, each proven by sweeps through the soup. */
  findLinks(soup: Soup, options?: LinkOptions): { links: JumpLink[]; report: LinksReport };
  /** Adds found links; `user` is their index. They are saved with the navmesh. */
  addJumpLinks(links: readonly JumpLink[], prototype?: Partial<OffMeshLink>): void;
  /** Sweeps the agent through the soup wherever the navmesh says free. */
  audit(soup: Soup, options?: AuditOptions): Audit;
  /** Why a point is not walkable, and the setting that would make it so. `mesh`: what was baked. */
  why(mesh: Mesh, point: Vec3Like, options?: NavInput & BakeHooks): WhyAnswer;
}

/** What a conversion from or to Detour found. */
export interface DetourReport {
  tileCount: number;
  polygonCount: number;
  /** Writing: polygons whose height detail is beyond Detour's limits; written flat. Reading: with unusable detail. */
  plainPatches: number;
  /** Reading: without area or not convex; left out, their links walls. */
  droppedPolygons: number;
  /** Reading: links to a polygon that does not link back; made walls. */
  oneWayLinks: number;
  /** Off-mesh connections, read or written. */
  offMeshLinks: number;
  /** Writing: left out, since they start in no tile. */
  offMeshOutside: number;
  /** Writing: that lead farther than into the next tile; they are written, but Detour does not connect them. */
  offMeshFar: number;
  /** Reading: polygons of area 0, which became area 63. */
  areaZeros: number;
}

/**
 * Reads a navmesh of Detour, with its off-mesh connections: a set, as RecastDemo and recast-navigation's `exportNavMesh`
 * write it, or the data of one tile, with references of 32 or 64 bits. Safe on any bytes.
 * `cellHeight`: metres, heights are rounded to it, for Detour does not keep its own. Default 1/1024.
 * @throws TalusError TL_ERR_MAGIC, TL_ERR_VERSION, TL_ERR_TRUNCATED, TL_ERR_CORRUPT, TL_ERR_EMPTY, TL_ERR_NOT_FINITE,
 * TL_ERR_RANGE (a vertex is on no lattice), TL_ERR_LIMIT, TL_ERR_ARGUMENT, TL_ERR_MEMORY
 */
export function navmeshFromDetour(bytes: Uint8Array, options?: { cellHeight?: number }): { navmesh: Navmesh; report: DetourReport };
/**
 * A navmesh as a set of Detour's tiles, with its off-mesh links. `refBits`: 64 for a Detour that was compiled with
 * DT_POLYREF64. Default 32.
 * @throws TalusError TL_ERR_LIMIT: a polygon of more than 6 corners (bake with `maxVertsPerPoly: 6`), flags above the
 * lowest 16, an area above 63, a link's `user` above 32 bits; TL_ERR_ARGUMENT, TL_ERR_MEMORY
 */
export function navmeshToDetour(navmesh: Navmesh, options?: { refBits?: 32 | 64 }): { bytes: Uint8Array; report: DetourReport };
