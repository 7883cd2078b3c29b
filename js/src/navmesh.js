// SPDX-License-Identifier: MIT
//
// The navmesh: baking, tiles, drawing. Its queries stand in nav_query.js, what changes it in nav_change.js, links, audit
// and why in nav_tools.js; each adds its methods to the class here.

import { argumentError } from './error.js';
import { Handle, PRIVATE, refuseNew } from './handle.js';
import { withInput } from './mesh.js';
import { putNavOptions, readNavOptions } from './nav_options.js';
import { F32, F64, SLOT, TL_ERR_MEMORY, U32, U64, U8, check, copyIn, copyOut, fail, ready, release, slotAabb, wasm, watched } from './module.js';

const REPORT = ['spanCount', 'compactSpanCount', 'regionCount', 'filteredRegions', 'filteredSpans', 'filteredArea',
                'contourCount', 'unbridgedHoles', 'slitOutlines', 'repairedContours', 'polygonCount', 'vertexCount',
                'detailTriangleCount', 'limitedPatches', 'tileCount', 'peakBytes'];

/** Milliseconds between the updates of a bake, booked to the stage that was under way. */
function stopwatch() {
  const times = {};
  let stage = null, since = 0;
  return {
    times,
    update(name, done, total) {
      const now = performance.now();
      if (stage !== null) times[stage] = (times[stage] ?? 0) + (now - since);
      stage = done < total ? name : null;
      since = now;
    },
  };
}

// Where each polygon's part of an array begins: numbers of 32 bits where the tile needs them, else of 16.
function firstsOf(tile, address) {
  return new (tile.hasWideFirsts ? Uint32Array : Uint16Array)(U8.buffer, address, tile.polygonCount + 1);
}

export class Navmesh extends Handle {
  #maxNodes = 2 ** 30; // memory grows with need: no search is too large
  #options = null;
  #hulls = new Map(); // that obstacles are made of, by their ids

  constructor(key, address, report) {
    refuseNew(key, 'Navmesh');
    super(address, 'js_navmesh_free');
    this.report = report;
  }

  static bake(mesh, options = {}) {
    const watch = stopwatch();
    if (options.obstacles && (options.reachableFrom?.length || options.dropInsideSolids || options.islandMinArea)) {
      throw argumentError('obstacles', 'a navmesh whose tiles change cannot be pruned; leave one of the two out');
    }
    return withInput(mesh, options, () => {
      const seeds = Float32Array.from((options.reachableFrom ?? []).flatMap((p) => [p[0], p[1], p[2]]));
      const seedsAt = seeds.length > 0 ? copyIn(seeds) : 0;
      try {
        const at = putNavOptions(0, options);
        F64[SLOT + at] = seeds.length / 3;
        F64[SLOT + at + 1] = options.dropInsideSolids ? 1 : 0;
        F64[SLOT + at + 2] = options.islandMinArea ?? 0;
        F64[SLOT + at + 3] = seedsAt;
        const address = watched(options, watch.update, () => wasm.js_navmesh_bake(at, options.obstacles ? 1 : 0)) >>> 0;
        if (address === 0) {
          check(F64[SLOT]);
          fail(F64[SLOT]);
        }
        wasm.js_navmesh_report(address);
        const report = { times: watch.times };
        REPORT.forEach((name, i) => { report[name] = F64[SLOT + i]; });
        return new Navmesh(PRIVATE, address, report);
      } finally {
        release(seedsAt);
      }
    });
  }

  static fromTiles(tiles, options = {}) {
    ready();
    putNavOptions(0, options);
    const address = wasm.js_navmesh_empty() >>> 0;
    if (address === 0) fail(TL_ERR_MEMORY);
    const navmesh = new Navmesh(PRIVATE, address, null);
    try {
      for (const tile of tiles) check(wasm.js_navmesh_add_copy(address, copyIn(tile), tile.length, 0));
    } catch (error) {
      navmesh.free();
      throw error;
    }
    return navmesh;
  }

