// SPDX-License-Identifier: MIT
//
// Bakes in a worker. The worker holds nothing between two bakes: what it needs is posted, what it made comes back as
// bytes, from which the page makes its objects. To abort is to replace the worker: a bake never waits for messages.

import { TalusError } from './error.js';
import { Hull } from './hull.js';
import { Mesh } from './mesh.js';
import { Navmesh } from './navmesh.js';
import { Soup } from './soup.js';
import { rememberLinks } from './nav_tools.js';
import { ready } from './module.js';

async function startWorker(options) {
  if (options.create) return options.create();
  if (typeof Worker !== 'undefined') {
    // Written so that bundlers see it.
    return options.url ? new Worker(options.url, { type: 'module' })
                       : new Worker(new URL('./worker_entry.js', import.meta.url), { type: 'module' });
  }
  const threads = 'node:worker_threads';
  const { Worker: NodeWorker } = await import(/* @vite-ignore */ threads);
  return new NodeWorker(options.url ?? new URL('./worker_entry.js', import.meta.url));
}

/** A mesh, or a list of points, as it is posted. */
const plainMesh = (mesh) => ({ vertices: mesh.vertices, indices: mesh.indices, materials: mesh.materials });

/** Options without what cannot be posted. */
function plainOptions(options) {
  const { onProgress, signal, ...rest } = options;
  return { ...rest, watched: onProgress !== undefined };
}

function listen(worker, onMessage, onError) {
  if (worker.on) {
    worker.on('message', onMessage);
    worker.on('error', onError);
  } else {
    worker.onmessage = (event) => onMessage(event.data);
    worker.onerror = (event) => onError(new TalusError('TL_ERR_IO', `the worker failed: ${event.message ?? 'it could not be loaded'}`));
  }
}

export class TalusWorker {
  #options;
  #worker = null; // a promise
  #job = null;    // the one under way: { resolve, reject, onProgress }
  #turn = Promise.resolve();
  #waiting = new Set(); // reject functions of what waits for its turn
  #threads = null;

  constructor(options = {}) {
    ready();
    this.#options = options;
  }

  async #start() {
    const worker = await startWorker(this.#options);
    const lost = (error) => {
      this.#worker = null;
      this.#job?.reject(error);
    };
    listen(worker, (message) => this.#take(message), lost);
    const { wasm, simd, threads } = this.#options;
    worker.postMessage({ init: { wasm: wasm instanceof URL ? wasm.href : wasm, simd, threads } });
    return worker;
  }

  get threads() {
    return this.#threads;
  }

  #take(message) {
    if (message.threads) this.#threads = message.threads;
    const job = this.#job;
    if (job === null) return;
    if (message.progress) {
      try {
        job.onProgress?.(...message.progress);
      } catch (error) {
        this.#stop(error);
      }
    } else if (message.error) {
      job.reject(message.error.result ? new TalusError(message.error.result, message.error.message, message.error)
                                      : new Error(message.error.message));
    } else if ('value' in message) {
      job.resolve(message.value);
    }
  }

