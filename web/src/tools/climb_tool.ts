// The support function: how the climb over a hull's edges finds the farthest vertex.

import type { App } from '../app';
import { Latest } from '../engine/latest';
import type { ClimbAnswer, Vec3 } from '../engine/protocol';
import { count, facts, fill, h, metres, slider } from '../panels/dom';
import { Marks } from '../scene/marks';
import { INK } from '../scene/palette';
import { player } from './player';
import type { Click, Handle, Tool } from './tool';

export class ClimbTool implements Tool {
  readonly name = 'climb';
  readonly label = 'Support';
  readonly key = '8';
  readonly hint = 'The hull of the level, and the climb to its vertex farthest along a direction. Click to aim it.';
  readonly panel = h('div');
  private answerBox = h('div', { 'aria-live': 'polite' });
  private marks: Marks;
  private latest = new Latest();
  private turn = 40;
  private rise = 35;
  private turnSlider: ReturnType<typeof slider>;
  private riseSlider: ReturnType<typeof slider>;
  private steps = player({ id: 'climb-step', label: 'Vertex', change: (step) => this.draw(step) });
  answer: ClimbAnswer | null = null;

  constructor(private app: App) {
    this.marks = new Marks(app.stage, 'climb');
    this.turnSlider = slider({
      id: 'climb-turn', label: 'Heading', unit: '°', min: 0, max: 360, step: 1, value: this.turn,
      change: (value) => { this.turn = value; this.refresh(); },
    });
    this.riseSlider = slider({
      id: 'climb-rise', label: 'Elevation', unit: '°', min: -90, max: 90, step: 1, value: this.rise,
      change: (value) => { this.rise = value; this.refresh(); },
    });
    this.panel.append(this.turnSlider.element, this.riseSlider.element, this.answerBox, this.steps.element);
  }

  private direction(): Vec3 {
    const [turn, rise] = [(this.turn * Math.PI) / 180, (this.rise * Math.PI) / 180];
    return [Math.cos(turn) * Math.cos(rise), Math.sin(rise), Math.sin(turn) * Math.cos(rise)];
  }

  handles(): Handle[] {
    return [];
  }

  click({ hit }: Click): void {
    if (!hit) return;
    const d = hit.point.map((v, i) => v - this.app.stage.anchor[i]!);
    this.turn = Math.round(((Math.atan2(d[2]!, d[0]!) * 180) / Math.PI + 360) % 360);
    this.rise = Math.round((Math.atan2(d[1]!, Math.hypot(d[0]!, d[2]!)) * 180) / Math.PI);
    this.turnSlider.set(this.turn);
    this.riseSlider.set(this.rise);
    this.refresh();
  }

  leave(): void {
    this.steps.stop();
    this.marks.visible = false;
  }

  refresh(): void {
    if (this.app.view.get().tool === 'climb') this.latest.run(() => this.ask());
  }

  private async ask(): Promise<void> {
    this.marks.visible = true;
    if (!this.app.engine.ready) return;
    const { layers } = this.app.view.get();
    if (!layers.includes('hull')) this.app.view.set({ layers: [...layers, 'hull'] });
    try {
      this.answer = await this.app.engine.call('climb', this.direction(), -1);
    } catch (error) {
      fill(this.answerBox, h('p', { class: 'bad' }, (error as Error).message));
      return;
    }
    const { answer } = this;
    const same = answer.path[answer.path.length - 1]!.every((v, i) => v === answer.answer[i]);
    fill(this.answerBox,
      h('p', { class: same ? 'good' : 'muted', id: 'climb-text' },
        `${answer.path.length - 1} steps over edges to the top, of ${count(answer.vertices)} vertices` +
        (same ? '; the library names the same one.' : '; the library names another one, just as far.')),
      facts([['Vertices compared', count(answer.neighbours.reduce((sum, around) => sum + around.length, 0))],
        ['Faces', count(answer.faces)]]));
    this.steps.setCount(answer.path.length);
    this.draw(this.steps.at());
  }

  private draw(step: number): void {
    const { answer } = this;
    this.marks.clear();
    if (!answer) return;
    const d = this.direction();
    const { radius, anchor } = this.app.stage;
    const arrow = anchor.map((v, i) => v + 1.3 * radius * d[i]!) as Vec3;
    this.marks.line([anchor, arrow], 0x2e86c1, 3, 0);
    this.marks.dots([arrow], 0x2e86c1, 14, 0);
    const way = answer.path.slice(0, step + 1);
    const around = answer.neighbours[step] ?? [];
    const here = way[way.length - 1]!;
    this.marks.segments(around.flatMap((n) => [here, n]), INK.single, 0);
    this.marks.dots(around, INK.single, 9, 0);
    this.marks.line(way, INK.path, 4, 0);
    this.marks.dots(way, INK.path, 10, 0, 'climb');
    this.marks.dots([here], step + 1 === answer.path.length ? INK.start : INK.path, 18, 0);
    this.steps.say(`${metres(answer.heights[step]!)} along the direction; ${around.length} neighbours` +
      (step + 1 === answer.path.length ? ', none of them farther: done' : ', the farthest of them is next'));
  }
}
