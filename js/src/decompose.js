// SPDX-License-Identifier: MIT

import { argumentError } from './error.js';
import { hullAt } from './hull.js';
import { withInput } from './mesh.js';
import { F64, SLOT, check, wasm, watched } from './module.js';

const SOLIDS = ['enclosed', 'surface'];

function putOptions(options) {
  const solid = SOLIDS.indexOf(options.solid ?? 'enclosed');
  if (solid < 0) throw argumentError('solid', "'enclosed' or 'surface'");
  const numbers = [options.tolerance ?? 0, options.relativeTolerance ?? 0.025, options.maxParts ?? 0, options.maxVertices ?? 256,
                   options.thickness ?? 0, solid, options.maxCells ?? 1 << 20];
  numbers.forEach((number, i) => { F64[SLOT + i] = number; });
}

function takePart(index) {
  const hull = hullAt(wasm.js_decompose_take(index));
  return { hull, concavity: F64[SLOT], maxOutside: F64[SLOT + 1] };
}

export function decompose(mesh, options = {}) {
  return withInput(mesh, null, () => watched(options, null, () => {
    try {
      putOptions(options);
      check(wasm.js_decompose());
      const [count, tolerance, cell, degenerateTriangles, cutCount, partsBeforeMerging, partsOverTolerance] = F64.slice(SLOT, SLOT + 7);
      const parts = Array.from({ length: count }, (_, i) => takePart(i)), worst = (of) => parts.reduce((most, part) => Math.max(most, of(part)), 0);
      return { parts, concavity: worst((part) => part.concavity), maxOutside: worst((part) => part.maxOutside),
               report: { tolerance, cell, degenerateTriangles, cutCount, partsBeforeMerging, partsOverTolerance } };
    } finally {
      wasm.js_decompose_end();
    }
  }));
}
