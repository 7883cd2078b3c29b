// SPDX-License-Identifier: MIT

import assert from 'node:assert/strict';
import test from 'node:test';
import { CharacterMover, Hull, Scene, Soup } from '../src/index.js';
import { courtyard, cube, errorOf, floor, randomNumbers } from './support.js';

const BALL = { type: 'sphere', radius: 1 };

test('a scene answers as its instances do, one by one', () => {
  const { soup } = courtyard(), { min, max } = soup.bounds(), random = randomNumbers(3);
  const scene = Scene.bake([{ soup }, { shape: BALL, pose: { position: [20, 6, 20] } }]);
  scene.set(1, { shape: { type: 'sphere', radius: 3 } });
  scene.refit();
  let balls = 0;
  for (let i = 0; i < 2000; i++) {
    const o = [0, 1, 2].map((k) => min[k] + random() * (max[k] - min[k])), d = [0, 1, 2].map(() => random() - 0.5);
    const alone = soup.castRay(...o, ...d), found = scene.castRay(...o, ...d);
    const other = scene.castRay(...o, ...d, Infinity, { ignored: [1, 1] });
    assert.equal(other?.t ?? null, alone?.t ?? null);
    assert.equal(scene.occluded(...o, ...d), scene.castRay(...o, ...d) !== null);
    if (found?.instance === 1) balls++;
    else if (alone !== null) assert.equal(alone.t, found.t);
  }
  assert.ok(balls > 5, `${balls} rays meet the ball`);
  scene.free();
});

test('instances move, change and are ignored', () => {
  const soup = Soup.bake(floor());
  const scene = Scene.bake([{ soup }, { shape: BALL, pose: { position: [2, 1, 0] }, mask: 4 }, {}]);
  assert.equal(scene.count, 3);
  const down = (x, filter) => {
    const hit = { ...scene.castRay(x, 9, 0, 0, -1, 0, 100, filter) };
    return { ...hit, t: Number(hit.t.toFixed(4)) }; // shapes are asked by iteration
  };
  assert.deepEqual([down(2).t, down(2).instance, down(2).triangle], [7, 1, null]);
  assert.deepEqual([down(2, { ignoredMask: 4 }).t, down(2, { ignoredMask: 4 }).instance], [9, 0]);
  assert.equal(scene.castRay(2, -9, 0, 0, 1, 0, 100, { ignoredMask: 4, triangles: { cull: 'back' } }), null);
  assert.equal(scene.lineOfSight(0, 1, 0, 4, 1, 0), false);
  scene.set(1, { pose: { position: [-3, 1, 0] } });
  assert.ok(scene.refit() >= 1);
  assert.deepEqual([down(2).t, down(-3).t], [9, 7]);
  assert.equal(scene.lineOfSight(0, 1, 0, 4, 1, 0), true);
  const near = scene.nearest([-3, 4, 0]);
  assert.deepEqual([near.instance, Number(near.distance.toFixed(4)), near.triangle], [1, 2, null]);
  const hit = scene.castShape({ type: 'sphere', radius: 0.5 }, { position: [0, 5, 0] }, [0, -10, 0]);
  assert.ok(Math.abs(hit.t - 0.45) < 1e-5 && hit.instance === 0 && hit.normal[1] === 1, JSON.stringify(hit));
  assert.equal(scene.castShape(BALL, { position: [0, 5, 0] }, [0, 1, 0]), null);
  assert.deepEqual(scene.findOverlaps(BALL, { position: [-3, 1.5, 0] }), [{ instance: 1, triangle: null }]);
  scene.set(2, { shape: { type: 'box', halfExtents: [1, 1, 1] }, pose: { position: [0, 20, 0] } });
  scene.set(1, { shape: null });
  scene.rebake();
  assert.deepEqual([down(-3).t, scene.castRay(0, 30, 0, 0, -1, 0).instance], [9, 2]);
  assert.equal(errorOf(() => scene.set(3, {})).field, 'index');
  assert.equal(errorOf(() => scene.set(0, { shape: { type: 'capsule', radius: 1 } })).field, 'shape');
  scene.refit();
  assert.equal(down(-3).t, 9, 'what was there stays');
  assert.equal(errorOf(() => Scene.bake([{ shape: { type: 'points', points: [0, 0, 0] } }])).field, 'shape');
  const wrong = errorOf(() => Scene.bake([{}, { shape: BALL, pose: { position: [NaN, 0, 0] } }]));
  assert.deepEqual([wrong.result, wrong.elementIndex], ['TL_ERR_NOT_FINITE', 1]);
  scene.free();
});

test('instances have scales', () => {
  const soup = Soup.bake(floor());
  const box = { type: 'box', halfExtents: [1, 1, 1] };
  const scene = Scene.bake([{ soup, scale: [2, 1, 2] }, { shape: box, scale: [1, 3, 1] }, { shape: BALL, pose: { position: [5, 0, 0] }, scale: 2 }]);
  const down = (x) => {
    const { t, instance } = scene.castRay(x, 9, 0, 0, -1, 0);
    return [Number(t.toFixed(4)), instance]; // shapes are asked by iteration
  };
  assert.deepEqual([down(0), down(5)], [[6, 1], [7, 2]]);
  scene.set(1, { scale: null });
  scene.refit();
  assert.deepEqual(down(0), [8, 1]);
  scene.set(2, { scale: [1, 2, 1] });
  const wrong = errorOf(() => scene.refit());
  assert.deepEqual([wrong.result, wrong.elementIndex], ['TL_ERR_ARGUMENT', 2]);
  scene.free();
});

