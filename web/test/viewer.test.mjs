// The viewer in a real browser, feature by feature. Each test leaves a picture in build/viewer/shots.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { floorObj, openBrowser, serve, Viewer } from './harness.mjs';
import { TALUS } from './native.mjs';

let browser;
let server;
let folder;

before(async () => {
  browser = await openBrowser();
  server = await serve();
  folder = mkdtempSync(join(tmpdir(), 'talus-viewer-'));
});
after(async () => {
  await browser?.close();
  server?.close();
  if (folder) rmSync(folder, { recursive: true });
});

const open = (hash, options) => Viewer.open(browser, server.url, hash, options);
/** Coarse cells and few layers: what a test looks at is seldom the bake. */
const COARSE = '&cellSize=0.4';

test('opens a sample, bakes it and draws it', async () => {
  const begin = Date.now();
  const viewer = await open('');
  await viewer.ready();
  const seconds = (Date.now() - begin) / 1000;
  const { counts, colours } = await viewer.pixels([0x7fb3d5]);
  assert.ok(counts[0] > 300, `walkable floor is seen: ${counts[0]} pixels`);
  assert.ok(colours > 50, 'the level is shaded');
  const stages = await viewer.ask(({ app }) => app.session.get().bake.stages);
  assert.ok(stages.length >= 8 && stages.every((one) => one.milliseconds >= 0));
  assert.equal(await viewer.page.locator('#times span').count(), stages.length);
  assert.match(await viewer.page.locator('#numbers').innerText(), /polygons in 1 tile/);
  await viewer.shot('open');
  assert.ok(seconds < 30, `took ${seconds} s`);
  await viewer.close();
});

const LAYERS = ['pairs', 'boxes', 'spans', 'floors', 'distance', 'regions', 'contours', 'merging', 'polygons', 'detail', 'tiles', 'links', 'hull'];

test('draws each layer, with a legend and a summary', async () => {
  const viewer = await open(`#level=sample:courtyard&layers=triangles${COARSE}`);
  await viewer.ready();
  const bare = await viewer.picture();
  for (const name of LAYERS) {
    if (name === 'links') {
      await viewer.page.click('#tool-link');
      await viewer.page.click('#find-links');
      await viewer.page.waitForSelector('#links-found');
      await viewer.page.click('#tool-look');
    }
    await viewer.ask(({ app }, name) => app.view.set({ layers: ['triangles', name] }), name);
    await viewer.until(({ app }, name) => app.layers.shown.has(name) && !app.layers.busy, name);
    const shown = await viewer.ask(({ app }, name) => {
      const { data, group } = app.layers.shown.get(name);
      let drawn = 0;
      group.traverse((object) => {
        if (object.geometry) drawn += object.geometry.instanceCount === undefined || object.geometry.instanceCount === Infinity
          ? object.geometry.attributes.position.count : object.geometry.instanceCount;
      });
      return { drawn, summary: data.summary, legends: data.legends.length };
    }, name);
    assert.ok(shown.drawn > 20, `${name}: ${shown.drawn} things drawn`);
    assert.match(shown.summary, /\d/, name);
    assert.ok(shown.legends >= 1, name);
    assert.notEqual(await viewer.picture(), bare, `${name} is seen`);
    await viewer.shot(`layer-${name}`);
  }
  await viewer.ask(({ app }) => app.view.set({ layers: [] }));
  const { colours } = await viewer.pixels();
  assert.ok(colours <= 256, `without layers nothing is drawn but the sky: ${colours} colours`);
  await viewer.close();
});

