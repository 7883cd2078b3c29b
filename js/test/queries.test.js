// SPDX-License-Identifier: MIT
//
// The small module: what the full one baked gives the same answers, a worker bakes, and what is not in it says so.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import test from 'node:test';
import { Crowd, Hull, Mesh, Navmesh, Soup, TalusWorker, distance, hasBakes, hasSimd, init, loadPack, sampleLevel, savePack } from '../src/index.js';
import { errorOf } from './errors.js';

// In another process, as this one has the small module: a file, and what the full module answers of it.
const program = `
  import { Navmesh, Soup, init, sampleLevel, savePack } from ${JSON.stringify(new URL('../src/index.js', import.meta.url).href)};
  await init();
  const level = sampleLevel('courtyard'), navmesh = Navmesh.bake(level.weld().mesh), soup = Soup.bake(level);
  navmesh.addJumpLinks(navmesh.findLinks(soup).links);
  const path = navmesh.findPath([2, 0, 20], [20, 5, 20]), wide = navmesh.findWidePath([2, 0, 20], [20, 5, 20], 0.8);
  const hit = soup.castRay(10, 30, 20, 0, -1, 0);
  process.stdout.write(JSON.stringify({ bytes: Buffer.from(savePack({ soup, navmesh })).toString('base64'), path, wide, hit },
                                      (_, value) => (typeof value === 'bigint' ? String(value) : value)));`;
const full = JSON.parse(execFileSync('node', ['--input-type=module', '-e', program], { encoding: 'utf8', maxBuffer: 1 << 26 }));
const plain = (value) => JSON.parse(JSON.stringify(value, (_, v) => (typeof v === 'bigint' ? String(v) : v)));

await init({ part: 'queries' });
const pack = loadPack(new Uint8Array(Buffer.from(full.bytes, 'base64')));
const floor = new Mesh([-5, 0, -5, -5, 0, 5, 5, 0, 5, 5, 0, -5], [0, 1, 2, 0, 2, 3]);

test('the module has SIMD and no bakes', () => {
  assert.equal(hasSimd(), true);
  assert.equal(hasBakes(), false);
});

test('the same answers as the full module', () => {
  assert.deepEqual(plain(pack.navmesh.findPath([2, 0, 20], [20, 5, 20])), full.path);
  assert.deepEqual(plain(pack.navmesh.findWidePath([2, 0, 20], [20, 5, 20], 0.8)), full.wide);
  assert.deepEqual({ ...pack.soup.castRay(10, 30, 20, 0, -1, 0) }, full.hit);
  assert.ok(pack.links.length > 0);
  assert.equal(pack.soup.overlaps({ type: 'sphere', radius: 0.5, center: [10, 30 - full.hit.t, 20] }), true);
  pack.navmesh.prepare();
  assert.equal(pack.navmesh.findPath([2, 0, 20], [20, 5, 20]).status, 'complete');
});

test('what is not in it says what to do', () => {
  const calls = [() => Soup.bake(floor), () => Navmesh.bake(floor), () => Hull.bake([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]),
                 () => sampleLevel('courtyard'), () => savePack({ soup: pack.soup }), () => pack.navmesh.addObstacle({}),
                 () => Crowd.create(pack.navmesh), () => pack.navmesh.audit(pack.soup), () => pack.navmesh.why(floor, [0, 0, 0]), () => pack.navmesh.findLinks(pack.soup),
                 () => distance({ type: 'sphere', radius: 1 }, null, { type: 'sphere', radius: 1 }, null)];
  for (const call of calls) {
    const error = errorOf(call);
    assert.equal(error.result, 'TL_ERR_UNSUPPORTED', String(call));
    assert.match(error.advice, /TalusWorker/);
  }
});

test('a worker bakes with the full module', async () => {
  const worker = new TalusWorker();
  const soup = await worker.bakeSoup(floor), navmesh = await worker.bakeNavmesh(floor);
  assert.equal(soup.castRay(1, 30, 0, 0, -1, 0).t, 30);
  assert.equal(navmesh.findPath([-3, 0, 0], [3, 0, 0]).status, 'complete');
  worker.terminate();
});

test('another part is refused', async () => {
  const source = `import { init } from ${JSON.stringify(new URL('../src/index.js', import.meta.url).href)};
    await init({ part: 'half' }).catch((error) => console.log(error.field));`;
  assert.equal(execFileSync('node', ['--input-type=module', '-e', source], { encoding: 'utf8' }), 'part\n');
});