  free() {
    if (this.freed) return;
    super.free();
    this.#hulls.forEach((hull) => hull._leave());
    this.#hulls.clear();
  }

  /** An obstacle is made of this hull now, which stays until the obstacle is gone or made of another one. */
  _keepHull(id, hull) {
    hull?._use();
    this.#hulls.get(id)?._leave();
    if (hull === null) this.#hulls.delete(id);
    else this.#hulls.set(id, hull);
  }

  /** What it was baked with. */
  get options() {
    if (this.#options === null) {
      wasm.js_navmesh_def(this._address);
      this.#options = readNavOptions(0);
    }
    return { ...this.#options };
  }

  get maxNodes() {
    return this.#maxNodes;
  }

  set maxNodes(count) {
    if (!Number.isInteger(count) || count < 2 || count > 2 ** 30) throw argumentError('maxNodes', 'give 2 to 2^30');
    wasm.js_navmesh_set_nodes(this._address, count);
    this.#maxNodes = count;
  }

  #counts() {
    wasm.js_navmesh_counts(this._address);
    const [tiles, polygons, corners, vertices, triangles, links] = F64.subarray(SLOT, SLOT + 6);
    return { tiles, polygons, corners, vertices, triangles, links };
  }

  get tileCount() {
    return this.#counts().tiles;
  }

  get polygonCount() {
    return this.#counts().polygons;
  }

  linkCount() {
    return this.#counts().links;
  }

