// Flying by keys: W A S D and the arrows move over the ground, Q and E down and up, Shift goes faster. Keys that are
// held move once a frame, by the time that went by.

import * as THREE from 'three';
import type { Stage } from './stage';

const MOVES: Record<string, [number, number, number]> = {
  KeyW: [0, 0, 1], ArrowUp: [0, 0, 1], KeyS: [0, 0, -1], ArrowDown: [0, 0, -1],
  KeyA: [-1, 0, 0], ArrowLeft: [-1, 0, 0], KeyD: [1, 0, 0], ArrowRight: [1, 0, 0],
  KeyE: [0, 1, 0], KeyQ: [0, -1, 0],
};

export function flyByKeys(stage: Stage, moved: () => void): void {
  const held = new Set<string>();
  let fast = false;
  let last = 0;

  const step = (now: number): void => {
    if (held.size === 0) return;
    const seconds = Math.min(0.1, (now - last) / 1000);
    last = now;
    const ahead = new THREE.Vector3().subVectors(stage.controls.target, stage.camera.position).normalize();
    const right = new THREE.Vector3().crossVectors(ahead, stage.camera.up).normalize();
    const motion = new THREE.Vector3();
    for (const code of held) {
      const [x, y, z] = MOVES[code]!;
      motion.addScaledVector(right, x).addScaledVector(stage.camera.up, y).addScaledVector(ahead, z);
    }
    const distance = stage.camera.position.distanceTo(stage.controls.target);
    const speed = Math.max(distance, stage.radius * 0.02) * (fast ? 2.5 : 0.8);
    motion.multiplyScalar(speed * seconds);
    stage.camera.position.add(motion);
    stage.controls.target.add(motion);
    stage.controls.update();
    stage.render();
    moved();
    requestAnimationFrame(step);
  };

  addEventListener('keydown', (event) => {
    fast = event.shiftKey;
    if (!MOVES[event.code] || event.ctrlKey || event.metaKey || event.altKey || takesKeys(event.target)) return;
    event.preventDefault();
    if (held.size === 0) {
      last = performance.now();
      requestAnimationFrame(step);
    }
    held.add(event.code);
  });
  addEventListener('keyup', (event) => {
    fast = event.shiftKey;
    held.delete(event.code);
  });
  addEventListener('blur', () => held.clear());
}

/** Whether keys belong to the element: a slider's arrows, a field's letters. */
export function takesKeys(target: EventTarget | null): boolean {
  return target instanceof HTMLElement && /^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName);
}
