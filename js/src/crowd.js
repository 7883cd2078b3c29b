// SPDX-License-Identifier: MIT
//
// Crowds: agents that walk a navmesh, avoid one another, and follow a leader in groups. wasm/js_nav_crowd.c has the order
// of numbers in the slot.

import { argumentError, wholeNumber } from './error.js';
import { Handle, PRIVATE, refuseNew } from './handle.js';
import { filterFlag, locate, putLocation } from './nav_query.js';
import { shortest } from './nav_options.js';
import { F64, SLOT, U64, U8, check, copyIn, copyOut, fail, putVec3, readString, ready, release, slotVec3, wasm } from './module.js';

const CROWD = ['maxAgents', 'maxPath', 'maxNeighbors', 'pathsPerStep', 'maxNodes', 'maxSharedGoals', 'maxGroups', 'maxMembers',
               'neighborDistance', 'agentHorizon', 'wallHorizon'];
const CROWD_COUNTS = 8;
const AGENT = ['reach', 'radius', 'height', 'maxSpeed', 'maxAcceleration', 'arriveDistance', 'priority'];
const GROUP = ['spacing', 'waitDistance', 'lostDistance'];
const FORMATIONS = ['loose', 'line', 'column', 'wedge', 'ring', 'slots'];
const STEP = ['searched', 'waiting', 'walking', 'arrived', 'unreachable', 'onLink', 'offMesh', 'shared'];

function putNumber(at, name, value) {
  if (value === undefined) return; // the default stands there
  if (typeof value !== 'number') throw argumentError(name, 'give a number');
  F64[SLOT + at] = value;
}

function putCount(at, name, value) {
  if (value === undefined) return;
  F64[SLOT + at] = wholeNumber(name, value);
}

function putCrowd(options) {
  ready().js_crowd_default();
  CROWD.forEach((name, i) => (i < CROWD_COUNTS ? putCount : putNumber)(i, name, options[name]));
}

function putAgent(options) {
  wasm.js_agent_default();
  putVec3(0, options.position ?? [0, 0, 0]);
  AGENT.forEach((name, i) => putNumber(3 + i, name, options[name]));
  putCount(3 + AGENT.length, 'filter', options.filter);
  if (options.isFixed !== undefined) F64[SLOT + 4 + AGENT.length] = options.isFixed ? 1 : 0;
}

/** Runs a call with a group's def in the slot: its slots stand in the module's memory meanwhile. */
function withGroup(options, followers, run) {
  const slots = options.slots ?? [];
  if (options.formation === 'slots' && slots.length !== 2 * followers) {
    throw argumentError('slots', 'give two numbers for each agent but the leader: forward, left');
  }
  const slotsAt = slots.length > 0 ? copyIn(Float32Array.from(slots)) : 0;
  try {
    wasm.js_group_default();
    if (options.formation !== undefined) F64[SLOT] = FORMATIONS.indexOf(options.formation);
    if (F64[SLOT] < 0) throw argumentError('formation', `one of ${FORMATIONS.join(', ')}`);
    GROUP.forEach((name, i) => putNumber(1 + i, name, options[name]));
    if (options.keepOrder !== undefined) F64[SLOT + 4] = options.keepOrder ? 1 : 0;
    F64[SLOT + 5] = slotsAt;
    return run();
  } finally {
    release(slotsAt);
  }
}

export class Crowd extends Handle {
  #navmesh;

  constructor(key, address, navmesh) {
    refuseNew(key, 'Crowd');
    super(address, 'js_crowd_free');
    this.#navmesh = navmesh;
  }

  static create(navmesh, options = {}) {
    putCrowd(options);
    const address = wasm.js_crowd_create() >>> 0;
    if (address === 0) {
      check(F64[SLOT]);
      fail(F64[SLOT]);
    }
    return new Crowd(PRIVATE, address, navmesh);
  }