test('opens on a path, steps through the stages of a bake, and looks into buildings', async () => {
  const viewer = await open('');
  await viewer.ready();
  await viewer.page.waitForSelector('#path-status.good');
  assert.match(await viewer.page.locator('#path-proof').innerText(), /no path is shorter/);
  const seen = [];
  await viewer.ask(({ app }) => app.view.set({ layers: ['triangles'] }));
  for (let i = 0; i < 9; i++) {
    await viewer.page.keyboard.press('.');
    seen.push(await viewer.ask(({ app }) => app.view.get().layers.at(-1)));
  }
  assert.deepEqual(seen, ['spans', 'floors', 'distance', 'regions', 'contours', 'merging', 'polygons', 'detail', 'tiles']);
  await viewer.page.click('button[aria-label="The stage before"]');
  assert.deepEqual(await viewer.ask(({ app }) => app.view.get().layers), ['triangles', 'detail']);
  // Rooms are closed by ceilings that are seen from behind: a click goes through, to a floor.
  await viewer.page.selectOption('#level', 'sample:dungeon');
  await viewer.until(({ app }) => app.session.get().level?.name.startsWith('dungeon') && !app.session.get().baking);
  await viewer.settled();
  const pick = () => viewer.ask(({ app }) => app.engine.call('pick', [8, 100, 8], [0, -1, 0]));
  const floor = await pick();
  assert.ok(!floor.back && floor.normal[1] > 0.9, 'a floor, seen from its front');
  await viewer.shot('into-rooms');
  // Above the cut nothing is drawn, and nothing is picked.
  await viewer.page.selectOption('#level', 'sample:city');
  await viewer.until(({ app }) => app.session.get().level?.name.startsWith('city') && !app.session.get().baking);
  await viewer.settled();
  const whole = await viewer.picture();
  const roof = (await viewer.ask(({ app }) => app.session.get().level.max))[1];
  await viewer.page.locator('#cut').evaluate((range) => {
    range.value = '3';
    range.dispatchEvent(new Event('input', { bubbles: true }));
  });
  await viewer.page.waitForFunction(() => /cut=3(\.|&|$)|cut=2\.9/.test(location.hash));
  assert.notEqual(await viewer.picture(), whole);
  await viewer.page.click('#tool-look');
  for (const [x, y] of [[0.4, 0.4], [0.5, 0.5], [0.6, 0.4], [0.5, 0.6]]) {
    const box = await viewer.page.locator('canvas').boundingBox();
    await viewer.page.mouse.click(box.x + x * box.width, box.y + y * box.height);
    await viewer.page.waitForTimeout(150);
    const point = (await viewer.page.locator('#tool-panel dd').nth(1).innerText()).split(',').map(Number);
    assert.ok(point[1] < 3.1 && roof > 10, `picked ${point}`);
  }
  await viewer.shot('cut');
  await viewer.close();
});

test('times the stages of a bake in tiles', async () => {
  const viewer = await open(`#level=sample:courtyard&tileSize=32${COARSE}`);
  await viewer.ready();
  const bake = await viewer.ask(({ app }) => app.session.get().bake);
  assert.ok(bake.tiles > 4 && bake.measuredTiles >= 1 && bake.measuredTiles <= bake.tiles, `${bake.measuredTiles} of ${bake.tiles}`);
  const names = bake.stages.map(({ stage }) => stage);
  for (const name of ['rasterize', 'regions', 'contours', 'polygons', 'detail']) assert.ok(names.includes(name), `${name} is in ${names}`);
  assert.ok(!names.includes('tiles'));
  const sum = bake.stages.reduce((all, { milliseconds }) => all + milliseconds, 0);
  assert.ok(sum > 0 && sum <= 1.001 * bake.milliseconds, `${sum} of ${bake.milliseconds} ms`);
  assert.match(await viewer.page.locator('#times').getAttribute('aria-label'), /rasterize .*regions/);
  await viewer.shot('tiles-times');
  await viewer.close();
});

test('bakes again when a slider moves, and marks a refused setting', async () => {
  const viewer = await open('#level=sample:courtyard');
  await viewer.ready();
  const before = await viewer.ask(({ app }) => app.session.get().bake);
  const picture = await viewer.picture();
  await viewer.page.locator('#set-agentRadius').evaluate((range) => {
    range.value = '1.5';
    range.dispatchEvent(new Event('input', { bubbles: true }));
  });
  await viewer.until(({ app }, old) => app.session.get().bake.area < old && !app.session.get().baking, before.area);
  await viewer.settled();
  const after = await viewer.ask(({ app }) => app.session.get().bake);
  assert.ok(after.area < 0.9 * before.area, `${after.area} of ${before.area} m2`);
  assert.notEqual(await viewer.picture(), picture);
  await viewer.page.waitForFunction(() => location.hash.includes('agentRadius=1.5'));
  assert.equal(await viewer.page.locator('.parameter.changed').count(), 1);
  await viewer.shot('slider');
  // Every parameter has a control with a name, a unit where it has one, and an explanation.
  assert.equal(await viewer.page.locator('.left .parameter .help').count(), 20);
  // A setting that the library refuses is named, and what was baked before stays.
  await viewer.ask(({ app }) => app.view.set({ settings: { ...app.view.get().settings, agentRadius: 0.6, cellSize: 1e-7 } }));
  await viewer.page.waitForSelector('.parameter.refused, #message.error', { timeout: 20_000 });
  assert.ok(await viewer.ask(({ app }) => app.session.get().bake.polygons > 0));
  await viewer.shot('refused-setting');
  await viewer.close();
});

