// SPDX-License-Identifier: MIT

import assert from 'node:assert/strict';
import test from 'node:test';
import { Mesh, Soup } from '../src/index.js';
import { courtyard, cube, errorOf, floor, randomNumbers } from './support.js';

test('a ray hits what it hits', () => {
  const soup = Soup.bake(floor());
  assert.deepEqual({ ...soup.castRay(1, 30, 0, 0, -1, 0) },
                   { t: 30, triangle: 1, u: soup.castRay(1, 30, 0, 0, -1, 0).u, v: soup.castRay(1, 30, 0, 0, -1, 0).v,
                     nx: 0, ny: 1, nz: 0, material: 0, back: false });
  assert.equal(soup.castRay(1, 30, 0, 0, -1, 0, 29), null);
  assert.equal(soup.castRay(1, -3, 0, 0, 1, 0).back, true);
  assert.equal(soup.castRay(1, -3, 0, 0, 1, 0, Infinity, { cull: 'back' }), null);
  assert.equal(soup.occluded(1, 3, 0, 0, -1, 0), true);
  assert.equal(soup.occluded(9, 3, 0, 0, -1, 0), false);
  assert.equal(soup.castSegment(1, 1, 0, 1, -1, 0).t, 0.5);
  assert.equal(soup.lineOfSight(1, 1, 0, 1, -1, 0), false);
  assert.equal(soup.lineOfSight(1, 1, 0, 2, 1, 0), true);
  soup.free();
});

test('filters: materials, a function, and what it throws', () => {
  const plain = floor();
  const soup = Soup.bake(new Mesh(plain.vertices, plain.indices, [3, 70]));
  assert.equal(soup.castRay(-1, 1, 2, 0, -1, 0).material, 3);
  assert.equal(soup.castRay(-1, 1, 2, 0, -1, 0, Infinity, { ignoredMaterials: [3] }), null);
  assert.equal(soup.castRay(1, 1, 0, 0, -1, 0, Infinity, { ignoredMaterials: [63] }), null);
  const asked = [];
  assert.equal(soup.castRay(1, 1, 0, 0, -1, 0, Infinity, { accept: (t, m) => { asked.push([t, m]); return false; } }), null);
  assert.deepEqual(asked, [[1, 70]]);
  assert.throws(() => soup.castRay(1, 1, 0, 0, -1, 0, Infinity, { accept: () => { throw new RangeError('mine'); } }), RangeError);
  assert.notEqual(soup.castRay(1, 1, 0, 0, -1, 0), null);
  assert.equal(errorOf(() => soup.castRay(0, 1, 0, 0, -1, 0, 1, { cull: 'both' })).field, 'cull');
});

test('batches and all hits agree with single rays, bit for bit', () => {
  const { soup } = courtyard(), { min, max } = soup.bounds(), random = randomNumbers(1), count = 2000;
  const rays = new Float32Array(7 * count);
  for (let i = 0; i < count; i++) {
    for (let k = 0; k < 3; k++) rays[7 * i + k] = min[k] + random() * (max[k] - min[k]);
    for (let k = 3; k < 6; k++) rays[7 * i + k] = random() - 0.5;
    rays[7 * i + 6] = 100;
  }
  const hits = soup.castRays(rays), again = soup.castRays(rays, null, { t: new Float32Array(count) });
  assert.deepEqual(hits.t, again.t);
  let hit = 0;
  for (let i = 0; i < count; i++) {
    const one = soup.castRay(...rays.subarray(7 * i, 7 * i + 7));
    if (one === null) {
      assert.equal(hits.triangle[i], 0xffffffff);
      assert.equal(hits.t[i], Infinity);
      continue;
    }
    hit++;
    assert.deepEqual({ ...one }, hitOfBatch(hits, i));
    const all = soup.castRayAll(rays.subarray(7 * i, 7 * i + 3), rays.subarray(7 * i + 3, 7 * i + 6), { maxT: 100 });
    assert.equal(all[0].t, one.t);
    assert.ok(all.every((h, k) => k === 0 || h.t >= all[k - 1].t));
  }
  assert.ok(hit > 1000 && hit < count);
  assert.equal(errorOf(() => soup.castRays(new Float32Array(8))).field, 'rays');
  assert.equal(errorOf(() => soup.castRays(rays, null, { t: new Float32Array(1) })).field, 'out.t');
});

