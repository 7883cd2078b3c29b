// The WebAssembly module, compiled once and handed to every worker. With SIMD where the browser has it; with threads
// where the page is cross-origin isolated, and the module with threads lies beside it: it is no part of the page, which
// from disk cannot use it.

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
  /** For each engine; 1: the module has none. */
  threads: number;
  /** Why there are none, where they were not asked for. */
  reason: string | null;
}

/** More gain little: a bake's stages that run on one take their share of its time. */
const MOST_THREADS = 8;

async function compile(url: string): Promise<WebAssembly.Module> {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
  return WebAssembly.compile(await response.arrayBuffer());
}

async function loadThreads(simd: boolean): Promise<WasmChoice | string> {
  const threads = Math.min(navigator.hardwareConcurrency ?? 1, MOST_THREADS);
  if (!simd) return 'the module with threads needs SIMD';
  if (threads < 2) return 'this machine has one processor';
  if (!crossOriginIsolated) return 'threads take a server that isolates the page, as make viewer does';
  try {
    return { module: await compile('talus-threads.wasm'), simd, threads, reason: null };
  } catch (error) {
    return `talus-threads.wasm, beside the page, could not be loaded: ${error instanceof Error ? error.message : String(error)}`;
  }
}

export async function loadWasm(): Promise<WasmChoice> {
  if (typeof WebAssembly !== 'object') {
    throw new NoWasm('This browser has no WebAssembly, or it is switched off (as in some "lockdown" modes).');
  }
  const simd = !new URLSearchParams(location.search).has('scalar') && WebAssembly.validate(SIMD_PROBE);
  const threaded = await loadThreads(simd);
  if (typeof threaded !== 'string') return threaded;
  try {
    return { module: await compile(simd ? simdUrl : scalarUrl), simd, threads: 1, reason: threaded };
  } catch (error) {
    throw new NoWasm(`The WebAssembly module could not be loaded: ${error instanceof Error ? error.message : String(error)}`);
  }
}
