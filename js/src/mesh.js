// SPDX-License-Identifier: MIT

import { argumentError, TalusError } from './error.js';
import { F64, SLOT, U64, allocate, check, copyIn, copyOut, readString, ready, release, wasm, watched } from './module.js';
import { packVolumes } from './nav_options.js';

function typed(Type, array, name) {
  if (array instanceof Type) return array;
  if (array === null || array === undefined || array.length === undefined) {
    throw argumentError(name, 'give an array of numbers');
  }
  return Type.from(array);
}

export class Mesh {
  constructor(vertices, indices = null, materials = null) {
    this.vertices = typed(Float32Array, vertices, 'vertices');
    if (this.vertices.length % 3 !== 0) throw argumentError('vertices', 'give three numbers a vertex');
    this.indices = indices === null ? Uint32Array.from({ length: this.vertices.length / 3 }, (_, i) => i)
                                    : typed(Uint32Array, indices, 'indices');
    if (this.indices.length % 3 !== 0) throw argumentError('indices', 'give three a triangle');
    this.materials = materials === null ? null : typed(Uint16Array, materials, 'materials');
    if (this.materials !== null && this.materials.length !== this.triangleCount) {
      throw argumentError('materials', 'give one a triangle');
    }
  }

  get vertexCount() {
    return this.vertices.length / 3;
  }

  get triangleCount() {
    return this.indices.length / 3;
  }

  bounds() {
    const min = [Infinity, Infinity, Infinity], max = [-Infinity, -Infinity, -Infinity], v = this.vertices;
    for (let i = 0; i < v.length; i++) {
      const axis = i % 3;
      if (v[i] < min[axis]) min[axis] = v[i];
      if (v[i] > max[axis]) max[axis] = v[i];
    }
    return { min, max };
  }

  weld(options = {}) {
    return withInput(this, null, () => watched(options, null, () => {
      try {
        check(wasm.js_weld(options.weldTolerance ?? 0, options.keepDuplicates ? 1 : 0));
        const s = SLOT, [vertices, triangles] = [F64[s], F64[s + 1]];
        const mesh = new Mesh(copyOut(Float32Array, F64[s + 2], 3 * vertices), copyOut(Uint32Array, F64[s + 3], 3 * triangles),
                              this.materials === null ? null : copyOut(Uint16Array, F64[s + 4], triangles));
        const report = { weldedVertices: F64[s + 6], unusedVertices: F64[s + 7], degenerateTriangles: F64[s + 8],
                         duplicateTriangles: F64[s + 9] };
        return { mesh, sourceTriangles: copyOut(Uint32Array, F64[s + 5], triangles), report };
      } finally {
        wasm.js_weld_end();
      }
    }));
  }
}

/** The areas of an input's triangles, or null. */
function areasOf(mesh, input) {
  if (input?.areas) {
    if (input.areas.length !== mesh.triangleCount) throw argumentError('areas', 'give one a triangle');
    return typed(Uint8Array, input.areas, 'areas');
  }
  if (!input?.materialAreas) return null;
  const areas = new Uint8Array(mesh.triangleCount);
  for (let i = 0; i < areas.length; i++) areas[i] = input.materialAreas[mesh.materials?.[i] ?? 0] ?? 63;
  return areas;
}

/** Runs a call that is about a mesh, its areas and volumes: they stand in the module's memory meanwhile. */
export function withInput(mesh, input, run) {
  ready();
  if (mesh !== null && !(mesh instanceof Mesh)) throw argumentError('mesh', 'give a Mesh');
  const blocks = [];
  const put = (array) => {
    if (array === null || array.length === 0) return 0;
    blocks.push(copyIn(array));
    return blocks[blocks.length - 1];
  };
  try {
    const volumes = packVolumes(input?.volumes);
    const [v, i, m] = mesh === null ? [0, 0, 0] : [put(mesh.vertices), put(mesh.indices), put(mesh.materials)];
    const areas = mesh === null ? null : areasOf(mesh, input);
    check(wasm.js_set_input(v, mesh?.vertexCount ?? 0, i, mesh?.triangleCount ?? 0, m, put(areas), put(volumes),
                            input?.volumes?.length ?? 0));
    return run();
  } finally {
    wasm.js_clear_input();
    blocks.forEach(release);
  }
}

export function sampleLevels() {
  const levels = [];
  for (let i = 0; ready().js_sample_info(i); i++) {
    levels.push({ name: readString(F64[SLOT]), description: readString(F64[SLOT + 1]), defaultTriangles: F64[SLOT + 2] });
  }
  return levels;
}

export function sampleLevel(name, { triangles, seed = 1 } = {}) {
  const levels = sampleLevels();
  const index = levels.findIndex((level) => level.name === name);
  if (index < 0) {
    throw new TalusError('TL_NOT_FOUND', `there is no built-in level '${name}': ${levels.map((l) => l.name).join(', ')}`);
  }
  U64[SLOT] = BigInt(seed);
  try {
    check(wasm.js_sample_build(index, triangles ?? levels[index].defaultTriangles));
    return new Mesh(copyOut(Float32Array, F64[SLOT + 2], 3 * F64[SLOT]), copyOut(Uint32Array, F64[SLOT + 3], 3 * F64[SLOT + 1]));
  } finally {
    wasm.js_sample_end();
  }
}
