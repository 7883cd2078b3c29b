// SPDX-License-Identifier: MIT
//
// What changes a navmesh: off-mesh links, temporary obstacles, tiles that are baked again.

import { argumentError, TalusError } from './error.js';
import { withInput } from './mesh.js';
import { Navmesh } from './navmesh.js';
import { readLocation } from './nav_query.js';
import { F64, SLOT, U64, check, putAabb, putPose, putVec3, slotVec3, wasm, watched } from './module.js';
import { SHAPE_NUMBERS, hullOf, withShapes } from './shape.js';

/** Writes a link in the order of tl_js_offmesh (wasm/js_nav_change.c). */
export function putOffMeshLink(link) {
  const s = SLOT;
  putVec3(0, link.start ?? [0, 0, 0]);
  putVec3(3, link.end ?? [0, 0, 0]);
  F64[s + 6] = link.radius ?? 0.5;
  F64[s + 7] = link.costFactor ?? 1;
  F64[s + 8] = link.fixedCost ?? 0;
  U64[s + 9] = link.flags ?? 1n;
  U64[s + 10] = link.user ?? 0n;
  F64[s + 11] = link.area ?? 63;
  F64[s + 12] = link.bothWays ? 1 : 0;
}

/** Reads what tl_js_put_offmesh wrote. */
export function readOffMeshLink(at) {
  const s = SLOT + at;
  return { start: slotVec3(at), end: slotVec3(at + 3), radius: F64[s + 6], costFactor: F64[s + 7], fixedCost: F64[s + 8],
           flags: U64[s + 9], user: U64[s + 10], area: F64[s + 11], bothWays: F64[s + 12] !== 0 };
}

const SHAPES = ['cylinder', 'box', 'prism', 'convex'];
const CONVEX = 44; // where the slot has a convex obstacle's shape, behind the points of a prism

/** Writes an obstacle in the order of obstacle_at. */
function putObstacle(at, obstacle) {
  const shape = SHAPES.indexOf(obstacle.type), s = SLOT + at, outline = obstacle.outline ?? [];
  if (shape < 0) throw argumentError('type', `one of ${SHAPES.join(', ')}`);
  if (outline.length > 32) throw argumentError('outline', 'give at most 16 points, x and z of each');
  const turned = obstacle.angle !== undefined && obstacle.angle !== 0;
  F64[s] = shape;
  F64[s + 1] = obstacle.area ?? 0;
  putVec3(at + 2, obstacle.base ?? [0, 0, 0]);
  F64[s + 5] = obstacle.height ?? 0;
  F64[s + 6] = obstacle.radius ?? 0;
  F64[s + 7] = obstacle.halfX ?? 0;
  F64[s + 8] = obstacle.halfZ ?? 0;
  F64[s + 9] = turned ? Math.cos(obstacle.angle) : 0;
  F64[s + 10] = turned ? Math.sin(obstacle.angle) : 0;
  F64[s + 11] = Math.floor(outline.length / 2);
  for (let i = 0; i < outline.length; i++) F64[s + 12 + i] = outline[i];
}

/** Runs a call with an obstacle in the slot. */
function withObstacle(at, obstacle, run) {
  putObstacle(at, obstacle);
  if (obstacle.type !== 'convex') return run();
  if (obstacle.shape?.type === 'points') throw argumentError('shape', 'give a Hull of the points: an obstacle keeps its shape');
  putPose(at + CONVEX + SHAPE_NUMBERS, obstacle.pose);
  return withShapes([[at + CONVEX, obstacle.shape]], run);
}

function needObstacles(navmesh) {
  if (!wasm.js_has_obstacles(navmesh._address)) {
    throw new TalusError('TL_ERR_UNSUPPORTED', 'the navmesh was baked without obstacles: bake it with obstacles: true and a tileSize',
                         { field: 'obstacles', advice: 'bake it with obstacles: true and a tileSize' });
  }
}

const methods = {
  addOffMeshLink(link) {
    putOffMeshLink(link);
    check(wasm.js_offmesh_add(this._address));
    return U64[SLOT];
  },

  removeOffMeshLink(ref) {
    U64[SLOT] = ref;
    check(wasm.js_offmesh_remove(this._address));
  },

  offMeshLinks() {
    const links = [];
    for (let cursor = 0; wasm.js_offmesh_next(this._address, cursor);) {
      const s = SLOT, anchored = F64[s + 15] !== 0;
      const ends = [18, 22].map((at) => (U64[s + at] === 0n ? null : readLocation(at)));
      cursor = F64[s];
      links.push({ ref: U64[s + 1], ...readOffMeshLink(2), anchored, length: F64[s + 16], cost: F64[s + 17], ends });
    }
    return links;
  },

  addObstacle(obstacle) {
    needObstacles(this);
    check(withObstacle(0, obstacle, () => wasm.js_obstacle_add(this._address)));
    const id = U64[SLOT];
    this._keepHull(id, obstacle.type === 'convex' ? hullOf(obstacle.shape) : null);
    return id;
  },

  moveObstacle(id, obstacle) {
    needObstacles(this);
    U64[SLOT] = id;
    check(withObstacle(1, obstacle, () => wasm.js_obstacle_move(this._address)));
    this._keepHull(id, obstacle.type === 'convex' ? hullOf(obstacle.shape) : null);
  },

  removeObstacle(id) {
    needObstacles(this);
    U64[SLOT] = id;
    check(wasm.js_obstacle_remove(this._address));
    this._keepHull(id, null);
  },

  updateObstacles(maxTiles = 0xffffffff) {
    needObstacles(this);
    check(wasm.js_obstacles_update(this._address, maxTiles));
    return F64[SLOT];
  },

  rebake(mesh, changed, options = {}) {
    return withInput(mesh, options, () => watched(options, null, () => {
      putAabb(0, changed);
      check(wasm.js_rebake(this._address));
      return F64[SLOT];
    }));
  },
};

Object.assign(Navmesh.prototype, methods);
