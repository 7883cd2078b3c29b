// What the tests share: a browser, a small web server, levels, and questions about what the page shows.

import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

export const PAGE = fileURLToPath(new URL('../../build/viewer/viewer.html', import.meta.url));
export const SHOTS = fileURLToPath(new URL('../../build/viewer/shots/', import.meta.url));

const PLACES = [process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
export const CHROMIUM = PLACES.find((path) => path && existsSync(path));

/** SwiftShader draws by software: the same picture on every machine, and none needs a graphics card. */
const SOFTWARE = ['--no-sandbox', '--use-angle=swiftshader', '--use-gl=angle', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];

export async function openBrowser(args = SOFTWARE) {
  return chromium.launch({ executablePath: CHROMIUM, headless: true, args });
}

/** With these a page is cross-origin isolated: it may have threads. */
export const ISOLATED = { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' };

/** Serves the page, and nothing else. */
export async function serve() {
  const page = readFileSync(PAGE);
  const server = createServer((_, response) => {
    response.writeHead(200, { 'content-type': 'text/html; charset=utf-8' });
    response.end(page);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

export class Viewer {
  /** Opens the page and waits until it has drawn what `hash` asks for. */
  static async open(browser, url, hash = '', options = {}) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, acceptDownloads: true, ...options });
    const page = await context.newPage();
    const viewer = new Viewer(page, context);
    page.on('pageerror', (error) => viewer.errors.push(String(error)));
    page.on('console', (message) => {
      if (message.type() === 'error') viewer.errors.push(message.text());
    });
    await page.goto(url + hash);
    return viewer;
  }

  constructor(page, context) {
    this.page = page;
    this.context = context;
    this.errors = [];
  }

  /** Waits for a condition on the page's own state; `test` gets app and tools. */
  async until(test, argument, timeout = 60_000) {
    await this.page.waitForFunction(
      ([code, argument]) => {
        const viewer = window.talusViewer;
        return viewer ? new Function('viewer', 'argument', `return (${code})(viewer, argument)`)(viewer, argument) : false;
      },
      [test.toString(), argument], { timeout, polling: 50 });
  }

  /** Asks the page's own state. */
  ask(question, argument) {
    return this.page.evaluate(
      ([code, argument]) => new Function('viewer', 'argument', `return (${code})(viewer, argument)`)(window.talusViewer, argument),
      [question.toString(), argument]);
  }

  /** The level is open, baked, and its layers are drawn. */
  async ready() {
    await this.until(({ app }) => {
      const session = app.session.get();
      return session.level && session.bake && !session.baking && !app.layers.busy &&
        app.view.get().layers.every((name) => app.layers.shown.has(name));
    });
  }

  async settled() {
    await this.page.waitForTimeout(200);
    await this.ready();
  }

  /** Draws and reads the picture: counts of colours by `near`, red, green and blue each within 24. */
  pixels(near = []) {
    return this.ask(({ app }, near) => {
      app.stage.draw();
      const source = app.stage.canvas;
      const copy = document.createElement('canvas');
      copy.width = 320;
      copy.height = Math.round((320 * source.height) / source.width);
      const paint = copy.getContext('2d', { willReadFrequently: true });
      paint.drawImage(source, 0, 0, copy.width, copy.height);
      const { data } = paint.getImageData(0, 0, copy.width, copy.height);
      const counts = near.map(() => 0);
      const seen = new Set();
      let sum = 0;
      for (let i = 0; i < data.length; i += 4) {
        seen.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
        sum += data[i] + data[i + 1] + data[i + 2];
        near.forEach((colour, k) => {
          const d = Math.max(Math.abs(data[i] - (colour >> 16)), Math.abs(data[i + 1] - ((colour >> 8) & 255)), Math.abs(data[i + 2] - (colour & 255)));
          if (d <= 24) counts[k]++;
        });
      }
      return { counts, colours: seen.size, mean: sum / (data.length / 4) / 3, total: data.length / 4 };
    }, near);
  }

  /** A checksum of the picture: another one means that something else is seen. */
  picture() {
    return this.ask(({ app }) => {
      app.stage.draw();
      const copy = document.createElement('canvas');
      copy.width = 320;
      copy.height = 200;
      const paint = copy.getContext('2d', { willReadFrequently: true });
      paint.drawImage(app.stage.canvas, 0, 0, 320, 200);
      let hash = 0;
      for (const byte of paint.getImageData(0, 0, 320, 200).data) hash = (Math.imul(hash, 31) + byte) | 0;
      return hash;
    });
  }

  /** Where a point of the level stands on the screen. */
  screen(point) {
    return this.ask(({ app }, point) => app.stage.screenOf(point), point);
  }

  async click(point, options) {
    const { x, y } = await this.screen(point);
    await this.page.mouse.click(x, y, options);
  }

  /** Drags from a point of the level to another one. */
  async drag(from, to) {
    const a = await this.screen(from);
    const b = await this.screen(to);
    await this.page.mouse.move(a.x, a.y);
    await this.page.mouse.down();
    for (let i = 1; i <= 8; i++) await this.page.mouse.move(a.x + ((b.x - a.x) * i) / 8, a.y + ((b.y - a.y) * i) / 8);
    await this.page.waitForTimeout(100);
    await this.page.mouse.up();
  }

  /** A finger that stays where it is. */
  async pressLong(at) {
    const touch = await this.context.newCDPSession(this.page);
    await touch.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [at] });
    await this.page.waitForTimeout(700);
    await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    await touch.detach();
  }

  /** A finger that moves over the screen. */
  async swipe(from, to) {
    const touch = await this.context.newCDPSession(this.page);
    const send = (type, points) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points });
    await send('touchStart', [from]);
    for (let i = 1; i <= 8; i++) {
      await send('touchMove', [{ x: from.x + ((to.x - from.x) * i) / 8, y: from.y + ((to.y - from.y) * i) / 8 }]);
      await this.page.waitForTimeout(20);
    }
    await this.page.waitForTimeout(100);
    await send('touchEnd', []);
    await touch.detach();
  }

  async shot(name) {
    mkdirSync(SHOTS, { recursive: true });
    await this.page.screenshot({ path: `${SHOTS}${name}.png` });
  }

  /** Drops a file of these words, or of these bytes. */
  async drop(name, content) {
    await this.page.evaluate(([name, content]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([typeof content === 'string' ? content : new Uint8Array(content)], name));
      dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
    }, [name, typeof content === 'string' ? content : [...content]]);
  }

  /** Nothing went wrong on the page that nobody expected. */
  async close() {
    await this.context.close();
    assert.deepEqual(this.errors, []);
  }
}

/** A floor of size x size metres around the origin; with a wall along x = 0 that leaves no gap. */
export function floorObj(size, wall = false) {
  const h = size / 2;
  const floor = `v ${-h} 0 ${-h}\nv ${-h} 0 ${h}\nv ${h} 0 ${h}\nv ${h} 0 ${-h}\nf 1 2 3 4\n`;
  return wall ? `${floor}v -0.1 4 ${-h}\nv -0.1 4 ${h}\nv -0.1 0 ${h}\nv -0.1 0 ${-h}\nf 5 6 7 8\nv 0.1 4 ${-h}\nv 0.1 4 ${h}\nv 0.1 0 ${h}\nv 0.1 0 ${-h}\nf 12 11 10 9\nf 5 9 10 6\n` : floor;
}

export const fileUrl = (path) => pathToFileURL(path).href;
