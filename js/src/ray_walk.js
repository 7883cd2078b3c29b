// SPDX-License-Identifier: MIT
//
// What a ray meets in the tree, and what is seen around a point: for drawing.

/** The boxes that a ray enters before `end`, and those beside them that it was tested against. */
export function walkBoxes(tree, origin, direction, end, hit) {
  const kept = [], entered = [], enters = [];
  const parentEntered = [true]; // by depth: whether the box above was entered
  for (let i = 0; i < tree.count; i++) {
    const depth = tree.depth[i];
    if (!parentEntered[depth]) {
      parentEntered[depth + 1] = false;
      continue;
    }
    const enter = enterBox(tree.boxes, 6 * i, origin, direction, end);
    parentEntered[depth + 1] = enter < Infinity;
    kept.push(i);
    entered.push(enter < Infinity ? 1 : 0);
    enters.push(enter);
  }
  const boxes = new Float32Array(6 * kept.length);
  kept.forEach((box, i) => boxes.set(tree.boxes.subarray(6 * box, 6 * box + 6), 6 * i));
  return { count: kept.length, boxes, depth: Uint8Array.from(kept, (i) => tree.depth[i]),
           leaf: Uint8Array.from(kept, (i) => tree.leaf[i]), entered: Uint8Array.from(entered),
           enter: Float32Array.from(enters), hit };
}

/** Where a ray enters a closed box within [0, end], or Infinity: the slab test. */
function enterBox(boxes, at, origin, direction, end) {
  let near = 0, far = end;
  for (let axis = 0; axis < 3; axis++) {
    const low = boxes[at + axis] - origin[axis], high = boxes[at + 3 + axis] - origin[axis], d = direction[axis];
    if (d === 0) {
      if (low > 0 || high < 0) return Infinity;
    } else {
      near = Math.max(near, Math.min(low / d, high / d));
      far = Math.min(far, Math.max(low / d, high / d));
    }
  }
  return near <= far ? near : Infinity;
}

/** The ends of level rays around an eye. */
export function visibleOutline(soup, eye, { count = 720, distance = 50, heading = 0, fieldOfView = 2 * Math.PI } = {}) {
  const rays = new Float32Array(7 * count);
  const open = fieldOfView < 2 * Math.PI; // all around, the last ray is not the first one again
  for (let i = 0; i < count; i++) {
    const angle = heading + fieldOfView * (i / Math.max(1, open ? count - 1 : count) - 0.5);
    rays.set([eye[0], eye[1], eye[2], Math.cos(angle), 0, Math.sin(angle), distance], 7 * i);
  }
  const hits = soup.castRays(rays);
  const points = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) {
    const t = Math.min(hits.t[i], distance);
    for (let axis = 0; axis < 3; axis++) points[3 * i + axis] = rays[7 * i + axis] + t * rays[7 * i + 3 + axis];
  }
  return { points, triangles: hits.triangle };
}
