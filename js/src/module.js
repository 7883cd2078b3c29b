// SPDX-License-Identifier: MIT
//
// The WebAssembly module: loaded once, with views of its memory that are made anew whenever it grows. All other files
// read `wasm`, `F64` and so on as they stand: after a call that may allocate, a view kept from before it is detached.

import { TalusError, argumentError, resultError } from './error.js';
import { sharedMemory, startThreads, whyNoThreads } from './threads.js';

/** The exports. Null before init. */
export let wasm = null;
export let U8, U16, I16, I32, U32, F32, F64, U64;
/** Index of the slot in F64 and U64; see wasm/js_slot.h. */
export let SLOT = 0;

let memory = null;
let simdLoaded = false;
let running = { count: 0, reason: null };
let loading = null;

// What a listener threw during a call, and who listens.
let thrown = null;
let progressListener = null;
let acceptFunction = null;

function refreshViews() {
  const buffer = memory.buffer;
  U8 = new Uint8Array(buffer);
  U16 = new Uint16Array(buffer);
  I16 = new Int16Array(buffer);
  I32 = new Int32Array(buffer);
  U32 = new Uint32Array(buffer);
  F32 = new Float32Array(buffer);
  F64 = new Float64Array(buffer);
  U64 = new BigUint64Array(buffer);
}

const imports = {
  env: {
    // Nothing may be thrown through C: it is kept until the call has ended.
    progress(stage, done, total) {
      if (progressListener === null) return 1;
      try {
        return progressListener(readString(stage), done, total) === false ? 0 : 1;
      } catch (error) {
        thrown = { error };
        return 0;
      }
    },
    accept(triangle, material) {
      if (thrown !== null) return 0;
      try {
        return acceptFunction(triangle >>> 0, material) ? 1 : 0;
      } catch (error) {
        thrown = { error };
        return 0;
      }
    },
    emscripten_notify_memory_growth: refreshViews,
  },
  wasi_snapshot_preview1: {
    // What the C library would need to end the process or to print; nothing calls them.
    proc_exit(code) { throw new Error(`talus: the module ended itself (${code})`); },
    fd_close: () => 8,
    fd_write: () => 8,
    fd_seek: () => 8,
  },
};

// A function of one vector instruction: engines without SIMD refuse it.
const SIMD_PROBE = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

/** The package's own files. The module of queries has SIMD: where the engine has none, the full one does its work. */
function ownSource(part, simd) {
  if (!simd) return new URL('../dist/talus.wasm', import.meta.url);
  if (part === 'queries') return new URL('../dist/talus-queries.wasm', import.meta.url);
  return new URL('../dist/talus-simd.wasm', import.meta.url);
}

const isChoice = (given) => typeof given === 'object' && given !== null && 'simd' in given && 'scalar' in given;

/** Why the module with threads is not the one to load; null: it is. */
function whyOneThread({ wasm: given, part }, simd) {
  if (part === 'queries') return "the module of queries has one thread: leave part: 'queries' out";
  if (!simd) return 'the module with threads needs SIMD, which the engine lacks or `simd: false` forbids';
  const missing = given && !(isChoice(given) && given.threads);
  return whyNoThreads() ?? (missing ? 'wasm names no module with threads: give { simd, scalar, threads }' : null);
}

function chooseSource(options) {
  const simd = options.simd !== false && WebAssembly.validate(SIMD_PROBE);
  const given = options.wasm ?? null, part = options.part ?? 'full', threads = options.threads ?? 1;
  if (part !== 'full' && part !== 'queries') throw argumentError('part', "'full' or 'queries'");
  if (!Number.isInteger(threads) || threads < 1 || threads > 64) throw argumentError('threads', 'give 1 to 64');
  let shared = null;
  if (threads > 1) {
    running.reason = whyOneThread(options, simd);
    if (running.reason === null) {
      shared = sharedMemory();
      if (shared === null) running.reason = 'there is no room for memory that threads share';
    }
  }
  if (shared !== null) return { source: given?.threads ?? new URL('../dist/talus-threads.wasm', import.meta.url), simd, shared };
  if (given === null) return { source: ownSource(part, simd), simd, shared };
  return isChoice(given) ? { source: simd ? given.simd : given.scalar, simd, shared } : { source: given, simd: null, shared };
}

