// SPDX-License-Identifier: MIT

import type { Aabb, BakeHooks, Freeable, Pose, Vec3, Vec3Like } from './base.js';
import type { Mesh } from './mesh.js';

/** How far an answer can be trusted. */
export type ConvexStatus = 'converged' | 'iterations' | 'degenerate' | 'not finite';

/** A convex shape in its own frame. `radius` rounds it: metres, >= 0, by default 0. */
export type Shape =
  | { type: 'sphere'; center?: Vec3Like; radius: number }
  | { type: 'capsule'; a: Vec3Like; b: Vec3Like; radius: number }
  | { type: 'box'; center?: Vec3Like; halfExtents: Vec3Like; radius?: number }
  | { type: 'triangle'; a: Vec3Like; b: Vec3Like; c: Vec3Like; radius?: number }
  | { type: 'cylinder'; a: Vec3Like; b: Vec3Like; discRadius: number; radius?: number }
  | { type: 'cone'; base: Vec3Like; apex: Vec3Like; discRadius: number; radius?: number }
  | { type: 'points'; points: ArrayLike<number>; radius?: number }
  | { type: 'hull'; hull: Hull; radius?: number }
  | Hull;

export interface HullOptions extends BakeHooks {
  /** 0: no limit, else >= 4. Default 0. */
  maxVertices?: number;
  /** Metres, >= 0: points may lie this far outside, for fewer corners. Default 0: none does. */
  tolerance?: number;
  /** Metres, >= 0: how thick input without volume is made. Default 0: it is refused. */
  thickness?: number;
  /** Half ulps of the largest coordinate: input this thin counts as flat. Default 8. */
  flatness?: number;
  /** Metres, >= 0: corners within this of an earlier one are left out. Default 0: only equal points are one. */
  weldDistance?: number;
  /** Metres, >= 0: nearly coplanar faces whose corners lie within this are one. 1e-5 of the size undoes rounding. Default 0. */
  mergeDistance?: number;
}

export interface HullReport {
  /** Before coplanar ones were merged. */
  triangleCount: number;
  thickened: boolean;
  /** Points outside, because maxVertices was reached or for the tolerance. */
  pointsLeftOut: number;
  /** Metres: no point of the input lies farther outside of the hull. */
  maxOutside: number;
  /** Of the exact hull, by weldDistance and mergeDistance. */
  cornersLeftOut: number;
}

/** For density 1. */
export interface HullMass {
  /** Cubic metres. */
  volume: number;
  /** Square metres. */
  area: number;
  center: Vec3;
  /** About the centre: xx, yy, zz, xy, xz, yz of the tensor. */
  inertia: Float64Array;
}

/** Where a ray enters a hull. */
export interface HullHit {
  /** In units of the direction's length; 0 when the origin is inside. */
  t: number;
  /** Null when the origin is inside. */
  face: number | null;
  normal: Vec3;
}

/** The convex hull of points: exact, at any scale. */
export class Hull implements Freeable {
  /**
   * @param points x, y, z of each, metres
   * @throws TalusError TL_ERR_EMPTY, TL_ERR_NOT_FINITE, TL_ERR_RANGE (point), TL_ERR_COINCIDENT, TL_ERR_COLLINEAR,
   * TL_ERR_COPLANAR (no volume), TL_ERR_ARGUMENT, TL_ERR_LIMIT, TL_ERR_MEMORY, TL_ERR_CANCELLED
   */
  static bake(points: ArrayLike<number>, options?: HullOptions): Hull;
  /** Copies and checks a hull's bytes. */
  static fromBytes(bytes: Uint8Array): Hull;
  private constructor();
  readonly freed: boolean;
  free(): void;
  [Symbol.dispose](): void;

  /** Null for a hull that came from bytes, or from `decompose`. */
  report: HullReport | null;
  /** A copy of the hull's bytes: the same as natively. */
  toBytes(): Uint8Array;
  /** A copy of this hull: scaled along its own axes, then turned and moved. A negative scale mirrors. */
  transform(scale: Vec3Like, pose?: Pose | null): Hull;

  readonly vertexCount: number;
  readonly faceCount: number;
  bounds(): Aabb;
  mass(): HullMass;
  /** x, y, z of each vertex. */
  vertices(): Float32Array;
  /** The input point of each vertex. */
  sources(): Uint32Array;
  /** Faces are polygons: face f has the corners `indices[first[f]]` to `indices[first[f + 1] - 1]`. */
  faces(): { first: Uint32Array; indices: Uint32Array };
  /** Faces as triangles, three vertices each: for drawing. */
  triangles(): Uint32Array;
  /** Edges, two vertices each, each edge once: for drawing. */
  edges(): Uint32Array;

  /** The vertex farthest along a direction, exactly; `hint` is a vertex to begin at, and changes the time only. */
  support(x: number, y: number, z: number, hint?: number): number;
  /**
   * The climb of the article: from `start` (by default 0) always to the neighbour farthest along the direction, until
   * none is farther. The vertices visited, the last of which is a farthest one.
   */
  supportClimb(direction: Vec3Like, start?: number): Uint32Array;
  castRay(origin: Vec3Like, direction: Vec3Like, maxT?: number): HullHit | null;
  /** Whether a point lies in the closed hull, exactly. */
  contains(point: Vec3Like): boolean;
}

