// SPDX-License-Identifier: MIT

import assert from 'node:assert/strict';
import test from 'node:test';
import { Corridor, Navmesh, sampleLevel } from '../src/index.js';
import { errorOf, floor } from './support.js';

const away = (a, b) => Math.hypot(a[0] - b[0], a[2] - b[2]);
const yard = (options = {}) => Navmesh.bake(sampleLevel('courtyard').weld().mesh, { agentRadius: 0.4, ...options });
const FROM = [2, 0, 20], TO = [20, 0, 1];

/** Walks to the end in steps of 0.2 m; gives the length of the way. */
function walk(corridor, eachStep = () => {}) {
  let length = 0;
  for (let step = 0; step < 1000; step++) {
    const here = corridor.position, { corners, more } = corridor.corners(2), next = corners.slice(3, 6);
    if (next.length === 0 || (!more && away(here, corridor.target) < 1e-3)) return length;
    const left = away(here, next), share = Math.min(1, 0.2 / left);
    const now = corridor.move(here.map((x, i) => x + share * (next[i] - x)));
    length += away(here, now);
    eachStep(step);
  }
  throw new Error('it does not arrive');
}

test('an agent walks the shortest path', () => {
  const navmesh = yard(), path = navmesh.findPath(FROM, TO, { polygons: true }), corridor = Corridor.create(navmesh, FROM);
  assert.deepEqual([corridor.position, corridor.target, corridor.polygons.length, corridor.reaches], [path.start.point, path.start.point, 1, true]);
  const search = corridor.find(TO);
  assert.equal(search.status, 'complete');
  assert.ok(search.nodeCount > 0 && Math.abs(search.cost - path.length) < 1e-3 * path.length);
  assert.deepEqual(corridor.polygons, path.polygons);
  assert.deepEqual(corridor.goal, path.goal.point);
  const all = corridor.corners(64);
  assert.equal(all.more, false);
  assert.equal(all.corners.length, path.corners.length);
  all.corners.forEach((x, i) => assert.ok(Math.abs(x - path.corners[i]) < 1e-4));
  assert.equal(all.cornerFlags[0] & 1, 1);
  assert.equal(all.cornerFlags.at(-1) & 2, 2);
  const some = corridor.corners(2);
  assert.deepEqual([some.more, some.corners.length, some.cornerPolygons.length, some.cornerFlags.length], [true, 6, 2, 2]);
  const length = walk(corridor);
  assert.ok(length >= path.length - 0.01 && length < 1.01 * path.length, `${length} of ${path.length}`);
  assert.ok(away(corridor.position, path.goal.point) < 1e-3);
  assert.equal(corridor.polygons.length, 1);
});

test('targets that walk, agents that are pushed, doors that open', () => {
  const navmesh = Navmesh.bake(floor(), { agentRadius: 0.3 }), corridor = Corridor.create(navmesh, [-4, 0, -4]);
  corridor.find([4, 0, 4]);
  assert.ok(away(corridor.moveTarget([3, 0, 4]), [3, 0, 4]) < 1e-3);
  assert.ok(away(corridor.target, [3, 0, 4]) < 1e-3);
  assert.ok(away(corridor.move([-3, 0, 0]), [-3, 0, 0]) < 1e-3);
  assert.ok(away(corridor.move([-30, 0, 0]), [-4.4, 0, 0]) < 0.1, `${corridor.position}`); // along the wall
  const { corners } = corridor.corners();
  assert.ok(away(corners.slice(3, 6), [3, 0, 4]) < 1e-3); // straight on
  assert.equal(corridor.shorten(), false); // nothing is shorter
  assert.equal(typeof corridor.improve(), 'boolean');
  assert.equal(corridor.reset([1, 0, 1]), true);
  assert.ok(away(corridor.target, [1, 0, 1]) < 1e-3);
  assert.equal(corridor.reset([90, 0, 90]), false);
  assert.equal(corridor.find([90, 0, 90]), null);
  assert.ok(away(corridor.target, [1, 0, 1]) < 1e-3); // as it was
});

test('tiles that leave are noticed and repaired', () => {
  const navmesh = yard({ tileSize: 32 }), corridor = Corridor.create(navmesh, FROM);
  corridor.find(TO);
  const count = corridor.polygons.length;
  assert.equal(corridor.validCount(), count);
  assert.equal(corridor.validCount(1), 1);
  assert.deepEqual(corridor.repair(), { status: 'complete', cost: 0, nodeCount: 0 });
  const obstacles = yard({ tileSize: 32, obstacles: true });
  const other = Corridor.create(obstacles, FROM);
  other.find(TO);
  const middle = other.corners(3).corners.slice(3, 6);
  obstacles.addObstacle({ type: 'cylinder', base: middle, radius: 1, height: 2 });
  obstacles.updateObstacles();
  assert.ok(other.validCount() < other.polygons.length);
  const repaired = other.repair();
  assert.equal(repaired.status, 'complete');
  assert.ok(repaired.nodeCount > 0);
  assert.equal(other.validCount(), other.polygons.length);
  walk(other);
  assert.ok(away(other.position, TO) < 1);
});

test('off-mesh links are passed', () => {
  const navmesh = yard();
  navmesh.addOffMeshLink({ start: FROM, end: TO, costFactor: 0.1 });
  const corridor = Corridor.create(navmesh, FROM);
  assert.equal(corridor.passLink(), null);
  corridor.find(TO);
  assert.ok(corridor.corners().cornerFlags.some((flags) => flags & 16));
  const passed = corridor.passLink();
  assert.ok(away(passed.from.point, FROM) < 1 && away(passed.to.point, TO) < 1);
  assert.equal(typeof passed.link, 'bigint');
  assert.ok(away(corridor.position, TO) < 1);
});

test('filters, short buffers, faults', () => {
  const navmesh = yard(), corridor = Corridor.create(navmesh, FROM, { capacity: 4 });
  corridor.find(TO);
  assert.equal(corridor.polygons.length, 4);
  assert.equal(corridor.reaches, false);
  assert.equal(corridor.validCount(9, { filter: { excludeFlags: 0xffffffffffffffffn } }), 1); // where it stands
  assert.equal(Corridor.create(navmesh, [500, 0, 500]), null);
  assert.equal(errorOf(() => Corridor.create(navmesh, FROM, { capacity: 0 })).field, 'capacity');
  assert.equal(errorOf(() => corridor.corners(0)).field, 'count');
  assert.equal(errorOf(() => corridor.move([NaN, 0, 0])).result, 'TL_ERR_NOT_FINITE');
  assert.throws(() => new Corridor(), TypeError);
  navmesh.free();
  assert.equal(errorOf(() => corridor.corners()).result, 'TL_ERR_STALE');
  corridor.free();
  assert.equal(errorOf(() => corridor.position).result, 'TL_ERR_STALE');
});
