// SPDX-License-Identifier: MIT
//
// Threads: workers with an instance of the module each, over the memory of the first one. They wait inside the module
// (wasm/js_threads.c) and never come back to their own loop of events: nothing but the end of the page, or of the worker
// that started them, ends them.

/** Bytes of a thread's stack; no call of the library takes more than a quarter of it. */
const STACK_BYTES = 128 * 1024;
/** Pages of 64 KB: the least is what the module was linked for. Where there is no room for 4 GB, less will do. */
const PAGES = 64, MOST_PAGES = [65536, 32768, 16384];

/** Why this engine or page cannot have threads; null: it can. */
export function whyNoThreads() {
  if (typeof SharedArrayBuffer === 'undefined' || globalThis.crossOriginIsolated === false) {
    return 'the page is not cross-origin isolated: serve it and its scripts with Cross-Origin-Opener-Policy: same-origin ' +
      'and Cross-Origin-Embedder-Policy: require-corp';
  }
  if (typeof Worker === 'undefined' && !globalThis.process?.versions?.node) return 'this engine has no workers';
  return null;
}

/** Memory that threads share; null: there is no room for it. */
export function sharedMemory() {
  for (const maximum of MOST_PAGES) {
    try {
      return new WebAssembly.Memory({ initial: PAGES, maximum, shared: true });
    } catch {
      // Try less.
    }
  }
  return null;
}

/** The threads that run: an engine may end a worker that nothing refers to. */
const pool = [];

async function newThread(create) {
  if (create) return create();
  // Written so that bundlers see it.
  if (typeof Worker !== 'undefined') return new Worker(new URL('./thread_entry.js', import.meta.url), { type: 'module' });
  const threads = 'node:worker_threads';
  const { Worker: NodeWorker } = await import(/* @vite-ignore */ threads);
  return new NodeWorker(new URL('./thread_entry.js', import.meta.url));
}

/** Starts one; ends when it runs in the module. */
function enter(thread, message) {
  return new Promise((resolve, reject) => {
    const answer = (text) => (text === 'ready' ? resolve() : reject(new Error(text)));
    const fail = (event) => reject(new Error(event.message || 'the script of a thread could not be loaded'));
    if (thread.on) {
      thread.on('message', answer);
      thread.on('error', fail);
    } else {
      thread.onmessage = (event) => answer(event.data);
      thread.onerror = fail;
    }
    thread.postMessage(message);
  });
}

/** A page's own thread may not sleep: there it looks again and again until the others are done. */
const maySleep = () => typeof window === 'undefined' || typeof document === 'undefined';

/** Starts `count - 1` threads beside the caller's. Throws, with none of them left, where one cannot be started. */
export async function startThreads(exports, module, memory, count, create) {
  const threads = [];
  try {
    for (let i = 1; i < count; i++) threads.push(await newThread(create));
    await Promise.all(threads.map((thread, i) => {
      const stack = exports.js_alloc(STACK_BYTES) >>> 0;
      if (stack === 0) throw new Error('out of memory');
      return enter(thread, { module, memory, worker: i + 1, stack: stack + STACK_BYTES });
    }));
  } catch (error) {
    threads.forEach((thread) => thread.terminate());
    throw error;
  }
  threads.forEach((thread) => thread.unref?.()); // node: its process need not wait for them
  pool.push(...threads);
  exports.js_threads_begin(count, maySleep() ? 1 : 0);
}
