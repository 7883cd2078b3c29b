// SPDX-License-Identifier: MIT

import type { Aabb, BakeHooks, Freeable, Pose, Vec3, Vec3Like } from './base.js';
import type { Mesh } from './mesh.js';
import type { ConvexStatus, Shape } from './convex.js';

/** How to bake a soup. */
export interface SoupOptions extends BakeHooks {
  /** 'fast': some 38 bytes a triangle; 'compact': some 17, and it cannot be refitted. Default 'fast'. */
  layout?: 'fast' | 'compact';
  /** Default 'bvh'. 'kd-tree' reproduces Ericson's article. */
  partition?: 'bvh' | 'kd-tree';
  /** Default true. */
  pairTriangles?: boolean;
  /**
   * What a bake does for faster rays, by spatial splits. 'fast': none, in 0.5 to 0.9 of the time; 'high': some 10 bytes
   * a triangle more. Default 'default': splits where they pay.
   */
  quality?: 'default' | 'fast' | 'high';
  /** The share of extra references that spatial splits add, [0, 1]. Default 0: as `quality` says. */
  splitBudget?: number;
}

export interface SoupStats {
  /** Bytes in all. */
  size: number;
  sourceTriangleCount: number;
  triangleCount: number;
  pairCount: number;
  singleCount: number;
  /** Triangles with the same three corners as one in a pair or a single, which stands for them. */
  coincidentCount: number;
  referenceCount: number;
  leafCount: number;
  nodeCount: number;
  depth: number;
  layout: 'fast' | 'compact';
}

/** What a query ignores. */
export interface TriangleFilter {
  /** 'back': only fronts count; 'front': only backs. Default 'none'. */
  cull?: 'none' | 'back' | 'front';
  /** Materials that are ignored; 63 stands for all from 63 up. */
  ignoredMaterials?: readonly number[];
  /** Called last; false ignores the triangle. Slows a query down. Must answer the same for the same triangle. */
  accept?: (triangle: number, material: number) => boolean;
}

/**
 * Where a ray hit. The point is origin + t * direction. One object serves all single rays of a soup: the next call
 * overwrites it, so copy what you keep.
 */
export interface RayHit {
  /** In units of the direction's length; of a segment in [0, 1]. */
  t: number;
  /** Index in the mesh that the soup was baked from. */
  triangle: number;
  /** The point is corner 0 * (1 - u - v) + corner 1 * u + corner 2 * v. */
  u: number;
  v: number;
  /** Unit normal of the triangle's front. */
  nx: number;
  ny: number;
  nz: number;
  material: number;
  /** The ray came from behind. */
  back: boolean;
}

/** Hits of a batch, ray by ray. */
export interface RayHits {
  /** Infinity: no hit. */
  t: Float32Array;
  /** 0xffffffff: no hit. */
  triangle: Uint32Array;
  /** u and v of each. */
  uv: Float32Array;
  /** Unit normals, three numbers each. */
  normal: Float32Array;
  material: Uint16Array;
  /** 1: the ray came from behind. */
  back: Uint8Array;
}

export interface SurfacePoint {
  point: Vec3;
  /** Metres from the query's point. */
  distance: number;
  normal: Vec3;
  triangle: number;
  material: number;
  /** The query's point lies behind the triangle's plane. */
  back: boolean;
  feature: 'face' | 'edge 0' | 'edge 1' | 'edge 2' | 'corner 0' | 'corner 1' | 'corner 2';
}

export interface ShapeHit {
  /** Share of the motion, [0, 1]; not later than the true one. */
  t: number;
  /** It overlapped at the start: t is 0. */
  initialOverlap: boolean;
  back: boolean;
  material: number;
  triangle: number;
  /** Metres, of an initial overlap: moving this far along the normal separates them. */
  depth: number;
  /** On the triangle. */
  point: Vec3;
  /** From the triangle to the shape: the face's, or an edge's or corner's own. */
  normal: Vec3;
  faceNormal: Vec3;
  /** Other than 'converged': the way is free until t, unknown beyond. */
  status: ConvexStatus;
}

