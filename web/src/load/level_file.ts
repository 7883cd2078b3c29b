// A level from a file that was dropped or chosen: by its ending, checked number by number, its failure named.

import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { PLYLoader } from 'three/examples/jsm/loaders/PLYLoader.js';
import { STLLoader } from 'three/examples/jsm/loaders/STLLoader.js';
import type { LevelMesh } from '../engine/protocol';
import type { LevelSource } from '../app';
import { LevelError, readObj } from './obj';

export { LevelError };

export interface ImportOptions {
  up: 'y' | 'z';
  /** Metres a unit of the file. */
  scale: number;
}

export const ENDINGS = ['.obj', '.glb', '.gltf', '.stl', '.ply', '.talus'] as const;

interface Triangles {
  positions: Float32Array;
  indices: Uint32Array;
}

/** All meshes below an object, in its frame. */
function trianglesOf(root: THREE.Object3D): Triangles {
  root.updateMatrixWorld(true);
  const positions: Float32Array[] = [];
  const indices: Uint32Array[] = [];
  let vertices = 0;
  root.traverse((object) => {
    if (!(object instanceof THREE.Mesh)) return;
    const part = ofGeometry(object.geometry as THREE.BufferGeometry, object.matrixWorld);
    const mirrored = object.matrixWorld.determinant() < 0;
    for (let i = 0; i < part.indices.length; i += 3) {
      const [b, c] = [part.indices[i + 1]!, part.indices[i + 2]!];
      part.indices[i] = part.indices[i]! + vertices;
      part.indices[i + 1] = (mirrored ? c : b) + vertices;
      part.indices[i + 2] = (mirrored ? b : c) + vertices;
    }
    positions.push(part.positions);
    indices.push(part.indices);
    vertices += part.positions.length / 3;
  });
  return { positions: joinFloats(positions), indices: joinIndices(indices) };
}

function joinFloats(parts: readonly Float32Array[]): Float32Array {
  const all = new Float32Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

function joinIndices(parts: readonly Uint32Array[]): Uint32Array {
  const all = new Uint32Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

function ofGeometry(geometry: THREE.BufferGeometry, matrix: THREE.Matrix4 | null): Triangles {
  const source = geometry.getAttribute('position');
  if (!source) throw new LevelError('holds no vertices');
  const positions = new Float32Array(3 * source.count);
  const point = new THREE.Vector3();
  for (let i = 0; i < source.count; i++) {
    point.fromBufferAttribute(source, i);
    if (matrix) point.applyMatrix4(matrix);
    point.toArray(positions, 3 * i);
  }
  const index = geometry.getIndex();
  const indices = index ? Uint32Array.from(index.array) : Uint32Array.from({ length: source.count }, (_, i) => i);
  return { positions, indices };
}

async function readTriangles(ending: string, bytes: ArrayBuffer): Promise<Triangles> {
  switch (ending) {
    case '.obj': return readObj(new TextDecoder().decode(bytes));
    case '.glb':
    case '.gltf': {
      const gltf = await new GLTFLoader().parseAsync(ending === '.glb' ? bytes : new TextDecoder().decode(bytes), '');
      return trianglesOf(gltf.scene);
    }
    case '.stl': return ofGeometry(new STLLoader().parse(bytes), null);
    default: return ofGeometry(new PLYLoader().parse(bytes), null);
  }
}

/** Names the first vertex or triangle that cannot be. */
function check({ positions, indices }: Triangles): void {
  if (indices.length < 3) throw new LevelError('holds no triangles');
  if (indices.length % 3 !== 0) throw new LevelError(`its ${indices.length} corners are not three a triangle`);
  for (let i = 0; i < positions.length; i++) {
    if (!Number.isFinite(positions[i]!)) throw new LevelError(`vertex ${Math.floor(i / 3)} is not finite`);
  }
  const count = positions.length / 3;
  for (let i = 0; i < indices.length; i++) {
    if (indices[i]! >= count) {
      throw new LevelError(`triangle ${Math.floor(i / 3)} names vertex ${indices[i]}, of ${count}`);
    }
  }
}

function convert({ positions }: Triangles, { up, scale }: ImportOptions): void {
  for (let i = 0; i < positions.length; i += 3) {
    const [x, y, z] = [positions[i]! * scale, positions[i + 1]! * scale, positions[i + 2]! * scale];
    positions[i] = x;
    positions[i + 1] = up === 'z' ? z : y;
    positions[i + 2] = up === 'z' ? -y : z;
  }
}

/** @throws LevelError with the file's name and what is wrong where */
export async function readLevel(file: File, options: ImportOptions): Promise<LevelSource> {
  const ending = /\.[^.]*$/.exec(file.name.toLowerCase())?.[0] ?? '';
  try {
    if (!(ENDINGS as readonly string[]).includes(ending)) {
      throw new LevelError(`is of no kind that is read here: ${ENDINGS.join(' ')}`);
    }
    const bytes = await file.arrayBuffer();
    if (bytes.byteLength === 0) throw new LevelError('is empty');
    if (ending === '.talus') return { kind: 'pack', name: file.name, bytes: new Uint8Array(bytes) };
    const triangles = await readTriangles(ending, bytes);
    convert(triangles, options);
    check(triangles);
    const mesh: LevelMesh = { name: file.name, ...triangles };
    return { kind: 'mesh', mesh };
  } catch (error) {
    const why = error instanceof RangeError ? 'is too large for this browser\'s memory'
      : error instanceof Error ? error.message : String(error);
    throw new LevelError(`${file.name}: ${why}`);
  }
}
