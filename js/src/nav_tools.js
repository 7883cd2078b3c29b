// SPDX-License-Identifier: MIT
//
// Jump links, the audit, and why a point is not walkable.

import { camelCase } from './error.js';
import { withInput } from './mesh.js';
import { Navmesh } from './navmesh.js';
import { NAV_DEF_NUMBERS, readNavOptions, shortest } from './nav_options.js';
import { putOffMeshLink } from './nav_change.js';
import { F32, F64, SLOT, TL_ERR_MEMORY, U32, U64, U8, check, copyIn, copyOut, fail, putVec3, readString, ready, release, slotAabb, slotVec3, wasm, watched } from './module.js';

const NONE = 0xffffffff;
const KINDS = ['drop', 'jump', 'climb'];
const LINK_DEFAULTS = { spacing: 0.5, maxDrop: 4, maxJump: 3, jumpHeight: 1, maxSpeed: 6, gravity: 9.81, maxClimb: 1.2, minGain: 3, maxNodes: 4096 };
const LINK_BYTES = 32; // tl_nav_jump_link: start, end, apex, kind, both ways, reserved

// The bytes of the set that a list of links came from: as found, with the margin of their sweeps.
const bytesOfLinks = new WeakMap();

/** The size that a blob's head says. */
const blobSize = (address) => U32[(address + 8) / 4];

/** The links of a set at an address. */
export function readLinks(address, size) {
  check(wasm.js_links_info(address, size));
  const [count, first, whole] = F64.subarray(SLOT, SLOT + 3);
  const links = Array.from({ length: count }, (_, i) => {
    const word = (first + LINK_BYTES * i) / 4;
    return { kind: KINDS[U8[4 * word + 28]], start: [...F32.subarray(word, word + 3)], end: [...F32.subarray(word + 3, word + 6)],
             apex: F32[word + 6], bothWays: U8[4 * word + 29] !== 0 };
  });
  rememberLinks(links, copyOut(Uint8Array, address, whole));
  return links;
}

export function rememberLinks(links, bytes) {
  bytesOfLinks.set(links, bytes);
}

/** A set's bytes in the module's memory: as it was found, or made of the list. */
function copyLinksIn(navmesh, links) {
  const bytes = bytesOfLinks.get(links);
  if (bytes !== undefined) return { address: copyIn(bytes), size: bytes.length };
  const data = new DataView(new ArrayBuffer(Math.max(1, links.length) * LINK_BYTES));
  links.forEach((link, i) => {
    for (let k = 0; k < 3; k++) {
      data.setFloat32(LINK_BYTES * i + 4 * k, link.start[k], true);
      data.setFloat32(LINK_BYTES * i + 12 + 4 * k, link.end[k], true);
    }
    data.setFloat32(LINK_BYTES * i + 24, link.apex, true);
    data.setUint8(LINK_BYTES * i + 28, KINDS.indexOf(link.kind));
    data.setUint8(LINK_BYTES * i + 29, link.bothWays ? 1 : 0);
  });
  const list = copyIn(new Uint8Array(data.buffer));
  const address = wasm.js_links_make(navmesh._address, list, links.length) >>> 0;
  release(list);
  if (address === 0) fail(TL_ERR_MEMORY);
  return { address, size: blobSize(address) };
}

export function linksBytes(links) {
  return bytesOfLinks.get(links);
}

export function jumpLinkPoint(link, t) {
  ready();
  F64[SLOT] = KINDS.indexOf(link.kind);
  F64[SLOT + 1] = link.bothWays ? 1 : 0;
  F64[SLOT + 2] = link.apex;
  putVec3(3, link.start);
  putVec3(6, link.end);
  F64[SLOT + 9] = t;
  wasm.js_link_point();
  return slotVec3(0);
}

function readReason(at) {
  const s = SLOT + at, name = readString(F64[s + 1]);
  const option = readString(F64[s + 4]);
  const triangle = F64[s + 8];
  return { cause: CAUSES[F64[s]], name, text: readString(F64[s + 2]), stage: readString(F64[s + 3]),
           option: option === null ? null : camelCase(option), value: shortest(F64[s + 5]), needed: shortest(F64[s + 6]),
           measured: F64[s + 7], triangle: triangle === NONE ? null : triangle };
}

