// Looking around: a click names what is under the pointer.

import type { App } from '../app';
import { count, facts, fill, h, metres } from '../panels/dom';
import { Marks } from '../scene/marks';
import type { Click, Handle, Tool } from './tool';

export class LookTool implements Tool {
  readonly name = 'look';
  readonly label = 'Look';
  readonly key = '1';
  readonly hint = 'Drag to orbit, right-drag or two fingers to pan, wheel or pinch to zoom, W A S D Q E to fly.';
  readonly panel = h('div');
  private answerBox = h('div', { 'aria-live': 'polite' }, h('p', { class: 'muted' }, 'Click anything to name it.'));
  private marks: Marks;

  constructor(private app: App) {
    this.marks = new Marks(app.stage, 'look');
    this.panel.append(this.answerBox);
  }

  handles(): Handle[] {
    return [];
  }

  click({ hit }: Click): void {
    this.marks.clear();
    if (!hit) {
      fill(this.answerBox, h('p', { class: 'muted' }, 'Nothing is there.'));
      return;
    }
    this.marks.dots([hit.point], 0x34495e, 12, 0);
    const slope = (Math.acos(Math.min(1, Math.max(-1, hit.normal[1]))) * 180) / Math.PI;
    fill(this.answerBox, facts([
      ['Triangle', count(hit.triangle)],
      ['Point', hit.point.map((v) => Number(v.toFixed(3))).join(', ')],
      ['Slope', `${slope.toFixed(1)}°`],
      ['Side', hit.back ? 'back' : 'front'],
      ['From the eye', metres(hit.t)],
    ]), h('button', { onclick: () => this.app.view.set({ tool: 'why', why: hit.point }) }, 'Why is this (not) walkable?'));
  }

  leave(): void {
    this.marks.visible = false;
  }

  refresh(): void {
    this.marks.visible = true;
  }
}
