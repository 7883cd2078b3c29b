// The pointer on the picture: a press that does not move is a click, a press on a handle drags it, all else belongs to
// the camera. Touch works alike.

import type { App } from '../app';
import { Latest } from '../engine/latest';
import type { RayHit, Vec3 } from '../engine/protocol';
import type { Click, Handle, Tool } from './tool';

const CLICK_PIXELS = 5;
const LONG_PRESS_MS = 500;
const HANDLE_PIXELS = { mouse: 14, pen: 18, touch: 28 } as const;

export class Pointer {
  private down: { x: number; y: number; id: number; time: number; moved: boolean; handle: string | null } | null = null;
  private drags = new Latest();

  constructor(private app: App, private tool: () => Tool) {
    const { canvas } = app.stage;
    // Before the camera's own listeners, so that a handle keeps the press to itself.
    canvas.addEventListener('pointerdown', (event) => this.press(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.release(event));
    canvas.addEventListener('pointercancel', () => this.stop());
    canvas.addEventListener('contextmenu', (event) => event.preventDefault()); // a long press asks for one
  }

  private nearestHandle(event: PointerEvent): Handle | null {
    const reach = HANDLE_PIXELS[event.pointerType as keyof typeof HANDLE_PIXELS] ?? HANDLE_PIXELS.mouse;
    let best: Handle | null = null;
    let bestDistance: number = reach;
    for (const handle of this.tool().handles()) {
      const at = this.app.stage.screenOf(handle.at);
      if (!at) continue;
      const distance = Math.hypot(at.x - event.clientX, at.y - event.clientY);
      if (distance < bestDistance) {
        best = handle;
        bestDistance = distance;
      }
    }
    return best;
  }

  private press(event: PointerEvent): void {
    if (!event.isPrimary || event.button !== 0) {
      this.stop();
      return;
    }
    const handle = this.nearestHandle(event);
    this.down = { x: event.clientX, y: event.clientY, id: event.pointerId, time: event.timeStamp, moved: false, handle: handle?.name ?? null };
    if (handle) {
      this.app.stage.controls.enabled = false;
      this.app.stage.canvas.setPointerCapture(event.pointerId);
    }
  }

  private move(event: PointerEvent): void {
    const { down } = this;
    if (!down) {
      if (event.pointerType === 'mouse' && event.buttons === 0) {
        this.app.stage.canvas.style.cursor = this.nearestHandle(event) ? 'grab' : '';
      }
      return;
    }
    if (event.pointerId !== down.id) return;
    if (Math.hypot(event.clientX - down.x, event.clientY - down.y) > CLICK_PIXELS) down.moved = true;
    if (!down.handle || !down.moved) return;
    this.drag(down.handle, event.clientX, event.clientY);
  }

  /** What the ray meets of what is drawn: it begins at the height where the level is cut off. */
  private async pick({ origin, direction }: Click['ray']): Promise<RayHit | null> {
    const { cut } = this.app.view.get();
    const skipped = cut === null || origin[1] <= cut ? 0 : (cut - origin[1]) / direction[1];
    if (!(skipped >= 0)) return null;
    const from = origin.map((v, i) => v + skipped * direction[i]!) as Vec3;
    const hit = await this.app.engine.call('pick', from, direction);
    return hit && (cut === null || hit.point[1] <= cut + 1e-3) ? { ...hit, t: hit.t + skipped } : null;
  }

  private drag(name: string, x: number, y: number): void {
    const ray = this.app.stage.rayAt(x, y);
    this.drags.run(async () => {
      const hit = await this.pick(ray);
      if (hit) this.tool().handles().find((one) => one.name === name)?.move(hit);
    });
  }

  private release(event: PointerEvent): void {
    const { down } = this;
    this.stop();
    if (!down || down.id !== event.pointerId || down.moved || !this.app.engine.ready) return;
    const ray = this.app.stage.rayAt(event.clientX, event.clientY);
    const second = event.shiftKey || (event.pointerType === 'touch' && event.timeStamp - down.time >= LONG_PRESS_MS);
    this.pick(ray)
      .then((hit) => this.tool().click({ hit, ray, second }))
      .catch((error: Error) => this.app.say(error.message, 'error'));
  }

  private stop(): void {
    this.down = null;
    this.app.stage.controls.enabled = true;
  }
}
