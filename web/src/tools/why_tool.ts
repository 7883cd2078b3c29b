// Why is this point not walkable? The answer in words, and the setting that would change it as a button.

import type { App } from '../app';
import { Latest } from '../engine/latest';
import type { Reason, Vec3, WhyAnswer } from '../engine/protocol';
import { fill, h, milliseconds } from '../panels/dom';
import { Marks } from '../scene/marks';
import { INK } from '../scene/palette';
import { parameterOf, showNumber } from '../state/parameters';
import type { Click, Handle, Tool } from './tool';

const SQUARE = 'm²';

export class WhyTool implements Tool {
  readonly name = 'why';
  readonly label = 'Why';
  readonly key = '3';
  readonly hint = 'Click a point: the stage and the setting that made it not walkable.';
  readonly panel = h('div', { 'aria-live': 'polite' });
  private marks: Marks;
  private latest = new Latest();
  /** Beside the point, on the picture. */
  private bubble = h('div', { class: 'bubble', hidden: true, role: 'status' });
  private shownAt: Vec3 | null = null;
  answer: WhyAnswer | null = null;

  constructor(private app: App) {
    this.marks = new Marks(app.stage, 'why');
    app.stage.canvas.parentElement!.append(this.bubble);
    app.stage.onFrame(() => this.place());
    app.view.watch((now, before) => {
      if (now.why !== before.why) this.refresh();
    });
  }

  handles(): Handle[] {
    const { why } = this.app.view.get();
    return why ? [{ name: 'why', at: why, move: (hit) => this.app.view.set({ why: hit.point }) }] : [];
  }

  click({ hit }: Click): void {
    if (hit) this.app.view.set({ why: hit.point });
  }

  leave(): void {
    this.marks.visible = false;
    this.bubble.hidden = true;
    this.shownAt = null;
  }

  refresh(): void {
    if (this.app.view.get().tool === 'why') this.latest.run(() => this.ask());
  }

  private async ask(): Promise<void> {
    const { why } = this.app.view.get();
    this.marks.clear();
    this.marks.visible = true;
    this.bubble.hidden = true;
    if (!why || !this.app.engine.ready || !this.app.session.get().bake) {
      fill(this.panel, h('p', { class: 'muted' }, this.hint));
      return;
    }
    this.marks.dots([why], INK.closed, 16);
    fill(this.panel, h('p', { class: 'muted' }, 'Baking the tile around the point, stage by stage …'));
    const begin = performance.now();
    try {
      const answer = await this.app.engine.call('why', why);
      this.answer = answer;
      this.marks.clear();
      this.marks.dots([why], answer.walkable ? INK.start : INK.hit, 18, 0.12, 'why');
      this.write(answer, performance.now() - begin);
      this.shownAt = why;
      this.app.stage.render();
    } catch (error) {
      fill(this.panel, h('p', { class: 'bad' }, (error as Error).message));
    }
  }

  private write(answer: WhyAnswer, time: number): void {
    const first = answer.reasons[0];
    const headline = answer.walkable
      ? answer.apart ? `Walkable, but on an island of ${showNumber(Number(answer.islandArea.toPrecision(4)))} ${SQUARE}: ` +
        `no path leads to the largest one, of ${showNumber(Number(answer.largestIslandArea.toPrecision(4)))} ${SQUARE}.`
        : 'Walkable: a polygon of the navmesh lies here.'
      : first ? `${first.text} ${first.measured}` : 'Not walkable.';
    const proof = answer.proven && first?.parameter
      ? h('p', { class: 'muted' }, `Proven: the tile was baked with ${answer.reasons.length === 1 ? 'it' : 'all of them'}, ` +
        `and the point is walkable (${answer.bakes} bakes, ${milliseconds(time)}).`)
      : h('p', { class: 'muted' }, `${answer.bakes} bakes, ${milliseconds(time)}.`);
    fill(this.panel, h('p', { class: answer.walkable ? 'good' : 'bad', id: 'why-text' }, headline),
      ...answer.reasons.flatMap((reason, i) => this.reasonRows(reason, i)),
      answer.reasons.length > 1 && this.allButton(answer.reasons),
      answer.walkable ? null : proof);
    fill(this.bubble, h('p', {}, headline), first ? this.button(first) : null);
  }

  private reasonRows(reason: Reason, i: number): (HTMLElement | null)[] {
    return [
      i === 0 ? null : h('p', {}, `Then: ${reason.text} ${reason.measured}`),
      h('p', { class: 'muted' }, `Stage: ${reason.stage}. Cause: ${reason.cause}.`),
      this.button(reason),
    ];
  }

  private button(reason: Reason): HTMLElement {
    if (!reason.parameter) {
      return h('p', { class: 'muted' }, reason.rawParameter === 'bounds'
        ? `The bounds would have to be ${showNumber(reason.needed)} m wider.` : 'No setting helps.');
    }
    const parameter = parameterOf(reason.parameter);
    const words = parameter.kind === 'flag' ? `${parameter.label}: turn ${reason.needed ? 'on' : 'off'}`
      : `${parameter.label}: ${showNumber(reason.value)} → ${showNumber(reason.needed)} ` +
        (parameter.kind === 'number' ? parameter.unit : '');
    return h('button', { class: 'apply', onclick: () => this.apply([reason]) }, words.trim());
  }

  private allButton(reasons: readonly Reason[]): HTMLElement | null {
    const usable = reasons.filter((reason) => reason.parameter);
    return usable.length < 2 ? null
      : h('button', { class: 'apply', onclick: () => this.apply(usable) }, `Change all ${usable.length}`);
  }

  private apply(reasons: readonly Reason[]): void {
    const settings = { ...this.app.view.get().settings };
    for (const { parameter, needed } of reasons) {
      const value = parameterOf(parameter!).kind === 'flag' ? needed !== 0 : needed;
      (settings as unknown as Record<string, unknown>)[parameter!] = value;
    }
    this.app.view.set({ settings });
  }

  private place(): void {
    const at = this.shownAt ? this.app.stage.screenOf(this.shownAt) : null;
    this.bubble.hidden = !at || !this.app.view.get().why;
    if (!at) return;
    const box = this.app.stage.canvas.getBoundingClientRect();
    const left = Math.min(Math.max(8, at.x - box.left + 16), Math.max(8, box.width - 300));
    const top = Math.min(Math.max(8, at.y - box.top - 20), Math.max(8, box.height - 120));
    this.bubble.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
  }
}
