// Levels that are dropped or chosen: every format, what is wrong with one, and a large one. Each test leaves a picture in
// build/viewer/shots.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { floorObj, openBrowser, serve, Viewer } from './harness.mjs';

let browser;
let server;

before(async () => {
  browser = await openBrowser();
  server = await serve();
});
after(async () => {
  await browser?.close();
  server?.close();
});

/** Coarse cells: what a test looks at is seldom the bake. */
const open = () => Viewer.open(browser, server.url, '#level=sample:courtyard&cellSize=0.4');

test('opens a dropped file, and names what is wrong with one', async () => {
  const viewer = await open();
  await viewer.ready();
  await viewer.drop('floor.obj', floorObj(12));
  await viewer.until(({ app }) => app.session.get().level.name === 'floor.obj' && !app.session.get().baking);
  await viewer.settled();
  assert.equal(await viewer.ask(({ app }) => app.session.get().level.triangles), 2);
  const area = await viewer.ask(({ app }) => app.session.get().bake.area);
  assert.ok(area > 90 && area < 144, `${area} m2 of 144 are left by the radius`);
  await viewer.shot('drop');
  const faults = [
    ['v 0 0 0\nv 1 0 0\nv 0 0 zero\n', /broken\.obj: line 3: .*zero.*not three finite numbers/],
    ['v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 4\n', /broken\.obj: line 4: vertex 4 is not there/],
    ['v 0 0 0\n', /broken\.obj: holds no faces/],
    ['', /broken\.obj: is empty/],
  ];
  for (const [text, words] of faults) {
    await viewer.drop('broken.obj', text);
    await viewer.page.waitForFunction((source) => new RegExp(source).test(document.querySelector('#message').innerText), words.source);
    assert.equal(await viewer.ask(({ app }) => app.session.get().level.name), 'floor.obj', 'the level before stays');
  }
  await viewer.drop('level.blend', 'x');
  await viewer.page.waitForFunction(() => /\.obj .*\.glb/.test(document.querySelector('#message').innerText));
  await viewer.drop('level.talus', 'no such file');
  await viewer.page.waitForFunction(() => /^level\.talus: .*not a talus file/.test(document.querySelector('#message').innerText));
  await viewer.shot('broken-file');
  await viewer.close();
});

/** A glTF of one buffer as its binary form: a header, then a chunk of JSON and one of bytes, each of whole words. */
function toGlb(gltf, buffer) {
  const scene = JSON.parse(gltf);
  delete scene.buffers[0].uri;
  const text = JSON.stringify(scene), json = Buffer.from(text.padEnd(4 * Math.ceil(text.length / 4)));
  const words = (...list) => Buffer.from(new Uint32Array(list).buffer);
  return Buffer.concat([words(0x46546c67, 2, 28 + json.length + buffer.length), words(json.length, 0x4e4f534a), json,
    words(buffer.length, 0x004e4942), buffer]);
}

test('reads STL, PLY, glTF and GLB as it reads OBJ', async () => {
  const viewer = await open();
  await viewer.ready();
  const stl = 'solid s\nfacet normal 0 1 0\nouter loop\nvertex -6 0 -6\nvertex -6 0 6\nvertex 6 0 6\nendloop\nendfacet\n' +
    'facet normal 0 1 0\nouter loop\nvertex -6 0 -6\nvertex 6 0 6\nvertex 6 0 -6\nendloop\nendfacet\nendsolid s\n';
  const ply = 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n' +
    'property list uchar int vertex_indices\nend_header\n-6 0 -6\n-6 0 6\n6 0 6\n6 0 -6\n4 0 1 2 3\n';
  const buffer = Buffer.alloc(4 * 12 + 6 * 2);
  [-6, 0, -6, -6, 0, 6, 6, 0, 6, 6, 0, -6].forEach((v, i) => buffer.writeFloatLE(v, 4 * i));
  [0, 1, 2, 0, 2, 3].forEach((v, i) => buffer.writeUInt16LE(v, 48 + 2 * i));
  const gltf = JSON.stringify({
    asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    buffers: [{ byteLength: 60, uri: `data:application/octet-stream;base64,${buffer.toString('base64')}` }],
    bufferViews: [{ buffer: 0, byteLength: 48 }, { buffer: 0, byteOffset: 48, byteLength: 12 }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 4, type: 'VEC3', min: [-6, 0, -6], max: [6, 0, 6] },
      { bufferView: 1, componentType: 5123, count: 6, type: 'SCALAR' }],
  });
  for (const [name, content] of [['a.stl', stl], ['b.ply', ply], ['c.gltf', gltf], ['d.obj', floorObj(12)], ['e.glb', toGlb(gltf, buffer)]]) {
    await viewer.drop(name, content);
    await viewer.until(({ app }, name) => app.session.get().level.name === name && !app.session.get().baking, name);
    const { level, bake } = await viewer.ask(({ app }) => app.session.get());
    assert.equal(level.triangles, 2, name);
    assert.ok(bake.area > 90 && bake.area < 144, `${name}: ${bake.area} m2`);
  }
  // A floor that stands upright is one once z is up.
  await viewer.page.setInputFiles('#file', { name: 'up.obj', mimeType: 'text/plain', buffer: Buffer.from('v -6 -6 0\nv 6 -6 0\nv 6 6 0\nv -6 6 0\nf 1 2 3 4\n') });
  await viewer.until(({ app }) => app.session.get().level.name === 'up.obj' && !app.session.get().baking);
  assert.equal(await viewer.ask(({ app }) => app.session.get().bake?.polygons ?? 0), 0);
  await viewer.page.selectOption('#up', 'z');
  await viewer.until(({ app }) => app.session.get().bake?.polygons > 0);
  await viewer.close();
});

