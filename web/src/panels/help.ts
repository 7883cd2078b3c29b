// The keys.

import { h } from './dom';

const KEYS: readonly [string, string][] = [
  ['1 … 9, 0', 'choose a tool'],
  ['W A S D, arrows', 'fly over the level; Shift goes faster'],
  ['Q E', 'down and up'],
  ['F', 'show all of the level'],
  [', .', 'the stage of the bake before, and the next one'],
  ['H', 'hide or show the panels'],
  ['O', 'open a file'],
  ['P', 'save the picture'],
  ['T', 'light, dark, or as the system has it'],
  ['Escape', 'cancel the bake that is under way'],
  ['?', 'this help'],
];

export function helpDialog(): { button: HTMLElement; show(): void } {
  const dialog = h('dialog', { 'aria-labelledby': 'help-title' },
    h('h2', { id: 'help-title' }, 'Keys and gestures'),
    h('div', { class: 'keys' }, ...KEYS.flatMap(([keys, what]) => [h('kbd', {}, keys), h('span', {}, what)])),
    h('p', {}, 'Drag orbits, right-drag or two fingers pan, wheel or pinch zooms. Drop an OBJ, glTF, GLB, STL, PLY or ' +
      '.talus file anywhere. Nothing leaves this page: the level is read and baked in the browser.'),
    h('form', { method: 'dialog' }, h('button', {}, 'Close')));
  document.body.append(dialog);
  const show = (): void => dialog.showModal();
  return { button: h('button', { class: 'quiet', 'aria-label': 'Help', title: 'Help (?)', onclick: show }, '?'), show };
}
