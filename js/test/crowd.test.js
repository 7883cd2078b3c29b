// SPDX-License-Identifier: MIT

import assert from 'node:assert/strict';
import test from 'node:test';
import { Crowd, Navmesh } from '../src/index.js';
import { courtyard, errorOf, floor } from './support.js';

const square = Navmesh.bake(floor(), { agentRadius: 0.3 });
const away = (a, b) => Math.hypot(a[0] - b[0], a[2] - b[2]);

test('agents walk to their goals and through one another never', () => {
  const crowd = Crowd.create(square), count = 12, agents = [];
  for (let i = 0; i < count; i++) {
    const angle = 2 * Math.PI * i / count, x = 4 * Math.cos(angle), z = 4 * Math.sin(angle);
    agents.push(crowd.add({ position: [x, 0, z], radius: 0.25, priority: i / count }));
    assert.equal(crowd.setGoal(agents[i], [-x, 0, -z]), true);
  }
  let nearest = Infinity, report;
  for (let step = 0; step < 400; step++) {
    report = crowd.step(1 / 20);
    const { positions } = crowd.agents();
    for (let i = 0; i < count; i++) {
      for (let k = 0; k < i; k++) nearest = Math.min(nearest, away(positions.subarray(3 * i, 3 * i + 3), positions.subarray(3 * k, 3 * k + 3)));
    }
  }
  assert.ok(nearest > 0.45 && nearest < 1, `${nearest} m`); // they meet in the middle
  assert.equal(report.arrived, count);
  const all = crowd.agents();
  assert.deepEqual([all.count, all.agents.length, all.positions.length, all.velocities.length, all.status.length], [12, 12, 36, 36, 12]);
  agents.forEach((agent, i) => {
    const state = crowd.agent(agent);
    assert.equal(state.status, 'arrived');
    assert.ok(away(state.position, state.goal) < 0.2);
    assert.equal(state.radius, 0.25);
    assert.notEqual(state.polygon, null);
    assert.equal(state.link, null);
    const k = all.agents.indexOf(agent);
    assert.deepEqual([...all.positions.subarray(3 * k, 3 * k + 3)], state.position, String(i));
    assert.equal(all.status[k], 'arrived');
  });
  crowd.free();
  assert.equal(errorOf(() => crowd.step(0.1)).result, 'TL_ERR_STALE');
});

test('corners of a way, filters, fixed agents, removal', () => {
  const { navmesh } = courtyard(), crowd = Crowd.create(navmesh, { maxAgents: 4 });
  const agent = crowd.add({ position: [2, 0, 20] });
  assert.equal(crowd.setGoal(agent, [20, 5, 20]), true);
  assert.equal(crowd.agent(agent).status, 'waiting');
  crowd.step(0.1);
  assert.equal(crowd.agent(agent).status, 'walking');
  const corners = crowd.corners(agent);
  assert.ok(corners.length >= 6);
  assert.ok(away(corners.subarray(0, 3), [2, 0, 20]) < 1);
  assert.equal(crowd.setGoal(agent, null), true);
  crowd.step(0.1);
  assert.equal(crowd.agent(agent).status, 'idle');
  assert.equal(crowd.setGoal(agent, [0, 900, 0]), false);
  assert.equal(crowd.add({ position: [0, 900, 0] }), null);
  crowd.setFilter(3, { excludeFlags: 0xffffffffffffffffn });
  assert.equal(crowd.add({ position: [2, 0, 20], filter: 3 }), null); // nothing passes
  crowd.setFilter(3, null);
  assert.notEqual(crowd.add({ position: [2, 0, 20], filter: 3 }), null);
  const player = crowd.add({ position: [3, 0, 20], isFixed: true });
  crowd.setMotion(player, [4, 1, 20], [1, 0, 0]);
  const { status, position, polygon } = crowd.agent(player);
  assert.deepEqual({ status, position, polygon }, { status: 'fixed', position: [4, 1, 20], polygon: null });
  crowd.remove(player);
  assert.equal(errorOf(() => crowd.agent(player)).result, 'TL_ERR_STALE');
  assert.equal(crowd.agents().count, 2);
  crowd.free();
});

