// The picture: renderer, camera and lights. A frame is drawn when something changed, never else, so that an open page
// costs nothing. Positions are relative to the level's centre, so that single precision does for levels far out.

import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { Vec3 } from '../engine/protocol';
import type { Camera } from '../state/view';
import { mix } from './palette';

THREE.ColorManagement.enabled = false;

export class NoWebGl extends Error {}

export class Stage {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(50, 1, 0.1, 1000);
  readonly renderer: THREE.WebGLRenderer;
  readonly controls: OrbitControls;
  readonly resolution = new THREE.Vector2(1, 1);
  anchor: Vec3 = [0, 0, 0];
  radius = 10;
  private size: Vec3 = [10, 10, 10];
  frames = 0;
  private wanted = false;
  private beforeFrame = new Set<() => void>();

  constructor(readonly canvas: HTMLCanvasElement) {
    // Made here, because three.js reports a missing context on the console only.
    const context = canvas.getContext('webgl2', { antialias: true, stencil: false, powerPreference: 'high-performance' });
    if (!context) throw new NoWebGl('This browser or its graphics driver offers no WebGL 2.');
    this.renderer = new THREE.WebGLRenderer({ canvas, context });
    this.renderer.localClippingEnabled = true;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    // Colours are what the palette says, as the page's own: no conversion on the way.
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    // A floor in the sun has its own colour, nearly; walls are a third darker, each side by another shade.
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0xb4bac6, 2.1));
    const sun = new THREE.DirectionalLight(0xfff6e8, 1.2);
    sun.position.set(0.45, 1, 0.3);
    this.scene.add(sun);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.screenSpacePanning = false;
    this.controls.maxPolarAngle = Math.PI * 0.98;
    this.controls.addEventListener('change', () => this.render());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement ?? canvas);
    canvas.addEventListener('webglcontextrestored', () => this.render());
    this.resize();
  }

  onFrame(callback: () => void): void {
    this.beforeFrame.add(callback);
  }

  /** Draws once, with the next frame of the screen. */
  render(): void {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => this.draw());
  }

  /** Draws now, so that the canvas can be read. */
  draw(): void {
    this.wanted = false;
    this.fitClip();
    for (const callback of this.beforeFrame) callback();
    this.renderer.render(this.scene, this.camera);
    this.frames++;
  }

  /** A colour that fades a little towards the top, as a sky does. */
  setBackground(colour: string): void {
    const canvas = document.createElement('canvas');
    canvas.width = 1;
    canvas.height = 256;
    const paint = canvas.getContext('2d')!;
    const fade = paint.createLinearGradient(0, 0, 0, 256);
    const low = new THREE.Color(colour).getHex();
    fade.addColorStop(0, `#${mix(low, 0x5b7fa6, 0.22).toString(16).padStart(6, '0')}`);
    fade.addColorStop(0.75, colour);
    paint.fillStyle = fade;
    paint.fillRect(0, 0, 1, 256);
    if (this.scene.background instanceof THREE.Texture) this.scene.background.dispose();
    this.scene.background = new THREE.CanvasTexture(canvas);
    this.render();
  }

  private resize(): void {
    const host = this.canvas.parentElement ?? this.canvas;
    const width = Math.max(1, host.clientWidth);
    const height = Math.max(1, host.clientHeight);
    this.renderer.setSize(width, height, false);
    this.resolution.set(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.render();
  }

  /** From outside, the near plane goes most of the way to the level: then depths behind walls differ from those before. */
  private fitClip(): void {
    const eye = this.camera.position;
    const outside = Math.hypot(...eye.toArray().map((v, i) => Math.max(0, Math.abs(v) - this.size[i]! / 2)));
    this.camera.far = eye.length() + 4 * this.radius;
    this.camera.near = Math.max(this.radius * 1e-4, Math.min(0.1, this.camera.far / 2e4), this.camera.far / 4e5, outside / 4);
    this.camera.updateProjectionMatrix();
  }

  /** Tells how large the level is, and shows it all when no camera is given. */
  setLevel(min: Vec3, max: Vec3, camera: Camera | null): void {
    this.anchor = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
    this.size = [max[0] - min[0], max[1] - min[1], max[2] - min[2]];
    this.radius = Math.max(1e-3, Math.hypot(...this.size) / 2);
    this.controls.maxDistance = 20 * this.radius;
    this.controls.minDistance = this.radius * 1e-3;
    if (camera) this.setCamera(camera);
    else this.showAll();
  }

  /**
   * The nearest camera, looking one way, that has the whole box in the picture, in its middle. A corner at x to the right
   * and z ahead of the box' centre is in it if |x - shift| <= slope (z + distance): two lines over the shift. The highest
   * falling line meets the highest rising one at the least distance.
   */
  showAll(): void {
    const back = new THREE.Vector3(0.55, 0.75, 0.85).normalize();
    const right = new THREE.Vector3(0, 1, 0).cross(back).normalize();
    const up = new THREE.Vector3().crossVectors(back, right);
    const slope = 0.92 * Math.tan((this.camera.fov * Math.PI) / 360);
    const corners = Array.from({ length: 8 }, (_, i) =>
      new THREE.Vector3(...this.size.map((size, k) => (i >> k & 1 ? 0.5 : -0.5) * size)));
    const least = (axis: THREE.Vector3, tangent: number): number => {
      const most = (sign: number): number => Math.max(...corners.map((c) => (sign * c.dot(axis)) / tangent + c.dot(back)));
      return (most(1) + most(-1)) / 2;
    };
    const distance = Math.max(least(right, slope * this.camera.aspect), least(up, slope));
    // The shift that leaves as much room on one side as on the other; each round brings the two closer.
    const middle = (axis: THREE.Vector3): number => {
      let shift = 0;
      for (let round = 0; round < 8; round++) {
        const places = corners.map((c) => (c.dot(axis) - shift) / (distance - c.dot(back)));
        shift += (distance / 2) * (Math.max(...places) + Math.min(...places));
      }
      return shift;
    };
    this.controls.target.set(0, 0, 0).addScaledVector(right, middle(right)).addScaledVector(up, middle(up));
    this.camera.position.copy(this.controls.target).addScaledVector(back, distance);
    this.controls.update();
    this.render();
  }

  setCamera(camera: Camera): void {
    this.controls.target.copy(this.toLocal(camera.target));
    this.camera.position.copy(this.toLocal(camera.eye));
    this.controls.update();
    this.render();
  }

  getCamera(): Camera {
    return { eye: this.toWorld(this.camera.position), target: this.toWorld(this.controls.target) };
  }

  toLocal(p: Vec3): THREE.Vector3 {
    return new THREE.Vector3(p[0] - this.anchor[0], p[1] - this.anchor[1], p[2] - this.anchor[2]);
  }

  toWorld(p: THREE.Vector3): Vec3 {
    return [p.x + this.anchor[0], p.y + this.anchor[1], p.z + this.anchor[2]];
  }

  /** The ray through a place of the screen, in world coordinates. */
  rayAt(clientX: number, clientY: number): { origin: Vec3; direction: Vec3 } {
    const box = this.canvas.getBoundingClientRect();
    const x = ((clientX - box.left) / box.width) * 2 - 1;
    const y = 1 - ((clientY - box.top) / box.height) * 2;
    this.camera.updateMatrixWorld();
    const far = new THREE.Vector3(x, y, 0.5).unproject(this.camera).sub(this.camera.position).normalize();
    return { origin: this.toWorld(this.camera.position), direction: [far.x, far.y, far.z] };
  }

  /** Where a point stands on the screen, in the page's pixels; null behind the eye. */
  screenOf(p: Vec3): { x: number; y: number } | null {
    this.camera.updateMatrixWorld();
    const local = this.toLocal(p).applyMatrix4(this.camera.matrixWorldInverse);
    if (local.z >= 0) return null;
    local.applyMatrix4(this.camera.projectionMatrix);
    const box = this.canvas.getBoundingClientRect();
    return { x: box.left + ((local.x + 1) / 2) * box.width, y: box.top + ((1 - local.y) / 2) * box.height };
  }

  /** Metres that a pixel covers at a point. */
  metresPerPixel(p: Vec3): number {
    const distance = this.toLocal(p).distanceTo(this.camera.position);
    return (2 * distance * Math.tan((this.camera.fov * Math.PI) / 360)) / this.resolution.y;
  }
}
