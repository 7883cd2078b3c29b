// SPDX-License-Identifier: MIT
//
// The stages of a bake as typed arrays. The addresses that the module gives are read at once, then its memory is freed.

import { F64, I16, I32, SLOT, U16, U32, check, copyOut, slotAabb, slotVec3, wasm, watched } from './module.js';
import { withInput } from './mesh.js';
import { putNavOptions } from './nav_options.js';

const NO_SPAN = 0xffffffff;

function readGrid() {
  const s = SLOT;
  return { width: F64[s], height: F64[s + 1], bounds: slotAabb(2), cellSize: F64[s + 8], cellHeight: F64[s + 9], borderSize: F64[s + 10] };
}

function readHeightfield() {
  wasm.js_stages_heightfield();
  const grid = readGrid(), [count, firstAt, spansAt] = F64.subarray(SLOT + 11, SLOT + 14);
  const min = new Uint16Array(count), max = new Uint16Array(count), area = new Uint8Array(count);
  for (let i = 0, at = spansAt / 2; i < count; i++, at += 4) {
    min[i] = U16[at];
    max[i] = U16[at + 1];
    area[i] = U16[at + 2];
  }
  return { ...grid, spanCount: count, firstSpan: copyOut(Uint32Array, firstAt, grid.width * grid.height + 1), min, max, area };
}

function readCompact() {
  wasm.js_stages_compact();
  const grid = readGrid();
  const [count, maxDistance, regionCount, first, floor, clearance, area, distance, region, step, neighbour] =
    F64.subarray(SLOT + 11, SLOT + 22);
  const neighbours = new Uint32Array(4 * count);
  for (let i = 0; i < 4 * count; i++) {
    const jump = step !== 0 ? I16[step / 2 + i] : 0;
    neighbours[i] = step === 0 ? U32[neighbour / 4 + i] : jump === 0 ? NO_SPAN : (i >> 2) + jump;
  }
  return {
    ...grid, spanCount: count, maxDistance, regionCount, neighbours,
    firstSpan: copyOut(Uint32Array, first, grid.width * grid.height + 1), floor: copyOut(Uint16Array, floor, count),
    clearance: copyOut(Uint16Array, clearance, count), area: copyOut(Uint8Array, area, count),
    distance: copyOut(Uint16Array, distance, count), region: copyOut(Uint32Array, region, count),
  };
}

/** Lattice points to metres, in the library's own order of operations. */
function toWorld(at, count, stride, origin, cellSize, cellHeight) {
  const f = Math.fround, vertices = new Float32Array(3 * count);
  const size = [cellSize, cellHeight, cellSize];
  for (let i = 0; i < count; i++) {
    for (let axis = 0; axis < 3; axis++) {
      vertices[3 * i + axis] = f(origin[axis] + f(I32[at / 4 + stride * i + axis] * size[axis]));
    }
  }
  return vertices;
}

function readOutlines(raw) {
  wasm.js_stages_contours(raw ? 1 : 0);
  const origin = slotVec3(0), [cellSize, cellHeight, count, vertexCount, contours, vertices] = F64.subarray(SLOT + 3, SLOT + 9);
  const firstVertex = new Uint32Array(count + 1), region = new Uint32Array(count), area = new Uint8Array(count);
  // Contours are ranges of the vertices; here they stand one after the other.
  const points = new Float32Array(3 * vertexCount), all = toWorld(vertices, vertexCount, 4, origin, cellSize, cellHeight);
  let used = 0;
  for (let i = 0; i < count; i++) {
    const at = contours / 4 + 4 * i, own = U32[at + 1];
    points.set(all.subarray(3 * U32[at], 3 * (U32[at] + own)), 3 * used);
    used += own;
    firstVertex[i + 1] = used;
    region[i] = U32[at + 2];
    area[i] = U32[at + 3];
  }
  return { count, firstVertex, vertices: points.slice(0, 3 * used), region, area };
}

