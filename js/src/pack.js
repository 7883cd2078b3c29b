// SPDX-License-Identifier: MIT
//
// The baked file: the same bytes as `talus bake` writes of the same parts.

import { argumentError } from './error.js';
import { Hull } from './hull.js';
import { withInput } from './mesh.js';
import { Navmesh } from './navmesh.js';
import { VOLUME_KINDS } from './nav_options.js';
import { readLinks } from './nav_tools.js';
import { putOffMeshLink, readOffMeshLink } from './nav_change.js';
import { Soup } from './soup.js';
import { F64, SLOT, U8, check, copyIn, copyOut, putAabb, readString, ready, release, slotAabb, slotVec3, wasm } from './module.js';

function typeName(type) {
  return String.fromCharCode(type & 255, type >> 8 & 255, type >> 16 & 255, type >>> 24);
}

function readChunks(count) {
  return Array.from({ length: count }, (_, i) => {
    wasm.js_pack_chunk(i);
    const s = SLOT;
    return { type: typeName(F64[s]), id: F64[s + 1], size: F64[s + 2], address: F64[s + 3] };
  });
}

function readMeta(chunk) {
  check(wasm.js_pack_meta(chunk.address, chunk.size));
  const s = SLOT;
  return { name: readString(F64[s]), sourceVertices: F64[s + 1], sourceTriangles: F64[s + 2], bounds: slotAabb(3),
           up: F64[s + 9] === 1 ? 'z' : 'y' };
}

const AXES = ['y', 'z', 'y-left', 'z-left'];

function readFrame(chunk) {
  check(wasm.js_pack_frame(chunk.address, chunk.size));
  return { origin: [...F64.slice(SLOT, SLOT + 3)], axes: AXES[F64[SLOT + 3]] };
}

/** How a direction of the level is turned to y up, right-handed, and back. */
const TURNS = {
  y: { in: ([x, y, z]) => [x, y, z], out: ([x, y, z]) => [x, y, z] },
  z: { in: ([x, y, z]) => [x, z, -y], out: ([x, y, z]) => [x, -z, y] },
  'y-left': { in: ([x, y, z]) => [x, y, -z], out: ([x, y, z]) => [x, y, -z] },
  'z-left': { in: ([x, y, z]) => [x, z, y], out: ([x, y, z]) => [x, z, y] },
};

function turnOf(frame) {
  const turn = TURNS[frame.axes];
  if (turn === undefined) throw argumentError('frame.axes', `give one of ${AXES.join(', ')}`);
  return turn;
}

export function pointFromLevel(frame, point) {
  return frame === null ? Array.from(point) : turnOf(frame).in(frame.origin.map((value, i) => point[i] - value));
}

export function pointToLevel(frame, point) {
  return frame === null ? Array.from(point) : turnOf(frame).out(point).map((value, i) => value + frame.origin[i]);
}

function readVolumes(chunk) {
  check(wasm.js_pack_volumes(chunk.address, chunk.size));
  return Array.from({ length: F64[SLOT] }, (_, i) => {
    wasm.js_pack_volume(chunk.address, i);
    const s = SLOT, type = VOLUME_KINDS[F64[s]], area = F64[s + 1], box = slotAabb(2);
    if (type === 'box') return { type, area, ...box };
    if (type === 'cylinder') return { type, area, base: slotVec3(8), radius: F64[s + 11], height: F64[s + 12] };
    return { type, area, points: copyOut(Float32Array, F64[s + 14], 3 * F64[s + 13]), minY: box.min[1], maxY: box.max[1] };
  });
}

function readHandLinks(chunk) {
  check(wasm.js_pack_offmesh(chunk.address, chunk.size));
  return Array.from({ length: F64[SLOT] }, (_, i) => {
    wasm.js_pack_offmesh_at(chunk.address, i);
    return readOffMeshLink(0);
  });
}

function readAreas(chunk) {
  check(wasm.js_pack_areas(chunk.address, chunk.size));
  return copyOut(Uint8Array, F64[SLOT + 1], F64[SLOT]);
}

const bytesOf = (chunk) => U8.slice(chunk.address, chunk.address + chunk.size);

