// SPDX-License-Identifier: MIT
//
// Shapes in the slot (wasm/js_convex.c). Points are copied into the module for the time of a call.

import { argumentError } from './error.js';
import { F64, SLOT, copyIn, putVec3, ready, release } from './module.js';

export const SHAPE_NUMBERS = 13;
export const STATUS = ['converged', 'iterations', 'degenerate', 'not finite'];

const ORIGIN = [0, 0, 0];
// The three vectors of each type, in its order.
const VECTORS = {
  sphere: (s) => [s.center ?? ORIGIN],
  capsule: (s) => [s.a, s.b],
  box: (s) => [s.center ?? ORIGIN, s.halfExtents],
  triangle: (s) => [s.a, s.b, s.c],
  cylinder: (s) => [s.a, s.b, [s.discRadius, 0, 0]],
  cone: (s) => [s.base, s.apex, [s.discRadius, 0, 0]],
  points: () => [],
  hull: () => [],
};
const KINDS = Object.keys(VECTORS);

/** The hull of a shape that is one; null for others. */
export function hullOf(shape) {
  return shape.supportClimb !== undefined ? shape : shape.type === 'hull' ? shape.hull : null;
}

/** Runs a call with shapes written to the slot: pairs of where and what. */
export function withShapes(shapes, run) {
  ready();
  const blocks = [];
  try {
    for (const [at, given] of shapes) {
      const shape = given?.type === undefined ? { type: 'hull', hull: given } : given;
      const kind = KINDS.indexOf(shape.type);
      if (kind < 0 || (shape.type === 'hull' && shape.hull?.supportClimb === undefined)) {
        throw argumentError('shape', `give a Hull, or an object of a type among ${KINDS.join(', ')}`);
      }
      let pointer = 0, count = 0;
      if (shape.type === 'hull') pointer = shape.hull._address;
      if (shape.type === 'points') {
        const points = Float32Array.from(shape.points);
        if (points.length < 3 || points.length % 3 !== 0) throw argumentError('points', 'give three numbers a point, at least one point');
        count = points.length / 3;
        pointer = copyIn(points);
        blocks.push(pointer);
      }
      const vectors = VECTORS[shape.type](shape);
      if (vectors.some((v) => v?.length === undefined)) throw argumentError('shape', `a ${shape.type} lacks one of its points`);
      F64[SLOT + at] = kind;
      F64[SLOT + at + 1] = shape.radius ?? 0;
      F64[SLOT + at + 2] = pointer;
      F64[SLOT + at + 3] = count;
      for (let i = 0; i < 3; i++) putVec3(at + 4 + 3 * i, vectors[i] ?? ORIGIN);
    }
    return run();
  } finally {
    blocks.forEach(release);
  }
}
