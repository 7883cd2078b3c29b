// Off-mesh links: placed by hand, or found along the ledges and proven by sweeps.

import type { App } from '../app';
import type { LinksAnswer, OffmeshLink, Vec3 } from '../engine/protocol';
import { Latest } from '../engine/latest';
import { count, facts, fill, h, milliseconds } from '../panels/dom';
import { Marks } from '../scene/marks';
import type { Click, Handle, Tool } from './tool';

export class LinkTool implements Tool {
  readonly name = 'link';
  readonly label = 'Links';
  readonly key = '5';
  readonly hint = 'Click both ends of a link. Drag an end to move it. Or let drops, jumps and climbs be found.';
  readonly panel = h('div');
  private answerBox = h('div', { 'aria-live': 'polite' });
  private marks: Marks;
  private latest = new Latest();
  private first: Vec3 | null = null;
  private bothWays = true;
  private anchored = 0;
  private finding = false;
  answer: LinksAnswer | null = null;

  constructor(private app: App) {
    this.marks = new Marks(app.stage, 'links');
    const both = h('input', { type: 'checkbox', checked: true, onchange: () => { this.bothWays = both.checked; } });
    this.panel.append(
      h('label', { class: 'check' }, both, 'both ways'),
      h('div', { class: 'row' },
        h('button', { id: 'find-links', onclick: () => void this.find() }, 'Find drops, jumps, climbs'),
        h('button', { onclick: () => this.app.view.set({ links: [] }) }, 'Remove placed')),
      this.answerBox);
    app.view.watch((now, before) => {
      if (now.links !== before.links) this.update();
    });
    app.session.watch((now, before) => {
      if (now.bakeNumber !== before.bakeNumber) this.answer = null;
    });
  }

  handles(): Handle[] {
    const { links } = this.app.view.get();
    const change = (i: number, part: Partial<OffmeshLink>): void => this.app.view.set({
      links: this.app.view.get().links.map((link, k) => (k === i ? { ...link, ...part } : link)),
    });
    return links.flatMap((link, i): Handle[] => [
      { name: `start ${i}`, at: link.start, move: (hit) => change(i, { start: hit.point }) },
      { name: `end ${i}`, at: link.end, move: (hit) => change(i, { end: hit.point }) },
    ]);
  }

  click({ hit }: Click): void {
    if (!hit) return;
    if (!this.first) {
      this.first = hit.point;
      this.refresh();
      return;
    }
    const link = { start: this.first, end: hit.point, bothWays: this.bothWays };
    this.first = null;
    this.app.view.set({ links: [...this.app.view.get().links, link], layers: withLinks(this.app) });
  }

  leave(): void {
    this.first = null;
    this.draw();
  }

  refresh(): void {
    this.draw();
    this.write();
  }

  private update(): void {
    this.draw();
    if (!this.app.session.get().bake) return;
    this.latest.run(async () => {
      try {
        this.anchored = await this.app.engine.call('setLinks', this.app.view.get().links);
        this.app.tilesChanged();
        this.write();
      } catch (error) {
        this.app.say((error as Error).message, 'error');
      }
    });
  }

  private async find(): Promise<void> {
    if (this.finding || !this.app.session.get().bake) return;
    this.finding = true;
    fill(this.answerBox, h('p', { class: 'muted' }, 'Sweeping the agent over the ledges …'));
    try {
      this.answer = await this.app.work('links', () => this.app.engine.call('findLinks'));
      this.app.view.set({ layers: withLinks(this.app) });
      this.app.tilesChanged();
    } catch (error) {
      this.app.say((error as Error).message, 'error');
    } finally {
      this.finding = false;
    }
    this.write();
  }

  private draw(): void {
    this.marks.clear();
    if (this.app.view.get().tool !== 'link') return;
    const ends = this.app.view.get().links.flatMap((link) => [link.start, link.end]);
    if (ends.length > 0) this.marks.dots(ends, 0x8e44ad, 14);
    if (this.first) this.marks.dots([this.first], 0xbb8fce, 14);
  }

  private write(): void {
    const { links } = this.app.view.get();
    fill(this.answerBox,
      this.first && h('p', { class: 'muted' }, 'Now click where the link ends.'),
      links.length > 0 && facts([['Placed', String(links.length)], ['With floor at both ends', String(this.anchored)]]),
      this.answer && h('p', { id: 'links-found' }, `${count(this.answer.count)} links found and proven.`),
      this.answer && facts([
        ['Drops', count(this.answer.drops)], ['Jumps', count(this.answer.jumps)], ['Climbs', count(this.answer.climbs)],
        ['Tried', count(this.answer.tried)], ['Time', milliseconds(this.answer.milliseconds)],
      ]));
  }
}

function withLinks(app: App): readonly ReturnType<App['view']['get']>['layers'][number][] {
  const { layers } = app.view.get();
  return layers.includes('links') ? layers : [...layers, 'links'];
}
