// SPDX-License-Identifier: MIT
//
// Triangles in a tree. A single ray allocates nothing: its numbers are arguments, its hit is read from where the module
// leaves it into one object.

import { argumentError } from './error.js';
import { Handle, PRIVATE, refuseNew } from './handle.js';
import { withInput } from './mesh.js';
import { F32, F64, SLOT, U16, U32, U8, accepting, check, copyIn, copyOut, fail, putAabb, putPose, putVec3, ready, release,
         slotAabb, slotVec3, wasm, watched } from './module.js';
import { putBatch, takeAnswers, takeHits } from './soup_batch.js';
import { visibleOutline, walkBoxes } from './ray_walk.js';
import { SHAPE_NUMBERS, STATUS, withShapes } from './shape.js';

const NO_TRIANGLE = 0xffffffff;
const HIT_WORDS = 8; // tl_ray_hit: t, triangle, u, v, normal, material and back
const FEATURES = ['face', 'edge 0', 'edge 1', 'edge 2', 'corner 0', 'corner 1', 'corner 2'];

let hitWord = 0; // index of the single ray's hit in F32

function newHit() {
  return { t: 0.5, triangle: 0, u: 0.5, v: 0.5, nx: 0.5, ny: 0.5, nz: 0.5, material: 0, back: false };
}

function readHit(hit, word) {
  hit.t = F32[word];
  hit.triangle = U32[word + 1];
  hit.u = F32[word + 2];
  hit.v = F32[word + 3];
  hit.nx = F32[word + 4];
  hit.ny = F32[word + 5];
  hit.nz = F32[word + 6];
  hit.material = U16[2 * word + 14];
  hit.back = U8[4 * word + 30] !== 0;
  return hit;
}

/** The module's filter, or 0. */
function putFilter(filter) {
  const cull = ['none', 'back', 'front'].indexOf(filter.cull ?? 'none');
  if (cull < 0) throw argumentError('cull', "one of 'none', 'back', 'front'");
  let low = 0, high = 0;
  for (const material of filter.ignoredMaterials ?? []) {
    if (material < 32) low |= 1 << material;
    else high |= 1 << (Math.min(material, 63) - 32);
  }
  return wasm.js_set_ray_filter(cull, low, high, filter.accept ? 1 : 0);
}

/** Runs a query with a filter; what its function throws is thrown. */
export function filtered(filter, run) {
  if (!filter) return run(0);
  const address = putFilter(filter);
  if (!filter.accept) return run(address);
  const result = accepting(filter.accept, () => run(address));
  check(0);
  return result;
}

export class Soup extends Handle {
  #hit = newHit();

  constructor(key, address, free) {
    refuseNew(key, 'Soup');
    super(address, free);
    hitWord = wasm.js_ray_hit() / 4;
  }

  static bake(mesh, options = {}) {
    const layout = ['fast', 'compact'].indexOf(options.layout ?? 'fast');
    const partition = ['bvh', 'kd-tree'].indexOf(options.partition ?? 'bvh');
    if (layout < 0) throw argumentError('layout', "'fast' or 'compact'");
    if (partition < 0) throw argumentError('partition', "'bvh' or 'kd-tree'");
    const quality = ['default', 'fast', 'high'].indexOf(options.quality ?? 'default');
    if (quality < 0) throw argumentError('quality', "one of 'default', 'fast', 'high'");
    return withInput(mesh, null, () => {
      const address = watched(options, null, () => wasm.js_soup_bake(
        layout, partition, options.pairTriangles === false ? 0 : 1, options.splitBudget ?? 0, quality)) >>> 0;
      if (address === 0) {
        check(F64[SLOT]);
        fail(F64[SLOT]);
      }
      return new Soup(PRIVATE, address, 'js_blob_free');
    });
  }

  static fromBytes(bytes) {
    ready();
    const address = copyIn(bytes);
    try {
      check(wasm.js_soup_check(address, bytes.length));
    } catch (error) {
      release(address);
      throw error;
    }
    return new Soup(PRIVATE, address, 'js_free');
  }