export interface Separation {
  /** Metres between the witness points; 0 on overlap. */
  distance: number;
  /** Metres; the true distance is not less. */
  lowerBound: number;
  overlap: boolean;
  /** On A's surface, in the world. */
  pointA: Vec3;
  pointB: Vec3;
  /** Unit, from A to B; zero on overlap. */
  normal: Vec3;
  status: ConvexStatus;
  iterations: number;
}

export interface Penetration {
  /** Metres: moving B this far along the normal separates the shapes. */
  depth: number;
  lowerBound: number;
  upperBound: number;
  normal: Vec3;
  pointA: Vec3;
  pointB: Vec3;
  status: ConvexStatus;
  iterations: number;
}

export interface ConvexHit {
  initialOverlap: boolean;
  /** Fraction of the motion; never later than the true one but for rounding. */
  t: number;
  /** Metres still between the shapes at t. */
  gap: number;
  /** On A's surface. */
  point: Vec3;
  /** From A to B. */
  normal: Vec3;
  status: ConvexStatus;
  iterations: number;
}

export interface ContactManifold {
  /** From A to B. */
  normal: Vec3;
  /** At most four. A negative separation is a depth. */
  contacts: { pointA: Vec3; pointB: Vec3; separation: number }[];
  status: ConvexStatus;
}

/** Distance and nearest points of two shapes. A pose that is null is the identity. */
export function distance(a: Shape, poseA: Pose | null, b: Shape, poseB: Pose | null): Separation;
/** Whether two shapes share a point. Cheaper than the distance. */
export function overlap(a: Shape, poseA: Pose | null, b: Shape, poseB: Pose | null): boolean;
/** The shortest motion that separates two shapes. Null: they are apart. */
export function penetration(a: Shape, poseA: Pose | null, b: Shape, poseB: Pose | null): Penetration | null;
/** Moves B by `motion`, metres, and finds when it first touches A. Null: it does not. */
export function cast(a: Shape, poseA: Pose | null, b: Shape, poseB: Pose | null, motion: Vec3Like): ConvexHit | null;
/** Where two shapes rest on each other. Lengths in metres, by default 0. */
export function contacts(a: Shape, poseA: Pose | null, b: Shape, poseB: Pose | null,
                         limits?: { margin?: number; tolerance?: number }): ContactManifold;
/** Casts a ray at a shape. */
export function castRayAtShape(shape: Shape, pose: Pose | null, origin: Vec3Like, direction: Vec3Like,
                               maxT?: number): ConvexHit | null;
/** The box of a shape in the world. */
export function shapeBounds(shape: Shape, pose?: Pose | null): Aabb;

export interface DecomposeOptions extends BakeHooks {
  /** Metres, >= 0: the concavity that a part may have. Default 0: as `relativeTolerance` says. */
  tolerance?: number;
  /** Above 0, up to 1: share of the longest side of the mesh's box. Default 0.025. */
  relativeTolerance?: number;
  /** 0: no limit; else parts are merged beyond the tolerance until there are no more. Default 0. */
  maxParts?: number;
  /** Of a part's hull: 0, no limit, or >= 4. The mesh may then reach out of the hulls. Default 256. */
  maxVertices?: number;
  /** Metres, >= 0 and at most the tolerance, of the hull of a flat part. Default 0: a sixteenth of the tolerance. */
  thickness?: number;
  /** 'enclosed': what cannot be reached from outside is solid; 'surface': rooms of a level stay open. Default 'enclosed'. */
  solid?: 'enclosed' | 'surface';
  /** 4,096 to 67,108,864 cells of the grid that guides the cuts, 8 bytes each. Fewer cost more parts, but no truth. Default 1,048,576. */
  maxCells?: number;
}

export interface ConvexPart {
  /** To be freed, like every hull. */
  hull: Hull;
  /** Metres: no point of the hull is farther from the body. Proven, not sampled. */
  concavity: number;
  /** Metres: no point of the mesh that this part covers is farther outside of its hull. */
  maxOutside: number;
}

/** Convex parts of a mesh, which may overlap; those of largest volume come first. */
export interface Decomposition {
  parts: ConvexPart[];
  /** Metres, the largest of the parts. */
  concavity: number;
  /** Metres, the largest of the parts. */
  maxOutside: number;
  report: {
    /** Metres, that was asked for. */
    tolerance: number;
    /** Metres, side of the grid's cells. */
    cell: number;
    /** Without area: left out. */
    degenerateTriangles: number;
    cutCount: number;
    partsBeforeMerging: number;
    /** Because of `maxParts`, or because they could not be cut any finer. */
    partsOverTolerance: number;
  };
}

/**
 * Divides a mesh into convex parts, none of which reaches farther from the body than a tolerance. The mesh may be open,
 * intersect itself, or be loose triangles. It takes from a tenth of a second to some seconds: `TalusWorker` has it too.
 * @throws TalusError TL_ERR_ARGUMENT (a field), TL_ERR_EMPTY, TL_ERR_DEGENERATE (no triangle has area), TL_ERR_INDEX,
 * TL_ERR_NOT_FINITE, TL_ERR_RANGE (the tolerance is below the coordinates' rounding, or one is beyond 1e9),
 * TL_ERR_LIMIT (more than 65,536 parts), TL_ERR_MEMORY, TL_ERR_CANCELLED
 */
export function decompose(mesh: Mesh, options?: DecomposeOptions): Decomposition;