test('a group follows its leader in its formation', () => {
  const crowd = Crowd.create(square), agents = [0, 1, 2, 3, 4].map((i) => crowd.add({ position: [-4, 0, i - 2] }));
  const group = crowd.addGroup(agents, { formation: 'wedge', spacing: 1 });
  assert.deepEqual([...crowd.members(group)].sort(), [...agents].sort());
  assert.equal(crowd.groupOf(agents[3]), group);
  crowd.setGoal(agents[0], [3, 0, 0]);
  for (let step = 0; step < 300; step++) crowd.step(1 / 20);
  const state = crowd.group(group);
  assert.deepEqual([state.formation, state.count, state.leader], ['wedge', 5, agents[0]]);
  assert.equal(state.inPlace, 5);
  assert.ok(Math.abs(Math.hypot(...state.heading) - 1) < 1e-5);
  assert.ok(agents.slice(1).every((a) => crowd.agent(a).position[0] < crowd.agent(agents[0]).position[0] - 0.4)); // behind it
  crowd.setFormation(group, { formation: 'slots', slots: [0, 1, 0, -1, 0, 2, 0, -2], keepOrder: true });
  for (let step = 0; step < 200; step++) crowd.step(1 / 20);
  const { heading } = crowd.group(group), at = crowd.agent(agents[0]).position;
  const ahead = ([x, , z]) => (x - at[0]) * heading[0] + (z - at[2]) * heading.at(-1);
  assert.ok(agents.every((a) => Math.abs(ahead(crowd.agent(a).position)) < 0.2)); // abreast
  assert.ok(heading[0] > 0.9);
  assert.equal(errorOf(() => crowd.setFormation(group, { formation: 'slots', slots: [0, 1] })).field, 'slots');
  assert.equal(errorOf(() => crowd.setFormation(group, { formation: 'square' })).field, 'formation');
  assert.equal(errorOf(() => crowd.setGoal(agents[1], [0, 0, 0])).result, 'TL_ERR_ARGUMENT'); // it follows
  assert.equal(errorOf(() => crowd.addGroup(agents)).field, 'agents');
  crowd.removeGroup(group);
  assert.equal(crowd.groupOf(agents[3]), null);
  assert.equal(errorOf(() => crowd.group(group)).result, 'TL_ERR_STALE');
});

test('a saved state goes on as the first one did', () => {
  const make = () => {
    const crowd = Crowd.create(square, { maxAgents: 8 });
    for (let i = 0; i < 8; i++) crowd.setGoal(crowd.add({ position: [i - 4, 0, i % 2 ? 4 : -4] }), [3 - i, 0, i % 2 ? -4 : 4]);
    return crowd;
  };
  const first = make(), second = Crowd.create(square, { maxAgents: 8 });
  for (let i = 0; i < 20; i++) first.step(0.05);
  const bytes = first.save();
  second.restore(bytes);
  assert.equal(second.hash(), first.hash());
  for (let i = 0; i < 20; i++) [first, second].forEach((crowd) => crowd.step(0.05));
  assert.deepEqual(second.save(), first.save());
  assert.notDeepEqual(second.save(), bytes);
  assert.equal(errorOf(() => second.restore(bytes.slice(0, -8))).result.startsWith('TL_ERR_'), true);
  assert.equal(errorOf(() => Crowd.create(square).restore(bytes)).result, 'TL_ERR_ARGUMENT');
});

test('errors name the option', () => {
  assert.equal(errorOf(() => Crowd.create(square, { maxAgents: 0 })).field, 'maxAgents');
  assert.equal(errorOf(() => Crowd.create(square, { maxPath: 1.5 })).field, 'maxPath');
  assert.equal(errorOf(() => Crowd.create(square, { agentHorizon: NaN })).field, 'agentHorizon');
  const crowd = Crowd.create(square, { maxAgents: 1 });
  assert.equal(errorOf(() => crowd.add({ position: [0, 0, 0], radius: -1 })).field, 'radius');
  assert.equal(errorOf(() => crowd.add({ position: [0, NaN, 0] })).result, 'TL_ERR_NOT_FINITE');
  crowd.add({ position: [0, 0, 0] });
  assert.equal(errorOf(() => crowd.add({ position: [0, 0, 0] })).result, 'TL_ERR_LIMIT');
  assert.equal(errorOf(() => crowd.step(-1)).result, 'TL_ERR_ARGUMENT');
  assert.throws(() => new Crowd(), TypeError);
});