async function fetchModule(source) {
  if (source instanceof WebAssembly.Module) return source;
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return WebAssembly.compile(source);
  const isResponse = typeof Response !== 'undefined' && source instanceof Response;
  const url = isResponse ? null : new URL(source.url ?? source, globalThis.location?.href ?? import.meta.url);
  if (url !== null && url.protocol === 'file:' && globalThis.process?.versions?.node) {
    // node's fetch takes no file addresses. The name is hidden from bundlers, which would look for it.
    const files = 'node:fs/promises';
    return WebAssembly.compile(await (await import(/* @vite-ignore */ files)).readFile(url));
  }
  const response = isResponse ? source : await fetch(source);
  if (!response.ok) {
    throw new TalusError('TL_ERR_IO', `the WebAssembly module could not be loaded: ${response.status} ${response.url}`);
  }
  // Not compileStreaming: it refuses servers that send another type than application/wasm.
  return WebAssembly.compile(await response.arrayBuffer());
}

/** Exports whose missing ones say so when they are called. */
function explained(exports) {
  const missing = (_, name) => (typeof name !== 'string' || !name.startsWith('js_') ? undefined : () => {
    throw new TalusError('TL_ERR_UNSUPPORTED', `the module of queries lacks ${name}: await init() without part: 'queries'`,
                         { field: 'part', advice: "await init() without part: 'queries', or bake in a TalusWorker" });
  });
  return Object.assign(Object.create(new Proxy({}, { get: missing })), exports);
}

async function load(options) {
  if (typeof WebAssembly !== 'object') {
    throw new TalusError('TL_ERR_UNSUPPORTED', 'this engine has no WebAssembly');
  }
  running = { count: 1, reason: null };
  const { source, simd, shared } = chooseSource(options);
  const module = await fetchModule(source);
  if (shared !== null) imports.env.memory = shared;
  const { exports } = await WebAssembly.instantiate(module, imports);
  memory = shared ?? exports.memory;
  wasm = hasBakesIn(exports) ? exports : explained(exports);
  simdLoaded = simd ?? wasm.js_has_simd() !== 0;
  refreshViews();
  wasm._initialize?.();
  SLOT = wasm.js_slot_address() / 8;
  if (shared === null) return;
  try {
    await startThreads(exports, module, shared, options.threads, options.createThread);
    running.count = options.threads;
  } catch (error) {
    running.reason = `a thread could not be started: ${error.message}`;
  }
}

export function init(options = {}) {
  loading ??= load(options).catch((error) => {
    loading = null;
    throw error;
  });
  return loading;
}

export const isReady = () => wasm !== null;
export const threads = () => ({ ...running });
export const hasSimd = () => wasm !== null && simdLoaded;

const hasBakesIn = (exports) => 'js_navmesh_bake' in exports;
export const hasBakes = () => wasm !== null && hasBakesIn(wasm);

export function version() {
  return readString(ready().js_version());
}

export function memoryBytes() {
  ready();
  return memory.buffer.byteLength;
}

/** The exports, or an error that says what is missing. */
export function ready() {
  if (wasm === null) throw new TalusError('TL_ERR_ARGUMENT', 'the module is not loaded: await init() first');
  return wasm;
}

/** A zero-terminated string; null for address 0. A copy is decoded: browsers refuse to decode memory that threads share. */
export function readString(address) {
  if (address === 0) return null;
  return new TextDecoder().decode(U8.slice(address, U8.indexOf(0, address)));
}

// --------------------------------------------------------------------------------------------------------
// Calls that may fail.

