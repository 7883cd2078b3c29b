// The line at the bottom: how a bake goes on, and then what it made and how long each stage took.

import type { App } from '../app';
import { plural } from '../plural';
import { colourOfId, css, mix } from '../scene/palette';
import { count, fill, h, milliseconds } from './dom';

/** `simd`: whether the module has it. `oneThread`: why threads were not asked for. */
export function footer(app: App, simd: boolean, oneThread: string | null): HTMLElement {
  const bar = h('progress', { max: 1, value: 0, 'aria-label': 'Progress of the bake' });
  const stage = h('span', { class: 'muted', id: 'stage' });
  const cancel = h('button', { id: 'cancel', onclick: () => app.cancel() }, 'Cancel');
  const work = h('div', { class: 'row', style: 'margin: 0' }, bar, stage, cancel);
  const numbers = h('span', { class: 'numbers', id: 'numbers' });
  const times = h('div', { class: 'times', id: 'times', role: 'img' });
  const total = h('span', { id: 'total' });
  app.session.watch(({ progress, baking, working, bake, level }) => {
    const busy = baking || working !== null;
    work.hidden = !busy;
    if (busy) {
      if (progress && progress.total > 0) bar.value = progress.done / progress.total;
      else bar.removeAttribute('value');
      stage.textContent = progress?.stage ?? working ?? 'starting';
    }
    numbers.textContent = level === null ? ''
      : plural(level.triangles, 'triangle') + (bake === null ? '' :
        ` · ${plural(bake.polygons, 'polygon')} in ${plural(bake.tiles, 'tile')}` +
        ` · ${Number(bake.area.toPrecision(5)).toLocaleString('en')} m²`);
    const sum = bake?.stages.reduce((all, one) => all + one.milliseconds, 0) ?? 0;
    times.hidden = sum === 0 || busy;
    if (bake && sum > 0) {
      const measured = bake.measuredTiles === null || bake.measuredTiles === bake.tiles ? ''
        : ` (by what ${count(bake.measuredTiles)} of ${plural(bake.tiles, 'tile')} take)`;
      times.setAttribute('aria-label', `Time of each stage${measured}: ` +
        bake.stages.map((one) => `${one.stage} ${milliseconds(one.milliseconds)}`).join(', '));
      fill(times, ...bake.stages.map((one, i) => h('span', {
        style: `flex: ${(100 * one.milliseconds) / sum}; background: ${css(mix(colourOfId(i + 3), 0xffffff, 0.45))}`,
        title: `${one.stage}: ${milliseconds(one.milliseconds)}${measured}`,
      }, `${one.stage} ${milliseconds(one.milliseconds)}`)));
    }
    const threads = bake?.threads.count ?? 1;
    total.textContent = !bake || busy ? '' : bake.milliseconds === 0 ? 'as baked in the file'
      : `bake ${milliseconds(bake.milliseconds)}${threads > 1 ? `, ${threads} threads` : ''}${simd ? '' : ', without SIMD'}`;
    total.title = [
      simd ? '' : 'Slower than it could be: this browser lacks WebAssembly SIMD. The results are the same.',
      threads > 1 ? '' : `On one thread: ${bake?.threads.reason ?? oneThread}`,
    ].join(' ').trim();
  });
  return h('footer', {}, work, numbers, times, total);
}
