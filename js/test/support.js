// SPDX-License-Identifier: MIT
//
// What the tests share: the module, with SIMD or (TALUS_SCALAR=1) without, with one thread or (TALUS_THREADS=4) more, and
// a level.

import { Mesh, Navmesh, Soup, init, sampleLevel } from '../src/index.js';

export { errorOf } from './errors.js';

await init({ simd: !process.env.TALUS_SCALAR, threads: Number(process.env.TALUS_THREADS ?? 1) });

/** A floor 10 m square, two triangles, facing up. */
export const floor = () => new Mesh([-5, 0, -5, -5, 0, 5, 5, 0, 5, 5, 0, -5], [0, 1, 2, 0, 2, 3]);

/** A unit cube around the origin, closed. */
export function cube(half = 1) {
  const vertices = [];
  for (let i = 0; i < 8; i++) vertices.push(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  const quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  return new Mesh(vertices, quads.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]));
}

let level = null;
export function courtyard() {
  if (level === null) {
    const source = sampleLevel('courtyard');
    const { mesh } = source.weld();
    level = { source, mesh, soup: Soup.bake(source), navmesh: Navmesh.bake(mesh) };
  }
  return level;
}

/** Numbers in [0, 1) that are the same every time (mulberry32). */
export function randomNumbers(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}
