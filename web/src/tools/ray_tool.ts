// A ray, and its walk through the tree: box by box in the order of the visit.

import type { App } from '../app';
import { Latest } from '../engine/latest';
import type { RayWalk, Vec3 } from '../engine/protocol';
import { count, facts, fill, h, metres } from '../panels/dom';
import { Marks } from '../scene/marks';
import { INK } from '../scene/palette';
import { player } from './player';
import type { Click, Handle, Tool } from './tool';

export class RayTool implements Tool {
  readonly name = 'ray';
  readonly label = 'Ray';
  readonly key = '6';
  readonly hint = 'Click to shoot a ray from the eye. Turn the view then, and play its walk through the tree of boxes.';
  readonly panel = h('div');
  private answerBox = h('div', { 'aria-live': 'polite' });
  private marks: Marks;
  private latest = new Latest();
  private steps = player({ id: 'ray-step', label: 'Box', change: (step) => this.draw(step) });
  answer: RayWalk | null = null;

  constructor(private app: App) {
    this.marks = new Marks(app.stage, 'ray');
    this.panel.append(this.answerBox, this.steps.element);
    app.view.watch((now, before) => {
      if (now.ray !== before.ray) this.refresh();
    });
  }

  handles(): Handle[] {
    const { ray } = this.app.view.get();
    const hit = this.answer?.hit;
    if (!ray || !hit) return [];
    return [{
      name: 'hit',
      at: hit.point,
      move: (to) => this.app.view.set({ ray: { ...ray, direction: towards(ray.origin, to.point) } }),
    }];
  }

  click({ ray }: Click): void {
    this.app.view.set({ ray });
  }

  leave(): void {
    this.steps.stop();
    this.marks.visible = false;
  }

  refresh(): void {
    if (this.app.view.get().tool === 'ray') this.latest.run(() => this.ask());
  }

  private async ask(): Promise<void> {
    const { ray } = this.app.view.get();
    this.marks.visible = true;
    this.answer = ray && this.app.engine.ready ? await this.app.engine.call('walk', ray.origin, ray.direction) : null;
    const { answer } = this;
    this.steps.element.hidden = !answer;
    if (!answer) {
      this.marks.clear();
      fill(this.answerBox, h('p', { class: 'muted' }, this.hint));
      return;
    }
    const triangles = this.app.session.get().level?.triangles ?? 0;
    fill(this.answerBox,
      h('p', { class: answer.hit ? 'good' : 'bad', id: 'ray-text' }, answer.hit
        ? `Triangle ${count(answer.hit.triangle)}, ${metres(answer.hit.t)} away${answer.hit.back ? ', from behind' : ''}.`
        : 'The ray hits nothing.'),
      facts([
        ['Boxes entered', count(answer.boxes)], ['Leaves opened', count(answer.leaves)],
        ['Boxes missed', count(answer.steps.length - answer.boxes)], ['Of triangles', count(triangles)],
      ]));
    this.steps.setCount(answer.steps.length);
    this.draw(this.steps.at());
  }

  private draw(step: number): void {
    const { answer } = this;
    const { ray } = this.app.view.get();
    this.marks.clear();
    if (!answer || !ray) return;
    const far: Vec3 = answer.hit?.point ?? ray.origin.map((v, i) => v + ray.direction[i]! * 4 * this.app.stage.radius) as Vec3;
    this.marks.line([ray.origin, far], INK.hit, 3, 0);
    this.marks.dots([ray.origin], 0x34495e, 12, 0);
    if (answer.hit) {
      const { point, normal } = answer.hit;
      const length = 30 * this.app.stage.metresPerPixel(point);
      this.marks.line([point, point.map((v, i) => v + length * normal[i]!) as Vec3], INK.start, 3, 0);
      this.marks.dots([point], INK.hit, 14, 0, 'hit');
    }
    answer.steps.slice(0, step + 1).forEach((box, i) => {
      const now = i === step;
      const colour = !box.hit ? 0x95a5a6 : box.leaf ? INK.single : 0x2e86c1;
      this.marks.box(box.min, box.max, now ? 0xffd400 : colour, now ? 1 : box.hit ? 0.7 : 0.25);
    });
    const box = answer.steps[step];
    this.steps.say(box ? `${box.leaf ? 'leaf' : 'node'} at depth ${box.depth}: ` +
      (box.hit ? `entered at ${metres(box.enter)}` : 'missed, or behind the hit') : '');
  }
}

function towards(a: Vec3, b: Vec3): Vec3 {
  const d: Vec3 = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const length = Math.hypot(...d) || 1;
  return [d[0] / length, d[1] / length, d[2] / length];
}
