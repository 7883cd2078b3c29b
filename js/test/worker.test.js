// SPDX-License-Identifier: MIT
//
// Bakes in a worker: the same bytes, while this thread goes on; aborted at any time.

import assert from 'node:assert/strict';
import test from 'node:test';
import { TalusWorker, bakeStages, sampleLevel } from '../src/index.js';
import { courtyard } from './support.js';

test('the same answers as on this thread', async () => {
  const { mesh, source, soup, navmesh } = courtyard(), worker = new TalusWorker(), heard = [];
  const baked = await worker.bakeNavmesh(mesh, { onProgress: (stage) => heard.push(stage) });
  assert.deepEqual(baked.tileBytes(0), navmesh.tileBytes(0));
  assert.equal(baked.report.polygonCount, navmesh.report.polygonCount);
  assert.ok(heard.includes('contours'));
  assert.deepEqual((await worker.bakeSoup(source)).toBytes(), soup.toBytes());
  assert.equal((await worker.bakeHull(mesh.vertices)).report.thickened, false);
  assert.deepEqual((await worker.weld(source)).mesh.indices, mesh.indices);
  assert.deepEqual((await worker.bakeStages(mesh)).compact.distance, bakeStages(mesh).compact.distance);
  assert.ok((await worker.polygonSteps(mesh, { contour: 0 })).count > 0);
  assert.equal((await worker.why(navmesh, mesh, [0.3, 0, 20])).reasons[0].option, 'agentRadius');
  const { links } = await worker.findLinks(navmesh, soup);
  assert.deepEqual(links, navmesh.findLinks(soup).links);
  baked.addJumpLinks(links);
  assert.deepEqual(await worker.audit(navmesh, soup, { pathCount: 50 }), navmesh.audit(soup, { pathCount: 50 }));
  await assert.rejects(worker.bakeNavmesh(mesh, { cellSize: -1 }), { name: 'TalusError', result: 'TL_ERR_ARGUMENT', field: 'cellSize' });
  worker.terminate();
});

test('this thread goes on; an aborted bake ends at once, and the next one runs', async () => {
  const worker = new TalusWorker(), large = sampleLevel('city', { triangles: 300000 }), stop = new AbortController();
  let ticks = 0;
  const clock = setInterval(() => { if (++ticks === 5) stop.abort(new Error('enough')); }, 5);
  const waiting = worker.bakeSoup(courtyard().source);
  const second = new AbortController();
  const dropped = worker.bakeSoup(large, { signal: second.signal });
  second.abort(new Error('not needed'));
  await assert.rejects(dropped, /not needed/);
  await waiting;
  await assert.rejects(worker.bakeNavmesh(large, { signal: stop.signal, cellSize: 0.1 }), /enough/);
  clearInterval(clock);
  assert.ok(ticks >= 5);
  assert.equal((await worker.bakeSoup(courtyard().source)).stats().triangleCount, 6000);
  const last = worker.bakeSoup(large);
  worker.terminate();
  await assert.rejects(last, { result: 'TL_ERR_CANCELLED' });
});
