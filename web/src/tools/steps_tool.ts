// How a contour becomes convex polygons: the shortest cut first, then merging across the longest edge first.

import type { App } from '../app';
import { Latest } from '../engine/latest';
import type { StepsAnswer, Vec3 } from '../engine/protocol';
import { facts, fill, h } from '../panels/dom';
import { plural } from '../plural';
import { Marks } from '../scene/marks';
import { colourOfId, INK, mix } from '../scene/palette';
import { player } from './player';
import type { Click, Handle, Tool } from './tool';

interface Piece {
  corners: readonly Vec3[];
  hue: number;
}

export class StepsTool implements Tool {
  readonly name = 'steps';
  readonly label = 'Merging';
  readonly key = '9';
  readonly hint = 'Click a region: how its contour is cut into triangles and merged into polygons, step by step.';
  readonly panel = h('div');
  private answerBox = h('div', { 'aria-live': 'polite' });
  private marks: Marks;
  private latest = new Latest();
  private point: Vec3 | null = null;
  private bake = -1;
  private steps = player({ id: 'merge-step', label: 'Step', change: (step) => this.draw(step) });
  answer: StepsAnswer | null = null;

  constructor(private app: App) {
    this.marks = new Marks(app.stage, 'steps');
    this.panel.append(this.answerBox, this.steps.element);
  }

  handles(): Handle[] {
    return [];
  }

  click({ hit }: Click): void {
    if (!hit) return;
    this.point = hit.point;
    this.bake = -1;
    this.refresh();
  }

  leave(): void {
    this.steps.stop();
    this.marks.visible = false;
  }

  refresh(): void {
    if (this.app.view.get().tool !== 'steps') return;
    this.marks.visible = true;
    const { bakeNumber, bake } = this.app.session.get();
    if (this.bake === bakeNumber || !bake) return;
    this.bake = bakeNumber;
    this.latest.run(() => this.ask());
  }

  private async ask(): Promise<void> {
    try {
      this.answer = await this.app.engine.call('steps', this.point);
    } catch (error) {
      fill(this.answerBox, h('p', { class: 'bad' }, (error as Error).message));
      return;
    }
    const { answer } = this;
    fill(this.answerBox, facts([
      ['Contour', `${answer.contour + 1} of ${answer.contours}`], ['Its vertices', String(answer.outline.length)],
      ['Cuts', String(answer.cuts)], ['Merges', String(answer.merges)],
      ['Polygons', String(Math.max(0, answer.cuts - answer.merges))],
    ]));
    this.steps.setCount(answer.steps.length, 0);
  }

  private draw(step: number): void {
    const { answer } = this;
    this.marks.clear();
    if (!answer || answer.steps.length === 0) return;
    const lift = 0.4;
    const pieces = piecesAfter(answer, step);
    for (const piece of pieces) {
      this.marks.fan(piece.corners, mix(colourOfId(piece.hue), 0xffffff, 0.15), 0.75, lift);
      this.marks.line([...piece.corners, piece.corners[0]!], INK.wall, 1.5, lift);
    }
    this.marks.line([...answer.outline, answer.outline[0]!], INK.wall, 3, lift);
    const now = answer.steps[step]!;
    this.marks.segments(now.partitions.slice(2), 0x7f8c8d, lift + 0.05);
    if (now.partitions.length > 1) this.marks.line(now.partitions.slice(0, 2), INK.path, 4, lift + 0.05);
    this.marks.dots(now.corners, INK.path, 9, lift);
    this.steps.say(now.kind === 'cut' && now.partitions.length === 0 ? 'Cut: what is left is a triangle.' : now.kind === 'cut'
      ? `Cut: of ${now.partitions.length / 2} possible partitions the shortest, red, cuts a triangle off.`
      : `Merge: of ${plural(now.partitions.length / 2, 'edge')} that could go, the longest, red, goes; the result stays convex.`);
  }
}

/** The pieces after a step. A merge takes away the two pieces whose corners are all its own. */
function piecesAfter(answer: StepsAnswer, step: number): Piece[] {
  const key = (p: Vec3): string => `${p[0]},${p[2]}`;
  let pieces: Piece[] = [];
  answer.steps.slice(0, step + 1).forEach((one, i) => {
    if (one.kind === 'merge') {
      const corners = new Set(one.corners.map(key));
      pieces = pieces.filter((piece) => !piece.corners.every((p) => corners.has(key(p))));
    }
    pieces.push({ corners: one.corners, hue: i + 1 });
  });
  return pieces;
}
