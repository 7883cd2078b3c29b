// SPDX-License-Identifier: MIT
//
// Batches: numbers are copied in and answers out as whole arrays, which the module lays out (wasm/js_soup_batch.c).

import { argumentError } from './error.js';
import { F32, TL_ERR_MEMORY, U16, U32, U8, fail, ready } from './module.js';

/** Rays or segments in the module's room for them. */
export function putBatch(numbers, width, name) {
  const count = numbers.length / width;
  if (!Number.isInteger(count)) throw argumentError(name, `give ${width === 7 ? 'seven' : 'six'} numbers each`);
  const room = ready().js_batch_room(count) >>> 0;
  if (room === 0) fail(TL_ERR_MEMORY);
  F32.set(numbers, room / 4);
  return { room, count };
}

/** The arrays of hits in the module's order: type, numbers a hit, the module's view. */
const ARRAYS = {
  t: [Float32Array, 1, () => F32], triangle: [Uint32Array, 1, () => U32], uv: [Float32Array, 2, () => F32],
  normal: [Float32Array, 3, () => F32], material: [Uint16Array, 1, () => U16], back: [Uint8Array, 1, () => U8],
};

function roomIn(array, Type, length, name) {
  if (array === undefined || array === null) return new Type(length);
  if (array.length < length) throw argumentError(name, `give room for ${length} numbers`);
  return array;
}

/** Copies the hits at an address into typed arrays: those of `out`, where it has some. */
export function takeHits(count, out, address) {
  const result = {};
  let at = address >>> 0;
  for (const [name, [Type, width, view]] of Object.entries(ARRAYS)) {
    const length = width * count, first = at / Type.BYTES_PER_ELEMENT;
    result[name] = roomIn(out?.[name], Type, length, `out.${name}`);
    result[name].set(view().subarray(first, first + length));
    at += length * Type.BYTES_PER_ELEMENT;
  }
  return result;
}

/** Copies an answer a byte, 0 or 1. */
export function takeAnswers(count, out, address) {
  const result = roomIn(out, Uint8Array, count, 'out'), first = address >>> 0;
  result.set(U8.subarray(first, first + count));
  return result;
}