/** One hit of a batch, as single calls give it. */
function hitOfBatch({ t, triangle, uv, normal, material, back }, i) {
  return { t: t[i], triangle: triangle[i], u: uv[2 * i], v: uv[2 * i + 1], nx: normal[3 * i], ny: normal[3 * i + 1], nz: normal[3 * i + 2],
           material: material[i], back: back[i] === 1 };
}

test('batches of segments, of what is occluded and of what is seen agree with single calls', () => {
  const { mesh } = courtyard(), materials = mesh.indices.filter((_, i) => i % 3 === 0).map((k) => k % 5);
  const soup = Soup.bake(new Mesh(mesh.vertices, mesh.indices, materials)), filter = { cull: 'front', ignoredMaterials: [2] };
  const { min, max } = soup.bounds(), random = randomNumbers(5), count = 1001; // odd: arrays behind one another stay aligned
  const segments = Float32Array.from({ length: 6 * count }, (_, i) => min[i % 3] + random() * (max[i % 3] - min[i % 3]));
  const rays = Float32Array.from({ length: 7 * count }, (_, i) => (i % 7 === 6 ? 9 : i % 7 < 3 ? segments[i % (6 * count)] : random() - 0.5));
  const hits = soup.castSegments(segments, filter), clear = soup.linesOfSight(segments, filter), occluded = soup.occludedRays(rays, filter);
  let met = 0, open = 0, hidden = 0;
  for (let i = 0; i < count; i++) {
    const segment = segments.subarray(6 * i, 6 * i + 6), one = soup.castSegment(...segment, filter);
    if (one !== null) assert.deepEqual({ ...one }, hitOfBatch(hits, i));
    else assert.equal(hits.triangle[i], 0xffffffff);
    met += one !== null;
    assert.equal(clear[i] === 1, soup.lineOfSight(...segment, filter));
    open += clear[i];
    assert.equal(occluded[i] === 1, soup.occluded(...rays.subarray(7 * i, 7 * i + 7), filter));
    hidden += occluded[i];
  }
  assert.ok(met > 100 && open > 100 && hidden > 100 && hidden < count - 100, `${met} ${open} ${hidden}`);
  const out = new Uint8Array(count + 3);
  assert.equal(soup.occludedRays(rays, filter, out), out);
  assert.deepEqual(out.subarray(0, count), occluded);
  assert.equal(errorOf(() => soup.linesOfSight(segments, null, new Uint8Array(3))).field, 'out');
  assert.equal(errorOf(() => soup.castSegments(new Float32Array(7))).field, 'segments');
  assert.equal(soup.castRays(new Float32Array(0)).t.length, 0);
});

test('shapes, points, boxes', () => {
  const soup = Soup.bake(cube());
  const ball = { type: 'sphere', radius: 0.5 };
  assert.equal(soup.overlaps(ball, { position: [1.2, 0, 0] }), true);
  assert.equal(soup.overlaps(ball, { position: [2, 0, 0] }), false);
  assert.ok(soup.findOverlaps(ball, { position: [1.2, 0, 0] }).length >= 2);
  const hit = soup.castShape(ball, { position: [5, 0, 0] }, [-10, 0, 0]);
  assert.ok(Math.abs(hit.t - 0.35) < 1e-5);
  assert.deepEqual(hit.normal, [1, 0, 0]);
  assert.equal(soup.castShape(ball, { position: [5, 0, 0] }, [10, 0, 0]), null);
  assert.equal(soup.nearest([3, 0, 0]).distance, 2);
  assert.equal(soup.nearest([3, 0, 0], 1), null);
  assert.equal(soup.locate([0, 0, 0]).side, 'inside');
  assert.equal(soup.locate([3, 0, 0]).side, 'outside');
  assert.equal(soup.locate([1, 0, 0]).side, 'on surface');
  soup.checkClosed();
  assert.equal(errorOf(() => Soup.bake(floor()).checkClosed()).result, 'TL_ERR_NOT_CLOSED');
  assert.equal(soup.trianglesInBox({ min: [0.9, -2, -2], max: [2, 2, 2] }).length >= 2, true);
  assert.equal(soup.castRayAll([-5, 0.1, 0.2], [1, 0, 0], { rule: 'crossed' }).length, 2);
});

