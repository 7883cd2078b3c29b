// The worker: calls the engine's methods by name, and says how a bake goes on.

import { Engine } from './engine';
import { init, TalusError } from 'talus';
import ThreadWorker from '../../../js/src/thread_entry.js?worker&inline';
import type { WasmChoice } from '../boot/wasm';
import type { Progress } from './protocol';

interface Call {
  id: number;
  method: string;
  args: unknown[];
}

const scope = self as unknown as {
  postMessage(message: unknown, transfer?: Transferable[]): void;
  onmessage: ((event: MessageEvent<Call | { wasm: WasmChoice }>) => void) | null;
};

let lastProgress = 0;
let lastStage = '';
function tell(progress: Progress): void {
  const now = performance.now();
  // Every stage is told; within one, thirty times a second do.
  if (progress.stage === lastStage && now - lastProgress < 33) return;
  lastProgress = now;
  lastStage = progress.stage;
  scope.postMessage({ progress });
}

const engine = new Engine(tell);
let started: Promise<void> | null = null;

// Typed arrays that own their buffer are moved to the page, not copied.
function buffersOf(value: unknown, found: Set<ArrayBuffer>, depth = 0): Set<ArrayBuffer> {
  if (ArrayBuffer.isView(value)) {
    if (value.buffer instanceof ArrayBuffer) found.add(value.buffer);
  } else if (value !== null && typeof value === 'object' && depth < 4 && !(Array.isArray(value) && value.length > 64)) {
    for (const part of Object.values(value)) buffersOf(part, found, depth + 1);
  }
  return found;
}

function faultOf(error: unknown): { message: string; result: string | null; field: string | null } {
  if (error instanceof TalusError) return { message: error.message, result: error.result, field: error.field };
  if (error instanceof RangeError && /memory|allocation|array length/i.test(error.message)) {
    return { message: 'out of memory: try a larger cell size, or a smaller level', result: 'TL_ERR_MEMORY', field: null };
  }
  return { message: error instanceof Error ? error.message : String(error), result: null, field: null };
}

scope.onmessage = async (event) => {
  if ('wasm' in event.data) {
    const { module, simd, threads } = event.data.wasm;
    started = init({ wasm: { simd: module, scalar: module, threads: module }, simd, threads, createThread: () => new ThreadWorker() });
    started.catch(() => {}); // each call reports it
    return;
  }
  const { id, method, args } = event.data;
  try {
    await started;
    const call = (engine as unknown as Record<string, (...args: unknown[]) => unknown>)[method];
    if (!call) throw new Error(`the engine has no '${method}'`);
    const value = await call.apply(engine, args);
    scope.postMessage({ id, value }, [...buffersOf(value, new Set())]);
  } catch (error) {
    scope.postMessage({ id, fault: faultOf(error) });
  }
};
