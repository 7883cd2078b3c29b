// A control for every bake parameter. What differs from the default is marked, and goes back by a click.

import type { App } from '../app';
import type { BakeSettings } from '../engine/protocol';
import { DEFAULTS, PARAMETERS, type Parameter } from '../state/parameters';
import { h, slider } from './dom';

interface Control {
  element: HTMLElement;
  set(value: BakeSettings[keyof BakeSettings]): void;
}

function change(app: App, key: keyof BakeSettings, value: unknown): void {
  app.view.set({ settings: { ...app.view.get().settings, [key]: value } });
}

function controlOf(app: App, parameter: Parameter): Control {
  const { key, label, help } = parameter;
  const id = `set-${key}`;
  if (parameter.kind === 'number') {
    const { unit, min, max, step, ratio, whole } = parameter;
    const { element, set } = slider({
      id, label, unit, min, max, step, ratio, help, value: DEFAULTS[key] as number,
      change: (value) => change(app, key, whole ? Math.round(value) : value),
    });
    return { element, set: (value) => set(value as number) };
  }
  if (parameter.kind === 'choice') {
    const select = h('select', { id, onchange: () => change(app, key, select.value) },
      ...parameter.choices.map((choice) => h('option', { value: choice }, choice)));
    const element = h('div', { class: 'parameter', title: help }, h('label', { htmlFor: id }, label), select,
      h('p', { class: 'help' }, help));
    return { element, set: (value) => { select.value = String(value); } };
  }
  const box = h('input', { type: 'checkbox', id, onchange: () => change(app, key, box.checked) });
  const element = h('div', { class: 'parameter', title: help },
    h('label', { class: 'check', htmlFor: id, style: 'grid-column: 1 / -1' }, box, label), h('p', { class: 'help' }, help));
  return { element, set: (value) => { box.checked = Boolean(value); } };
}

export function settingsPanel(app: App): HTMLElement {
  const controls = new Map<keyof BakeSettings, Control>();
  const groups = new Map<string, HTMLElement[]>();
  for (const parameter of PARAMETERS) {
    const control = controlOf(app, parameter);
    controls.set(parameter.key, control);
    groups.set(parameter.group, [...(groups.get(parameter.group) ?? []), control.element]);
  }
  const reset = h('button', { class: 'quiet', onclick: () => app.view.set({ settings: { ...DEFAULTS } }) }, 'Reset all');
  const panel = h('div', {},
    h('section', { class: 'heading' }, h('h2', {}, 'Bake settings'), reset),
    ...[...groups].map(([name, elements], i) =>
      h('details', { class: 'group', open: i < 5 }, h('summary', {}, name), ...elements)));
  app.view.watch(({ settings }) => {
    let changed = false;
    for (const [key, control] of controls) {
      control.set(settings[key]);
      const differs = settings[key] !== DEFAULTS[key];
      control.element.classList.toggle('changed', differs);
      changed ||= differs;
    }
    reset.hidden = !changed;
  });
  app.session.watch(({ message }) => {
    for (const [key, control] of controls) control.element.classList.toggle('refused', message?.field === key);
  });
  return panel;
}
