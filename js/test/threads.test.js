// SPDX-License-Identifier: MIT
//
// Threads: the same bytes and answers as with one, errors and cancelling, and a clear word where they cannot be had.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, readdirSync } from 'node:fs';
import test from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { Mesh, Navmesh, Soup, TalusWorker, hasSimd, init, memoryBytes, sampleLevel, threads } from '../src/index.js';
import { errorOf } from './errors.js';

const index = new URL('../src/index.js', import.meta.url).href;

/** What another process prints, as this one's module is loaded once. */
function printed(source, env = {}) {
  return execFileSync('node', ['--input-type=module', '-e', source], { encoding: 'utf8', timeout: 60_000, env: { ...process.env, ...env } });
}

/** Bytes and answers of all that runs on threads, as one text. Its source runs elsewhere, with one thread. */
function everything(talus, hash) {
  const words = [], add = (name, ...arrays) => words.push(`${name} ${hash(arrays)}`);
  const tilesOf = (navmesh) => navmesh.tiles().map((_, i) => navmesh.tileBytes(i));
  for (const name of ['courtyard', 'dungeon', 'terrain']) {
    const level = talus.sampleLevel(name), { mesh } = level.weld();
    const soup = talus.Soup.bake(level), whole = talus.Navmesh.bake(mesh), tiled = talus.Navmesh.bake(mesh, { tileSize: 48 });
    const obstacles = talus.Navmesh.bake(mesh, { tileSize: 64, obstacles: true });
    add(`${name} soup`, soup.toBytes());
    add(`${name} navmesh`, ...tilesOf(whole));
    add(`${name} tiles`, ...tilesOf(tiled));
    add(`${name} with obstacles`, ...tilesOf(obstacles));
    const place = (navmesh, i, k) => navmesh.randomPoint({ random: () => ((i * 37 + k * 17) % 103) / 103 }).point;
    for (let i = 0; i < 20; i++) obstacles.addObstacle({ type: 'cylinder', base: place(obstacles, i, 1), radius: 0.4, height: 2 });
    words.push(`${name} wait ${obstacles.updateObstacles()}`);
    add(`${name} under obstacles`, ...tilesOf(obstacles));
    words.push(`${name} prepared ${JSON.stringify([tiled.prepare(), obstacles.prepare({ tableBytes: 0 })])}`);
    for (let i = 0; i < 20; i++) words.push(`${obstacles.findPath(place(obstacles, i, 2), place(obstacles, i, 3))?.length}`);
    add(`${name} hull`, talus.Hull.bake(mesh.vertices).toBytes());
    words.push(`${name} peak ${whole.report.peakBytes > 0} ${JSON.stringify(whole.audit(soup, { pathCount: 50 }))}`);
    const rays = Float32Array.from({ length: 7 * 20000 }, (_, i) => (i % 7 === 6 ? 1000 : Math.fround(((i * 7919) % 1009) / 20 - (i % 7 > 2 ? 25 : 0))));
    const batch = soup.castRays(rays);
    add(`${name} rays`, ...Object.values(batch).map((array) => new Uint8Array(array.buffer)), soup.occludedRays(rays));
    const segments = rays.subarray(0, 6 * 5001);
    add(`${name} segments`, ...Object.values(soup.castSegments(segments)).map((array) => new Uint8Array(array.buffer)), soup.linesOfSight(segments));
    for (const count of [0, 1, 255, 1025, 1281]) add(`${name} ${count} rays`, new Uint8Array(soup.castRays(rays.subarray(0, 7 * count)).t.buffer));
    add(`${name} rays of a filter`, new Uint8Array(soup.castRays(rays, { accept: (triangle) => triangle % 3 !== 0 }).t.buffer));
    const crowd = talus.Crowd.create(whole, { maxAgents: 300 });
    for (let i = 0; i < 300; i++) {
      const at = (k) => whole.randomPoint({ random: () => ((i * 31 + k * 17) % 101) / 101 }).point;
      crowd.setGoal(crowd.add({ position: at(1) }), at(2));
    }
    for (let i = 0; i < 60; i++) crowd.step(1 / 60);
    words.push(`${name} crowd ${crowd.hash()}`);
  }
  return words.join('\n');
}
const hash = (arrays) => arrays.reduce((sum, array) => sum.update(array), createHash('sha256')).digest('hex');
const one = printed(`
  import * as talus from ${JSON.stringify(index)};
  import { createHash } from 'node:crypto';
  await talus.init();
  const hash = ${hash};
  console.log((${everything})(talus, hash));`).trim();

await init({ threads: 3 });

test('as many as were asked for', () => {
  assert.deepEqual(threads(), { count: 3, reason: null });
  assert.equal(hasSimd(), true);
});

