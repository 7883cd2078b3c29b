// SPDX-License-Identifier: MIT

import assert from 'node:assert/strict';
import test from 'node:test';
import { Hull, cast, castRayAtShape, contacts, distance, overlap, penetration, shapeBounds } from '../src/index.js';
import { cube, errorOf, randomNumbers } from './support.js';

const box = { type: 'box', halfExtents: [1, 1, 1] };
const at = (x, y = 0, z = 0) => ({ position: [x, y, z] });

test('pairs of shapes', () => {
  const apart = distance({ type: 'sphere', radius: 1 }, null, box, at(5));
  assert.deepEqual([apart.distance, apart.overlap, apart.pointA, apart.pointB, apart.normal, apart.status],
                   [3, false, [1, 0, 0], [4, 0, 0], [1, 0, 0], 'converged']);
  assert.equal(overlap(box, null, box, at(1.5)), true);
  assert.equal(overlap(box, null, box, at(2.5)), false);
  assert.ok(Math.abs(penetration(box, null, box, at(1.5)).depth - 0.5) < 1e-6);
  assert.equal(penetration(box, null, box, at(2.5)), null);
  assert.ok(Math.abs(cast(box, null, box, at(5), [-6, 0, 0]).t - 0.5) < 1e-6);
  assert.equal(cast(box, null, box, at(5), [6, 0, 0]), null);
  assert.equal(contacts(box, null, box, at(0, 1.99), { margin: 0.1, tolerance: 0.1 }).contacts.length, 4);
  assert.ok(Math.abs(castRayAtShape(box, null, [5, 0, 0], [-1, 0, 0]).t - 4) < 1e-6);
  assert.equal(castRayAtShape(box, null, [5, 0, 0], [1, 0, 0]), null);
  const turned = { rotation: [0, Math.SQRT1_2, 0, Math.SQRT1_2], position: [1, 2, 3] };
  assert.ok(shapeBounds({ type: 'box', halfExtents: [3, 1, 1] }, turned).max[2] > 5.9);
});

test('hulls of noisy points: corners welded, faces merged', () => {
  const random = randomNumbers(3), corners = [...cube().vertices], points = [...corners.map((x) => x + 1e-4 * random()), ...corners];
  const exact = Hull.bake(points), merged = Hull.bake(points, { weldDistance: 1e-3, mergeDistance: 1e-3 });
  assert.ok(exact.faceCount > 6);
  assert.deepEqual([merged.faceCount, merged.vertexCount, merged.report.cornersLeftOut > 0], [6, 8, true]);
  assert.ok(merged.report.maxOutside > 0 && merged.report.maxOutside <= 2e-3);
  assert.equal(exact.report.cornersLeftOut, 0);
  const rough = Hull.bake(points, { tolerance: 1e-3 });
  assert.ok(rough.vertexCount < exact.vertexCount && rough.report.maxOutside > 0 && rough.report.maxOutside <= 1e-3);
  assert.equal(errorOf(() => Hull.bake(points, { weldDistance: -1 })).field, 'weldDistance');
  assert.equal(errorOf(() => Hull.bake(points, { tolerance: NaN })).field, 'tolerance');
});

test('every type of shape', () => {
  const shapes = [
    { type: 'capsule', a: [0, 0, 0], b: [0, 1, 0], radius: 1 }, { type: 'triangle', a: [1, 0, 0], b: [0, 1, 0], c: [0, 0, 1] },
    { type: 'cylinder', a: [0, 0, 0], b: [0, 1, 0], discRadius: 1 }, { type: 'cone', base: [0, 0, 0], apex: [0, 1, 0], discRadius: 1 },
    { type: 'points', points: [0, 0, 0, 1, 0, 0] }, { type: 'hull', hull: Hull.bake(cube().vertices), radius: 0 }, Hull.bake(cube().vertices),
  ];
  for (const shape of shapes) assert.ok(Math.abs(distance(shape, null, { type: 'sphere', radius: 1 }, at(5)).distance - 3) < 1e-5, shape.type);
  assert.equal(errorOf(() => distance({ type: 'ball' }, null, box, null)).field, 'shape');
  assert.equal(errorOf(() => distance({ type: 'capsule', radius: 1 }, null, box, null)).field, 'shape');
  assert.equal(errorOf(() => distance({ type: 'points', points: [1] }, null, box, null)).field, 'points');
});

test('hulls', () => {
  const hull = Hull.bake([...cube().vertices, 0, 0, 0]);
  assert.deepEqual([hull.vertexCount, hull.faceCount, hull.triangles().length, hull.edges().length], [8, 6, 36, 24]);
  assert.deepEqual([hull.mass().volume, hull.mass().area, hull.mass().center], [8, 24, [0, 0, 0]]);
  assert.deepEqual(hull.bounds(), { min: [-1, -1, -1], max: [1, 1, 1] });
  assert.deepEqual([...hull.sources()], [0, 1, 2, 3, 4, 5, 6, 7]);
  assert.deepEqual([...hull.faces().first], [0, 4, 8, 12, 16, 20, 24]);
  assert.equal(hull.contains([0.5, 0.5, 0.5]), true);
  assert.equal(hull.contains([1.5, 0, 0]), false);
  assert.deepEqual(hull.castRay([5, 0, 0], [-1, 0, 0]).normal, [1, 0, 0]);
  assert.equal(hull.castRay([0, 0, 0], [1, 0, 0]).face, null);
  assert.equal(hull.castRay([5, 0, 0], [1, 0, 0]), null);
  assert.equal(hull.transform([2, 1, 1], at(1)).bounds().max[0], 3);
  assert.deepEqual(Hull.fromBytes(hull.toBytes()).toBytes(), hull.toBytes());
  assert.equal(hull.report.thickened, false);
  assert.equal(errorOf(() => Hull.bake([0, 0, 0, 1, 0, 0, 0, 0, 1])).result, 'TL_ERR_COPLANAR');
  assert.equal(Hull.bake([0, 0, 0, 1, 0, 0, 0, 0, 1], { thickness: 0.1 }).report.thickened, true);
});

test('arrays of a hull are the caller\'s own, and end with it', () => {
  const hull = Hull.bake(cube().vertices), read = () => [hull.sources(), hull.faces().first, hull.faces().indices, hull.edges(), hull.triangles()];
  const before = read().map((array) => [...array]);
  for (const array of read()) array.fill(7);
  assert.deepEqual(read().map((array) => [...array]), before);
  hull.free();
  for (const call of [() => hull.sources(), () => hull.faces(), () => hull.edges(), () => hull.supportClimb([1, 0, 0])]) {
    assert.equal(errorOf(call).result, 'TL_ERR_STALE');
  }
});

test('the climb ends where the support is', () => {
  const random = randomNumbers(7), points = Float32Array.from({ length: 900 }, () => random() - 0.5);
  const hull = Hull.bake(points), v = hull.vertices();
  let longest = 0;
  for (let i = 0; i < 200; i++) {
    const d = [random() - 0.5, random() - 0.5, random() - 0.5].map(Math.fround);
    const climb = hull.supportClimb(d, i % hull.vertexCount), last = climb[climb.length - 1];
    const dot = (k) => v[3 * k] * d[0] + v[3 * k + 1] * d[1] + v[3 * k + 2] * d[2];
    assert.equal(dot(last), dot(hull.support(...d)));
    for (let k = 1; k < climb.length; k++) assert.ok(dot(climb[k]) > dot(climb[k - 1]));
    longest = Math.max(longest, climb.length);
  }
  assert.ok(longest > 4);
});
