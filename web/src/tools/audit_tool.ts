// The audit: the agent's capsule swept wherever the navmesh says free. Its findings are gone through one by one.

import type { App } from '../app';
import type { AuditAnswer, Finding } from '../engine/protocol';
import { count, facts, fill, h, metres, milliseconds } from '../panels/dom';
import { Marks } from '../scene/marks';
import { INK } from '../scene/palette';
import { player } from './player';
import type { Handle, Tool } from './tool';

const WORDS: Record<string, (one: Finding) => string> = {
  blocked: (one) => `blocked: a triangle reaches ${metres(one.depth)} into the agent`,
  step: (one) => `step: the floor rises or falls by ${metres(one.depth)} within a cell`,
  'no floor': (one) => `no floor: ${Number.isFinite(one.depth) ? `it lies ${metres(one.depth)} lower` : 'nothing below'}`,
  missing: (one) => `missing: ${Number(one.area.toPrecision(3))} m² of floor with room for the agent have no navmesh`,
};

export class AuditTool implements Tool {
  readonly name = 'audit';
  readonly label = 'Audit';
  readonly key = '0';
  readonly hint = 'Checks the navmesh against the triangles: polygons, portals, random paths, and floor without navmesh.';
  readonly panel = h('div');
  private answerBox = h('div', { 'aria-live': 'polite' });
  private marks: Marks;
  private running = false;
  private steps = player({ id: 'audit-step', label: 'Finding', change: (step) => this.show(step) });
  answer: AuditAnswer | null = null;

  constructor(private app: App) {
    this.marks = new Marks(app.stage, 'audit');
    this.steps.element.hidden = true;
    this.panel.append(
      h('button', { id: 'run-audit', class: 'apply', onclick: () => void this.run() }, 'Run the audit'),
      this.answerBox, this.steps.element);
    app.session.watch((now, before) => {
      if (now.bakeNumber !== before.bakeNumber || now.tilesNumber !== before.tilesNumber) this.forget();
    });
  }

  handles(): Handle[] {
    return [];
  }

  click(): void {}

  leave(): void {
    this.steps.stop();
    this.marks.visible = false;
  }

  refresh(): void {
    this.marks.visible = this.app.view.get().tool === 'audit';
  }

  private forget(): void {
    this.answer = null;
    this.marks.clear();
    this.steps.element.hidden = true;
    fill(this.answerBox);
  }

  private async run(): Promise<void> {
    if (this.running || !this.app.session.get().bake) return;
    this.running = true;
    fill(this.answerBox, h('p', { class: 'muted' }, 'Sweeping the agent through the triangles …'));
    try {
      this.answer = await this.app.work('audit', () => this.app.engine.call('audit', 2000));
      this.write(this.answer);
    } catch (error) {
      fill(this.answerBox, h('p', { class: 'bad' }, (error as Error).message));
    } finally {
      this.running = false;
    }
  }

  private write(answer: AuditAnswer): void {
    const faults = answer.findings.length;
    fill(this.answerBox,
      h('p', { class: faults === 0 ? 'good' : 'bad', id: 'audit-text' }, faults === 0
        ? 'No contradiction between navmesh and triangles.'
        : `${count(faults)} finding${faults === 1 ? '' : 's'}, from ${count(answer.contradictions)} places.`),
      facts([
        ['Paths walked', `${count(answer.paths)}, ${metres(answer.pathMetres)}`],
        ['Polygons', count(answer.polygons)], ['Portals', count(answer.portals)], ['Sweeps', count(answer.steps)],
        ['Floor samples', count(answer.samples)], ['Time', milliseconds(answer.milliseconds)],
      ]));
    this.steps.element.hidden = faults === 0;
    this.steps.setCount(faults, 0);
  }

  private show(step: number): void {
    this.marks.clear();
    const { answer } = this;
    const one = answer?.findings[step];
    if (!answer || !one) return;
    this.marks.dots(answer.findings.map((other) => other.point), INK.single, 9, 0.1, 'findings');
    this.marks.line([one.point, one.contact], INK.hit, 3, 0);
    this.marks.dots([one.point], INK.hit, 18, 0.1, 'finding');
    this.steps.say(`${(WORDS[one.kind] ?? ((other: Finding) => other.kind))(one)}` +
      (one.triangle >= 0 ? `; triangle ${count(one.triangle)}` : '') + (one.count > 1 ? `; ${count(one.count)} places` : ''));
    // The eye goes there only when a person steps, not when the audit ends.
    if (document.activeElement && this.panel.contains(document.activeElement) && answer.findings.length > 1) {
      const { eye, target } = this.app.stage.getCamera();
      const d = eye.map((v, i) => v - target[i]!);
      const length = Math.hypot(...d) || 1;
      const near = Math.min(length, Math.max(12, 0.15 * this.app.stage.radius));
      this.app.stage.setCamera({
        target: one.point,
        eye: one.point.map((v, i) => v + (d[i]! / length) * near) as typeof eye,
      });
    }
  }
}
