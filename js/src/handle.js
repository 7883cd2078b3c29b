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
  #users = 0;
  #freed = false;

  constructor(address, free) {
    this.#address = address;
    this._free = free;
    registry.register(this, { address, free }, this.#token);
  }

  /** The address, or an error where it was freed. */
  get _address() {
    if (this.#freed) {
      throw new TalusError('TL_ERR_STALE', `this ${this.constructor.name} was freed (TL_ERR_STALE)`);
    }
    return this.#address;
  }

  get freed() {
    return this.#freed;
  }

  free() {
    if (this.#freed) return;
    this.#freed = true;
    if (this.#users === 0) this.#release();
  }

  #release() {
    registry.unregister(this.#token);
    wasm[this._free](this.#address);
  }

  /** Something in the module points here now: the memory stays until the last one is gone, also when this is freed. */
  _use() {
    const address = this._address;
    this.#users++;
    return address;
  }

  _leave() {
    this.#users--;
    if (this.#users === 0 && this.#freed) this.#release();
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
