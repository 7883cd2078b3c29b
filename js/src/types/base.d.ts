// SPDX-License-Identifier: MIT
//
// What all parts of the package share. Lengths are metres, y is up, triangles are counter-clockwise seen from their
// front. Numbers are rounded to 32-bit floats on their way into the library, unless a comment says otherwise.

/** A point in metres, or a direction: three numbers, of an array or a typed array. */
export type Vec3Like = ArrayLike<number>;
/** A point in metres, or a direction, as the package returns it. */
export type Vec3 = [x: number, y: number, z: number];
/** A rotation as a unit quaternion x, y, z, w: the order of three.js. */
export type QuatLike = ArrayLike<number>;

/** A closed box along the axes, metres. */
export interface Aabb {
  min: Vec3;
  max: Vec3;
}

/** A rigid motion: rotate, then translate. What is left out is the identity. */
export interface Pose {
  position?: Vec3Like;
  rotation?: QuatLike;
}

/** Where the .wasm comes from: an address, its bytes, or what was compiled from them. */
export type WasmSource = string | URL | Request | Response | ArrayBuffer | Uint8Array | WebAssembly.Module;

export interface InitOptions {
  /**
   * The module, or how to choose it. By default the files of the package, `dist/talus.wasm`, `dist/talus-simd.wasm` and
   * `dist/talus-threads.wasm`, beside the sources: the one with SIMD where the engine has it, and the one with threads
   * where they are asked for. Give all where a bundler or a server has them elsewhere; a single source is taken as it is,
   * and has one thread.
   */
  wasm?: WasmSource | { simd: WasmSource; scalar: WasmSource; threads?: WasmSource };
  /** False: the module without SIMD, also where the engine has it. */
  simd?: boolean;
  /**
   * 'queries': the small module, `dist/talus-queries.wasm`, half the bytes to be downloaded. It loads what was baked
   * and queries it: `loadPack`, `Soup`, `Navmesh` with paths, off-mesh links and sight. What bakes, changes tiles or
   * finds links, `Crowd`, `Scene`, `CharacterMover`, `Hull`, `decompose`, the functions on two shapes, `savePack`, `audit`, `why`, `navmeshFromDetour` and `navmeshToDetour` throw a `TalusError`
   * ("TL_ERR_UNSUPPORTED"); a `TalusWorker` still bakes, with the full module that it loads for itself. Engines
   * without SIMD get the full module. Default 'full'. Ignored where `wasm` is given.
   */
  part?: 'full' | 'queries';
  /**
   * Threads that bakes, audits, crowds and batches of rays run on, the caller's among them: 1 (the default) to 64. More
   * than one take a page that is cross-origin isolated (`crossOriginIsolated`), or node; where they cannot be had all
   * runs on one, and `threads()` says why. The same bytes and answers with any number.
   */
  threads?: number;
  /** Makes a thread's worker, for bundlers that want to see `new Worker(...)`; runs `talus/thread-entry`. */
  createThread?: () => Worker;
}

/** The threads of the module that was loaded. */
export interface Threads {
  /** With the caller's; 0 before `init` has begun. */
  count: number;
  /** Why there are fewer than were asked for; null where there are as many. */
  reason: string | null;
}

/**
 * Loads the WebAssembly module. Must have ended before anything else is called; else those calls throw a `TalusError`.
 * Further calls return the first one's promise; after a failure the next call tries again.
 */
export function init(options?: InitOptions): Promise<void>;

/** Whether `init` has ended. */
export function isReady(): boolean;
/** "MAJOR.MINOR.PATCH" of the library. */
export function version(): string;
/** Whether the module that was loaded has SIMD. */
export function hasSimd(): boolean;
/** Whether the module that was loaded bakes: not that of `part: 'queries'`. */
export function hasBakes(): boolean;
/** How many threads there are, and why no more. */
export function threads(): Threads;
/** Bytes of the module's memory now. It grows as needed, up to 4 GB, and never shrinks. */
export function memoryBytes(): number;

/** The library's results; `docs/design.md` and `talus/base.h` say what each means. */
export type ResultName =
  | 'TL_NOT_FOUND' | 'TL_INCOMPLETE' | 'TL_NOT_LOADED'
  | 'TL_ERR_MEMORY' | 'TL_ERR_CANCELLED' | 'TL_ERR_IO'
  | 'TL_ERR_ARGUMENT' | 'TL_ERR_UNSUPPORTED' | 'TL_ERR_LIMIT' | 'TL_ERR_STALE'
  | 'TL_ERR_EMPTY' | 'TL_ERR_NOT_FINITE' | 'TL_ERR_RANGE' | 'TL_ERR_INDEX' | 'TL_ERR_DEGENERATE' | 'TL_ERR_COINCIDENT'
  | 'TL_ERR_COLLINEAR' | 'TL_ERR_COPLANAR' | 'TL_ERR_NON_MANIFOLD' | 'TL_ERR_WINDING' | 'TL_ERR_NOT_CLOSED'
  | 'TL_ERR_SELF_INTERSECTION'
  | 'TL_ERR_FORMAT' | 'TL_ERR_MAGIC' | 'TL_ERR_VERSION' | 'TL_ERR_TRUNCATED' | 'TL_ERR_HASH' | 'TL_ERR_CORRUPT'
  | 'TL_ERR_ITERATIONS' | 'TL_ERR_NODES';

/** What went wrong, as the library's report says it. `message` is a sentence made of all of it. */
export class TalusError extends Error {
  /** The library's own word. */
  readonly result: ResultName;
  /** The stage of a bake that failed. */
  readonly stage: string | null;
  /** The option that was refused, spelled as in JavaScript ("cellSize"). */
  readonly field: string | null;
  /** What kind of element is to blame ("vertex", "triangle", "contour"). */
  readonly element: string | null;
  /** Its index in the input. */
  readonly elementIndex: number | null;
  /** What to do about it. */
  readonly advice: string | null;
}

/** Progress of a bake: `done` runs from 0, when the stage begins, to `total`, when it has ended. */
export type ProgressListener = (stage: string, done: number, total: number) => void;

/** How a bake is watched and stopped. */
export interface BakeHooks {
  /** An exception it throws ends the bake, and is thrown on. */
  onProgress?: ProgressListener;
  /**
   * Ends the bake when it is aborted: the signal's reason is thrown. A bake on the page's own thread sees only what its
   * own `onProgress` aborts; one in a `TalusWorker` is ended at any time.
   */
  signal?: AbortSignal;
}

/**
 * Something that holds memory of the module. `free` gives it back at once; what is forgotten is given back when the
 * garbage collector finds it, some time. A call on what was freed throws a `TalusError` ("TL_ERR_STALE").
 */
export interface Freeable {
  /** Whether `free` was called. */
  readonly freed: boolean;
  /** Gives the memory back. A second call does nothing. */
  free(): void;
  [Symbol.dispose](): void;
}
