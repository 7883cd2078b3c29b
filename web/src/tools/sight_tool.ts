// What a guard sees: a level fan of exact rays at eye height.

import type { App } from '../app';
import { Latest } from '../engine/latest';
import type { SightAnswer } from '../engine/protocol';
import { facts, fill, h, metres, milliseconds, slider } from '../panels/dom';
import { Marks } from '../scene/marks';
import { INK } from '../scene/palette';
import type { Click, Handle, Tool } from './tool';

export class SightTool implements Tool {
  readonly name = 'sight';
  readonly label = 'Sight';
  readonly key = '7';
  readonly hint = 'Click where a guard stands; drag the guard. The fan is what the guard sees at eye height.';
  readonly panel = h('div');
  private answerBox = h('div', { 'aria-live': 'polite' });
  private marks: Marks;
  private latest = new Latest();
  private height: ReturnType<typeof slider>;
  answer: SightAnswer | null = null;

  constructor(private app: App) {
    this.marks = new Marks(app.stage, 'sight');
    this.height = slider({
      id: 'eye-height', label: 'Eye height', unit: 'm', min: 0.1, max: 10, step: 0.1, value: app.view.get().eyeHeight,
      change: (eyeHeight) => this.app.view.set({ eyeHeight }),
    });
    this.panel.append(this.height.element, this.answerBox);
    app.view.watch((now, before) => {
      if (now.guard !== before.guard || now.eyeHeight !== before.eyeHeight) this.refresh();
    });
  }

  handles(): Handle[] {
    const { guard } = this.app.view.get();
    return guard ? [{ name: 'guard', at: guard, move: (hit) => this.app.view.set({ guard: hit.point }) }] : [];
  }

  click({ hit }: Click): void {
    if (hit) this.app.view.set({ guard: hit.point });
  }

  leave(): void {
    this.marks.visible = false;
  }

  refresh(): void {
    if (this.app.view.get().tool === 'sight') this.latest.run(() => this.ask());
  }

  private async ask(): Promise<void> {
    const { guard, eyeHeight } = this.app.view.get();
    this.marks.visible = true;
    this.height.set(eyeHeight);
    this.answer = guard && this.app.engine.ready
      ? await this.app.engine.call('sight', guard, eyeHeight, this.app.stage.radius) : null;
    this.marks.clear();
    const { answer } = this;
    if (!answer || !guard) {
      fill(this.answerBox, h('p', { class: 'muted' }, this.hint));
      return;
    }
    this.marks.fan([answer.eye, ...answer.rim], INK.sight, 0.45, 0, true);
    this.marks.line([...answer.rim, answer.rim[0]!], 0xb7950b, 1.5, 0);
    this.marks.line([guard, answer.eye], 0x34495e, 4, 0);
    this.marks.dots([guard], 0x34495e, 14, 0, 'guard');
    this.marks.dots([answer.eye], INK.sight, 16, 0, 'eye');
    const far = Math.max(...answer.rim.map((p) => Math.hypot(p[0] - answer.eye[0], p[2] - answer.eye[2])));
    fill(this.answerBox, facts([
      ['Area in sight', `${Number(answer.area.toPrecision(4)).toLocaleString('en')} m²`], ['Farthest', metres(far)],
      ['Rays', String(answer.rim.length)], ['Time', milliseconds(answer.milliseconds)],
    ]));
  }
}