test('cancels a bake and keeps the one before', async () => {
  const viewer = await open('#level=sample:terrain&cellSize=1');
  await viewer.ready();
  const before = await viewer.ask(({ app }) => app.session.get().bake.polygons);
  await viewer.ask(({ app }) => app.view.set({ settings: { ...app.view.get().settings, cellSize: 0.04, cellHeight: 0.04 } }));
  await viewer.page.waitForSelector('#cancel', { state: 'visible' });
  await viewer.until(({ app }) => app.session.get().progress !== null);
  await viewer.shot('progress');
  await viewer.page.click('#cancel');
  await viewer.page.waitForSelector('#cancel', { state: 'hidden' });
  assert.equal(await viewer.ask(({ app }) => app.session.get().bake.polygons), before);
  const hit = await viewer.ask(({ app }) => app.engine.call('pick', [0, 500, 0], [0, -1, 0]));
  assert.notEqual(hit, undefined, 'the engine still answers');
  await viewer.close();
});

test('finds the exact path, drags its goal, and serves wider walkers', async () => {
  const viewer = await open('#level=sample:courtyard&tool=path');
  await viewer.ready();
  await viewer.ask(({ app }) => app.view.set({ start: [2, 0, 20], goal: [20, 5, 20] }));
  await viewer.page.waitForSelector('#path-status.good');
  const answer = () => viewer.ask(({ tools }) => tools.find((tool) => tool.name === 'path').answer);
  const first = await answer();
  assert.equal(first.status, 'complete');
  assert.ok(first.length > first.straight && first.length - first.lowerBound < 1e-6 * first.length, 'proven to be shortest');
  if (TALUS) {
    execFileSync(TALUS, ['sample', 'courtyard', '-o', 'courtyard.obj'], { cwd: folder });
    const native = JSON.parse(execFileSync(TALUS, ['path', 'courtyard.obj', '2,0,20', '20,5,20', '--json'], { cwd: folder, encoding: 'utf8' }));
    assert.ok(Math.abs(native.length - first.surfaceLength) < 1e-3, `${native.length} on the command line, ${first.surfaceLength} here`);
  }
  const { counts } = await viewer.pixels([0xc0392b]);
  assert.ok(counts[0] > 30, `the path is seen: ${counts[0]} pixels`);
  await viewer.shot('path');
  await viewer.drag([2, 0, 20], [12, 0, 34]);
  await viewer.until(({ app }) => app.view.get().start[2] > 25);
  await viewer.until(({ tools }, old) => { const now = tools.find((tool) => tool.name === 'path').answer; return now && now.length !== old; }, first.length);
  await viewer.ask(({ app }) => app.view.set({ start: [12, 0, 14], goal: [28, 0, 14], walkRadius: 1 }));
  await viewer.until(({ tools }) => tools.find((tool) => tool.name === 'path').answer?.clearance !== null && tools.find((tool) => tool.name === 'path').answer?.clearance !== undefined);
  const wide = await answer();
  assert.equal(wide.status, 'complete');
  assert.ok(wide.length > 16.01 && wide.clearance > 0.3, `${wide.length} m, where a narrow walker goes 16 m; ${wide.clearance} m kept`);
  await viewer.shot('path-wide');
  await viewer.close();
});