  /** Ends the bake under way with a reason, and the worker with it. */
  #stop(reason) {
    const worker = this.#worker;
    this.#worker = null;
    worker?.then((w) => w.terminate(), () => {});
    this.#job?.reject(reason);
  }

  async #run(task, args, options) {
    const signal = options.signal;
    signal?.throwIfAborted();
    const abort = () => this.#stop(signal.reason);
    try {
      return await new Promise((resolve, reject) => {
        this.#job = { resolve, reject, onProgress: options.onProgress };
        signal?.addEventListener('abort', abort);
        this.#worker ??= this.#start();
        this.#worker.then((worker) => {
          worker.ref?.(); // node: its process waits for a bake, and not for an idle worker
          worker.postMessage({ task, args, options: plainOptions(options) });
        }).catch(reject);
      });
    } finally {
      signal?.removeEventListener('abort', abort);
      this.#job = null;
      this.#worker?.then((worker) => worker.unref?.(), () => {});
    }
  }

  /** Runs a task when those before it have ended. */
  #queue(task, args, options = {}) {
    let drop, given = false;
    const dropped = new Promise((_, reject) => {
      drop = (reason) => {
        given = true; // at once: its turn may come before the rejection does
        reject(reason);
      };
    });
    dropped.catch(() => {});
    this.#waiting.add(drop);
    const leave = () => { this.#waiting.delete(drop); };
    const abandon = () => drop(options.signal.reason);
    options.signal?.addEventListener('abort', abandon);
    const result = this.#turn.then(() => {
      leave();
      if (given) return undefined;
      return this.#run(task, args, options);
    });
    this.#turn = result.catch(() => {});
    return Promise.race([result, dropped]).finally(() => {
      leave();
      options.signal?.removeEventListener('abort', abandon);
    });
  }

  async weld(mesh, options) {
    const { vertices, indices, materials, sourceTriangles, report } = await this.#queue('weld', { mesh: plainMesh(mesh) }, options);
    return { mesh: new Mesh(vertices, indices, materials), sourceTriangles, report };
  }

  async bakeSoup(mesh, options) {
    return Soup.fromBytes(await this.#queue('soup', { mesh: plainMesh(mesh) }, options));
  }

  async bakeHull(points, options) {
    const { bytes, report } = await this.#queue('hull', { points: Float32Array.from(points) }, options);
    const hull = Hull.fromBytes(bytes);
    hull.report = report;
    return hull;
  }

  async decompose(mesh, options) {
    const { parts, ...rest } = await this.#queue('decompose', { mesh: plainMesh(mesh) }, options);
    return { parts: parts.map(({ bytes, ...part }) => ({ hull: Hull.fromBytes(bytes), ...part })), ...rest };
  }

  async bakeNavmesh(mesh, options = {}) {
    if (options.obstacles) {
      throw new TalusError('TL_ERR_UNSUPPORTED', 'obstacles keep what a worker cannot hand over: bake on this thread', { field: 'obstacles' });
    }
    const { tiles, options: baked, report } = await this.#queue('navmesh', { mesh: plainMesh(mesh) }, options);
    const navmesh = Navmesh.fromTiles(tiles, baked);
    navmesh.report = report;
    return navmesh;
  }

  bakeStages(mesh, options) {
    return this.#queue('stages', { mesh: plainMesh(mesh) }, options);
  }

  polygonSteps(mesh, options) {
    return this.#queue('steps', { mesh: plainMesh(mesh) }, options);
  }

  #plainNavmesh(navmesh) {
    return { tiles: navmesh.tiles().map((_, i) => navmesh.tileBytes(i)), options: navmesh.options, links: navmesh.offMeshLinks() };
  }

  async findLinks(navmesh, soup, options) {
    const { links, report, bytes } = await this.#queue('links', { navmesh: this.#plainNavmesh(navmesh), soup: soup.toBytes() }, options);
    rememberLinks(links, bytes);
    return { links, report };
  }

  async audit(navmesh, soup, options) {
    const { audit, refs } = await this.#queue('audit', { navmesh: this.#plainNavmesh(navmesh), soup: soup.toBytes() }, options);
    // Polygons have other references here than in the worker.
    const here = navmesh.polygons().refs;
    for (const finding of audit.findings) finding.polygon = finding.polygon === null ? null : here[refs.indexOf(finding.polygon)];
    return audit;
  }

  why(navmesh, mesh, point, options) {
    return this.#queue('why', { navmesh: this.#plainNavmesh(navmesh), mesh: plainMesh(mesh), point: Array.from(point) }, options);
  }

  terminate() {
    const reason = new TalusError('TL_ERR_CANCELLED', 'the worker was terminated (TL_ERR_CANCELLED)');
    this.#waiting.forEach((drop) => drop(reason));
    this.#stop(reason);
  }
}
