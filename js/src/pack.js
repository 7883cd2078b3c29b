// SPDX-License-Identifier: MIT
//
// The baked file: the same bytes as `talus bake` writes of the same parts.

import { argumentError } from './error.js';
import { Hull } from './hull.js';
import { withInput } from './mesh.js';
import { Navmesh } from './navmesh.js';
import { VOLUME_KINDS } from './nav_options.js';
import { readLinks } from './nav_tools.js';
import { putOffMeshLink } from './nav_change.js';
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

const bytesOf = (chunk) => U8.slice(chunk.address, chunk.address + chunk.size);

function readNavmesh(settings, tiles, links) {
  return Navmesh._create((navmesh) => {
    check(wasm.js_pack_navmesh(settings.address, settings.size, navmesh));
    for (const tile of tiles) check(wasm.js_navmesh_add_copy(navmesh, copyIn(bytesOf(tile)), tile.size));
    if (links !== undefined) {
      putOffMeshLink({});
      check(wasm.js_links_add(navmesh, links.address, links.size));
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
    const [meta, soup, hull, settings, links, volumes] = ['META', 'SOUP', 'HULL', 'NAVM', 'LINK', 'MARK'].map(of);
    const tiles = chunks.filter((chunk) => chunk.type === 'NAVT');
    return {
      meta: meta ? readMeta(meta) : null,
      soup: soup ? keep(Soup.fromBytes(bytesOf(soup))) : null,
      hull: hull ? keep(Hull.fromBytes(bytesOf(hull))) : null,
      navmesh: settings ? keep(readNavmesh(settings, tiles, links)) : null,
      links: links ? readLinks(links.address, links.size) : [],
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

export function savePack({ meta = null, soup = null, hull = null, navmesh = null, volumes = null } = {}) {
  ready();
  return withInput(null, { volumes }, () => {
    const name = copyIn(new TextEncoder().encode(`${meta?.name ?? ''}\0`));
    try {
      if (meta !== null && !meta.bounds) throw argumentError('meta.bounds', 'give the box of the mesh');
      F64[SLOT] = meta !== null ? 1 : 0;
      F64[SLOT + 1] = meta?.sourceVertices ?? 0;
      F64[SLOT + 2] = meta?.sourceTriangles ?? 0;
      putAabb(3, meta?.bounds ?? { min: [0, 0, 0], max: [0, 0, 0] });
      F64[SLOT + 9] = meta?.up === 'z' ? 1 : 0;
      check(wasm.js_pack_write(name, addressOf(soup), addressOf(hull), addressOf(navmesh)));
      const [size, at] = F64.subarray(SLOT, SLOT + 2);
      return U8.slice(at, at + size);
    } finally {
      release(name);
      wasm.js_trim();
    }
  });
}

