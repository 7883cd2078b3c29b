// Start and goal: the exact path, its length and its proof, for an agent of any radius.

import type { App } from '../app';
import { Latest } from '../engine/latest';
import type { PathAnswer, Vec3 } from '../engine/protocol';
import { facts, fill, h, metres, milliseconds, slider } from '../panels/dom';
import { Marks } from '../scene/marks';
import { INK } from '../scene/palette';
import { SECOND_CLICK, type Click, type Handle, type Tool } from './tool';

const WORDS: Record<Exclude<PathAnswer['status'], 'complete'>, string> = {
  unreachable: 'No path leads to the goal: it lies on another island. That is proven, without a search.',
  'start blocked': 'The start is too near to a wall for an agent of this radius.',
  'goal blocked': 'The goal is too near to a wall for an agent of this radius.',
  'out of nodes': 'The search ran out of nodes before it was sure.',
  'no start': 'There is no navmesh near the start.',
  'no goal': 'There is no navmesh near the goal.',
};

function proofOf({ length, lowerBound }: PathAnswer): string {
  const gap = length - lowerBound;
  return gap < 1e-6 * Math.max(1, length) ? 'Proven: no path is shorter.' : `Proven: no path is shorter than ${metres(lowerBound)}.`;
}

export class PathTool implements Tool {
  readonly name = 'path';
  readonly label = 'Path';
  readonly key = '2';
  readonly hint = `Click the start, then the goal. Drag either one. ${SECOND_CLICK} moves the start.`;
  readonly panel = h('div');
  private answerBox = h('div', { 'aria-live': 'polite' });
  private marks: Marks;
  private latest = new Latest();
  private radius: ReturnType<typeof slider>;
  answer: PathAnswer | null = null;

  constructor(private app: App) {
    this.marks = new Marks(app.stage, 'path');
    this.radius = slider({
      id: 'walk-radius', label: 'Walker\'s radius', unit: 'm', min: 0, max: 4, step: 0.05,
      value: app.view.get().walkRadius,
      help: 'Of an agent wider than the navmesh was baked for; 0: the bake\'s own. One mesh serves all radii.',
      change: (walkRadius) => this.app.view.set({ walkRadius }),
    });
    this.panel.append(this.radius.element, this.answerBox);
    app.view.watch((now, before) => {
      if (now.start !== before.start || now.goal !== before.goal || now.walkRadius !== before.walkRadius) this.refresh();
    });
  }

  handles(): Handle[] {
    const { start, goal } = this.app.view.get();
    const handle = (name: 'start' | 'goal', at: Vec3): Handle =>
      ({ name, at, move: (hit) => this.app.view.set({ [name]: hit.point }) });
    return [...(goal ? [handle('goal', goal)] : []), ...(start ? [handle('start', start)] : [])];
  }

  click({ hit, second }: Click): void {
    if (!hit) return;
    const { start } = this.app.view.get();
    this.app.view.set(!start || second ? { start: hit.point } : { goal: hit.point });
  }

  leave(): void {}

  refresh(): void {
    this.radius.set(this.app.view.get().walkRadius);
    this.latest.run(() => this.ask());
  }

  private async ask(): Promise<void> {
    const { start, goal, walkRadius } = this.app.view.get();
    this.answer = null;
    if (start && goal && this.app.engine.ready && this.app.session.get().bake) {
      try {
        this.answer = await this.app.engine.call('path', start, goal, walkRadius);
      } catch (error) {
        fill(this.answerBox, h('p', { class: 'bad' }, (error as Error).message));
        return;
      }
    }
    this.draw(start, goal);
    this.write(start, goal);
  }

  private draw(start: Vec3 | null, goal: Vec3 | null): void {
    this.marks.clear();
    const { answer } = this;
    if (answer && answer.corners.length > 1) {
      this.marks.line(answer.corners, answer.status === 'complete' ? INK.path : INK.corridor, 4, 0.3);
      this.marks.dots(answer.corners.slice(1, -1), INK.path, 8, 0.2, 'corners');
    }
    if (answer?.nearest && goal) {
      this.marks.segments([answer.nearest, goal], INK.goal, 0.2);
      this.marks.dots([answer.nearest], INK.corridor, 14, 0.2, 'nearest');
    }
    if (start) this.marks.dots([start], INK.start, 18, 0.12, 'start');
    if (goal) this.marks.dots([goal], INK.goal, 18, 0.12, 'goal');
  }

  private write(start: Vec3 | null, goal: Vec3 | null): void {
    const { answer } = this;
    if (!start || !goal || !answer) {
      fill(this.answerBox, h('p', { class: 'muted' }, start ? 'Now click the goal.' : 'Click the start.'));
      return;
    }
    const good = answer.status === 'complete';
    const rows: [string, string][] = [];
    if (good) {
      rows.push(['Length in space', metres(answer.surfaceLength)], ['As the crow flies', metres(answer.straight)]);
      if (answer.clearance !== null) rows.push(['Kept from walls', `${metres(answer.clearance)} more than the bake's radius`]);
      rows.push(['Corners', String(answer.corners.length)]);
      if (answer.polygons > 0) rows.push(['Polygons', String(answer.polygons)]);
    }
    if (answer.nearest && goal) {
      const away = Math.hypot(...answer.nearest.map((v, i) => v - goal[i]!));
      rows.push(['Nearest reachable', `${metres(away)} from the goal`]);
    }
    rows.push(['Answered in', milliseconds(answer.milliseconds)]);
    fill(this.answerBox,
      h('p', { class: good ? 'good answer' : 'bad', id: 'path-status' }, answer.status === 'complete' ? `${metres(answer.length)} in the plane` : WORDS[answer.status]),
      good && answer.exact ? h('p', { class: 'muted', id: 'path-proof' }, proofOf(answer)) : null,
      facts(rows),
      h('div', { class: 'row' },
        answer.nearest && h('button', { onclick: () => this.app.view.set({ goal: answer.nearest! }) }, 'Go there instead'),
        h('button', { onclick: () => this.app.view.set({ start: null, goal: null }) }, 'Clear')));
  }
}