/** Waves of 2 x side x side triangles, 20 cm each. */
function wavesGlb(side) {
  const row = side + 1, vertices = row * row;
  const points = new Float32Array(3 * vertices), corners = new Uint32Array(6 * side * side);
  for (let i = 0; i < vertices; i++) {
    const x = 0.2 * (i % row), z = 0.2 * Math.floor(i / row);
    points.set([x, Math.sin(0.4 * x) * Math.cos(0.3 * z), z], 3 * i);
  }
  for (let q = 0; q < side * side; q++) {
    const a = Math.floor(q / side) * row + (q % side), b = a + row;
    corners.set([a, b, b + 1, a, b + 1, a + 1], 6 * q);
  }
  const gltf = JSON.stringify({
    asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    buffers: [{ byteLength: points.byteLength + corners.byteLength }],
    bufferViews: [{ buffer: 0, byteLength: points.byteLength }, { buffer: 0, byteOffset: points.byteLength, byteLength: corners.byteLength }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: vertices, type: 'VEC3', min: [0, -1, 0], max: [0.2 * side, 1, 0.2 * side] },
      { bufferView: 1, componentType: 5125, count: corners.length, type: 'SCALAR' }],
  });
  return toGlb(gltf, Buffer.concat([Buffer.from(points.buffer), Buffer.from(corners.buffer)]));
}

test('a million triangles are drawn once a frame, in few calls, and only when something moves', async () => {
  const viewer = await open();
  await viewer.ready();
  await viewer.page.setInputFiles('#file', { name: 'waves.glb', mimeType: 'model/gltf-binary', buffer: wavesGlb(708) });
  await viewer.until(({ app }) => app.session.get().level.name === 'waves.glb' && !app.session.get().baking, undefined, 120_000);
  await viewer.settled();
  const { level, bake } = await viewer.ask(({ app }) => app.session.get());
  assert.ok(level.triangles > 1e6 && bake.polygons > 10 && bake.area > 15_000, `${level.triangles} triangles, ${bake.area} m2 walkable`);
  // A question is answered from the tree: on the page's own thread nothing looks at a million triangles.
  const hit = await viewer.ask(({ app }) => app.engine.call('pick', [70, 50, 70], [0, -1, 0]));
  assert.ok(Math.abs(hit.point[1] - Math.sin(28) * Math.cos(21)) < 0.05, `${hit.point}`);
  // What a frame costs is what it draws: counts, since frames of a graphics card by software take seconds.
  const draws = await viewer.ask(({ app }) => {
    const { stage } = app, { info } = stage.renderer;
    const draws = [0, 1].map((i) => {
      stage.setCamera({ ...stage.getCamera(), eye: [200, 60 + i, 200] });
      stage.draw();
      return { calls: info.render.calls, triangles: info.render.triangles, buffers: { ...info.memory } };
    });
    return draws;
  });
  for (const { calls, triangles, buffers } of draws) {
    assert.ok(calls <= 12, `${calls} calls`);
    assert.ok(triangles >= level.triangles && triangles < 1.2 * level.triangles, `${triangles} triangles drawn`);
    assert.deepEqual(buffers, draws[0].buffers, 'turning makes no buffers');
  }
  await viewer.page.waitForFunction(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))).then(() => true));
  const frames = await viewer.ask(({ app }) => app.stage.frames);
  await viewer.page.waitForTimeout(1000);
  assert.equal(await viewer.ask(({ app }) => app.stage.frames), frames, 'a picture that stands still is not drawn');
  await viewer.shot('million');
  await viewer.close();
});
