// SPDX-License-Identifier: MIT

import type { Freeable, Pose, Vec3, Vec3Like } from './base.js';
import type { Shape } from './convex.js';
import type { Soup, TriangleFilter } from './soup.js';

/** A soup or a convex shape at a pose and a scale; with neither, nothing is there. */
export interface Instance {
  soup?: Soup | null;
  /** No `points`: give a `Hull` of them. */
  shape?: Shape | null;
  /** From the instance's space to the world. Default: the identity. */
  pose?: Pose | null;
  /**
   * Factors along the instance's own axes, before the pose, mirrored where negative; one number for all. What is rounded
   * takes one size for all axes. Default 1.
   */
  scale?: number | Vec3Like | null;
  /** Your own 32 bits, by which queries ignore instances; 0 is ignored by all. Default 1. */
  mask?: number;
}

/** What a query ignores. */
export interface SceneFilter {
  /** An instance counts when its mask has a bit that is not set here. Default 0. */
  ignoredMask?: number;
  /** The first instance that is ignored, and how many: say, those of the agent that asks. */
  ignored?: readonly [first: number, count: number];
  /** What is ignored in soups. */
  triangles?: TriangleFilter;
}

/** Where a ray hit. One object serves all rays of a scene: the next call overwrites it, so copy what you keep. */
export interface SceneHit {
  /** In units of the direction's length. */
  t: number;
  instance: number;
  /** In the soup's mesh; null: the instance is a shape. */
  triangle: number | null;
  /** As of a soup's hit. */
  u: number;
  v: number;
  /** In the world; zero where the ray began inside a shape. */
  nx: number;
  ny: number;
  nz: number;
  material: number;
  back: boolean;
  /** The ray began inside a shape: t is 0. */
  inside: boolean;
}

/** What a moving shape hit. */
export interface SceneShapeHit {
  /** Share of the motion, [0, 1]; not later than the true one. */
  t: number;
  /** It overlapped at the start: t is 0. */
  initialOverlap: boolean;
  instance: number;
  triangle: number | null;
  /** Metres, of an initial overlap: moving this far along the normal separates them. */
  depth: number;
  point: Vec3;
  /** Unit, towards the shape. */
  normal: Vec3;
}

/** The nearest point of a scene. */
export interface ScenePoint {
  point: Vec3;
  /** Metres; 0 inside a shape. */
  distance: number;
  /** Zero inside a shape. */
  normal: Vec3;
  instance: number;
  triangle: number | null;
}

/**
 * Soups and convex shapes at poses that change (doors, props, vehicles), asked together. Queries answer for the last
 * `bake`, `rebake` or `refit`. Asking each instance in turn would give the same answers, bit for bit. The scene keeps what
 * its instances point to: a soup or hull that is freed meanwhile gives its memory back when the scene lets go of it.
 */
export class Scene implements Freeable {
  private constructor();
  /** Errors with the instance in `elementIndex`: TL_ERR_NOT_FINITE, TL_ERR_RANGE, TL_ERR_ARGUMENT, TL_ERR_LIMIT, TL_ERR_MEMORY. */
  static bake(instances: readonly Instance[]): Scene;
  readonly freed: boolean;
  free(): void;
  [Symbol.dispose](): void;
  /** Instances. */
  readonly count: number;
  /** Changes what is given of an instance; queries see it after the next `refit` or `rebake`, and must not be asked before. */
  set(index: number, change: Instance): void;
  /**
   * Takes the instances as they are now, in O(n). Returns the ratio of the tree's cost to what it was when it was baked:
   * from 1.5 or so it pays to `rebake`. Errors as of `bake`; the scene is unchanged then.
   */
  refit(): number;
  /** Bakes the tree anew. */
  rebake(): void;
  /** The closest hit, of equal t the lowest instance's; null: none. Shapes are solid. */
  castRay(ox: number, oy: number, oz: number, dx: number, dy: number, dz: number, maxT?: number, filter?: SceneFilter | null): SceneHit | null;
  /** Whether a ray hits anything. */
  occluded(ox: number, oy: number, oz: number, dx: number, dy: number, dz: number, maxT?: number, filter?: SceneFilter | null): boolean;
  /** Whether nothing meets the segment from a to b. */
  lineOfSight(ax: number, ay: number, az: number, bx: number, by: number, bz: number, filter?: SceneFilter | null): boolean;
  /** The nearest point at most `maxDistance` metres away, of equal distances the lowest instance's; null: none. */
  nearest(point: Vec3Like, maxDistance?: number, filter?: SceneFilter | null): ScenePoint | null;
  /** Sweeps a shape by `motion`, without rotation: what it hits first; null: the way is free. */
  castShape(shape: Shape, pose: Pose | null, motion: Vec3Like, filter?: SceneFilter | null): SceneShapeHit | null;
  /** What a shape touches, each triangle and each shape once; of a shape the triangle is null. */
  findOverlaps(shape: Shape, pose?: Pose | null, filter?: SceneFilter | null): { instance: number; triangle: number | null }[];
}
