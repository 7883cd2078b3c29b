// SPDX-License-Identifier: MIT

import type { Aabb, BakeHooks } from './base.js';

/** What `Mesh.weld` did. */
export interface WeldReport {
  /** Vertices that became another one. */
  weldedVertices: number;
  /** Vertices that no kept triangle uses. */
  unusedVertices: number;
  /** Dropped: two equal corners, or no area in exact arithmetic. */
  degenerateTriangles: number;
  /** Dropped: same corners and winding as an earlier one. */
  duplicateTriangles: number;
}

export interface WeldOptions extends BakeHooks {
  /** Metres, >= 0: vertices this near to an earlier one become it. Default 0: only equal positions. */
  weldTolerance?: number;
  /** Keep triangles that repeat another one's three vertices in the same winding. Default false. */
  keepDuplicates?: boolean;
}

/**
 * A triangle list: plain arrays, which the mesh keeps and does not copy. It holds no memory of the module, and may be
 * posted to a worker (`mesh.vertices` and the others, not the mesh itself).
 */
export class Mesh {
  /**
   * @param vertices x, y, z of each vertex, metres
   * @param indices three a triangle; left out: each three vertices are a triangle
   * @param materials one a triangle, 0 to 65535; left out: all 0
   * @throws TalusError TL_ERR_ARGUMENT where lengths do not fit; what the numbers hold is checked by the bakes
   */
  constructor(vertices: ArrayLike<number>, indices?: ArrayLike<number> | null, materials?: ArrayLike<number> | null);
  readonly vertices: Float32Array;
  readonly indices: Uint32Array;
  readonly materials: Uint16Array | null;
  readonly vertexCount: number;
  readonly triangleCount: number;
  /** The box of all vertices, those that no triangle uses too. */
  bounds(): Aabb;
  /**
   * A copy of unique vertices and of triangles with area. `sourceTriangles[i]` is the triangle here that triangle i of
   * the copy came from.
   * @throws TalusError TL_ERR_EMPTY, TL_ERR_NOT_FINITE, TL_ERR_RANGE (vertex), TL_ERR_INDEX (triangle), TL_ERR_ARGUMENT
   */
  weld(options?: WeldOptions): { mesh: Mesh; sourceTriangles: Uint32Array; report: WeldReport };
}

/** A built-in level, in the order that `talus sample --help` lists them. */
export interface SampleInfo {
  name: string;
  description: string;
  /** Triangles of the level unless told otherwise. */
  defaultTriangles: number;
}
export function sampleLevels(): SampleInfo[];
/**
 * Builds a built-in level: the triangles of `talus sample NAME`.
 * @throws TalusError TL_ERR_NOT_FOUND: there is no level of that name; TL_ERR_LIMIT: too many triangles
 */
export function sampleLevel(name: string, options?: { triangles?: number; seed?: number | bigint }): Mesh;
