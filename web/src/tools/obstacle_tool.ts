// Crates and pillars that come, move and go: only the tiles that they touch are baked again.

import type { App } from '../app';
import { Latest } from '../engine/latest';
import type { Obstacle, ObstacleUpdate } from '../engine/protocol';
import { facts, fill, h, milliseconds, slider } from '../panels/dom';
import { Marks } from '../scene/marks';
import { SECOND_CLICK, type Click, type Handle, type Tool } from './tool';

const TILE = 48;

export class ObstacleTool implements Tool {
  readonly name = 'obstacle';
  readonly label = 'Obstacle';
  readonly key = '4';
  readonly hint = `Click to put an obstacle down; drag it. ${SECOND_CLICK} takes one away.`;
  readonly panel = h('div');
  private answerBox = h('div', { 'aria-live': 'polite' });
  private marks: Marks;
  private latest = new Latest();
  private shape: Obstacle['shape'] = 'cylinder';
  private radius = 1;
  private height = 2;
  last: ObstacleUpdate | null = null;

  constructor(private app: App) {
    this.marks = new Marks(app.stage, 'obstacles');
    const choose = h('select', { 'aria-label': 'Shape', onchange: () => { this.shape = choose.value as Obstacle['shape']; } },
      h('option', { value: 'cylinder' }, 'Cylinder'), h('option', { value: 'box' }, 'Box'));
    const size = (id: string, label: string, max: number, value: number, change: (v: number) => void): HTMLElement =>
      slider({ id, label, unit: 'm', min: 0.1, max, step: 0.1, value, change }).element;
    this.panel.append(
      h('div', { class: 'row' }, h('label', {}, 'Shape ', choose)),
      size('obstacle-radius', 'Radius', 10, this.radius, (v) => { this.radius = v; }),
      size('obstacle-height', 'Height', 10, this.height, (v) => { this.height = v; }),
      this.answerBox);
    app.view.watch((now, before) => {
      if (now.obstacles !== before.obstacles) this.update();
    });
  }

  handles(): Handle[] {
    return this.app.view.get().obstacles.map((one) => ({
      name: `obstacle ${one.id}`,
      at: one.base,
      move: (hit) => this.app.view.set({
        obstacles: this.app.view.get().obstacles.map((other) => (other.id === one.id ? { ...other, base: hit.point } : other)),
      }),
    }));
  }

  click({ hit, second }: Click): void {
    if (!hit) return;
    const { obstacles, settings } = this.app.view.get();
    if (settings.tileSize === 0) return;
    if (second) {
      const near = obstacles.filter((one) =>
        Math.hypot(one.base[0] - hit.point[0], one.base[2] - hit.point[2]) <= one.radius * 1.5);
      this.app.view.set({ obstacles: obstacles.filter((one) => !near.includes(one)) });
      return;
    }
    const id = 1 + Math.max(0, ...obstacles.map((one) => one.id));
    this.app.view.set({
      obstacles: [...obstacles, { id, shape: this.shape, base: hit.point, radius: this.radius, height: this.height }],
    });
  }

  leave(): void {}

  refresh(): void {
    this.draw();
    this.write();
  }

  private update(): void {
    this.draw();
    if (this.app.view.get().settings.tileSize === 0 || !this.app.session.get().bake) {
      this.write();
      return;
    }
    this.latest.run(async () => {
      try {
        this.last = await this.app.engine.call('setObstacles', this.app.view.get().obstacles);
        this.app.tilesChanged();
        this.write();
      } catch (error) {
        this.app.say((error as Error).message, 'error');
      }
    });
  }

  private draw(): void {
    this.marks.clear();
    for (const one of this.app.view.get().obstacles) {
      this.marks.solid(one.shape, one.base, one.radius, one.height, 0xc97b3d);
    }
  }

  private write(): void {
    const { obstacles, settings } = this.app.view.get();
    if (settings.tileSize === 0) {
      fill(this.answerBox,
        h('p', { class: 'bad' }, 'Obstacles need tiles, so that a change bakes a part of the level only.'),
        h('button', { class: 'apply', onclick: () => this.app.view.set({ settings: { ...settings, tileSize: TILE } }) },
          `Tile size: 0 → ${TILE} cells`));
      return;
    }
    const bake = this.app.session.get().bake;
    fill(this.answerBox,
      this.last && obstacles.length > 0 ? facts([
        ['Obstacles', String(obstacles.length)],
        ['Tiles baked again', `${this.last.tiles} of ${bake ? bake.tilesX * bake.tilesZ : '?'}`],
        ['Time', milliseconds(this.last.milliseconds)],
      ]) : h('p', { class: 'muted' }, 'None yet.'),
      obstacles.length > 0 && h('button', { onclick: () => this.app.view.set({ obstacles: [] }) }, 'Take all away'));
  }
}