test('says at once that a goal is unreachable, and where the nearest reachable place is', async () => {
  const viewer = await open(`#level=sample:courtyard${COARSE}`);
  await viewer.ready();
  await viewer.drop('wall.obj', floorObj(20, true));
  await viewer.until(({ app }) => app.session.get().level.name === 'wall.obj' && !app.session.get().baking);
  await viewer.page.click('#tool-path');
  await viewer.settled();
  await viewer.click([-6, 0, 0]);
  await viewer.until(({ app }) => app.view.get().start !== null);
  await viewer.click([6, 0, 3]);
  await viewer.page.waitForSelector('#path-status.bad');
  const answer = await viewer.ask(({ tools }) => tools.find((tool) => tool.name === 'path').answer);
  assert.equal(answer.status, 'unreachable');
  assert.ok(answer.nearest[0] < 0 && answer.nearest[0] > -2, `nearest at x = ${answer.nearest[0]}: this side of the wall`);
  await viewer.shot('unreachable');
  // An off-mesh link over the wall makes it reachable.
  await viewer.page.click('#tool-link');
  await viewer.ask(({ app }) => app.view.set({ links: [{ start: [-2, 0, 0], end: [2, 0, 0], bothWays: true }] }));
  await viewer.until(({ tools }) => tools.find((tool) => tool.name === 'path').answer?.status === 'complete');
  await viewer.shot('offmesh-link');
  await viewer.close();
});

test('places links by two clicks, drags their ends, and finds more', async () => {
  const viewer = await open('#level=sample:courtyard&tool=link&camera=20,42,22;20,0,18');
  await viewer.ready();
  const placed = () => viewer.ask(({ app }) => app.view.get().links);
  const panel = viewer.page.locator('#tool-panel');
  await viewer.page.locator('#tool-panel input[type=checkbox]').uncheck();
  await viewer.click([15, 0, 14]);
  await panel.getByText('Now click where the link ends.').waitFor();
  assert.deepEqual(await placed(), [], 'one end is no link');
  await viewer.click([25, 0, 14]);
  await viewer.until(({ app }) => app.view.get().links.length === 1);
  const [link] = await placed();
  assert.ok(Math.abs(link.start[0] - 15) < 0.5 && Math.abs(link.end[0] - 25) < 0.5 && !link.bothWays, JSON.stringify(link));
  await panel.getByText('With floor at both ends').waitFor();
  assert.deepEqual(await panel.locator('dd').allInnerTexts(), ['1', '1']);
  await viewer.drag(link.end, [25, 0, 10]);
  await viewer.until(({ app }) => app.view.get().links[0].end[2] < 11);
  await viewer.page.waitForFunction(() => /links?=/.test(location.hash));
  await viewer.page.click('#find-links');
  await viewer.page.waitForSelector('#links-found');
  const found = await viewer.ask(({ tools }) => tools.find((tool) => tool.name === 'link').answer);
  assert.ok(found.count > 0 && found.tried >= found.count, `${found.count} of ${found.tried} tried`);
  await viewer.settled();
  await viewer.shot('links-placed');
  await panel.getByText('Remove placed').click();
  await viewer.until(({ app }) => app.view.get().links.length === 0);
  await viewer.close();
});

test('says why a point is not walkable, and its button makes it walkable', async () => {
  const viewer = await open('#level=sample:courtyard&tool=why&why=0.3,0,20');
  await viewer.ready();
  await viewer.page.waitForSelector('#why-text.bad');
  const words = await viewer.page.locator('#why-text').innerText();
  assert.ok(words.length > 20, words);
  await viewer.page.waitForSelector('.bubble', { state: 'visible' }); // it is put in its place by the next frame
  await viewer.shot('why');
  const buttons = viewer.page.locator('#tool-panel button.apply');
  await buttons.last().click();
  await viewer.until(({ app }) => !app.session.get().baking && app.session.get().bakeNumber > 1);
  await viewer.page.waitForSelector('#why-text.good', { timeout: 30_000 });
  await viewer.shot('why-applied');
  await viewer.close();
});