function takeReport() {
  wasm.js_take_report();
  const s = SLOT;
  return {
    stage: readString(F64[s]), field: readString(F64[s + 1]), element: readString(F64[s + 2]),
    advice: readString(F64[s + 3]), elementIndex: F64[s + 4],
  };
}

// Of tl_result (talus/base.h): its last outcome, and errors that JavaScript finds itself.
const TL_NOT_LOADED = 3;
export const TL_INCOMPLETE = 2;
export const TL_ERR_MEMORY = 4;
export const TL_ERR_NODES = 30;

/** Throws what a listener threw, or the error of a result. TL_OK, TL_NOT_FOUND, TL_INCOMPLETE and TL_NOT_LOADED pass. */
export function check(result) {
  if (thrown !== null) {
    const { error } = thrown;
    thrown = null;
    takeReport();
    throw error;
  }
  if (result > TL_NOT_LOADED) fail(result);
  return result;
}

export function fail(result) {
  const name = readString(wasm.js_result_name(result));
  const text = readString(wasm.js_result_text(result));
  throw resultError(name, text, takeReport());
}

/** Runs a bake whose progress goes to `listener` (false cancels); signals end it with their reason. */
export function watched(hooks, listener, run) {
  const signal = hooks?.signal, onProgress = hooks?.onProgress;
  signal?.throwIfAborted();
  const before = progressListener;
  progressListener = signal || onProgress || listener
    ? (stage, done, total) => {
        listener?.(stage, done, total);
        onProgress?.(stage, done, total);
        signal?.throwIfAborted();
        return true;
      }
    : null;
  try {
    return run();
  } finally {
    progressListener = before;
  }
}

/** Runs a query with a filter's function. */
export function accepting(accept, run) {
  const before = acceptFunction;
  acceptFunction = accept;
  try {
    return run();
  } finally {
    acceptFunction = before;
  }
}

// --------------------------------------------------------------------------------------------------------
// Memory.

/** Memory of the module, aligned to 64 bytes; freed with release. */
export function allocate(bytes) {
  const address = bytes > 0xffffff00 ? 0 : wasm.js_alloc(bytes) >>> 0;
  if (address === 0) fail(TL_ERR_MEMORY);
  return address;
}

export function release(address) {
  if (address !== 0) wasm.js_free(address);
}

/** A copy of a typed array in the module's memory. */
export function copyIn(array) {
  const address = allocate(array.byteLength);
  U8.set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), address);
  return address;
}

// Comparisons, not a table of functions: the engine folds them away.
function viewOf(Type) {
  return Type === Float32Array ? F32 : Type === Uint32Array ? U32 : Type === BigUint64Array ? U64 : Type === Uint8Array ? U8
    : Type === Uint16Array ? U16 : Type === Int32Array ? I32 : I16;
}

/** A copy of `count` elements at an address, of the array type given; an empty one where there is no address. */
export function copyOut(Type, address, count) {
  const first = address / Type.BYTES_PER_ELEMENT;
  return viewOf(Type).slice(first, address === 0 ? first : first + count);
}

export const slotVec3 = (at) => [F64[SLOT + at], F64[SLOT + at + 1], F64[SLOT + at + 2]];
export const slotAabb = (at) => ({ min: slotVec3(at), max: slotVec3(at + 3) });

export function putVec3(at, v) {
  F64[SLOT + at] = v[0];
  F64[SLOT + at + 1] = v[1];
  F64[SLOT + at + 2] = v[2];
}

export function putAabb(at, box) {
  putVec3(at, box.min);
  putVec3(at + 3, box.max);
}

/** Rotation, then position. Null is the identity. */
export function putPose(at, pose) {
  const r = pose?.rotation, p = pose?.position;
  for (let i = 0; i < 4; i++) F64[SLOT + at + i] = r ? r[i] : 0;
  for (let i = 0; i < 3; i++) F64[SLOT + at + 4 + i] = p ? p[i] : 0;
}
