// SPDX-License-Identifier: MIT

import { Handle, PRIVATE, refuseNew } from './handle.js';
import { F64, SLOT, U64, check, copyOut, fail, wasm, watched } from './module.js';

export class Sight extends Handle {
  #navmesh;

  constructor(key, address, navmesh, pairCount) {
    refuseNew(key, 'Sight');
    super(address, 'js_blob_free');
    this.#navmesh = navmesh;
    this.pairCount = pairCount;
  }

  static bake(navmesh, soup, options = {}) {
    const address = watched(options, null, () => wasm.js_sight_bake(
      navmesh._address, soup._address, options.eyeHeight ?? 1.6, options.maxDistance ?? Infinity)) >>> 0;
    if (address === 0) {
      check(F64[SLOT]);
      fail(F64[SLOT]);
    }
    return new Sight(PRIVATE, address, navmesh, F64[SLOT + 1]);
  }

  sees(a, b) {
    U64[SLOT] = a;
    U64[SLOT + 1] = b;
    check(wasm.js_sight_sees(this._address, this.#navmesh._address));
    return F64[SLOT] !== 0;
  }

  seenFrom(polygon) {
    U64[SLOT] = polygon;
    check(wasm.js_sight_from(this._address, this.#navmesh._address));
    const refs = copyOut(BigUint64Array, F64[SLOT + 1], F64[SLOT]);
    wasm.js_trim();
    return refs;
  }
}