  /** The tiles' slots in the order of a file, and what each holds. */
  #tiles() {
    const { tiles } = this.#counts();
    const order = wasm.js_tile_order(this._address) >>> 0;
    if (order === 0) fail(TL_ERR_MEMORY);
    const slots = copyOut(Uint32Array, order, tiles);
    release(order);
    return Array.from(slots, (slot) => {
      wasm.js_tile_info(this._address, slot);
      const s = SLOT;
      const [firstCorner, links, flags, areas, firstVertex, firstTriangle, vertices, triangles] = F64.subarray(s + 17, s + 25);
      return { slot, address: F64[s], size: F64[s + 1], x: F64[s + 2], z: F64[s + 3], layer: F64[s + 4], polygonCount: F64[s + 5],
               area: F64[s + 6], bounds: slotAabb(7), cornerCount: F64[s + 13], vertexCount: F64[s + 14], triangleCount: F64[s + 15],
               hasWideTriangles: (F64[s + 16] & 1) !== 0, hasWideLinks: (F64[s + 16] & 8) !== 0, hasWideFlags: (F64[s + 16] & 16) !== 0, hasWideFirsts: (F64[s + 16] & 32) !== 0,
               firstCorner, links, flags, areas, firstVertex, firstTriangle, vertices, triangles, firstRef: U64[s + 25] };
    });
  }

  tiles() {
    return this.#tiles().map(({ x, z, layer, polygonCount, area, size, bounds }) => ({ x, z, layer, polygonCount, area, size, bounds }));
  }

  tileBytes(index) {
    const tile = this.#tiles()[index];
    if (tile === undefined) throw argumentError('index', `give 0 to ${this.tileCount - 1}`);
    return U8.slice(tile.address, tile.address + tile.size);
  }

  polygons() {
    const tiles = this.#tiles(), counts = this.#counts(), count = counts.polygons;
    const result = {
      count, refs: new BigUint64Array(count), first: new Uint32Array(count + 1), corners: new Float32Array(3 * counts.corners),
      links: new Uint32Array(counts.corners), area: new Uint8Array(count), flags: new BigUint64Array(count),
      tile: new Uint32Array(count), island: new Uint32Array(count),
    };
    let polygon = 0, corner = 0;
    tiles.forEach((tile, t) => {
      const n = tile.polygonCount;
      const islands = wasm.js_tile_islands(this._address, tile.slot) >>> 0;
      if (islands === 0) fail(TL_ERR_MEMORY);
      result.island.set(U32.subarray(islands / 4, islands / 4 + n), polygon);
      result.area.set(U8.subarray(tile.areas, tile.areas + n), polygon);
      if (tile.hasWideFlags) result.flags.set(U64.subarray(tile.flags / 8, tile.flags / 8 + n), polygon);
      else for (let p = 0; p < n; p++) result.flags[polygon + p] = BigInt(U8[tile.flags + p]);
      // By their sign numbers of 16 bits become the same of 32.
      result.links.set(new (tile.hasWideLinks ? Int32Array : Int16Array)(U8.buffer, tile.links, tile.cornerCount), corner);
      const firstCorner = firstsOf(tile, tile.firstCorner), firstVertex = firstsOf(tile, tile.firstVertex);
      for (let p = 0; p < n; p++) {
        // A surface's first vertices are its polygon's corners.
        const first = firstCorner[p], corners = firstCorner[p + 1] - first;
        const from = tile.vertices / 4 + 3 * firstVertex[p];
        result.corners.set(F32.subarray(from, from + 3 * corners), 3 * (corner + first));
        result.refs[polygon + p] = tile.firstRef + BigInt(p);
        result.first[polygon + p] = corner + first;
        result.tile[polygon + p] = t;
      }
      polygon += n;
      corner += tile.cornerCount;
    });
    result.first[count] = corner;
    return result;
  }

  surface() {
    const tiles = this.#tiles(), counts = this.#counts();
    const vertices = new Float32Array(3 * counts.vertices), triangles = new Uint32Array(3 * counts.triangles);
    const polygons = new Uint32Array(counts.triangles);
    let vertex = 0, triangle = 0, polygon = 0;
    for (const tile of tiles) {
      vertices.set(F32.subarray(tile.vertices / 4, tile.vertices / 4 + 3 * tile.vertexCount), 3 * vertex);
      const corners = new (tile.hasWideTriangles ? Uint16Array : Uint8Array)(U8.buffer, tile.triangles, 4 * tile.triangleCount);
      const firstVertex = firstsOf(tile, tile.firstVertex), firstTriangle = firstsOf(tile, tile.firstTriangle);
      for (let p = 0; p < tile.polygonCount; p++, polygon++) {
        const base = vertex + firstVertex[p];
        for (let t = firstTriangle[p]; t < firstTriangle[p + 1]; t++) {
          for (let k = 0; k < 3; k++) triangles[3 * (triangle + t) + k] = base + corners[4 * t + k];
          polygons[triangle + t] = polygon;
        }
      }
      vertex += tile.vertexCount;
      triangle += tile.triangleCount;
    }
    return { vertices, triangles, polygons };
  }

  portals() {
    const tiles = this.#tiles(), firstOfSlot = new Map(), polygons = [], ends = [];
    let first = 0;
    for (const tile of tiles) {
      firstOfSlot.set(tile.slot, first);
      first += tile.polygonCount;
    }
    for (const tile of tiles) {
      check(wasm.js_tile_portals(this._address, tile.slot));
      const [count, address] = F64.subarray(SLOT, SLOT + 2);
      for (let i = 0, w = address / 4; i < count; i++, w += 10) {
        polygons.push(firstOfSlot.get(tile.slot) + U32[w], firstOfSlot.get(U32[w + 1]) + U32[w + 2]);
        for (let k = 4; k < 10; k++) ends.push(F32[w + k]);
      }
    }
    wasm.js_trim();
    return { count: polygons.length / 2, polygons: Uint32Array.from(polygons), ends: Float32Array.from(ends) };
  }

  /** For a file: an empty navmesh whose options are read into it by `fill(address)`. */
  static _create(fill) {
    putNavOptions(0);
    const address = wasm.js_navmesh_empty() >>> 0;
    if (address === 0) fail(TL_ERR_MEMORY);
    const navmesh = new Navmesh(PRIVATE, address, null);
    try {
      fill(address);
    } catch (error) {
      navmesh.free();
      throw error;
    }
    return navmesh;
  }
}


