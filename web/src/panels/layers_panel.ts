// The layers in the order of the pipeline, each with what it shows and its legend.

import type { App } from '../app';
import type { LayerName } from '../engine/protocol';
import { CATALOGUE, nextStage } from '../layers/catalogue';
import { css } from '../scene/palette';
import { fill, h, slider } from './dom';

/** Shows the stage of the bake after the one shown, or before. */
export function stepStage(app: App, by: 1 | -1): void {
  app.view.set({ layers: nextStage(app.view.get().layers, by) });
}

/** A height above which nothing is drawn: the level's own top is none. */
function cutSlider(app: App): HTMLElement {
  const holder = h('div');
  let forget = (): void => {};
  app.session.watch(({ level }, before) => {
    if (level === null || (level === before.level && holder.childElementCount > 0)) return;
    const [low, high] = [level.min[1], level.max[1]];
    const control = slider({
      id: 'cut', label: 'Cut off above', unit: 'm', min: low, max: high, step: (high - low) / 200 || 1,
      help: 'Hides what lies above this height, to look into buildings.', value: app.view.get().cut ?? high,
      change: (value) => app.view.set({ cut: value >= high ? null : value }),
    });
    forget();
    forget = app.view.watch(({ cut }) => control.set(cut ?? high));
    fill(holder, control.element);
  });
  return holder;
}

export function layersPanel(app: App): HTMLElement {
  const rows = new Map<LayerName, { box: HTMLInputElement; about: HTMLElement }>();
  const depth = slider({
    id: 'box-depth', label: 'Depth', unit: '', min: 0, max: 24, step: 1, value: app.view.get().boxDepth,
    change: (boxDepth) => app.view.set({ boxDepth }),
  });
  depth.element.style.marginLeft = '20px';
  const elements: HTMLElement[] = [];
  let stage = '';
  for (const { name, label, help, stage: of } of CATALOGUE) {
    if (of !== stage) elements.push(h('div', { class: 'stage-name' }, of));
    stage = of;
    const box = h('input', { type: 'checkbox', id: `layer-${name}`, onchange: () => toggle(name, box.checked) });
    const about = h('div');
    rows.set(name, { box, about });
    elements.push(h('div', { class: 'layer' },
      h('label', { class: 'check', title: help, htmlFor: `layer-${name}` }, box, label),
      name === 'boxes' ? depth.element : null, about));
  }

  const toggle = (name: LayerName, on: boolean): void => {
    const { layers } = app.view.get();
    app.view.set({ layers: on ? [...layers, name] : layers.filter((one) => one !== name) });
  };

  const show = (): void => {
    const { layers, boxDepth } = app.view.get();
    depth.set(boxDepth);
    depth.element.hidden = !layers.includes('boxes');
    for (const [name, { box, about }] of rows) {
      box.checked = layers.includes(name);
      const shown = box.checked ? app.layers.shown.get(name) : undefined;
      if (!box.checked) fill(about);
      else if (!shown) fill(about, h('p', { class: 'about' }, '…'));
      else {
        fill(about, h('div', { class: 'legend' },
          ...shown.data.legends.map(({ colour, text }) => h('span', { style: `--swatch: ${css(colour)}` }, text))),
        h('p', { class: 'about' }, shown.data.summary));
      }
    }
  };
  app.layers.watch(show);
  app.view.watch(show);
  const step = (by: 1 | -1, sign: string, words: string): HTMLElement =>
    h('button', { class: 'quiet', 'aria-label': words, title: `${words} (${by < 0 ? ',' : '.'})`, onclick: () => stepStage(app, by) }, sign);
  return h('section', {},
    h('div', { class: 'heading' }, h('h2', {}, 'Layers'),
      h('span', {}, step(-1, '‹', 'The stage before'), h('span', { class: 'muted' }, 'stage'), step(1, '›', 'The next stage'))),
    cutSlider(app), ...elements);
}
