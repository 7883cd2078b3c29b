// The page's side of the engine. A bake runs in a worker of its own, while the engine before it answers questions as
// ever; when it ends well, it takes over. So cancelling is ending that worker, at once, whatever it is doing, and a
// bake that fails leaves all as it was. A spare worker is kept ready, for a slider starts many bakes.

import type { Engine } from './engine';
import type { WasmChoice } from '../boot/wasm';
import type { Progress } from './protocol';
import EngineWorker from './worker?worker&inline';

type Methods = { [K in keyof Engine as Engine[K] extends (...args: never[]) => unknown ? K : never]: Engine[K] };
export type Method = keyof Methods;
export type Arguments<M extends Method> = Parameters<Methods[M]>;
export type Answer<M extends Method> = Awaited<ReturnType<Methods[M]>>;

export class Cancelled extends Error {
  constructor() {
    super('cancelled');
  }
}

/** What the library said of a failure; `field` is a setting's name. */
export class EngineError extends Error {
  constructor(message: string, readonly result: string | null, readonly field: string | null) {
    super(message);
  }
}

interface Reply {
  id?: number;
  value?: unknown;
  fault?: { message: string; result: string | null; field: string | null };
  progress?: Progress;
}

/** Milliseconds after which a bake is long enough for the next spare worker to start beside it. */
const SPARE_AFTER = 400;

/** A worker with an engine in it. It starts while the module is still being compiled. */
class Runner {
  private worker = new EngineWorker();
  private started: Promise<void>;
  private next = 1;
  private calls = new Map<number, { resolve: (value: never) => void; reject: (error: Error) => void }>();
  onProgress: (progress: Progress) => void = () => {};
  dead: Error | null = null;

  constructor(wasm: Promise<WasmChoice>) {
    this.worker.onmessage = (event: MessageEvent<Reply>) => this.take(event.data);
    this.worker.onerror = (event) => {
      event.preventDefault();
      this.end(new EngineError(event.message || 'the worker could not be started', null, null));
    };
    this.started = wasm.then((choice) => this.worker.postMessage({ wasm: choice }));
    this.started.catch((error: Error) => this.end(error));
  }

  private take(reply: Reply): void {
    if (reply.progress) this.onProgress(reply.progress);
    const call = reply.id === undefined ? undefined : this.calls.get(reply.id);
    if (!call) return;
    this.calls.delete(reply.id!);
    if (reply.fault) call.reject(new EngineError(reply.fault.message, reply.fault.result, reply.fault.field));
    else call.resolve(reply.value as never);
  }

  call<M extends Method>(method: M, args: Arguments<M>): Promise<Answer<M>> {
    if (this.dead) return Promise.reject(this.dead);
    return new Promise((resolve, reject) => {
      const id = this.next++;
      this.calls.set(id, { resolve, reject });
      void this.started.then(() => this.worker.postMessage({ id, method, args }), () => {}); // else it has ended
    });
  }

  end(why: Error): void {
    this.dead = why;
    this.worker.terminate();
    for (const call of this.calls.values()) call.reject(why);
    this.calls.clear();
  }
}

export class EngineHost {
  private current: Runner | null = null;
  private candidate: Runner | null = null;
  private spare: Runner | null;
  onProgress: (progress: Progress) => void = () => {};

  constructor(private wasm: Promise<WasmChoice>) {
    this.spare = new Runner(wasm);
  }

  private get idle(): Runner {
    if (!this.spare || this.spare.dead) this.spare = new Runner(this.wasm);
    return this.spare;
  }

  /** Whether there is an engine that answers. */
  get ready(): boolean {
    return this.current !== null;
  }

  /** Whether a bake is under way. */
  get baking(): boolean {
    return this.candidate !== null;
  }

  /** Asks the engine that is in use. */
  call<M extends Method>(method: M, ...args: Arguments<M>): Promise<Answer<M>> {
    if (!this.current) return Promise.reject(new EngineError('no level is open', null, null));
    return this.current.call(method, args);
  }

  /** The built-in levels: known before any is open. */
  samples(): Promise<Answer<'samples'>> {
    return this.idle.call('samples', []);
  }

  /**
   * Runs `work` on a fresh engine, which takes over when it ends well. A call while another is under way cancels that.
   */
  async replace<T>(work: (call: EngineHost['call']) => Promise<T>): Promise<T> {
    this.cancel();
    const runner = this.idle;
    this.spare = null;
    setTimeout(() => this.idle, SPARE_AFTER);
    this.candidate = runner;
    runner.onProgress = (progress) => this.onProgress(progress);
    try {
      const value = await work((method, ...args) => runner.call(method, args));
      this.current?.end(new Cancelled());
      this.current = runner;
      return value;
    } catch (error) {
      runner.end(error instanceof Error ? error : new Error(String(error)));
      throw error;
    } finally {
      if (this.candidate === runner) this.candidate = null;
    }
  }

  /** Ends the engine that is in use, with all that it was asked. */
  endCurrent(): void {
    this.current?.end(new Cancelled());
    this.current = null;
  }

  /** Ends the bake that is under way, if there is one. */
  cancel(): void {
    this.candidate?.end(new Cancelled());
    this.candidate = null;
  }
}
