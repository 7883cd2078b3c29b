// SPDX-License-Identifier: MIT
//
// Convex parts: few where the right number is plain, and all that they promise.

import assert from 'node:assert/strict';
import test from 'node:test';
import { Mesh, TalusWorker, decompose, distance, memoryBytes } from '../src/index.js';
import { cube, errorOf, floor } from './support.js';

/** Two cubes of side 2 around x = 0 and x = 6, and a beam that joins them at y = 0. */
function dumbbell() {
  const one = cube(), vertices = [], indices = [];
  const add = (place) => {
    indices.push(...[...one.indices].map((i) => i + vertices.length / 3));
    for (let v = 0; v < one.vertexCount; v++) vertices.push(...place(...one.vertices.subarray(3 * v, 3 * v + 3)));
  };
  add((x, y, z) => [x, y, z]);
  add((x, y, z) => [x + 6, y, z]);
  add((x, y, z) => [3 + 2.5 * x, 0.2 * y, 0.2 * z]);
  return new Mesh(vertices, indices);
}

test('one part for what is convex, three for a dumbbell', () => {
  assert.equal(decompose(cube()).parts.length, 1);
  const { parts, concavity, maxOutside, report } = decompose(dumbbell(), { tolerance: 0.2 });
  assert.equal(parts.length, 3);
  assert.ok(concavity <= 0.2 && maxOutside < 1e-4 && Math.abs(report.tolerance - 0.2) < 1e-6 && report.partsOverTolerance === 0);
  assert.deepEqual(parts.map((part) => part.concavity <= concavity), [true, true, true]);
  const within = (point) => parts.some(({ hull }) => distance(hull, null, { type: 'sphere', center: point, radius: 1e-3 }, null).overlap);
  const { vertices } = dumbbell();
  for (let i = 0; i < vertices.length; i += 3) assert.ok(within([...vertices.subarray(i, i + 3)]));
  assert.ok(!within([3, 0.9, 0]));
});

test('budgets, flat meshes, progress and errors', () => {
  const merged = decompose(dumbbell(), { tolerance: 0.2, maxParts: 1 });
  assert.deepEqual([merged.parts.length, merged.report.partsOverTolerance, merged.concavity > 0.2], [1, 1, true]);
  assert.equal(decompose(floor(), { thickness: 0.2, maxCells: 4096 }).parts[0].hull.report, null);
  const heard = new Set();
  decompose(dumbbell(), { onProgress: (stage) => { heard.add(stage); } });
  assert.ok(heard.has('proof'));
  assert.throws(() => decompose(cube(), { onProgress: () => { throw new RangeError(); } }), RangeError);
  assert.equal(errorOf(() => decompose(cube(), { maxVertices: 3 })).field, 'maxVertices');
  assert.equal(errorOf(() => decompose(cube(), { solid: 'rooms' })).field, 'solid');
  assert.equal(errorOf(() => decompose(floor(), { thickness: 0.5 })).field, 'thickness');
  assert.equal(errorOf(() => decompose(new Mesh([0, 0, 0, 1, 0, 0, 2, 0, 0]))).result, 'TL_ERR_DEGENERATE');
});

test('parts are freed like hulls: memory does not grow', () => {
  const round = () => decompose(dumbbell(), { maxCells: 4096 }).parts.forEach(({ hull }) => hull.free());
  for (let i = 0; i < 3; i++) round();
  const before = memoryBytes();
  for (let i = 0; i < 10; i++) round();
  assert.equal(memoryBytes(), before);
});

test('in a worker: the same bytes', async () => {
  const worker = new TalusWorker(), here = decompose(dumbbell(), { tolerance: 0.2 });
  const there = await worker.decompose(dumbbell(), { tolerance: 0.2 });
  assert.deepEqual(there.parts.map(({ hull }) => hull.toBytes()), here.parts.map(({ hull }) => hull.toBytes()));
  assert.deepEqual([there.concavity, there.report], [here.concavity, here.report]);
  worker.terminate();
});