test('puts obstacles down, and bakes again only the tiles that they touch', async () => {
  const viewer = await open('#level=sample:courtyard&tool=obstacle&start=15,0,14&goal=25,0,14&camera=20,42,22;20,0,18');
  await viewer.ready();
  // Without tiles it says what is missing, with a button.
  await viewer.page.click('#tool-panel button.apply');
  await viewer.until(({ app }) => app.session.get().bake?.tiles > 1 && !app.session.get().baking);
  await viewer.settled();
  await viewer.until(({ tools }) => tools.find((tool) => tool.name === 'path').answer?.status === 'complete');
  const before = await viewer.ask(({ tools }) => tools.find((tool) => tool.name === 'path').answer.length);
  await viewer.ask(({ app }) => app.view.set({ obstacles: [{ id: 1, shape: 'box', base: [20, 0.2, 14], radius: 1.5, height: 2 }] }));
  await viewer.until(({ tools }) => tools.find((tool) => tool.name === 'obstacle').last?.tiles > 0);
  const { last, all } = await viewer.ask(({ app, tools }) => ({
    last: tools.find((tool) => tool.name === 'obstacle').last, all: app.session.get().bake.tilesX * app.session.get().bake.tilesZ,
  }));
  assert.ok(last.tiles >= 1 && last.tiles < all, `${last.tiles} of ${all} tiles`);
  await viewer.until(({ tools }, old) => tools.find((tool) => tool.name === 'path').answer?.length > old + 0.01, before);
  await viewer.settled();
  await viewer.shot('obstacle');
  await viewer.drag([20, 0.2, 14], [20, 0.2, 10]);
  await viewer.until(({ app }) => app.view.get().obstacles[0].base[2] < 12);
  await viewer.until(({ tools }, old) => Math.abs((tools.find((tool) => tool.name === 'path').answer?.length ?? 0) - old) < 0.01, before);
  await viewer.close();
});

test('walks a ray through the tree of boxes', async () => {
  const viewer = await open(`#level=sample:courtyard&tool=ray&ray=20,30,20;0.2,-1,0.1${COARSE}`);
  await viewer.ready();
  await viewer.page.waitForSelector('#ray-text.good');
  const walk = await viewer.ask(({ tools }) => tools.find((tool) => tool.name === 'ray').answer);
  const entered = walk.steps.filter((step) => step.hit);
  assert.ok(entered.length >= 3 && entered.some((step) => step.leaf), `${entered.length} boxes`);
  assert.equal(walk.steps[0].depth, 0, 'begins at the root');
  for (const step of entered) assert.ok(step.enter <= walk.hit.t + 1e-3, 'no box behind the hit is entered');
  await viewer.shot('ray');
  await viewer.page.locator('#ray-step').fill('0');
  const few = await viewer.picture();
  await viewer.page.locator('#ray-step').fill(String(walk.steps.length - 1));
  assert.notEqual(await viewer.picture(), few, 'steps draw other boxes');
  await viewer.close();
});

test('shows what a guard sees', async () => {
  const viewer = await open(`#level=sample:courtyard&tool=sight&guard=12,0,12${COARSE}`);
  await viewer.ready();
  await viewer.until(({ tools }) => tools.find((tool) => tool.name === 'sight').answer);
  const sight = await viewer.ask(({ tools }) => tools.find((tool) => tool.name === 'sight').answer);
  assert.ok(sight.rim.length >= 360 && sight.area > 10, `${sight.area} m2`);
  await viewer.shot('sight');
  await viewer.ask(({ app }) => app.view.set({ eyeHeight: 9 }));
  await viewer.until(({ tools }, old) => (tools.find((tool) => tool.name === 'sight').answer?.area ?? 0) > old, sight.area);
  await viewer.close();
});

test('climbs a hull vertex by vertex', async () => {
  const viewer = await open(`#level=sample:terrain&tool=climb&cellSize=1`);
  await viewer.ready();
  await viewer.page.waitForSelector('#climb-text.good');
  const climb = await viewer.ask(({ tools }) => tools.find((tool) => tool.name === 'climb').answer);
  assert.ok(climb.path.length >= 2);
  for (let i = 1; i < climb.heights.length; i++) assert.ok(climb.heights[i] > climb.heights[i - 1], 'always up');
  await viewer.settled();
  await viewer.shot('climb');
  const top = await viewer.picture(), said = viewer.page.locator('#tool-panel .step-text');
  assert.match(await said.innerText(), /none of them farther: done/);
  await viewer.page.click('#tool-panel button[aria-label="One step back"]');
  assert.match(await said.innerText(), /the farthest of them is next/);
  assert.notEqual(await viewer.picture(), top, 'each step is drawn');
  // Another direction, another top.
  await viewer.page.locator('#climb-turn').evaluate((range) => {
    range.value = String((Number(range.value) + 170) % 360);
    range.dispatchEvent(new Event('input', { bubbles: true }));
  });
  await viewer.until(({ tools }, old) => String(tools.find((tool) => tool.name === 'climb').answer.answer) !== old, String(climb.answer));
  await viewer.close();
});