function readNavmesh(settings, { tiles, links, handLinks, rules, pruned }) {
  return Navmesh._create((navmesh) => {
    check(wasm.js_pack_navmesh(settings.address, settings.size, navmesh));
    for (const tile of tiles) check(wasm.js_navmesh_add_copy(navmesh, copyIn(bytesOf(tile)), tile.size, 0));
    if (rules !== undefined) check(wasm.js_pack_pruning(rules.address, rules.size, navmesh));
    for (const tile of pruned) check(wasm.js_navmesh_add_copy(navmesh, copyIn(bytesOf(tile)), tile.size, 1));
    if (links !== undefined) {
      putOffMeshLink({});
      check(wasm.js_links_add(navmesh, links.address, links.size));
    }
    for (const link of handLinks) {
      putOffMeshLink(link);
      check(wasm.js_offmesh_add(navmesh));
    }
  });
}

export function loadPack(bytes) {
  ready();
  const address = copyIn(bytes instanceof ArrayBuffer ? new Uint8Array(bytes) : bytes);
  const made = [];
  const keep = (object) => {
    made.push(object);
    return object;
  };
  try {
    check(wasm.js_pack_open(address, bytes.byteLength));
    const chunks = readChunks(F64[SLOT]);
    const of = (type) => chunks.find((chunk) => chunk.type === type);
    const [meta, frame, soup, hull, settings, links, byHand, areas, volumes, rules] =
      ['META', 'FRAM', 'SOUP', 'HULL', 'NAVM', 'LINK', 'OFFM', 'AREA', 'MARK', 'PRUN'].map(of);
    const offMeshLinks = byHand ? readHandLinks(byHand) : [];
    const [tiles, pruned] = ['NAVT', 'PRUT'].map((type) => chunks.filter((chunk) => chunk.type === type));
    return {
      meta: meta ? readMeta(meta) : null,
      frame: frame ? readFrame(frame) : null,
      soup: soup ? keep(Soup.fromBytes(bytesOf(soup))) : null,
      hull: hull ? keep(Hull.fromBytes(bytesOf(hull))) : null,
      navmesh: settings ? keep(readNavmesh(settings, { tiles, links, handLinks: offMeshLinks, rules, pruned })) : null,
      links: links ? readLinks(links.address, links.size) : [],
      offMeshLinks,
      areas: areas ? readAreas(areas) : null,
      volumes: volumes ? readVolumes(volumes) : [],
      chunks: chunks.map(({ type, id, size }) => ({ type, id, size })),
    };
  } catch (error) {
    made.forEach((object) => object.free());
    throw error;
  } finally {
    release(address);
  }
}

const addressOf = (part) => (part ? part._address : 0);

export function savePack({ meta = null, frame = null, soup = null, hull = null, navmesh = null, offMeshLinks = [], areas = null,
                           volumes = null } = {}) {
  ready();
  return withInput(null, { volumes }, () => {
    offMeshLinks.forEach((link, i) => {
      putOffMeshLink(link);
      check(wasm.js_pack_put_link(i, offMeshLinks.length));
    });
    const areasAt = areas === null || areas.length === 0 ? 0 : copyIn(Uint8Array.from(areas));
    const name = copyIn(new TextEncoder().encode(`${meta?.name ?? ''}\0`));
    try {
      if (meta !== null && !meta.bounds) throw argumentError('meta.bounds', 'give the box of the mesh');
      F64[SLOT] = meta !== null ? 1 : 0;
      F64[SLOT + 1] = meta?.sourceVertices ?? 0;
      F64[SLOT + 2] = meta?.sourceTriangles ?? 0;
      putAabb(3, meta?.bounds ?? { min: [0, 0, 0], max: [0, 0, 0] });
      F64[SLOT + 9] = meta?.up === 'z' ? 1 : 0;
      F64[SLOT + 10] = frame !== null ? 1 : 0;
      if (frame !== null) {
        turnOf(frame);
        F64.set([...frame.origin, AXES.indexOf(frame.axes)], SLOT + 11);
      }
      F64[SLOT + 15] = areas?.length ?? 0;
      F64[SLOT + 16] = areasAt;
      check(wasm.js_pack_write(name, addressOf(soup), addressOf(hull), addressOf(navmesh)));
      const [size, at] = F64.subarray(SLOT, SLOT + 2);
      return U8.slice(at, at + size);
    } finally {
      release(name);
      release(areasAt);
      wasm.js_trim();
    }
  });
}

