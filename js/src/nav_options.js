// SPDX-License-Identifier: MIT
//
// Options of a navmesh: in the slot in the order of tl_js_nav_def (wasm/js_mesh.c).

import { argumentError, wholeNumber } from './error.js';
import { F64, SLOT, check, putAabb, ready, slotAabb, wasm } from './module.js';

const NUMBERS = ['cellSize', 'cellHeight', 'agentHeight', 'agentRadius', 'agentMaxClimb', 'agentMaxSlope', 'regionMinSize',
                 'regionMergeSize', 'edgeMaxLen', 'edgeMaxError', 'detailSampleDist', 'detailSampleMaxError', 'tileHeight'];
const COUNTS = ['maxVertsPerPoly', 'tileSize'];
const WORDS = { partition: ['watershed', 'monotone', 'layers'], polygonMethod: ['classic', 'optimal', 'delaunay'] };
const FLAGS = ['filterLowHangingObstacles', 'filterLedgeSpans', 'filterWalkableLowHeightSpans'];
const NAMES = [...NUMBERS, ...COUNTS, ...Object.keys(WORDS), ...FLAGS, 'bounds'];
export const NAV_DEF_NUMBERS = 26;

const EMPTY = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };

let defaults = null;

/** Options as they stand in the slot. */
export function readNavOptions(at) {
  const options = {};
  let s = SLOT + at;
  for (const name of NUMBERS) options[name] = shortest(F64[s++]);
  for (const name of COUNTS) options[name] = F64[s++];
  for (const [name, words] of Object.entries(WORDS)) options[name] = words[F64[s++]];
  for (const name of FLAGS) options[name] = F64[s++] !== 0;
  const bounds = slotAabb(s - SLOT);
  options.bounds = bounds.min[0] <= bounds.max[0] ? bounds : null;
  return options;
}

/** The shortest decimal that is the same float: 0.3 rather than 0.30000001192092896. */
export function shortest(value) {
  for (let digits = 6; digits < 10; digits++) {
    const rounded = Number(value.toPrecision(digits));
    if (Math.fround(rounded) === value) return rounded;
  }
  return value;
}

export function defaultNavOptions() {
  if (defaults === null) {
    ready().js_default_nav_def();
    defaults = readNavOptions(0);
  }
  return { ...defaults };
}

function number(name, value) {
  if (typeof value !== 'number') throw argumentError(name, 'give a number');
  return value;
}

/** Writes options; those that are left out or undefined are the defaults. */
export function putNavOptions(at, options = {}) {
  const all = defaultNavOptions();
  for (const name of NAMES) if (options[name] !== undefined) all[name] = options[name];
  let s = SLOT + at;
  for (const name of NUMBERS) F64[s++] = number(name, all[name]);
  for (const name of COUNTS) F64[s++] = wholeNumber(name, all[name]);
  for (const [name, words] of Object.entries(WORDS)) {
    const word = words.indexOf(all[name]);
    if (word < 0) throw argumentError(name, `one of ${words.join(', ')}`);
    F64[s++] = word;
  }
  for (const name of FLAGS) F64[s++] = all[name] ? 1 : 0;
  putAabb(s - SLOT, all.bounds ?? EMPTY);
  return at + NAV_DEF_NUMBERS;
}

export function tileGrid(options, levelBounds) {
  ready();
  const at = putNavOptions(0, options);
  putAabb(at, levelBounds);
  check(wasm.js_tile_grid(at));
  return { x: F64[SLOT], z: F64[SLOT + 1] };
}

const KINDS = ['box', 'polygon', 'cylinder'];
export const VOLUME_KINDS = KINDS;

/** Volumes as doubles, fourteen numbers each and then its points (wasm/js_mesh.c). */
export function packVolumes(volumes) {
  if (!volumes || volumes.length === 0) return null;
  const numbers = [];
  volumes.forEach((v, i) => {
    const kind = KINDS.indexOf(v.type);
    if (kind < 0) throw argumentError(`volumes[${i}].type`, `one of ${KINDS.join(', ')}`);
    if (!Number.isInteger(v.area) || v.area < 0 || v.area > 255) throw argumentError(`volumes[${i}].area`, 'give 0 to 255');
    const min = kind === 0 ? v.min : [0, v.minY ?? 0, 0], max = kind === 0 ? v.max : [0, v.maxY ?? 0, 0];
    const points = kind === 1 ? [...v.points] : [];
    numbers.push(kind, v.area, min[0], min[1], min[2], max[0], max[1], max[2]);
    const base = v.base ?? [0, 0, 0];
    numbers.push(base[0], base[1], base[2], v.radius ?? 0, v.height ?? 0, points.length / 3, ...points);
  });
  return Float64Array.from(numbers);
}