test('refit moves triangles; drawing counts them', () => {
  const mesh = floor(), soup = Soup.bake(mesh);
  const lifted = new Mesh(mesh.vertices.map((x, i) => (i % 3 === 1 ? x + 2 : x)), mesh.indices);
  soup.refit(lifted);
  assert.equal(soup.castRay(1, 30, 0, 0, -1, 0).t, 28);
  const level = courtyard().soup, stats = level.stats(), pairs = level.pairs(), boxes = level.boxes();
  assert.equal(pairs.count, stats.pairCount + stats.singleCount);
  assert.equal(pairs.triangles.filter((t) => t !== 0xffffffff).length, stats.triangleCount - stats.coincidentCount);
  assert.ok(boxes.count > stats.leafCount);
  assert.equal(Math.max(...boxes.depth), stats.depth);
  assert.ok(level.boxes(1).count < boxes.count);
  const walk = level.walkRay([20, 10, 20], [0, -1, 0]);
  assert.equal(walk.hit.t, 5);
  assert.equal(walk.entered[0], 1);
  assert.ok(walk.count < boxes.count && walk.entered.includes(0));
  const seen = level.visibleOutline([20, 6.8, 20], { count: 90, distance: 30 });
  assert.equal(seen.points.length, 270);
  assert.equal(errorOf(() => Soup.bake(mesh, { layout: 'compact' }).refit(lifted)).result, 'TL_ERR_UNSUPPORTED');
});

test('quality: splits add references, not answers', () => {
  // Long slivers through clutter: boxes that only splits make smaller.
  const random = randomNumbers(9), vertices = [];
  const add = (size, ...corners) => {
    const at = [0, 1, 2].map(() => size * random());
    corners.forEach((corner) => vertices.push(...corner.map((x, i) => x + at[i])));
  };
  for (let i = 0; i < 200; i++) add(20, [0, 0, 0], [10, 10, 10], [10.05, 10, 10]);
  for (let i = 0; i < 1000; i++) add(30, [0, 0, 0], [0.1, 0, 0], [0, 0.1, 0.1]);
  const [fast, high] = ['fast', 'high'].map((quality) => Soup.bake(new Mesh(vertices), { quality }));
  assert.ok(high.stats().referenceCount > fast.stats().referenceCount);
  let hits = 0;
  for (let i = 0; i < 3000; i++) {
    const ray = Array.from({ length: 6 }, (_, k) => (k < 3 ? 30 * random() : random() - 0.5));
    const [a, b] = [fast, high].map((soup) => ({ ...soup.castRay(...ray) }));
    assert.deepEqual(a, b);
    hits += a.t !== undefined ? 1 : 0;
  }
  assert.ok(hits > 10, String(hits));
});

test('bytes go round; damaged ones are refused by name', () => {
  const { soup } = courtyard(), bytes = soup.toBytes();
  const copy = Soup.fromBytes(bytes);
  assert.deepEqual(copy.toBytes(), bytes);
  assert.equal(copy.castRay(20, 10, 20, 0, -1, 0).t, 5);
  copy.free();
  assert.equal(errorOf(() => Soup.fromBytes(bytes.slice(0, 100))).result, 'TL_ERR_TRUNCATED');
  const other = bytes.slice();
  other[0] ^= 1;
  assert.equal(errorOf(() => Soup.fromBytes(other)).result, 'TL_ERR_MAGIC');
});

test('errors name what is wrong', () => {
  const nan = errorOf(() => Soup.bake(new Mesh([0, 0, 0, 1, 0, 0, 0, NaN, 1])));
  assert.deepEqual([nan.result, nan.element, nan.elementIndex], ['TL_ERR_NOT_FINITE', 'vertex', 2]);
  assert.equal(errorOf(() => Soup.bake(new Mesh([0, 0, 0], [0, 0, 7]))).result, 'TL_ERR_INDEX');
  assert.equal(errorOf(() => Soup.bake(new Mesh([]))).result, 'TL_ERR_EMPTY');
  assert.equal(errorOf(() => Soup.bake(floor(), { layout: 'tiny' })).field, 'layout');
  assert.equal(errorOf(() => Soup.bake(floor(), { splitBudget: 2 })).field, 'splitBudget');
  assert.equal(errorOf(() => Soup.bake(floor(), { quality: 'best' })).field, 'quality');
  assert.equal(errorOf(() => Soup.bake({})).field, 'mesh');
  assert.equal(errorOf(() => new Mesh([1, 2])).field, 'vertices');
  assert.equal(errorOf(() => Soup.bake(floor()).castRayAll([0, NaN, 0], [0, 1, 0])).result, 'TL_ERR_NOT_FINITE');
  assert.throws(() => new Soup(), TypeError);
});