test('tells merging step by step', async () => {
  const viewer = await open(`#level=sample:courtyard&tool=steps&layers=triangles${COARSE}`);
  await viewer.ready();
  await viewer.until(({ tools }) => tools.find((tool) => tool.name === 'steps').answer?.steps.length > 0);
  const steps = await viewer.ask(({ tools }) => tools.find((tool) => tool.name === 'steps').answer);
  assert.equal(steps.cuts, steps.steps.filter((step) => step.kind === 'cut').length);
  assert.ok(steps.cuts >= 2 && steps.merges >= 1, `${steps.cuts} cuts, ${steps.merges} merges`);
  const first = await viewer.picture();
  await viewer.page.locator('#merge-step').fill(String(steps.cuts - 1));
  const cut = await viewer.picture();
  await viewer.shot('steps-cut');
  await viewer.page.locator('#merge-step').fill(String(steps.steps.length - 1));
  await viewer.shot('steps-merged');
  assert.notEqual(cut, first);
  assert.notEqual(await viewer.picture(), cut);
  // It plays by itself, from the beginning when it stands at the end, and stops where it is told to.
  const step = viewer.page.locator('#merge-step');
  const play = viewer.page.locator('#tool-panel button[aria-label="Play"]');
  await play.click();
  const pause = viewer.page.locator('#tool-panel button[aria-label="Pause"]');
  await viewer.page.waitForFunction(() => { const at = Number(document.getElementById('merge-step').value); return at > 0 && at < 5; });
  await pause.click();
  const stopped = await step.inputValue();
  await viewer.page.waitForTimeout(700);
  assert.equal(await step.inputValue(), stopped, 'a story that is stopped stands still');
  await viewer.page.click('#tool-panel button[aria-label="One step on"]');
  assert.equal(Number(await step.inputValue()), Number(stopped) + 1);
  await viewer.close();
});

test('audits, and steps through what it finds', async () => {
  const viewer = await open(`#level=sample:courtyard&tool=audit${COARSE}`);
  await viewer.ready();
  await viewer.page.click('#run-audit');
  await viewer.page.waitForSelector('#audit-text');
  const audit = await viewer.ask(({ tools }) => tools.find((tool) => tool.name === 'audit').answer);
  assert.ok(audit.paths >= 1000 && audit.steps > 1000);
  assert.equal(await viewer.page.locator('#audit-text.good').count(), audit.findings.length === 0 ? 1 : 0);
  await viewer.shot('audit');
  // Obstacles take navmesh away where the triangles have floor: the audit must say so.
  await viewer.ask(({ app }) => app.view.set({ settings: { ...app.view.get().settings, tileSize: 48 } }));
  await viewer.until(({ app }) => app.session.get().bake?.tiles > 1 && !app.session.get().baking);
  await viewer.ask(({ app }) => app.view.set({ obstacles: [{ id: 1, shape: 'cylinder', base: [25, 0, 27], radius: 4, height: 2 }] }));
  await viewer.until(({ tools }) => tools.find((tool) => tool.name === 'obstacle').last?.tiles > 0);
  await viewer.page.click('#run-audit');
  await viewer.page.waitForSelector('#audit-text.bad');
  const found = await viewer.ask(({ tools }) => tools.find((tool) => tool.name === 'audit').answer.findings);
  assert.ok(found.some((one) => one.kind === 'missing' && Math.hypot(one.point[0] - 25, one.point[2] - 27) < 5));
  await viewer.shot('audit-findings');
  // One by one: the words and the mark are the next finding's, and the eye goes there.
  if (found.length > 1) {
    const words = () => viewer.page.locator('#tool-panel .step-text').innerText();
    const [before, camera] = [await viewer.picture(), await viewer.ask(({ app }) => app.stage.getCamera())];
    assert.match(await words(), /missing|blocked|step|no floor/);
    await viewer.page.click('#tool-panel button[aria-label="One step on"]');
    assert.equal(await viewer.page.locator('#audit-step').inputValue(), '1');
    const target = await viewer.ask(({ app }) => app.stage.getCamera().target);
    assert.notDeepEqual(target, camera.target);
    assert.ok(Math.hypot(...target.map((v, i) => v - found[1].point[i])) < 1e-3, 'the eye looks at the second finding');
    assert.notEqual(await viewer.picture(), before);
    await viewer.shot('audit-second');
  }
  await viewer.close();
});

