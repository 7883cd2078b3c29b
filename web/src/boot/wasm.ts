// The WebAssembly module, compiled once and handed to every worker. With SIMD where the browser has it.

import scalarUrl from '#wasm/talus.wasm?url';
import simdUrl from '#wasm/talus-simd.wasm?url';

export class NoWasm extends Error {}

// A function that splats a byte over a vector: valid only where SIMD is known.
const SIMD_PROBE = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

export interface WasmChoice {
  module: WebAssembly.Module;
  simd: boolean;
}

export async function loadWasm(): Promise<WasmChoice> {
  if (typeof WebAssembly !== 'object') {
    throw new NoWasm('This browser has no WebAssembly, or it is switched off (as in some "lockdown" modes).');
  }
  const simd = !new URLSearchParams(location.search).has('scalar') && WebAssembly.validate(SIMD_PROBE);
  try {
    const response = await fetch(simd ? simdUrl : scalarUrl);
    if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
    return { module: await WebAssembly.compile(await response.arrayBuffer()), simd };
  } catch (error) {
    throw new NoWasm(`The WebAssembly module could not be loaded: ${error instanceof Error ? error.message : String(error)}`);
  }
}
