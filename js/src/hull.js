// SPDX-License-Identifier: MIT

import { Handle, PRIVATE, refuseNew } from './handle.js';
import { F32, F64, SLOT, U8, allocate, check, copyIn, copyOut, fail, putPose, putVec3, ready, release, slotAabb, slotVec3, wasm, watched } from './module.js';

const NO_VERTEX = 0xffffffff;

function fromResult(address) {
  address >>>= 0;
  const s = SLOT;
  if (address === 0) {
    check(F64[s]);
    fail(F64[s]);
  }
  return new Hull(PRIVATE, address, 'js_blob_free', {
    triangleCount: F64[s + 1], thickened: F64[s + 2] !== 0, pointsLeftOut: F64[s + 3], maxOutside: F64[s + 4],
    cornersLeftOut: F64[s + 5],
  });
}

export class Hull extends Handle {
  #parts = null; // its topology: read once, for a hull never changes

  constructor(key, address, free, report) {
    refuseNew(key, 'Hull');
    super(address, free);
    this.report = report;
  }

  static bake(points, options = {}) {
    ready();
    const array = points instanceof Float32Array ? points : Float32Array.from(points);
    const address = copyIn(array);
    try {
      return fromResult(watched(options, null, () => wasm.js_hull_bake(
        address, Math.floor(array.length / 3), options.maxVertices ?? 0, options.tolerance ?? 0, options.thickness ?? 0,
        options.flatness ?? 8, options.weldDistance ?? 0, options.mergeDistance ?? 0)));
    } finally {
      release(address);
    }
  }

  static fromBytes(bytes) {
    ready();
    const address = copyIn(bytes);
    try {
      check(wasm.js_hull_check(address, bytes.length));
    } catch (error) {
      release(address);
      throw error;
    }
    return new Hull(PRIVATE, address, 'js_free', null);
  }

  transform(scale, pose = null) {
    const address = this._address;
    putVec3(0, scale);
    putPose(3, pose);
    return fromResult(wasm.js_hull_transform(address));
  }

  // Offsets in the slot as js_hull_info writes them.
  #info() {
    wasm.js_hull_info(this._address);
    const s = SLOT;
    return { size: F64[s], vertexCount: F64[s + 1], faceCount: F64[s + 2], halfEdgeCount: F64[s + 3], vertices: F64[s + 4] };
  }

  #topology() {
    if (this.freed) this.#parts = null;
    this.#parts ??= this.#readTopology();
    return this.#parts;
  }

  // Words as js_hull_topology writes them.
  #readTopology() {
    const { vertexCount, halfEdgeCount, faceCount } = this.#info();
    const edges = 2 * vertexCount, faces = edges + 4 * halfEdgeCount, length = faces + 2 * faceCount;
    const address = allocate(4 * length);
    try {
      wasm.js_hull_topology(this._address, address);
      const words = copyOut(Uint32Array, address, length);
      return { faceCount, halfEdgeCount, sources: words.subarray(0, vertexCount), vertexEdges: words.subarray(vertexCount, edges),
               halfEdges: words.subarray(edges, faces), faces: words.subarray(faces) };
    } finally {
      release(address);
    }
  }

  toBytes() {
    const { size } = this.#info();
    return U8.slice(this._address, this._address + size);
  }

  get vertexCount() {
    return this.#info().vertexCount;
  }

  get faceCount() {
    return this.#info().faceCount;
  }

  bounds() {
    this.#info();
    return slotAabb(5);
  }

  mass() {
    this.#info();
    const s = SLOT;
    return { volume: F64[s + 11], area: F64[s + 12], center: slotVec3(13), inertia: F64.slice(s + 16, s + 22) };
  }

  vertices() {
    const info = this.#info();
    return copyOut(Float32Array, info.vertices, 3 * info.vertexCount);
  }

  sources() {
    return this.#topology().sources.slice();
  }

  faces() {
    const { faces, halfEdges, faceCount, halfEdgeCount } = this.#topology();
    const first = new Uint32Array(faceCount + 1), indices = new Uint32Array(halfEdgeCount);
    let at = 0;
    for (let f = 0; f < faceCount; f++) {
      for (let e = faces[2 * f]; e < faces[2 * f] + faces[2 * f + 1]; e++) indices[at++] = halfEdges[4 * e];
      first[f + 1] = at;
    }
    return { first, indices };
  }

  triangles() {
    const { first, indices } = this.faces();
    const triangles = [];
    for (let f = 0; f + 1 < first.length; f++) {
      for (let i = first[f] + 2; i < first[f + 1]; i++) triangles.push(indices[first[f]], indices[i - 1], indices[i]);
    }
    return Uint32Array.from(triangles);
  }

  edges() {
    const { halfEdges: half, halfEdgeCount } = this.#topology();
    const edges = [];
    for (let e = 0; e < halfEdgeCount; e++) {
      const twin = half[4 * e + 1];
      if (e < twin) edges.push(half[4 * e], half[4 * twin]);
    }
    return Uint32Array.from(edges);
  }

  support(x, y, z, hint = NO_VERTEX) {
    return wasm.js_hull_support(this._address, x, y, z, hint) >>> 0;
  }

  supportClimb(direction, start = 0) {
    const { halfEdges: half, vertexEdges: anyEdge } = this.#topology(), info = this.#info(), first = info.vertices / 4;
    // Products of floats are exact in doubles; the sum of three is rounded twice.
    const [x, y, z] = [0, 1, 2].map((i) => Math.fround(direction[i]));
    const height = (i) => F32[first + 3 * i] * x + F32[first + 3 * i + 1] * y + F32[first + 3 * i + 2] * z;
    const visited = [start < info.vertexCount ? start : 0];
    for (;;) {
      const here = visited[visited.length - 1];
      let best = here, edge = anyEdge[here];
      do {
        const beside = half[4 * half[4 * edge + 1]];
        if (height(beside) > height(best)) best = beside;
        edge = half[4 * half[4 * edge + 1] + 2];
      } while (edge !== anyEdge[here]);
      if (best === here) return Uint32Array.from(visited);
      visited.push(best);
    }
  }

  castRay(origin, direction, maxT = Infinity) {
    const address = this._address;
    putVec3(0, origin);
    putVec3(3, direction);
    F64[SLOT + 6] = maxT;
    if (!wasm.js_hull_cast_ray(address)) return null;
    const face = F64[SLOT + 1];
    return { t: F64[SLOT], face: face === NO_VERTEX ? null : face, normal: slotVec3(2) };
  }

  contains(point) {
    return wasm.js_hull_contains(this._address, point[0], point[1], point[2]) !== 0;
  }
}

/** Takes over a hull that the module made. */
export const hullAt = (address) => new Hull(PRIVATE, address >>> 0, 'js_blob_free', null);
