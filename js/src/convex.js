// SPDX-License-Identifier: MIT
//
// Queries on pairs of convex shapes.

import { F64, SLOT, putPose, putVec3, slotAabb, slotVec3, wasm } from './module.js';
import { SHAPE_NUMBERS, STATUS, withShapes } from './shape.js';

// Shape A, its pose, shape B, its pose, then what else is asked.
const POSE_A = SHAPE_NUMBERS, SHAPE_B = POSE_A + 7, POSE_B = SHAPE_B + SHAPE_NUMBERS, EXTRA = POSE_B + 7;

function withPair(a, poseA, b, poseB, run) {
  return withShapes([[0, a], [SHAPE_B, b]], () => {
    putPose(POSE_A, poseA);
    putPose(POSE_B, poseB);
    return run();
  });
}

export function distance(a, poseA, b, poseB) {
  return withPair(a, poseA, b, poseB, () => {
    wasm.js_convex_distance();
    const s = SLOT;
    return { distance: F64[s], lowerBound: F64[s + 1], overlap: F64[s + 2] !== 0, pointA: slotVec3(3), pointB: slotVec3(6),
             normal: slotVec3(9), status: STATUS[F64[s + 12]], iterations: F64[s + 13] };
  });
}

export function overlap(a, poseA, b, poseB) {
  return withPair(a, poseA, b, poseB, () => wasm.js_convex_overlap() !== 0);
}

export function penetration(a, poseA, b, poseB) {
  return withPair(a, poseA, b, poseB, () => {
    if (!wasm.js_convex_penetration()) return null;
    const s = SLOT;
    return { depth: F64[s], lowerBound: F64[s + 1], upperBound: F64[s + 2], normal: slotVec3(3), pointA: slotVec3(6),
             pointB: slotVec3(9), status: STATUS[F64[s + 12]], iterations: F64[s + 13] };
  });
}

function readHit() {
  const s = SLOT;
  return { initialOverlap: F64[s] !== 0, t: F64[s + 1], gap: F64[s + 2], point: slotVec3(3), normal: slotVec3(6),
           status: STATUS[F64[s + 9]], iterations: F64[s + 10] };
}

export function cast(a, poseA, b, poseB, motion) {
  return withPair(a, poseA, b, poseB, () => {
    putVec3(EXTRA, motion);
    return wasm.js_convex_cast() ? readHit() : null;
  });
}

export function castRayAtShape(shape, pose, origin, direction, maxT = Infinity) {
  return withShapes([[0, shape]], () => {
    putPose(POSE_A, pose);
    putVec3(SHAPE_B, origin);
    putVec3(SHAPE_B + 3, direction);
    F64[SLOT + SHAPE_B + 6] = maxT;
    return wasm.js_convex_cast_ray() ? readHit() : null;
  });
}

export function contacts(a, poseA, b, poseB, { margin = 0, tolerance = 0 } = {}) {
  return withPair(a, poseA, b, poseB, () => {
    F64[SLOT + EXTRA] = margin;
    F64[SLOT + EXTRA + 1] = tolerance;
    wasm.js_convex_contacts();
    const list = Array.from({ length: F64[SLOT] }, (_, i) => ({
      pointA: slotVec3(5 + 7 * i), pointB: slotVec3(8 + 7 * i), separation: F64[SLOT + 11 + 7 * i],
    }));
    return { normal: slotVec3(1), contacts: list, status: STATUS[F64[SLOT + 4]] };
  });
}

export function shapeBounds(shape, pose = null) {
  return withShapes([[0, shape]], () => {
    putPose(POSE_A, pose);
    wasm.js_convex_bounds();
    return slotAabb(0);
  });
}
