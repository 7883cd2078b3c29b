// What leaves the page: a link, the baked file, a picture, and the command line that does the same.

import type { App } from '../app';
import { commandLines } from '../state/command_line';
import { viewToHash } from '../state/hash';
import { fill, h } from './dom';

export function download(name: string, data: Blob): void {
  const link = h('a', { href: URL.createObjectURL(data), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

function baseName(app: App): string {
  return (app.session.get().level?.name ?? 'level').replace(/\.[^.]*$/, '');
}

export async function exportPack(app: App): Promise<void> {
  try {
    const bytes = await app.engine.call('save');
    download(`${baseName(app)}.talus`, new Blob([bytes as Uint8Array<ArrayBuffer>]));
  } catch (error) {
    app.say((error as Error).message, 'error');
  }
}

export function exportPicture(app: App): void {
  // The canvas holds its picture only until the browser shows it: drawn and read in one go.
  app.stage.draw();
  app.stage.canvas.toBlob((blob) => {
    if (blob) download(`${baseName(app)}.png`, blob);
    else app.say('The browser could not make a picture.', 'error');
  });
}

export function shareButtons(app: App): HTMLElement[] {
  const dialog = h('dialog', { 'aria-labelledby': 'command-title' });
  const showCommand = (): void => {
    const text = commandLines(app.view.get(), app.session.get().level?.name ?? 'level.obj');
    const close = h('button', { onclick: () => dialog.close() }, 'Close');
    fill(dialog, h('h2', { id: 'command-title' }, 'The same bake on the command line'), h('pre', { id: 'command' }, text),
      h('div', { class: 'row' }, h('button', { class: 'apply', onclick: () => void copy(app, text) }, 'Copy'), close));
    dialog.showModal();
  };
  const copyLink = (): void => {
    const hash = viewToHash({ ...app.view.get(), camera: app.stage.getCamera() });
    history.replaceState(null, '', hash);
    void copy(app, location.href);
  };
  document.body.append(dialog);
  return [
    h('button', { id: 'copy-link', title: 'A link that reproduces this view', onclick: copyLink }, 'Copy link'),
    h('button', { id: 'export-talus', title: 'The baked file, as talus bake writes it', onclick: () => void exportPack(app) }, 'Save .talus'),
    h('button', { id: 'export-png', title: 'Save the picture (P)', onclick: () => exportPicture(app) }, 'Save PNG'),
    h('button', { id: 'show-command', title: 'The command line that does the same', onclick: showCommand }, 'Command'),
  ];
}

async function copy(app: App, text: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    app.say('Copied.');
  } catch {
    app.say(`The browser does not let this page copy. Here it is: ${text}`);
  }
}