test('exports the baked file, a picture, and the command line', async () => {
  const viewer = await open('#level=sample:courtyard&agentRadius=0.4&tileSize=48&tool=path&start=2,0,20&goal=20,5,20');
  await viewer.ready();
  const download = async (button) => {
    const [file] = await Promise.all([viewer.page.waitForEvent('download'), viewer.page.click(button)]);
    const path = join(folder, file.suggestedFilename());
    await file.saveAs(path);
    return path;
  };
  const pack = await download('#export-talus');
  assert.match(pack, /courtyard\.talus$/);
  const bytes = readFileSync(pack);
  assert.equal(bytes.subarray(0, 5).toString('latin1'), 'TALUS');
  const picture = readFileSync(await download('#export-png'));
  assert.equal(picture.subarray(1, 4).toString('latin1'), 'PNG');
  assert.ok(picture.length > 5000, 'the picture is not empty');
  await viewer.page.click('#show-command');
  const command = await viewer.page.locator('#command').innerText();
  assert.match(command, /talus bake courtyard\.obj -o courtyard\.talus --agent-radius 0\.4 --tile-size 48/);
  assert.match(command, /talus path courtyard\.talus 2,0,20 20,5,20/);
  await viewer.shot('command');
  if (TALUS) {
    // The lines run as they stand, and bake the same bytes.
    const run = join(folder, 'run');
    execFileSync('mkdir', ['-p', run]);
    for (const line of command.split('\n')) execFileSync(TALUS, line.split(' ').slice(1), { cwd: run });
    assert.ok(readFileSync(join(run, 'courtyard.talus')).equals(bytes), 'the same file as by the command line');
  }
  // The file comes back as it was.
  await viewer.page.keyboard.press('Escape');
  await viewer.page.setInputFiles('#file', pack);
  await viewer.until(({ app }) => app.session.get().level.name === 'courtyard.talus' && !app.session.get().baking);
  await viewer.settled();
  assert.equal(await viewer.ask(({ app }) => app.view.get().settings.tileSize), 48);
  assert.match(await viewer.page.locator('#total').innerText(), /as baked/);
  await viewer.close();
});

test('a link reproduces the view', async () => {
  const hash = '#level=sample:dungeon&agentRadius=0.4&cellSize=0.25&partition=monotone&filterLedgeSpans=false&layers=triangles,regions' +
    '&tool=sight&camera=30,25,40;12,0,12&guard=8,0,8&eyeHeight=1.2&theme=dark';
  const first = await open(hash);
  await first.ready();
  await first.until(({ tools }) => tools.find((tool) => tool.name === 'sight').answer);
  await first.page.waitForTimeout(500);
  await first.page.click('#copy-link');
  const link = await first.page.evaluate(() => location.hash);
  for (const part of hash.slice(1).split('&')) assert.ok(link.includes(part), `${part} is in ${link}`);
  const picture = await first.picture();
  await first.shot('link');
  const second = await open(link);
  await second.ready();
  await second.until(({ tools }) => tools.find((tool) => tool.name === 'sight').answer);
  await second.page.waitForTimeout(300);
  assert.equal(await second.picture(), picture);
  assert.deepEqual(await second.ask(({ app }) => app.view.get().settings), await first.ask(({ app }) => app.view.get().settings));
  await first.close();
  await second.close();
  const third = await open('#level=sample:courtyard&cellSize=wide&flavour=mint&layers=triangles,soup');
  await third.ready();
  const message = await third.page.locator('#message').innerText();
  for (const word of ['cellSize', 'flavour', 'soup']) assert.ok(message.includes(word), `${word} is named in: ${message}`);
  await third.close();
});