const CAUSES = ['none', 'outside', 'no floor', 'slope', 'area input', 'ledge', 'ceiling', 'radius', 'volume', 'island', 'outline', 'changed', 'pruned'];
const FINDINGS = ['blocked', 'step', 'no floor', 'missing'];

function readFinding(index) {
  wasm.js_audit_finding(index);
  const s = SLOT, triangle = F64[s + 1], polygon = U64[s + 2];
  return { kind: FINDINGS[F64[s]], triangle: triangle === NONE ? null : triangle, polygon: polygon === 0n ? null : polygon,
           point: slotVec3(3), contact: slotVec3(6), depth: F64[s + 9], count: F64[s + 10], bounds: slotAabb(11), area: F64[s + 17] };
}

const methods = {
  findLinks(soup, options = {}) {
    const navmesh = this._address, soupAddress = soup._address;
    Object.entries(LINK_DEFAULTS).forEach(([name, value], i) => { F64[SLOT + i] = options[name] ?? value; });
    const set = watched(options, null, () => wasm.js_links_find(navmesh, soupAddress)) >>> 0;
    if (set === 0) {
      check(F64[SLOT]);
      fail(F64[SLOT]);
    }
    const [, ledgeCount, sampleCount, noLanding, tooFast, ...counts] = F64.slice(SLOT, SLOT + 17);
    const kinds = Object.fromEntries(KINDS.map((kind, i) => {
      const [tried, blocked, useless, kept] = counts.slice(4 * i, 4 * i + 4);
      return [kind, { tried, blocked, useless, kept }];
    }));
    try {
      return { links: readLinks(set, blobSize(set)), report: { ledgeCount, sampleCount, noLanding, tooFast, kinds } };
    } finally {
      wasm.js_blob_free(set);
    }
  },

  addJumpLinks(links, prototype = {}) {
    const { address, size } = copyLinksIn(this, links);
    try {
      putOffMeshLink(prototype);
      check(wasm.js_links_add(this._address, address, size));
    } finally {
      release(address);
    }
  },

  audit(soup, options = {}) {
    const navmesh = this._address, soupAddress = soup._address;
    return withInput(null, options, () => withAreas(options.areas, () => watched(options, null, () => {
      F64[SLOT] = options.pathCount ?? 2000;
      U64[SLOT + 1] = BigInt(options.seed ?? 1);
      F64[SLOT + 2] = options.probeRadius ?? -1;
      F64[SLOT + 3] = options.minMissingArea ?? -1;
      try {
        check(wasm.js_audit_run(navmesh, soupAddress));
        const [count, radius, step, height, surface, gap, pathCount, pathMetres, polygonCount, portalCount, stepCount,
               contradictions, floorSamples, sampleSpacing, missingArea] = F64.slice(SLOT, SLOT + 15);
        return { findings: Array.from({ length: count }, (_, i) => readFinding(i)), probe: { radius, step, height, surface, gap },
                 pathCount, pathMetres, polygonCount, portalCount, stepCount, contradictions, floorSamples, sampleSpacing, missingArea };
      } finally {
        wasm.js_audit_end();
      }
    })));
  },

  why(mesh, point, options = {}) {
    const navmesh = this._address;
    return withInput(mesh, options, () => watched(options, null, () => {
      putVec3(0, point);
      check(wasm.js_why(navmesh));
      const s = SLOT, head = 12;
      return { walkable: F64[s] !== 0, floor: slotVec3(1), proven: F64[s + 4] !== 0, tileX: F64[s + 6], tileZ: F64[s + 7],
               bakeCount: F64[s + 8], apart: F64[s + 9] !== 0, islandArea: F64[s + 10], largestIslandArea: F64[s + 11],
               needed: readNavOptions(head),
               reasons: Array.from({ length: F64[s + 5] }, (_, i) => readReason(head + NAV_DEF_NUMBERS + 9 * i)) };
    }));
  },
};

/** Runs with areas by the soup's triangles: the audit has no mesh of its own. */
function withAreas(areas, run) {
  if (!areas) return run();
  const address = copyIn(areas);
  wasm.js_set_areas(address);
  try {
    return run();
  } finally {
    release(address);
  }
}

Object.assign(Navmesh.prototype, methods);