function readPolygons() {
  wasm.js_stages_polygons();
  const origin = slotVec3(0);
  const [cellSize, cellHeight, count, vertexCount, indexCount, vertices, first, indices, neighbours, regions, areas] =
    F64.subarray(SLOT + 3, SLOT + 14);
  return {
    count, first: count === 0 ? new Uint32Array(1) : copyOut(Uint32Array, first, count + 1),
    indices: copyOut(Uint32Array, indices, indexCount), neighbours: copyOut(Uint32Array, neighbours, indexCount),
    vertices: toWorld(vertices, vertexCount, 3, origin, cellSize, cellHeight),
    region: copyOut(Uint32Array, regions, count), area: Uint8Array.from(copyOut(Uint32Array, areas, count)),
  };
}

function readDetail() {
  wasm.js_stages_detail();
  const [patches, vertexCount, triangleCount, patchesAt, vertices, trianglesAt, maxError] = F64.subarray(SLOT, SLOT + 7);
  const triangles = new Uint32Array(3 * triangleCount), polygons = new Uint32Array(triangleCount);
  for (let p = 0; p < patches; p++) {
    const [firstVertex, , first, count] = U32.subarray(patchesAt / 4 + 4 * p, patchesAt / 4 + 4 * p + 4);
    for (let t = first; t < first + count; t++) {
      for (let k = 0; k < 3; k++) triangles[3 * t + k] = firstVertex + U16[trianglesAt / 2 + 4 * t + k];
      polygons[t] = p;
    }
  }
  return { vertices: copyOut(Float32Array, vertices, 3 * vertexCount), triangles, polygons, maxError };
}

function withStages(mesh, options, read) {
  const { tileX = 0, tileZ = 0 } = options;
  return withInput(mesh, options, () => watched(options, null, () => {
    putNavOptions(0, options);
    try {
      check(wasm.js_stages_bake(tileX, tileZ));
      return read(tileX, tileZ);
    } finally {
      wasm.js_stages_end();
    }
  }));
}

export function bakeStages(mesh, options = {}) {
  return withStages(mesh, options, (tileX, tileZ) => ({
    tileX, tileZ, heightfield: readHeightfield(), compact: readCompact(),
    contours: { raw: readOutlines(true), simplified: readOutlines(false) }, polygons: readPolygons(), detail: readDetail(),
  }));
}

// --------------------------------------------------------------------------------------------------------
// Steps of dividing the contours.

/** Heights for points of the plane: a contour's vertices have theirs. */
function heightsOf(contours) {
  const heights = new Map();
  for (let i = 0; i < contours.vertices.length; i += 3) {
    heights.set(`${contours.vertices[i]},${contours.vertices[i + 2]}`, contours.vertices[i + 1]);
  }
  return heights;
}

export function polygonSteps(mesh, options = {}) {
  return withStages(mesh, options, () => {
    const contours = readOutlines(false), heights = heightsOf(contours);
    wasm.js_stages_contours(0);
    const origin = slotVec3(0), cellSize = F64[SLOT + 3], only = options.contour ?? -1;
    check(wasm.js_stages_steps(only));
    const [numberCount, at] = F64.subarray(SLOT, SLOT + 2), numbers = copyOut(Int32Array, at, numberCount);
    wasm.js_trim();
    const f = Math.fround, points = { partitions: [], outline: [], corners: [] }, first = { partitions: [0], outline: [0], corners: [0] };
    const kind = [], contour = [];
    for (let i = 0; i < numbers.length;) {
      const counts = { partitions: 2 * numbers[i + 2], outline: numbers[i + 3], corners: numbers[i + 4] };
      kind.push(numbers[i]);
      contour.push(only < 0 ? numbers[i + 1] : only);
      i += 5;
      for (const part of ['partitions', 'outline', 'corners']) {
        for (let k = 0; k < counts[part]; k++, i += 2) {
          const x = f(origin[0] + f(numbers[i] * cellSize)), z = f(origin[2] + f(numbers[i + 1] * cellSize));
          points[part].push(x, heights.get(`${x},${z}`) ?? origin[1], z);
        }
        first[part].push(points[part].length / 3);
      }
    }
    return {
      count: kind.length, kind: Uint8Array.from(kind), contour: Uint32Array.from(contour),
      firstPartition: Uint32Array.from(first.partitions, (n) => n / 2), partitions: Float32Array.from(points.partitions),
      firstOutline: Uint32Array.from(first.outline), outline: Float32Array.from(points.outline),
      firstCorner: Uint32Array.from(first.corners), corners: Float32Array.from(points.corners),
    };
  });
}