/** Pairs of triangles, for drawing. A single has no second triangle: d repeats a. */
export interface SoupPairs {
  count: number;
  /** a, b, c, d of each: twelve numbers. Triangles a, b, c and a, c, d. */
  corners: Float32Array;
  /** Two indices each; 0xffffffff: a single's missing second. */
  triangles: Uint32Array;
}

/** Boxes of the tree, parents before children, depth first. */
export interface SoupBoxes {
  count: number;
  /** min x, y, z, max x, y, z of each. */
  boxes: Float32Array;
  /** 0: the root. */
  depth: Uint8Array;
  /** 1: the box holds pairs. */
  leaf: Uint8Array;
}

/**
 * A ray's walk through the tree: the boxes that it enters before its hit, and the boxes beside them that it was tested
 * against and misses; parents before children. Sorted by `enter`, they come in the order in which the ray meets them.
 */
export interface RayWalk extends SoupBoxes {
  /** 1: the ray enters the box before its hit; 0: tested, and left out. */
  entered: Uint8Array;
  /** In units of the direction's length: where the ray enters the box; Infinity where it does not. */
  enter: Float32Array;
  /** The hit itself, a copy. */
  hit: RayHit | null;
}

/** What is seen from a point, in a level plane or all around. */
export interface VisibleOutline {
  /** x, y, z of the end of each ray, in order around the eye. */
  points: Float32Array;
  /** The triangle that ends the ray; 0xffffffff: none within the distance. */
  triangles: Uint32Array;
}

/**
 * Triangles in a tree of boxes. What a ray hits is exact: none slips through an edge or a corner.
 *
 * Arguments are those of `tl_soup_...` in `talus/soup.h`, which is the reference for every guarantee.
 */
export class Soup implements Freeable {
  /**
   * @throws TalusError TL_ERR_EMPTY, TL_ERR_INDEX (triangle), TL_ERR_NOT_FINITE, TL_ERR_RANGE (vertex),
   * TL_ERR_DEGENERATE (no triangle has area), TL_ERR_LIMIT, TL_ERR_ARGUMENT, TL_ERR_MEMORY, TL_ERR_CANCELLED
   */
  static bake(mesh: Mesh, options?: SoupOptions): Soup;
  /** Copies and checks a soup's bytes. @throws TalusError TL_ERR_TRUNCATED, TL_ERR_MAGIC, TL_ERR_VERSION, TL_ERR_CORRUPT */
  static fromBytes(bytes: Uint8Array): Soup;
  private constructor();
  readonly freed: boolean;
  free(): void;
  [Symbol.dispose](): void;

  /** A copy of the soup's bytes: the same as natively. */
  toBytes(): Uint8Array;
  stats(): SoupStats;
  bounds(): Aabb;

