// What tools draw over the level: thick lines, dots of constant size, fans and boxes. Seen through walls, but paler
// there, so that nothing is lost and depth still shows.

import * as THREE from 'three';
import { Line2 } from 'three/examples/jsm/lines/Line2.js';
import { LineGeometry } from 'three/examples/jsm/lines/LineGeometry.js';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import type { Vec3 } from '../engine/protocol';
import { disposeTree } from '../layers/build';
import type { Stage } from './stage';

let disc: THREE.Texture | null = null;
function discTexture(): THREE.Texture {
  if (disc) return disc;
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const paint = canvas.getContext('2d')!;
  paint.beginPath();
  paint.arc(32, 32, 29, 0, 7);
  paint.fillStyle = '#fff';
  paint.fill();
  paint.lineWidth = 5;
  paint.strokeStyle = '#222a';
  paint.stroke();
  disc = new THREE.CanvasTexture(canvas);
  return disc;
}

export class Marks {
  readonly group = new THREE.Group();

  constructor(private stage: Stage, name: string) {
    this.group.name = name;
    this.group.renderOrder = 100; // after every layer, of which some are transparent too
    stage.scene.add(this.group);
  }

  clear(): void {
    for (const child of [...this.group.children]) {
      this.group.remove(child);
      // The disc's texture is shared.
      disposeTree(child);
    }
    this.stage.render();
  }

  set visible(on: boolean) {
    this.group.visible = on;
    this.stage.render();
  }

  private local(points: readonly Vec3[], lift: number): Float32Array {
    const { anchor } = this.stage;
    const positions = new Float32Array(3 * points.length);
    points.forEach((p, i) => {
      positions[3 * i] = p[0] - anchor[0];
      positions[3 * i + 1] = p[1] - anchor[1] + lift;
      positions[3 * i + 2] = p[2] - anchor[2];
    });
    return positions;
  }

  /** A polyline, `width` pixels thick. */
  line(points: readonly Vec3[], colour: number, width: number, lift = 0.12): void {
    if (points.length < 2) return;
    for (const behind of [true, false]) {
      const geometry = new LineGeometry();
      geometry.setPositions(this.local(points, lift));
      const material = new LineMaterial({
        color: colour, linewidth: width, transparent: behind, opacity: behind ? 0.5 : 1, depthTest: !behind,
        // Over every layer that lies on the same floor.
        polygonOffset: true, polygonOffsetFactor: -20, polygonOffsetUnits: -60,
      });
      material.resolution.copy(this.stage.resolution);
      const line = new Line2(geometry, material);
      line.renderOrder = behind ? 5 : 6;
      line.frustumCulled = false;
      this.group.add(line);
    }
    this.stage.render();
  }

  /** Segments of one pixel, two points each. */
  segments(points: readonly Vec3[], colour: number, lift = 0.1, opacity = 1): void {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(this.local(points, lift), 3));
    const material = new THREE.LineBasicMaterial({ color: colour, transparent: opacity < 1, opacity });
    const lines = new THREE.LineSegments(geometry, material);
    lines.renderOrder = 4;
    this.group.add(lines);
    this.stage.render();
  }

  /** Discs of `size` pixels. */
  dots(points: readonly Vec3[], colour: number, size: number, lift = 0.12, name = ''): void {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(this.local(points, lift), 3));
    const material = new THREE.PointsMaterial({
      color: colour, size: size * Math.min(devicePixelRatio, 2), sizeAttenuation: false, map: discTexture(),
      transparent: true, alphaTest: 0.3, depthTest: false,
    });
    const dots = new THREE.Points(geometry, material);
    dots.name = name;
    dots.renderOrder = 8;
    dots.frustumCulled = false;
    this.group.add(dots);
    this.stage.render();
  }

  /** Filled triangles around the first point. */
  fan(points: readonly Vec3[], colour: number, opacity: number, lift = 0.1, closed = false): void {
    if (points.length < 3) return;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(this.local(points, lift), 3));
    const indices: number[] = [];
    for (let i = 2; i < points.length; i++) indices.push(0, i - 1, i);
    if (closed) indices.push(0, points.length - 1, 1);
    geometry.setIndex(indices);
    const material = new THREE.MeshBasicMaterial({
      color: colour, transparent: true, opacity, side: THREE.DoubleSide, depthWrite: false,
      polygonOffset: true, polygonOffsetFactor: -12, polygonOffsetUnits: -24,
    });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.renderOrder = 3;
    this.group.add(mesh);
    this.stage.render();
  }

  box(min: Vec3, max: Vec3, colour: number, opacity: number): void {
    const corner = (i: number): Vec3 =>
      [i & 1 ? max[0] : min[0], i & 2 ? max[1] : min[1], i & 4 ? max[2] : min[2]];
    const points: Vec3[] = [];
    for (let i = 0; i < 8; i++) for (const bit of [1, 2, 4]) if ((i & bit) === 0) points.push(corner(i), corner(i | bit));
    this.segments(points, colour, 0, opacity);
  }

  /** A solid cylinder or box that stands on `base`. */
  solid(shape: 'cylinder' | 'box', base: Vec3, radius: number, height: number, colour: number): void {
    const geometry = shape === 'box' ? new THREE.BoxGeometry(2 * radius, height, 2 * radius)
      : new THREE.CylinderGeometry(radius, radius, height, 32);
    const mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ color: colour }));
    mesh.position.copy(this.stage.toLocal([base[0], base[1] + height / 2, base[2]]));
    this.group.add(mesh);
    this.stage.render();
  }
}
