// SPDX-License-Identifier: MIT
//
// The stages of a bake, as typed arrays for drawing. All are copies: they hold no memory of the module, and may be
// posted to and from a worker.

import type { Aabb, BakeHooks } from './base.js';
import type { Mesh } from './mesh.js';
import type { NavInput, NavOptions } from './nav_bake.js';

/** Where columns lie: column (x, z) covers origin + [x, x + 1) * cellSize along x, the same along z. */
export interface StageGrid {
  /** Columns, border included. */
  width: number;
  height: number;
  /** Metres; min is the lower corner of column (0, 0) and of height 0. */
  bounds: Aabb;
  /** Metres. */
  cellSize: number;
  cellHeight: number;
  /** Columns on each side that belong to the neighbour tiles. */
  borderSize: number;
}

/** Solid spans after the filters. */
export interface HeightfieldStage extends StageGrid {
  spanCount: number;
  /** Column c holds the spans firstSpan[c] to firstSpan[c + 1] - 1; c = z * width + x. */
  firstSpan: Uint32Array;
  /** Voxels. */
  min: Uint16Array;
  max: Uint16Array;
  /** Of the top; 0: not walkable. */
  area: Uint8Array;
}

/** Floors above walkable spans, after erosion, areas, distance field and regions. */
export interface CompactStage extends StageGrid {
  spanCount: number;
  firstSpan: Uint32Array;
  /** Voxels: where an agent stands. */
  floor: Uint16Array;
  /** Voxels of free height. */
  clearance: Uint16Array;
  area: Uint8Array;
  /** Twice the distance to the border in columns; empty where the partition needs none. */
  distance: Uint16Array;
  maxDistance: number;
  /** 0: none; the highest bit: it fills the tile's border. */
  region: Uint32Array;
  regionCount: number;
  /** Four a floor: the floor beside it towards -x, +z, +x, -z, or 0xffffffff. */
  neighbours: Uint32Array;
}

/** Outlines: outline i has the vertices firstVertex[i] to firstVertex[i + 1] - 1, closed. */
export interface OutlineStage {
  count: number;
  firstVertex: Uint32Array;
  /** x, y, z in the world, metres, of each vertex. */
  vertices: Float32Array;
  region: Uint32Array;
  area: Uint8Array;
}

/** Convex polygons: polygon p has the corners first[p] to first[p + 1] - 1. */
export interface PolygonStage {
  count: number;
  first: Uint32Array;
  /** Of each corner: its vertex. */
  indices: Uint32Array;
  /** Of the edge that begins at each corner: the polygon across, 0xffffffff: a wall, 0xfffffff0 | side: a portal. */
  neighbours: Uint32Array;
  /** x, y, z in the world, metres, of each vertex. */
  vertices: Float32Array;
  region: Uint32Array;
  area: Uint8Array;
}

/** The detail mesh. */
export interface DetailStage {
  /** x, y, z, metres. */
  vertices: Float32Array;
  /** Three a triangle. */
  triangles: Uint32Array;
  /** The polygon of each triangle. */
  polygons: Uint32Array;
  /** Metres. */
  maxError: number;
}

/** How contours become polygons, step by step: cuts and then merges, contour by contour. Points are x, y, z, metres. */
export interface PolygonSteps {
  count: number;
  /** 0: a triangle is cut off; 1: two polygons become one. */
  kind: Uint8Array;
  contour: Uint32Array;
  /** Of each step, count + 1: its partitions in `partitions`, two points each, the chosen one first. */
  firstPartition: Uint32Array;
  partitions: Float32Array;
  /** Its points in `outline`: what was left of the outline before a cut. */
  firstOutline: Uint32Array;
  outline: Float32Array;
  /** Its points in `corners`: the triangle that was cut off, or the merged polygon. */
  firstCorner: Uint32Array;
  corners: Float32Array;
}

/** All stages of one tile. */
export interface BakeStages {
  tileX: number;
  tileZ: number;
  heightfield: HeightfieldStage;
  compact: CompactStage;
  /** Traced, then simplified. Holes are bridged in the simplified ones. */
  contours: { raw: OutlineStage; simplified: OutlineStage };
  polygons: PolygonStage;
  detail: DetailStage;
}

/**
 * Bakes one tile and keeps what the stages hand to one another.
 * @throws TalusError as `Navmesh.bake` does
 */
export function bakeStages(mesh: Mesh, options?: NavOptions & NavInput & BakeHooks & { tileX?: number; tileZ?: number }): BakeStages;

/**
 * Divides the contours of a tile again, with every step. Takes time that grows with the square of a contour's vertices.
 * Of the methods 'classic' is followed wholly, the others as far as they share its steps.
 */
export function polygonSteps(mesh: Mesh, options?: NavOptions & NavInput & BakeHooks & {
  tileX?: number;
  tileZ?: number;
  /** That contour alone, an index into `contours.simplified`. Default: all. */
  contour?: number;
}): PolygonSteps;
