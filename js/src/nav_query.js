// SPDX-License-Identifier: MIT
//
// Questions to a navmesh: points, paths, what lies around. Places are points, or locations { polygon, point }.

import { argumentError } from './error.js';
import { Navmesh } from './navmesh.js';
import { F32, F64, SLOT, TL_ERR_NODES, U32, U64, check, fail, slotVec3, wasm } from './module.js';

const START_GIVEN = 1, GOAL_GIVEN = 2, FILTERED = 4, WITH_POLYGONS = 8;
export const HALF_EXTENTS = [2, 4, 2];
export const PATH_STATUS = ['none', 'complete', 'unreachable', 'out of nodes', 'unfinished', 'stale'];
const WIDE_STATUS = ['none', 'complete', 'unreachable', 'out of nodes', 'start blocked', 'goal blocked'];
const ALL_FLAGS = 0xffffffffffffffffn;

/** Writes a filter, and says so in the flags. */
export function filterFlag(filter) {
  if (!filter) return 0;
  U64[SLOT] = filter.includeFlags ?? ALL_FLAGS;
  U64[SLOT + 1] = filter.excludeFlags ?? 0n;
  const costs = filter.areaCost instanceof Map ? [...filter.areaCost] : Object.entries(filter.areaCost ?? {});
  if (costs.length > 256) throw argumentError('areaCost', 'give at most 256');
  F64[SLOT + 2] = costs.length;
  costs.forEach(([area, cost], i) => {
    if (!(Number(area) >= 0 && Number(area) <= 255)) throw argumentError('areaCost', `area ${area}: give 0 to 255`);
    F64[SLOT + 3 + 2 * i] = Number(area);
    F64[SLOT + 4 + 2 * i] = cost;
  });
  F64[SLOT + 3 + 2 * costs.length] = filter.slack ?? 0;
  wasm.js_set_nav_filter();
  return FILTERED;
}

const isLocation = (place) => place.polygon !== undefined;
const pointOf = (place) => (place.polygon !== undefined ? place.point : place);

export function readLocation(at) {
  return { polygon: U64[SLOT + at], point: slotVec3(at + 1) };
}

/** A place as a location: points are moved to the nearest polygon. Null: none is near. */
export function locate(navmesh, place, options) {
  return isLocation(place) ? place : navmesh.findNearest(place, options);
}

export function putLocation(at, location) {
  U64[SLOT + at] = location.polygon;
  for (let i = 0; i < 3; i++) F64[SLOT + at + 1 + i] = location.point[i];
}

/** Flags of a call with a start and a goal, whose references are put into the slot. */
function placeFlags(start, goal, options) {
  let flags = filterFlag(options.filter);
  if (isLocation(start)) {
    U64[SLOT] = start.polygon;
    flags |= START_GIVEN;
  }
  if (isLocation(goal)) {
    U64[SLOT + 1] = goal.polygon;
    flags |= GOAL_GIVEN;
  }
  return flags;
}

// Paths are plain arrays. They are short and asked for often, and V8 keeps a typed array of more than 64 bytes outside of
// its heap: one takes as long to make as finding a prepared path does. A function for each type, so that each stays fast.
function floatsAt(first, count) {
  const list = new Array(count);
  for (let i = 0; i < count; i++) list[i] = F32[first + i];
  return list;
}

function wordsAt(first, count) {
  const list = new Array(count);
  for (let i = 0; i < count; i++) list[i] = U32[first + i];
  return list;
}

export function refsAt(first, count) {
  const list = new Array(count);
  for (let i = 0; i < count; i++) list[i] = U64[first + i];
  return list;
}

/** What tl_js_put_corners left at a place of the slot. */
export function readCorners(at) {
  const s = SLOT + at, count = F64[s];
  return {
    corners: floatsAt(F64[s + 2] / 4, 3 * count),
    cornerPolygons: refsAt(F64[s + 1] / 8, count),
    cornerFlags: wordsAt(F64[s + 3] / 4, count),
  };
}

// Where js_find_path leaves what.
function readPath(words) {
  const s = SLOT, { corners, cornerPolygons, cornerFlags } = readCorners(15);
  const complete = F64[s] !== 0;
  return {
    status: words[F64[s]],
    corners: complete ? corners : [], cornerPolygons, cornerFlags,
    polygons: refsAt(F64[s + 14] / 8, F64[s + 13]),
    length: F64[s + 1], lowerBound: F64[s + 2], surfaceLength: F64[s + 3],
    start: readLocation(5), goal: readLocation(9), nodeCount: F64[s + 4],
  };
}

