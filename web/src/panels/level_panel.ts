// What level is open: samples, files, and how a file is read.

import type { App } from '../app';
import type { SampleInfo } from '../engine/protocol';
import { ENDINGS } from '../load/level_file';
import { bytes, count, facts, fill, h, milliseconds } from './dom';

/** The chooser in the top line. */
export function levelChooser(app: App, openFiles: (files: readonly File[]) => void): { element: HTMLElement; setSamples(samples: readonly SampleInfo[]): void } {
  const select = h('select', { id: 'level', 'aria-label': 'Level' });
  const file = h('input', {
    type: 'file', accept: ENDINGS.join(','), hidden: true, id: 'file',
    onchange: () => {
      openFiles([...(file.files ?? [])]);
      file.value = '';
    },
  });
  let samples: readonly SampleInfo[] = [];
  const show = (): void => {
    const { level } = app.view.get();
    const own = level.startsWith('sample:') ? [] : [h('option', { value: level }, level)];
    fill(select, ...own, ...samples.map((one) => h('option', { value: `sample:${one.name}` }, one.name)));
    select.value = level;
  };
  select.addEventListener('change', () => {
    if (select.value.startsWith('sample:')) void app.open({ kind: 'sample', name: select.value.slice(7) });
  });
  app.view.watch((now, before) => {
    if (now.level !== before.level) show();
  });
  return {
    element: h('div', { class: 'row', style: 'margin: 0; flex-wrap: nowrap' }, select, file,
      h('button', { onclick: () => file.click(), title: `${ENDINGS.join(' ')} (O)`, id: 'open' }, 'Open …')),
    setSamples: (list) => {
      samples = list;
      show();
    },
  };
}

/** What is known of the level, and how files are read. */
export function levelPanel(app: App, reopen: () => void): HTMLElement {
  const about = h('div');
  const up = h('select', { id: 'up', onchange: () => { app.view.set({ up: up.value as 'y' | 'z' }); reopen(); } },
    h('option', { value: 'y' }, 'y is up'), h('option', { value: 'z' }, 'z is up'));
  const scale = h('input', {
    type: 'number', step: 'any', min: '0', class: 'number', id: 'scale', style: 'width: 64px',
    onchange: () => {
      if (!(Number(scale.value) > 0)) return;
      app.view.set({ scale: Number(scale.value) });
      reopen();
    },
  });
  const how = h('div', { class: 'row' }, up, h('label', { htmlFor: 'scale' }, 'metres a unit'), scale);
  app.view.watch((view) => {
    up.value = view.up;
    if (document.activeElement !== scale) scale.value = String(view.scale);
    how.hidden = view.level.startsWith('sample:') || view.level.endsWith('.talus');
  });
  app.session.watch(({ level }, before) => {
    if (level === null || level === before.level && about.childElementCount > 0) return;
    const size = level.max.map((v, i) => String(Number((v - level.min[i]!).toPrecision(3)))).join(' × ');
    fill(about, facts([
      ['Triangles', count(level.triangles) + (level.degenerate > 0 ? `, ${count(level.degenerate)} without area` : '')],
      ['Size', `${size} m`],
      ['Ray tree', `${bytes(level.soupBytes)}, ${milliseconds(level.soupMilliseconds)}`],
    ]));
  });
  return h('section', {}, h('h2', {}, 'Level'), about, how);
}