  /** The slot's first number is a name: an agent or a group. */
  #named(name) {
    U64[SLOT] = name;
    return this._address;
  }

  add(options) {
    const crowd = this._address, navmesh = this.#navmesh._address;
    putAgent(options);
    return check(wasm.js_crowd_add(crowd, navmesh)) === 0 ? U64[SLOT] : null;
  }

  remove(agent) {
    check(wasm.js_crowd_remove(this.#named(agent)));
  }

  setGoal(agent, goal, options = {}) {
    const place = goal === null ? null : locate(this.#navmesh, goal, options);
    if (goal !== null && place === null) return false;
    if (place !== null) putLocation(1, place);
    check(wasm.js_crowd_set_goal(this.#named(agent), place === null ? 0 : 1));
    return true;
  }

  setMotion(agent, position, velocity) {
    putVec3(1, position);
    putVec3(4, velocity);
    check(wasm.js_crowd_set_motion(this.#named(agent)));
  }

  setFilter(place, filter) {
    check(wasm.js_crowd_set_filter(this._address, place, filterFlag(filter)));
  }

  step(dt) {
    check(wasm.js_crowd_step(this._address, this.#navmesh._address, dt));
    return Object.fromEntries(STEP.map((name, i) => [name, F64[SLOT + i]]));
  }

  agent(agent) {
    check(wasm.js_crowd_agent(this.#named(agent)));
    const s = SLOT, link = U64[s + 11], polygon = U64[s + 10];
    return { status: readString(F64[s]), position: slotVec3(1), velocity: slotVec3(4), wanted: slotVec3(7),
             polygon: polygon === 0n ? null : polygon, link: link === 0n ? null : link, goal: slotVec3(12),
             radius: shortest(F64[s + 15]), height: shortest(F64[s + 16]) };
  }

  agents() {
    check(wasm.js_crowd_agents(this._address));
    const [count, at] = F64.subarray(SLOT, SLOT + 2), statusAt = at + 32 * count;
    const names = new Map();
    const status = Array.from(U8.subarray(statusAt, statusAt + count), (code) => {
      if (!names.has(code)) names.set(code, readString(wasm.js_agent_status(code) >>> 0));
      return names.get(code);
    });
    return { count, agents: copyOut(BigUint64Array, at, count), positions: copyOut(Float32Array, at + 8 * count, 3 * count),
             velocities: copyOut(Float32Array, at + 20 * count, 3 * count), status };
  }

  corners(agent) {
    const result = check(wasm.js_crowd_corners(this.#named(agent), this.#navmesh._address));
    return result === 0 ? copyOut(Float32Array, F64[SLOT + 1], 3 * F64[SLOT]) : null;
  }

  addGroup(agents, options = {}) {
    const crowd = this._address, names = BigUint64Array.from(agents), at = copyIn(names);
    try {
      return withGroup(options, names.length - 1, () => {
        check(wasm.js_crowd_add_group(crowd, at, names.length));
        return U64[SLOT];
      });
    } finally {
      release(at);
    }
  }

  removeGroup(group) {
    check(wasm.js_crowd_remove_group(this.#named(group)));
  }

  setFormation(group, options = {}) {
    const followers = this.group(group).count - 1;
    withGroup(options, followers, () => {
      U64[SLOT + 6] = group;
      check(wasm.js_crowd_set_formation(this._address));
    });
  }

  group(group) {
    check(wasm.js_crowd_group(this.#named(group)));
    const s = SLOT;
    return { formation: FORMATIONS[F64[s]], count: F64[s + 1], inPlace: F64[s + 2], onTrail: F64[s + 3], lag: F64[s + 4],
             speed: F64[s + 5], heading: slotVec3(6), leader: U64[s + 9] };
  }

  members(group) {
    check(wasm.js_crowd_members(this.#named(group)));
    return copyOut(BigUint64Array, F64[SLOT + 1], F64[SLOT]);
  }

  groupOf(agent) {
    wasm.js_crowd_group_of(this.#named(agent));
    return U64[SLOT] === 0n ? null : U64[SLOT];
  }

  save() {
    check(wasm.js_crowd_save(this._address));
    const [size, at] = F64.subarray(SLOT, SLOT + 2);
    return U8.slice(at, at + size);
  }

  restore(bytes) {
    const crowd = this._address, at = copyIn(bytes);
    try {
      check(wasm.js_crowd_restore(crowd, at, bytes.length));
    } finally {
      release(at);
    }
  }

  hash() {
    wasm.js_crowd_hash(this._address);
    return U64[SLOT];
  }
}