const methods = {
  findNearest(point, options = {}) {
    const navmesh = this._address, flags = filterFlag(options.filter), h = options.halfExtents ?? HALF_EXTENTS;
    const result = check(wasm.js_find_nearest(navmesh, flags, point[0], point[1], point[2], h[0], h[1], h[2]));
    return result === 0 ? readLocation(0) : null;
  },

  findNearestReachable(from, point, options = {}) {
    const location = locate(this, from, options);
    if (location === null) return null;
    const flags = filterFlag(options.filter);
    U64[SLOT] = location.polygon;
    return check(wasm.js_find_reachable(this._address, flags, point[0], point[1], point[2])) === 0 ? readLocation(0) : null;
  },

  closestPoint(polygon, point) {
    putLocation(0, { polygon, point });
    check(wasm.js_closest_point(this._address));
    return { point: slotVec3(0), inside: F64[SLOT + 3] !== 0 };
  },

  height(polygon, x, z) {
    U64[SLOT] = polygon;
    check(wasm.js_height(this._address, x, z));
    return F64[SLOT];
  },

  island(polygon) {
    U64[SLOT] = polygon;
    check(wasm.js_island(this._address));
    return F64[SLOT];
  },

  isReachable(start, goal, options = {}) {
    const path = this.findPath(start, goal, options);
    if (path?.status === 'out of nodes') fail(TL_ERR_NODES);
    return path !== null && path.status === 'complete';
  },

  findPath(start, goal, options = {}) {
    const navmesh = this._address, h = options.halfExtents ?? HALF_EXTENTS;
    const flags = placeFlags(start, goal, options) | (options.polygons ? WITH_POLYGONS : 0);
    const a = pointOf(start), b = pointOf(goal);
    const result = check(wasm.js_find_path(navmesh, flags, a[0], a[1], a[2], b[0], b[1], b[2], h[0], h[1], h[2]));
    return result === 0 ? readPath(PATH_STATUS) : null;
  },

  findRoute(start, goal, options = {}) {
    const navmesh = this._address, h = options.halfExtents ?? HALF_EXTENTS, flags = filterFlag(options.filter);
    const a = pointOf(start), b = pointOf(goal);
    const result = check(wasm.js_find_route(navmesh, flags, a[0], a[1], a[2], b[0], b[1], b[2], h[0], h[1], h[2]));
    if (result !== 0) return null;
    const path = readPath(PATH_STATUS);
    return { ...path, cost: path.lowerBound, lowerBound: 0, polygons: options.polygons ? path.polygons : [] };
  },

  findWidePath(start, goal, agentRadius, options = {}) {
    const navmesh = this._address, h = options.halfExtents ?? HALF_EXTENTS, flags = placeFlags(start, goal, options);
    const a = pointOf(start), b = pointOf(goal);
    const result = check(wasm.js_find_wide_path(navmesh, flags, agentRadius, a[0], a[1], a[2], b[0], b[1], b[2], h[0], h[1], h[2]));
    if (result !== 0) return null;
    const { status, corners, cornerPolygons, length, lowerBound: wallDistance, surfaceLength, start: from, goal: to } = readPath(WIDE_STATUS);
    return { status, corners, cornerPolygons, wallDistance, length, surfaceLength, start: from, goal: to };
  },

  findWidePlace(center, agentRadius, options = {}) {
    const location = locate(this, center, options);
    if (location === null) return null;
    const flags = filterFlag(options.filter);
    putLocation(0, location);
    return check(wasm.js_find_wide_place(this._address, flags, options.radius ?? 10, agentRadius)) === 0 ? readLocation(0) : null;
  },

  prepare({ tableBytes = 32 * 1024 * 1024 } = {}) {
    F64[SLOT] = tableBytes;
    check(wasm.js_prepare(this._address));
    const s = SLOT;
    return { kind: ['none', 'graph', 'table'][F64[s]], cornerVertexCount: F64[s + 1], edgeCount: F64[s + 2], bytes: F64[s + 3] };
  },

  castRay(start, end, options = {}) {
    const location = locate(this, start, options);
    if (location === null) return null;
    const flags = filterFlag(options.filter);
    putLocation(0, location);
    check(wasm.js_surface_ray(this._address, flags, end[0], end[1], end[2]));
    const s = SLOT;
    return { hit: F64[s] !== 0, t: F64[s + 1], point: slotVec3(2), normal: slotVec3(5), polygon: U64[s + 8] };
  },

  moveAlongSurface(start, target, options = {}) {
    const location = locate(this, start, options);
    if (location === null) return null;
    const flags = filterFlag(options.filter);
    putLocation(0, location);
    check(wasm.js_move(this._address, flags, target[0], target[1], target[2]));
    return readLocation(0);
  },

  findWall(center, radius, options = {}) {
    const location = locate(this, center, options);
    if (location === null) return null;
    const flags = filterFlag(options.filter);
    putLocation(0, location);
    check(wasm.js_find_wall(this._address, flags, radius));
    const s = SLOT;
    return F64[s] === 0 ? null : { distance: F64[s + 1], point: slotVec3(2), normal: slotVec3(5), polygon: U64[s + 8] };
  },

  randomPoint({ around = null, radius = 10, filter = null, random = Math.random } = {}) {
    const location = around === null ? null : locate(this, around, { filter });
    if (around !== null && location === null) return null;
    const flags = filterFlag(filter);
    for (let i = 0; i < 2; i++) {
      U64[SLOT + i] = BigInt(Math.floor(random() * 2 ** 32)) << 32n | BigInt(Math.floor(random() * 2 ** 32));
    }
    if (location !== null) putLocation(2, location);
    return check(wasm.js_random_point(this._address, flags, location === null ? 0 : 1, radius)) === 0 ? readLocation(0) : null;
  },
};

Object.assign(Navmesh.prototype, methods);