test('what a scene points to outlives its own free', () => {
  const soup = Soup.bake(floor()), hull = Hull.bake(cube().vertices);
  const scene = Scene.bake([{ soup }, { shape: hull, pose: { position: [0, 5, 0] } }]);
  soup.free();
  hull.free();
  assert.equal(soup.freed, true);
  assert.equal(errorOf(() => soup.castRay(0, 1, 0, 0, -1, 0)).result, 'TL_ERR_STALE');
  for (let i = 0; i < 50; i++) Soup.bake(floor()).free(); // would take the place of what was freed
  assert.equal(scene.castRay(3, 9, 3, 0, -1, 0).t, 9);
  assert.ok(Math.abs(scene.castRay(0, 9, 0, 0, -1, 0).t - 3) < 1e-4);
  scene.free();
  scene.free();
  assert.equal(errorOf(() => scene.castRay(0, 9, 0, 0, -1, 0)).result, 'TL_ERR_STALE');
});

const GRAVITY = -9.81;
/** Steps at 60 Hz with gravity, walking along x. */
function walk(mover, level, state, steps, speed) {
  const reports = [];
  for (let i = 0; i < steps; i++) {
    const fall = state.grounded ? 0 : (state.velocity?.[1] ?? 0) + GRAVITY / 60;
    reports.push(mover.move(level, state, { velocity: [speed, fall, 0], seconds: 1 / 60 }));
  }
  return reports;
}

test('a character falls, lands, walks and stops at a wall', () => {
  const mover = CharacterMover.create();
  const scene = Scene.bake([{ soup: Soup.bake(floor()) }, { shape: { type: 'box', halfExtents: [0.5, 2, 5] }, pose: { position: [3, 2, 0] } }]);
  const state = { position: [-3, 1, 0] };
  const reports = walk(mover, scene, state, 300, 2);
  assert.equal(reports.filter((one) => one.landed).length, 1);
  assert.ok(state.grounded && Math.abs(state.position[1] - 0.002) < 1e-3, `feet at ${state.position[1]}`);
  assert.ok(state.position[0] > 2.1 && state.position[0] < 2.2, `stands at ${state.position[0]}: radius 0.3 before the wall at 2.5`);
  const last = reports.at(-1);
  assert.ok(last.blocked && last.hits.some((hit) => hit.surface === 'wall' && hit.instance === 1 && hit.triangle === null));
  const up = mover.move(scene, state, { velocity: [0, 5, 0], seconds: 1 / 60, jump: true });
  assert.ok(up.leftGround && !state.grounded && state.position[1] > 0.05);
  // The same state and steps, the same numbers: also from a copy.
  const a = { position: [-3, 1, 0] };
  walk(mover, scene, a, 77, 1.3);
  const b = JSON.parse(JSON.stringify(a));
  walk(mover, scene, a, 50, 1.3);
  walk(mover, scene, b, 50, 1.3);
  assert.deepEqual(a, b);
});

test('a character rides on a platform, and errors change nothing', () => {
  const mover = CharacterMover.create({ radius: 0.4, height: 1.6 });
  const scene = Scene.bake([{ shape: { type: 'box', halfExtents: [2, 0.5, 2] }, pose: { position: [0, -0.5, 0] } }]);
  const state = { position: [0.5, 0.01, 0] };
  walk(mover, scene, state, 5, 0);
  assert.deepEqual([state.grounded, state.groundTriangle, state.groundInstance], [true, null, 0]);
  const x = state.position[0];
  scene.set(0, { pose: { position: [1, -0.25, 0] } });
  scene.refit();
  const report = mover.move(scene, state, { velocity: [0, 0, 0], seconds: 1 / 60 });
  assert.ok(Math.abs(state.position[0] - x - 1) < 1e-4 && state.position[1] > 0.24, `carried to ${state.position}`);
  assert.ok(Math.abs(report.carried[0] - 1) < 1e-4);
  const before = structuredClone(state);
  assert.equal(errorOf(() => mover.move(scene, state, { velocity: [NaN, 0, 0], seconds: 1 })).field, 'velocity');
  assert.deepEqual(state, before);
  assert.equal(errorOf(() => CharacterMover.create({ radius: 2, height: 1 })).result, 'TL_ERR_ARGUMENT');
  assert.equal(errorOf(() => mover.move({}, state, { velocity: [0, 0, 0], seconds: 1 })).field, 'level');
  const { soup } = courtyard();
  const walker = { position: [20, 1, 30] };
  walk(mover, soup, walker, 240, 1.5);
  assert.ok(walker.grounded && walker.position[0] > 22 && Math.abs(walker.position[1]) < 0.3, `walked to ${walker.position}`);
});
