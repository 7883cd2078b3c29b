// SPDX-License-Identifier: MIT
//
// Corridors: the polygons from an agent to its target, kept while both move and tiles come and go (wasm/js_corridor.c).

import { wholeNumber } from './error.js';
import { Handle, PRIVATE, refuseNew } from './handle.js';
import { HALF_EXTENTS, PATH_STATUS, filterFlag, locate, putLocation, readCorners, readLocation, refsAt } from './nav_query.js';
import { F64, SLOT, TL_ERR_MEMORY, TL_INCOMPLETE, U64, check, fail, ready, slotVec3, wasm } from './module.js';

const readSearch = () => ({ status: PATH_STATUS[F64[SLOT]], cost: F64[SLOT + 1], nodeCount: F64[SLOT + 2] });

export class Corridor extends Handle {
  #navmesh;

  constructor(key, address, navmesh) {
    refuseNew(key, 'Corridor');
    super(address, 'js_corridor_free');
    this.#navmesh = navmesh;
  }

  static create(navmesh, at, { capacity = 256, ...options } = {}) {
    wholeNumber('capacity', capacity, 1, 1 << 20);
    const location = locate(navmesh, at, options);
    if (location === null) return null;
    const address = ready().js_corridor_create(capacity) >>> 0;
    if (address === 0) fail(TL_ERR_MEMORY);
    const corridor = new Corridor(PRIVATE, address, navmesh);
    putLocation(0, location);
    wasm.js_corridor_reset(address);
    return corridor;
  }

  /** Calls with the navmesh, a filter, and a place in the slot where one is given. */
  #call(name, { filter }, args = [], place = null) {
    const corridor = this._address, navmesh = this.#navmesh._address, flags = filterFlag(filter);
    if (place !== null) putLocation(0, place);
    return wasm[name](corridor, navmesh, flags, ...args);
  }

  /** Writes the corridor's state into the slot. */
  #state() {
    wasm.js_corridor_state(this._address);
    return SLOT;
  }

  get position() {
    this.#state();
    return slotVec3(0);
  }

  get target() {
    this.#state();
    return slotVec3(3);
  }

  get goal() {
    this.#state();
    return slotVec3(6);
  }

  get reaches() {
    return F64[this.#state() + 9] !== 0;
  }

  get polygons() {
    const s = this.#state();
    return refsAt(F64[s + 11] / 8, F64[s + 10]);
  }

  reset(at, options = {}) {
    const location = locate(this.#navmesh, at, options);
    if (location === null) return false;
    putLocation(0, location);
    wasm.js_corridor_reset(this._address);
    return true;
  }

  find(goal, options = {}) {
    const location = locate(this.#navmesh, goal, options);
    if (location === null) return null;
    check(this.#call('js_corridor_find', options, [], location));
    return readSearch();
  }

  corners(count = 3) {
    wholeNumber('count', count, 1, 1 << 16);
    const result = check(wasm.js_corridor_corners(this._address, this.#navmesh._address, count));
    return { ...readCorners(0), more: result === TL_INCOMPLETE };
  }

  move(to, options = {}) {
    check(this.#call('js_corridor_move', options, [0, to[0], to[1], to[2]]));
    return this.position;
  }

  moveTarget(to, options = {}) {
    check(this.#call('js_corridor_move', options, [1, to[0], to[1], to[2]]));
    return this.target;
  }

  passLink() {
    const result = check(wasm.js_corridor_pass_link(this._address, this.#navmesh._address));
    return result === 0 ? { link: U64[SLOT], from: readLocation(1), to: readLocation(5) } : null;
  }

  shorten(range = 20, options = {}) {
    check(this.#call('js_corridor_shorten', options, [range]));
    return F64[SLOT] !== 0;
  }

  improve({ ahead = 32, maxSteps = 256, ...options } = {}) {
    check(this.#call('js_corridor_improve', options, [wholeNumber('ahead', ahead), wholeNumber('maxSteps', maxSteps)]));
    return F64[SLOT] !== 0;
  }

  validCount(maxCount = 0xffffffff, options = {}) {
    return this.#call('js_corridor_check', options, [wholeNumber('maxCount', maxCount)]) >>> 0;
  }

  repair(options = {}) {
    const h = options.halfExtents ?? HALF_EXTENTS;
    return check(this.#call('js_corridor_repair', options, [h[0], h[1], h[2]])) === 0 ? readSearch() : null;
  }
}