test('is dark where the system is, and light at a key', async () => {
  const viewer = await open(`#level=sample:courtyard${COARSE}`, { colorScheme: 'dark' });
  await viewer.ready();
  const luminance = () => viewer.page.evaluate(() => {
    const [r, g, b] = getComputedStyle(document.querySelector('header')).backgroundColor.match(/\d+/g).map(Number);
    return (r + g + b) / 3;
  });
  assert.ok(await luminance() < 80);
  const dark = await viewer.pixels();
  await viewer.shot('dark');
  await viewer.page.keyboard.press('t');
  await viewer.page.waitForFunction(() => document.documentElement.dataset.theme === 'light');
  assert.ok(await luminance() > 200);
  assert.ok((await viewer.pixels()).mean > dark.mean + 30, 'the picture\'s ground changes too');
  await viewer.close();
});

test('works by keyboard and by touch', async () => {
  const viewer = await open(`#level=sample:courtyard${COARSE}`);
  await viewer.ready();
  await viewer.page.keyboard.press('2');
  assert.equal(await viewer.ask(({ app }) => app.view.get().tool), 'path');
  const before = await viewer.ask(({ app }) => app.stage.getCamera().eye);
  await viewer.page.keyboard.down('w');
  await viewer.until(({ app }, from) => Math.hypot(...app.stage.getCamera().eye.map((v, i) => v - from[i])) > 0.5, before);
  await viewer.page.keyboard.up('w');
  await viewer.page.waitForTimeout(150);
  const after = await viewer.ask(({ app }) => app.stage.getCamera().eye);
  await viewer.page.waitForTimeout(150);
  assert.deepEqual(await viewer.ask(({ app }) => app.stage.getCamera().eye), after, 'a key that is let go moves nothing');
  await viewer.page.keyboard.press('f');
  const unnamed = await viewer.page.evaluate(() => [...document.querySelectorAll('button, input, select')]
    .filter((one) => one.type !== 'file' && !one.textContent.trim() && !one.getAttribute('aria-label') && !(one.labels?.length > 0))
    .map((one) => one.outerHTML));
  assert.deepEqual(unnamed, [], 'every control has a name');
  await viewer.close();
  const phone = await open(`#level=sample:courtyard&tool=path${COARSE}`, { viewport: { width: 400, height: 760 }, hasTouch: true, isMobile: true });
  await phone.ready();
  const at = await phone.screen([20, 0, 30]);
  await phone.page.touchscreen.tap(at.x, at.y);
  await phone.until(({ app }) => app.view.get().start !== null);
  assert.match(await phone.page.locator('.hint').innerText(), /Click the start.*A long press moves the start/);
  await phone.pressLong(await phone.screen([20, 0, 24]));
  await phone.until(({ app }) => Math.abs(app.view.get().start[2] - 24) < 1);
  assert.equal(await phone.ask(({ app }) => app.view.get().goal), null);
  await phone.shot('phone');
  // A finger on a mark drags it, a finger beside it turns the level.
  const eye = () => phone.ask(({ app }) => app.stage.getCamera().eye);
  const [start, still] = [await phone.ask(({ app }) => app.view.get().start), await eye()];
  await phone.swipe(await phone.screen(start), { x: at.x - 40, y: at.y });
  await phone.until(({ app }, old) => Math.hypot(...app.view.get().start.map((v, i) => v - old[i])) > 0.5, start);
  assert.deepEqual(await eye(), still, 'a mark that is dragged turns nothing');
  await phone.swipe({ x: 200, y: 250 }, { x: 120, y: 250 });
  await phone.until(({ app }, old) => Math.hypot(...app.stage.getCamera().eye.map((v, i) => v - old[i])) > 0.5, still);
  await phone.page.click('button.drawer >> nth=0');
  assert.equal(await phone.page.locator('#set-cellSize').isVisible(), true);
  await phone.shot('phone-drawer');
  await phone.close();
});
