// SPDX-License-Identifier: MIT
//
// What a navmesh is baked from and with. Names and defaults are those of tl_nav_def in `talus/nav_bake.h`, in camelCase.

import type { Aabb, BakeHooks, Vec3Like } from './base.js';

/** How a navmesh is baked. */
export interface NavOptions {
  /** Metres, > 0: edge of a voxel on x and z. Default 0.3. */
  cellSize?: number;
  /** Metres, > 0: height of a voxel. Default 0.2. */
  cellHeight?: number;
  /** Metres, > 0: free height that an agent needs. Default 2. */
  agentHeight?: number;
  /** Metres, >= 0: the walkable area is eroded by it. Default 0.6. */
  agentRadius?: number;
  /** Metres, >= 0: the highest step. Default 0.9. */
  agentMaxClimb?: number;
  /** Degrees, [0, 90). Default 45. */
  agentMaxSlope?: number;
  /** Cells: islands of fewer columns than its square are removed. Default 8. */
  regionMinSize?: number;
  /** Cells: regions of fewer columns than its square are merged. Default 20. */
  regionMergeSize?: number;
  /** Metres, >= 0: longest contour edge along a wall; 0: any. Default 12. */
  edgeMaxLen?: number;
  /** Cells, >= 0: how far a simplified contour may leave the traced one. Default 1.3. */
  edgeMaxError?: number;
  /** [3, 64]. Default 6. */
  maxVertsPerPoly?: number;
  /** Cells: spacing of height samples; < 0.9: none. Default 6. */
  detailSampleDist?: number;
  /** Voxel heights: how far the detail mesh may leave the floor. Default 1. */
  detailSampleMaxError?: number;
  /** How floors are divided into regions. Default 'watershed'. */
  partition?: 'watershed' | 'monotone' | 'layers';
  /** How contours are divided into polygons. Default 'classic'. */
  polygonMethod?: 'classic' | 'optimal' | 'delaunay';
  /** Default true. */
  filterLowHangingObstacles?: boolean;
  /** Default true. */
  filterLedgeSpans?: boolean;
  /** Default true. */
  filterWalkableLowHeightSpans?: boolean;
  /** Cells; 0: the whole level is one tile. Default 0. */
  tileSize?: number;
  /** Metres: floors of one place are divided into layers of this height; 0: they are not. Default 0. */
  tileHeight?: number;
  /** Metres: what to bake. Default: the bounds of the mesh. */
  bounds?: Aabb | null;
}

/** A volume that gives floors an area: 0 to 255, 0 is not walkable. */
export type NavVolume =
  | { type: 'box'; area: number; min: Vec3Like; max: Vec3Like }
  | { type: 'polygon'; area: number; points: ArrayLike<number>; minY: number; maxY: number }
  | { type: 'cylinder'; area: number; base: Vec3Like; radius: number; height: number };

/** What gives floors their areas. Without any all have area 63. */
export interface NavInput {
  /** One a triangle, 0 to 255; 0 is not walkable. */
  areas?: Uint8Array | null;
  /** Instead: the area of each material; of those without an entry 63. */
  materialAreas?: ArrayLike<number> | null;
  volumes?: readonly NavVolume[] | null;
}

export type NavBakeOptions = NavOptions & NavInput & BakeHooks & {
  /** Keep what temporary obstacles need (`addObstacle`). Needs a tileSize; such a navmesh is not pruned. Default false. */
  obstacles?: boolean;
  /** Islands without one of these points are removed, unless there are none. */
  reachableFrom?: readonly Vec3Like[];
  /** Remove islands inside closed parts of the mesh, which must be welded. Default false. */
  dropInsideSolids?: boolean;
  /** Square metres: smaller islands are removed. Default 0. */
  islandMinArea?: number;
};

/** Counts of a bake, summed over its tiles. */
export interface NavBakeReport {
  spanCount: number;
  compactSpanCount: number;
  regionCount: number;
  filteredRegions: number;
  filteredSpans: number;
  /** Square metres. */
  filteredArea: number;
  contourCount: number;
  unbridgedHoles: number;
  slitOutlines: number;
  repairedContours: number;
  polygonCount: number;
  vertexCount: number;
  detailTriangleCount: number;
  limitedPatches: number;
  tileCount: number;
  /** Bytes held at one time, at most. */
  peakBytes: number;
  /**
   * Milliseconds in each stage, in the order in which they began. Of a bake in tiles 'tiles' alone: they run side by side,
   * and tell no stages. `bakeStages` with `onProgress` times those of one.
   */
  times: Record<string, number>;
}

/** The defaults, all of them. */
export function defaultNavOptions(): Required<NavOptions>;
/** The number of tiles along x and z. @throws TalusError as `Navmesh.bake` does */
export function tileGrid(options: NavOptions, levelBounds: Aabb): { x: number; z: number };
