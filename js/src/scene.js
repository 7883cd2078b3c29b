// SPDX-License-Identifier: MIT
//
// Scenes: soups and shapes at poses that change, asked together (wasm/js_scene.c). A scene keeps what it points to alive:
// soups and hulls that are freed meanwhile give their memory back when the scene lets go of them.

import { argumentError } from './error.js';
import { Handle, PRIVATE, refuseNew } from './handle.js';
import { F64, SLOT, TL_ERR_MEMORY, U32, check, fail, putPose, putVec3, ready, slotVec3, wasm } from './module.js';
import { SHAPE_NUMBERS, hullOf, withShapes } from './shape.js';
import { Soup, filtered } from './soup.js';

const NO_TRIANGLE = 0xffffffff;
const triangleAt = (at) => (F64[SLOT + at] === NO_TRIANGLE ? null : F64[SLOT + at]);

function newHit() {
  return { t: 0.5, instance: 0, triangle: null, u: 0.5, v: 0.5, nx: 0.5, ny: 0.5, nz: 0.5, material: 0, back: false, inside: false };
}

function readHit(hit) {
  const s = SLOT;
  hit.t = F64[s];
  hit.triangle = triangleAt(1);
  hit.u = F64[s + 2];
  hit.v = F64[s + 3];
  hit.nx = F64[s + 4];
  hit.ny = F64[s + 5];
  hit.nz = F64[s + 6];
  hit.material = F64[s + 7];
  hit.back = F64[s + 8] !== 0;
  hit.instance = F64[s + 9];
  hit.inside = F64[s + 10] !== 0;
  return hit;
}

/** Runs a query with a scene's filter. */
export function sceneFiltered(filter, run) {
  if (!filter) return run(0);
  const [first, count] = filter.ignored ?? [0, 0];
  return filtered(filter.triangles, (triangles) => run(wasm.js_set_scene_filter(filter.ignoredMask ?? 0, first, count, triangles)));
}

export class Scene extends Handle {
  #hit = newHit();
  /** What each instance points to. */
  #used = [];

  constructor(key, address, count) {
    refuseNew(key, 'Scene');
    super(address, 'js_scene_free');
    this.#used = new Array(count).fill(null);
  }

  static bake(instances) {
    const address = ready().js_scene_create(instances.length) >>> 0;
    if (address === 0) fail(TL_ERR_MEMORY);
    const scene = new Scene(PRIVATE, address, instances.length);
    try {
      instances.forEach((instance, i) => scene.set(i, { pose: null, mask: 1, ...instance }));
      scene.rebake();
    } catch (error) {
      scene.free();
      throw error;
    }
    return scene;
  }

  get count() {
    return this.#used.length;
  }

  free() {
    if (this.freed) return;
    super.free();
    this.#used.forEach((one) => one?._leave());
    this.#used = [];
  }

  set(index, change) {
    if (!Number.isInteger(index) || index < 0 || index >= this.#used.length) throw argumentError('index', 'no instance has it');
    const { soup, shape } = change, scene = this._address;
    if (soup && shape) throw argumentError('soup', 'an instance is a soup or a shape, not both');
    if (soup && !(soup instanceof Soup)) throw argumentError('soup', 'give a Soup');
    if (shape?.type === 'points') throw argumentError('shape', 'give a Hull of the points: a scene keeps its shapes');
    if (soup) wasm.js_scene_set(scene, index, soup._address, 0);
    else if (shape) withShapes([[0, shape]], () => wasm.js_scene_set(scene, index, 0, 1));
    else if (soup === null || shape === null) wasm.js_scene_set(scene, index, 0, 0);
    // Only now: what the instance pointed to may be let go.
    if (soup !== undefined || shape !== undefined) this.#use(index, soup ?? (shape ? hullOf(shape) : null));
    if (change.pose !== undefined) {
      putPose(0, change.pose);
      wasm.js_scene_place(scene, index);
    }
    if (change.scale !== undefined) {
      const scale = change.scale ?? 1;
      putVec3(0, typeof scale === 'number' ? [scale, scale, scale] : scale);
      wasm.js_scene_scale(scene, index);
    }
    if (change.mask !== undefined) wasm.js_scene_mask(scene, index, change.mask);
  }

  #use(index, handle) {
    handle?._use();
    this.#used[index]?._leave();
    this.#used[index] = handle;
  }

  refit() {
    check(wasm.js_scene_refit(this._address));
    return F64[SLOT];
  }

  rebake() {
    check(wasm.js_scene_bake(this._address));
  }

  castRay(ox, oy, oz, dx, dy, dz, maxT = Infinity, filter = null) {
    const scene = this._address;
    const hit = sceneFiltered(filter, (f) => wasm.js_scene_cast_ray(scene, ox, oy, oz, dx, dy, dz, maxT, f));
    return hit !== 0 ? readHit(this.#hit) : null;
  }

  occluded(ox, oy, oz, dx, dy, dz, maxT = Infinity, filter = null) {
    const scene = this._address;
    return sceneFiltered(filter, (f) => wasm.js_scene_occluded(scene, ox, oy, oz, dx, dy, dz, maxT, f)) !== 0;
  }

  lineOfSight(ax, ay, az, bx, by, bz, filter = null) {
    const scene = this._address;
    return sceneFiltered(filter, (f) => wasm.js_scene_line_of_sight(scene, ax, ay, az, bx, by, bz, f)) !== 0;
  }

  nearest(point, maxDistance = Infinity, filter = null) {
    const scene = this._address;
    putVec3(0, point);
    F64[SLOT + 3] = maxDistance;
    if (check(sceneFiltered(filter, (f) => wasm.js_scene_nearest(scene, f))) !== 0) return null;
    return { point: slotVec3(0), distance: F64[SLOT + 3], normal: slotVec3(4), triangle: triangleAt(7), instance: F64[SLOT + 8] };
  }

  castShape(shape, pose, motion, filter = null) {
    const scene = this._address;
    const result = withShapes([[0, shape]], () => {
      putPose(SHAPE_NUMBERS, pose);
      putVec3(SHAPE_NUMBERS + 7, motion);
      return check(sceneFiltered(filter, (f) => wasm.js_scene_cast_shape(scene, f)));
    });
    if (result !== 0) return null;
    return { t: F64[SLOT], initialOverlap: F64[SLOT + 1] !== 0, triangle: triangleAt(2), depth: F64[SLOT + 3], point: slotVec3(4),
             normal: slotVec3(7), instance: F64[SLOT + 10] };
  }

  findOverlaps(shape, pose = null, filter = null) {
    const scene = this._address;
    withShapes([[0, shape]], () => {
      putPose(SHAPE_NUMBERS, pose);
      check(sceneFiltered(filter, (f) => wasm.js_scene_find_overlaps(scene, f)));
    });
    const word = F64[SLOT + 1] / 4;
    return Array.from({ length: F64[SLOT] }, (_, i) => {
      const triangle = U32[word + 2 * i + 1];
      return { instance: U32[word + 2 * i], triangle: triangle === NO_TRIANGLE ? null : triangle };
    });
  }
}