  toBytes() {
    const { size } = this.stats();
    return U8.slice(this._address, this._address + size);
  }

  stats() {
    wasm.js_soup_info(this._address);
    const s = SLOT;
    return { size: F64[s], sourceTriangleCount: F64[s + 1], triangleCount: F64[s + 2], pairCount: F64[s + 3],
             singleCount: F64[s + 4], referenceCount: F64[s + 5], leafCount: F64[s + 6], nodeCount: F64[s + 7],
             depth: F64[s + 8], layout: F64[s + 9] === 1 ? 'compact' : 'fast', coincidentCount: F64[s + 10] };
  }

  bounds() {
    wasm.js_soup_info(this._address);
    return slotAabb(11);
  }

  castRay(ox, oy, oz, dx, dy, dz, maxT = Infinity, filter = null) {
    const soup = this._address;
    const hit = filter ? filtered(filter, (f) => wasm.js_soup_cast_ray(soup, ox, oy, oz, dx, dy, dz, maxT, f))
                       : wasm.js_soup_cast_ray(soup, ox, oy, oz, dx, dy, dz, maxT, 0);
    return hit !== 0 ? readHit(this.#hit, hitWord) : null;
  }

  occluded(ox, oy, oz, dx, dy, dz, maxT = Infinity, filter = null) {
    const soup = this._address;
    return filtered(filter, (f) => wasm.js_soup_occluded(soup, ox, oy, oz, dx, dy, dz, maxT, f)) !== 0;
  }

  castSegment(ax, ay, az, bx, by, bz, filter = null) {
    const soup = this._address;
    const hit = filtered(filter, (f) => wasm.js_soup_cast_segment(soup, ax, ay, az, bx, by, bz, f));
    return hit !== 0 ? readHit(this.#hit, hitWord) : null;
  }

  lineOfSight(ax, ay, az, bx, by, bz, filter = null) {
    const soup = this._address;
    return filtered(filter, (f) => wasm.js_soup_line_of_sight(soup, ax, ay, az, bx, by, bz, f)) !== 0;
  }

  castRays(rays, filter = null, out = null) {
    const { room, count } = putBatch(rays, 7, 'rays');
    return takeHits(count, out, filtered(filter, (f) => wasm.js_soup_cast_rays(this._address, room, count, f)));
  }

  castSegments(segments, filter = null, out = null) {
    const { room, count } = putBatch(segments, 6, 'segments');
    return takeHits(count, out, filtered(filter, (f) => wasm.js_soup_cast_segments(this._address, room, count, f)));
  }

  occludedRays(rays, filter = null, out = null) {
    const { room, count } = putBatch(rays, 7, 'rays');
    return takeAnswers(count, out, filtered(filter, (f) => wasm.js_soup_occluded_rays(this._address, room, count, f)));
  }

  linesOfSight(segments, filter = null, out = null) {
    const { room, count } = putBatch(segments, 6, 'segments');
    return takeAnswers(count, out, filtered(filter, (f) => wasm.js_soup_lines_of_sight(this._address, room, count, f)));
  }

  castRayAll(origin, direction, { maxT = Infinity, rule = 'touched', filter = null } = {}) {
    const soup = this._address;
    putVec3(0, origin);
    putVec3(3, direction);
    F64[SLOT + 6] = maxT;
    check(filtered(filter, (f) => wasm.js_soup_cast_ray_all(soup, rule === 'crossed' ? 1 : 0, f)));
    const word = F64[SLOT + 1] / 4;
    return Array.from({ length: F64[SLOT] }, (_, i) => readHit(newHit(), word + HIT_WORDS * i));
  }

  nearest(point, maxDistance = Infinity, filter = null) {
    const soup = this._address;
    putVec3(0, point);
    F64[SLOT + 3] = maxDistance;
    if (check(filtered(filter, (f) => wasm.js_soup_nearest(soup, f))) !== 0) return null;
    const s = SLOT;
    return { point: slotVec3(0), distance: F64[s + 3], normal: slotVec3(4), triangle: F64[s + 7], material: F64[s + 8],
             back: F64[s + 9] !== 0, feature: FEATURES[F64[s + 10]] };
  }

  #withShape(shape, pose, filter, run) {
    return withShapes([[0, shape]], () => {
      putPose(SHAPE_NUMBERS, pose);
      return check(filtered(filter, run));
    });
  }

  overlaps(shape, pose = null, filter = null) {
    const soup = this._address;
    this.#withShape(shape, pose, filter, (f) => wasm.js_soup_overlaps(soup, f));
    return F64[SLOT] !== 0;
  }

  findOverlaps(shape, pose = null, filter = null) {
    const soup = this._address;
    this.#withShape(shape, pose, filter, (f) => wasm.js_soup_find_overlaps(soup, f));
    return copyOut(Uint32Array, F64[SLOT + 1], F64[SLOT]);
  }

  castShape(shape, pose, motion, filter = null) {
    const soup = this._address;
    const result = this.#withShape(shape, pose, filter, (f) => {
      putVec3(SHAPE_NUMBERS + 7, motion);
      return wasm.js_soup_cast_shape(soup, f);
    });
    if (result !== 0) return null;
    const s = SLOT;
    return { t: F64[s], initialOverlap: F64[s + 1] !== 0, back: F64[s + 2] !== 0, material: F64[s + 3], triangle: F64[s + 4],
             depth: F64[s + 5], point: slotVec3(6), normal: slotVec3(9), faceNormal: slotVec3(12), status: STATUS[F64[s + 15]] };
  }

  locate(point) {
    const soup = this._address;
    putVec3(0, point);
    check(wasm.js_soup_locate(soup));
    const triangle = F64[SLOT + 2];
    return { side: ['outside', 'inside', 'on surface'][F64[SLOT]], winding: F64[SLOT + 1],
             triangle: triangle === NO_TRIANGLE ? null : triangle };
  }

  checkClosed() {
    check(wasm.js_soup_check_closed(this._address));
  }

  trianglesInBox(box) {
    const soup = this._address;
    putAabb(0, box);
    check(wasm.js_soup_triangles_in_box(soup));
    return copyOut(Uint32Array, F64[SLOT + 1], F64[SLOT]);
  }

  refit(mesh) {
    const soup = this._address;
    withInput(mesh, null, () => check(wasm.js_soup_refit(soup)));
  }

  pairs() {
    check(wasm.js_soup_pairs(this._address));
    const count = F64[SLOT], word = F64[SLOT + 1] / 4;
    const corners = new Float32Array(12 * count), triangles = new Uint32Array(2 * count);
    for (let i = 0; i < count; i++) {
      corners.set(F32.subarray(word + 14 * i, word + 14 * i + 12), 12 * i);
      triangles.set(U32.subarray(word + 14 * i + 12, word + 14 * i + 14), 2 * i);
    }
    wasm.js_trim();
    return { count, corners, triangles };
  }

  boxes(maxDepth = 255) {
    check(wasm.js_soup_boxes(this._address, maxDepth));
    const count = F64[SLOT], word = F64[SLOT + 1] / 4;
    const boxes = new Float32Array(6 * count), depth = new Uint8Array(count), leaf = new Uint8Array(count);
    for (let i = 0; i < count; i++) {
      boxes.set(F32.subarray(word + 8 * i, word + 8 * i + 6), 6 * i);
      depth[i] = U32[word + 8 * i + 6];
      leaf[i] = U32[word + 8 * i + 7];
    }
    wasm.js_trim();
    return { count, boxes, depth, leaf };
  }

  walkRay(origin, direction, maxT = Infinity) {
    const hit = this.castRay(...[0, 1, 2].map((i) => origin[i]), ...[0, 1, 2].map((i) => direction[i]), maxT);
    return walkBoxes(this.boxes(), origin, direction, hit === null ? maxT : hit.t, hit === null ? null : { ...hit });
  }

  visibleOutline(eye, options = {}) {
    return visibleOutline(this, eye, options);
  }
}