test('the same bytes and answers as with one thread', async () => {
  const lines = everything(await import('../src/index.js'), hash).split('\n');
  assert.ok(lines.length > 25);
  assert.deepEqual(lines, one.split('\n'));
});

test('memory that a thread made larger is seen', () => {
  const before = memoryBytes(), { mesh } = sampleLevel('city', { triangles: 200000 }).weld();
  const navmesh = Navmesh.bake(mesh, { tileSize: 64 });
  assert.ok(memoryBytes() > before);
  const polygons = navmesh.polygons();
  assert.ok(polygons.corners.every(Number.isFinite) && polygons.count > 1000);
  navmesh.free();
  const after = memoryBytes();
  for (let i = 0; i < 3; i++) Navmesh.bake(mesh, { tileSize: 64 }).free();
  assert.ok(memoryBytes() <= 1.25 * after, `${memoryBytes()} of ${after}`);
});

test('errors, cancelling and memory that runs out', () => {
  const { mesh } = sampleLevel('dungeon').weld();
  assert.equal(errorOf(() => Navmesh.bake(mesh, { cellSize: -1 })).field, 'cellSize');
  let updates = 0;
  assert.throws(() => Navmesh.bake(mesh, { tileSize: 32, onProgress: () => { if (++updates === 3) throw new RangeError('enough'); } }), /enough/);
  const wide = new Mesh([0, 0, 0, 0, 0, 5e4, 5e4, 0, 0], [0, 1, 2]);
  assert.equal(errorOf(() => Navmesh.bake(wide, { cellSize: 1.6, cellHeight: 0.2, agentRadius: 0 })).result, 'TL_ERR_MEMORY');
  assert.ok(Navmesh.bake(mesh, { tileSize: 32 }).polygonCount > 0);
});

/** How many threads this process has, where the system tells. */
const tasks = () => (existsSync('/proc/self/task') ? readdirSync('/proc/self/task').length : 0);

test('a worker has its own; an aborted bake ends them too', { timeout: 60_000 }, async () => {
  const before = tasks();
  const worker = new TalusWorker({ threads: 2 }), level = sampleLevel('city', { triangles: 100000 }), stop = new AbortController();
  assert.equal(worker.threads, null);
  assert.deepEqual((await worker.bakeSoup(level)).toBytes(), Soup.bake(level).toBytes());
  assert.deepEqual(worker.threads, { count: 2, reason: null });
  const bake = worker.bakeNavmesh(level, { cellSize: 0.1, tileSize: 32, signal: stop.signal, onProgress: () => stop.abort(new Error('enough')) });
  await assert.rejects(bake, /enough/);
  assert.ok((await worker.bakeHull(level.vertices)).vertexCount > 3);
  worker.terminate();
  while (tasks() > before) await sleep(20);
});

test('one thread, and why, where there can be no more', () => {
  const ask = (before, options) => JSON.parse(printed(`
    ${before}
    const { init, threads, Soup, sampleLevel } = await import(${JSON.stringify(index)});
    await init(${options});
    if (Soup.bake(sampleLevel('courtyard')).stats().triangleCount !== 6000) throw new Error();
    console.log(JSON.stringify(threads()));`));
  assert.deepEqual(ask('', '{}'), { count: 1, reason: null });
  const reasons = [['globalThis.crossOriginIsolated = false;', '{ threads: 2 }', /Cross-Origin-Opener-Policy/],
                   ['delete globalThis.SharedArrayBuffer;', '{ threads: 2 }', /Cross-Origin-Embedder-Policy/],
                   ['WebAssembly.Memory = class { constructor() { throw new RangeError(); } };', '{ threads: 2 }', /no room/],
                   ['', '{ threads: 2, simd: false }', /SIMD/],
                   ['', `{ threads: 2, wasm: ${JSON.stringify(new URL('../dist/talus.wasm', import.meta.url).href)} }`, /no module with threads/],
                   ["import { Worker } from 'node:worker_threads';",
                    "{ threads: 2, createThread: () => new Worker('throw new Error(\"no thread here\")', { eval: true }) }", /no thread here/]];
  for (const [before, options, reason] of reasons) {
    const answer = ask(before, options);
    assert.equal(answer.count, 1, options);
    assert.match(answer.reason, reason);
  }
});

test('numbers that are none are refused', () => {
  for (const count of ['0', '65', '1.5', '"2"']) {
    assert.equal(printed(`import { init } from ${JSON.stringify(index)};
      await init({ threads: ${count} }).catch((error) => console.log(error.field));`), 'threads\n');
  }
});

test('the small module has one', () => {
  assert.match(printed(`import { init, threads } from ${JSON.stringify(index)};
    await init({ part: 'queries', threads: 2 }); console.log(threads().count, threads().reason);`), /^1 the module of queries/);
});
