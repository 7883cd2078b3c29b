// What a person sees when the page cannot work at all.

import { NoWebGl } from '../scene/stage';
import { h } from '../panels/dom';
import { NoWasm } from './wasm';

export function showFailure(host: HTMLElement, error: unknown): void {
  const text = error instanceof Error ? error.message : String(error);
  const help = error instanceof NoWebGl
    ? ['The viewer draws by WebGL 2. ', 'Turn on hardware acceleration in the browser\'s settings, update the graphics driver, ' +
        'or try another browser: Firefox, Chrome, Edge and Safari 15 have it.']
    : error instanceof NoWasm
      ? ['The level is baked by WebAssembly. ', 'Try a current Firefox, Chrome, Edge or Safari. A page from disk may be kept ' +
          'from it by a policy: serve it by a web server then.']
      : ['', 'Please report it with the browser\'s console.'];
  host.replaceChildren(h('div', { class: 'fatal', role: 'alert', id: 'fatal' }, h('div', {},
    h('h2', {}, 'The viewer cannot start'), h('p', {}, text), h('p', { class: 'muted' }, help.join('')),
    h('p', { class: 'muted' }, 'Pictures of every stage without a browser: ', h('code', {}, 'talus draw LEVEL -o PICTURE.png --overview')))));
}
