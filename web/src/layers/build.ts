// From a layer's arrays to objects of three.js. Every layer is one group with a few objects in it.

import * as THREE from 'three';
import { MOST_OPEN, type CellData, type LayerData, type LineData, type TriangleData, type Vec3 } from '../engine/protocol';

export interface LayerStyle {
  /** 1 opaque. */
  opacity: number;
  /** Lit by the sun, so that steps and slopes show. */
  lit: boolean;
  /** Towards the eye, in units of polygon offset: which of two layers at the same place is seen. */
  rank: number;
  /** Triangles are seen from their front; their backs are a haze, so that one looks into rooms from above. */
  openBacks?: boolean;
}

const HAZE = 0.16;

function triangleMeshes(data: TriangleData, style: LayerStyle): THREE.Mesh[] {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(data.positions, 3));
  geometry.setAttribute('color', new THREE.BufferAttribute(data.colours, 3, true));
  const material = (side: THREE.Side, opacity: number): THREE.Material => {
    const common = {
      vertexColors: true, side, opacity, transparent: opacity < 1, depthWrite: opacity > HAZE,
      polygonOffset: true, polygonOffsetFactor: -style.rank, polygonOffsetUnits: -2 * style.rank,
    };
    return style.lit ? new THREE.MeshLambertMaterial({ ...common, flatShading: true }) : new THREE.MeshBasicMaterial(common);
  };
  if (!style.openBacks || data.positions.length > 9 * MOST_OPEN) return [new THREE.Mesh(geometry, material(THREE.DoubleSide, style.opacity))];
  return [new THREE.Mesh(geometry, material(THREE.FrontSide, style.opacity)), new THREE.Mesh(geometry, material(THREE.BackSide, HAZE))];
}

function lineSegments(data: LineData): THREE.LineSegments {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(data.positions, 3));
  geometry.setAttribute('color', new THREE.BufferAttribute(data.colours, 3, true));
  const lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ vertexColors: true }));
  lines.renderOrder = 2;
  return lines;
}

// A cell is drawn by instancing: 20 bytes each, so that millions fit.
const CELL_VERTEX = `
  in vec3 position;
  in vec4 cell;
  in vec4 tint;
  uniform mat4 modelViewMatrix;
  uniform mat4 projectionMatrix;
  uniform vec3 origin;
  uniform vec2 size;
  out vec3 shade;
  out float height;
  void main() {
    float y = mix(cell.z, cell.w, position.y) * size.y;
    vec3 at = origin + vec3((cell.x + position.x) * size.x, y, (cell.y + position.z) * size.x);
    shade = tint.rgb;
    height = at.y;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(at, 1.0);
    gl_Position.z -= OFFSET * gl_Position.w;
  }
`;
const CELL_FRAGMENT = `
  precision highp float;
  in vec3 shade;
  in float height;
  uniform float light;
  uniform float cut;
  out vec4 colour;
  void main() {
    if (height > cut) discard;
    colour = vec4(shade * light, 1.0);
  }
`;

// Top, and the four sides in two shades of dark: boxes without normals.
const FACES: readonly { light: number; corners: readonly number[] }[] = [
  { light: 1, corners: [0, 1, 0, 0, 1, 1, 1, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1, 0] },
  { light: 0.72, corners: [
    0, 0, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 1, 0,
    1, 0, 0, 1, 1, 1, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1, 1, 1] },
  { light: 0.6, corners: [
    0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 1, 1, 0,
    0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 0, 1, 1, 1, 1, 0, 1, 1] },
];

function cellMeshes(data: CellData, anchor: Vec3, style: LayerStyle): THREE.Mesh[] {
  const cells = new THREE.InstancedBufferAttribute(data.cells, 4);
  const tints = new THREE.InstancedBufferAttribute(data.colours, 4, true);
  const flat = data.cells.length > 0 && data.cells[2] === data.cells[3];
  return (flat ? FACES.slice(0, 1) : FACES).map((face) => {
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(face.corners), 3));
    geometry.setAttribute('cell', cells);
    geometry.setAttribute('tint', tints);
    geometry.instanceCount = data.cells.length / 4;
    const material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: CELL_VERTEX.replace('OFFSET', (style.rank * 2e-6).toFixed(9)),
      fragmentShader: CELL_FRAGMENT,
      side: THREE.DoubleSide,
      uniforms: {
        origin: { value: new THREE.Vector3(...data.origin.map((v, i) => v - anchor[i]!)) },
        size: { value: new THREE.Vector2(data.cellSize, data.cellHeight) },
        light: { value: face.light },
        cut: { value: 1e30 },
      },
    });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.frustumCulled = false;
    return mesh;
  });
}

export function buildLayer(data: LayerData, style: LayerStyle): THREE.Group {
  const group = new THREE.Group();
  if (data.triangles && data.triangles.positions.length > 0) group.add(...triangleMeshes(data.triangles, style));
  if (data.cells && data.cells.cells.length > 0) group.add(...cellMeshes(data.cells, data.anchor, style));
  if (data.lines && data.lines.positions.length > 0) group.add(lineSegments(data.lines));
  return group;
}

/** Hides what lies above a plane; null shows all. */
export function cutTree(root: THREE.Object3D, plane: THREE.Plane | null): void {
  root.traverse((object) => {
    const { material } = object as Partial<THREE.Mesh>;
    for (const one of [material ?? []].flat()) {
      if (one instanceof THREE.RawShaderMaterial) one.uniforms.cut!.value = plane?.constant ?? 1e30;
      else one.clippingPlanes = plane ? [plane] : null;
    }
  });
}

export function disposeTree(root: THREE.Object3D): void {
  root.traverse((object) => {
    const mesh = object as Partial<THREE.Mesh>;
    mesh.geometry?.dispose();
    const materials = Array.isArray(mesh.material) ? mesh.material : mesh.material ? [mesh.material] : [];
    for (const material of materials) material.dispose();
  });
}
