// SPDX-License-Identifier: MIT
//
// What holds memory of the module: freed by hand, or when the garbage collector finds it.

import { TalusError } from './error.js';
import { wasm } from './module.js';

// By the name of the export that frees it.
const registry = new FinalizationRegistry(({ address, free }) => wasm[free](address));

export class Handle {
  #address;
  #token = {};

  constructor(address, free) {
    this.#address = address;
    this._free = free;
    registry.register(this, { address, free }, this.#token);
  }

  /** The address, or an error where it was freed. */
  get _address() {
    if (this.#address === 0) {
      throw new TalusError('TL_ERR_STALE', `this ${this.constructor.name} was freed (TL_ERR_STALE)`);
    }
    return this.#address;
  }

  get freed() {
    return this.#address === 0;
  }

  free() {
    if (this.#address === 0) return;
    registry.unregister(this.#token);
    wasm[this._free](this.#address);
    this.#address = 0;
  }

  [Symbol.dispose ?? Symbol.for('Symbol.dispose')]() {
    this.free();
  }
}

/** Guards the classes' constructors: objects come from their static functions alone. */
export const PRIVATE = Symbol('private');

export function refuseNew(key, name) {
  if (key !== PRIVATE) throw new TypeError(`${name} has no constructor: call ${name}.bake or ${name}.fromBytes`);
}