  /**
   * The closest hit of the ray from (ox, oy, oz) along (dx, dy, dz), which may have any length but 0; t up to `maxT`,
   * by default Infinity. Null: nothing. Allocates nothing; the answer is overwritten by the next call.
   */
  castRay(ox: number, oy: number, oz: number, dx: number, dy: number, dz: number, maxT?: number,
          filter?: TriangleFilter | null): RayHit | null;
  /** Whether the ray hits anything. Faster. */
  occluded(ox: number, oy: number, oz: number, dx: number, dy: number, dz: number, maxT?: number,
           filter?: TriangleFilter | null): boolean;
  /** The hit of the segment from a to b that is closest to a. Both ends are exact. */
  castSegment(ax: number, ay: number, az: number, bx: number, by: number, bz: number,
              filter?: TriangleFilter | null): RayHit | null;
  /** Whether no triangle meets the closed segment from a to b. */
  lineOfSight(ax: number, ay: number, az: number, bx: number, by: number, bz: number,
              filter?: TriangleFilter | null): boolean;
  /**
   * The closest hits of many rays, for each what `castRay` gives.
   * @param rays seven numbers a ray: origin, direction, the largest t
   * @param out to be filled instead of new arrays; they must be long enough
   */
  castRays(rays: Float32Array, filter?: TriangleFilter | null, out?: Partial<RayHits> | null): RayHits;
  /**
   * The hits closest to the starts of many segments, for each what `castSegment` gives: t in [0, 1].
   * @param segments six numbers each: its start and its end
   */
  castSegments(segments: Float32Array, filter?: TriangleFilter | null, out?: Partial<RayHits> | null): RayHits;
  /**
   * Whether rays hit anything, for each what `occluded` gives: 1 or 0. Faster than `castRays`.
   * @param rays seven numbers a ray: origin, direction, the largest t
   */
  occludedRays(rays: Float32Array, filter?: TriangleFilter | null, out?: Uint8Array | null): Uint8Array;
  /**
   * Whether segments are clear, for each what `lineOfSight` gives: 1 or 0.
   * @param segments six numbers each: its start and its end
   */
  linesOfSight(segments: Float32Array, filter?: TriangleFilter | null, out?: Uint8Array | null): Uint8Array;
  /**
   * All hits of a ray, sorted by t. 'touched': every triangle that the ray touches; 'crossed': every passage through a
   * surface once, also through an edge or a corner.
   * @throws TalusError TL_ERR_NOT_FINITE, TL_ERR_ARGUMENT (direction, maxT)
   */
  castRayAll(origin: Vec3Like, direction: Vec3Like,
             options?: { maxT?: number; rule?: 'touched' | 'crossed'; filter?: TriangleFilter | null }): RayHit[];
  /** The nearest point at most `maxDistance` metres away, by default Infinity. @throws TalusError TL_ERR_NOT_FINITE */
  nearest(point: Vec3Like, maxDistance?: number, filter?: TriangleFilter | null): SurfacePoint | null;
  /** Whether a shape touches any triangle. @throws TalusError TL_ERR_NOT_FINITE, TL_ERR_ARGUMENT (a radius) */
  overlaps(shape: Shape, pose?: Pose | null, filter?: TriangleFilter | null): boolean;
  /** The triangles that a shape touches, each once. */
  findOverlaps(shape: Shape, pose?: Pose | null, filter?: TriangleFilter | null): Uint32Array;
  /** Sweeps a shape by `motion`, metres, without turning it. Null: the way is free. */
  castShape(shape: Shape, pose: Pose | null, motion: Vec3Like, filter?: TriangleFilter | null): ShapeHit | null;
  /**
   * Whether a point lies inside a closed surface, exactly.
   * @throws TalusError TL_ERR_NOT_CLOSED, TL_ERR_WINDING: the surface is not closed
   */
  locate(point: Vec3Like): { side: 'outside' | 'inside' | 'on surface'; winding: number; triangle: number | null };
  /** @throws TalusError TL_ERR_NOT_CLOSED, TL_ERR_WINDING, with a triangle: the triangles enclose no volume */
  checkClosed(): void;
  /** Triangles that may touch a box. */
  trianglesInBox(box: Aabb): Uint32Array;
  /**
   * Moves the triangles to where the mesh's vertices are now: the same triangles at other positions. Not with the
   * compact layout.
   */
  refit(mesh: Mesh): void;

  /** All pairs and singles. */
  pairs(): SoupPairs;
  /** The boxes of the tree down to a depth, by default all. */
  boxes(maxDepth?: number): SoupBoxes;
  /** A ray's walk through the tree. */
  walkRay(origin: Vec3Like, direction: Vec3Like, maxT?: number): RayWalk;
  /** Where `count` level rays around an eye end, at most `distance` metres away: what a guard sees. */
  visibleOutline(eye: Vec3Like, options?: {
    /** Rays, by default 720. */
    count?: number;
    /** Metres. Default 50. */
    distance?: number;
    /** Radians from +x towards +z: the middle of the field of view. Default 0. */
    heading?: number;
    /** Radians. Default all around. */
    fieldOfView?: number;
  }): VisibleOutline;
}
