// SPDX-License-Identifier: MIT
//
// Navmeshes from and to Detour's bytes, as recast-navigation and RecastDemo save them (wasm/js_detour.c).

import { argumentError } from './error.js';
import { Navmesh } from './navmesh.js';
import { F64, SLOT, U8, check, copyIn, ready, release, wasm } from './module.js';

const REPORT = ['tileCount', 'polygonCount', 'plainPatches', 'droppedPolygons', 'oneWayLinks', 'offMeshLinks', 'offMeshOutside',
                'offMeshFar', 'areaZeros'];

function readReport(at) {
  return Object.fromEntries(REPORT.map((name, i) => [name, F64[SLOT + at + i]]));
}

export function navmeshFromDetour(bytes, { cellHeight = 1 / 1024 } = {}) {
  ready();
  if (!(bytes instanceof Uint8Array)) throw argumentError('bytes', 'give a Uint8Array');
  const address = copyIn(bytes);
  let report = null;
  try {
    const navmesh = Navmesh._create((self) => {
      F64[SLOT] = cellHeight;
      const result = wasm.js_detour_read(self, address, bytes.length);
      report = readReport(0);
      check(result);
    });
    return { navmesh, report };
  } finally {
    release(address);
  }
}

export function navmeshToDetour(navmesh, { refBits = 32 } = {}) {
  if (refBits !== 32 && refBits !== 64) throw argumentError('refBits', '32, or 64 for a Detour with DT_POLYREF64');
  check(wasm.js_detour_write(navmesh._address, refBits === 64 ? 1 : 0));
  const bytes = U8.slice(F64[SLOT], F64[SLOT] + F64[SLOT + 1]);
  return { bytes, report: readReport(2) };
}
