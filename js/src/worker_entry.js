// SPDX-License-Identifier: MIT
//
// What runs in a TalusWorker: one task a message, its arguments and results plain data.

import { decompose } from './decompose.js';
import { Hull } from './hull.js';
import { Mesh } from './mesh.js';
import { Navmesh } from './navmesh.js';
import './nav_query.js';
import './nav_change.js';
import { linksBytes } from './nav_tools.js';
import { Soup } from './soup.js';
import { bakeStages, polygonSteps } from './stages.js';
import { init, threads } from './module.js';

const meshOf = ({ vertices, indices, materials }) => new Mesh(vertices, indices, materials);

function navmeshOf({ tiles, options, links }) {
  const navmesh = Navmesh.fromTiles(tiles, options);
  links.forEach((link) => navmesh.addOffMeshLink(link));
  return navmesh;
}

const tasks = {
  weld({ mesh }, options) {
    const { mesh: welded, sourceTriangles, report } = meshOf(mesh).weld(options);
    return { vertices: welded.vertices, indices: welded.indices, materials: welded.materials, sourceTriangles, report };
  },
  soup: ({ mesh }, options) => using(Soup.bake(meshOf(mesh), options), (soup) => soup.toBytes()),
  hull: ({ points }, options) => using(Hull.bake(points, options), (hull) => ({ bytes: hull.toBytes(), report: hull.report })),
  decompose({ mesh }, options) {
    const { parts, ...rest } = decompose(meshOf(mesh), options);
    return { parts: parts.map(({ hull, ...part }) => ({ ...part, bytes: using(hull, () => hull.toBytes()) })), ...rest };
  },
  navmesh: ({ mesh }, options) => using(Navmesh.bake(meshOf(mesh), options), (navmesh) => ({
    tiles: navmesh.tiles().map((_, i) => navmesh.tileBytes(i)), options: navmesh.options, report: navmesh.report,
  })),
  stages: ({ mesh }, options) => bakeStages(meshOf(mesh), options),
  steps: ({ mesh }, options) => polygonSteps(meshOf(mesh), options),
  links: ({ navmesh, soup }, options) => using(navmeshOf(navmesh), (nav) => using(Soup.fromBytes(soup), (s) => {
    const { links, report } = nav.findLinks(s, options);
    return { links, report, bytes: linksBytes(links) };
  })),
  audit: ({ navmesh, soup }, options) => using(navmeshOf(navmesh), (nav) => using(Soup.fromBytes(soup), (s) => (
    { audit: nav.audit(s, options), refs: nav.polygons().refs }
  ))),
  why: ({ navmesh, mesh, point }, options) => using(navmeshOf(navmesh), (nav) => nav.why(meshOf(mesh), point, options)),
};

function using(object, run) {
  try {
    return run(object);
  } finally {
    object.free();
  }
}

/** The buffers of all typed arrays in a value: handed over, not copied. */
function buffersIn(value, found = new Set()) {
  if (ArrayBuffer.isView(value)) found.add(value.buffer);
  else if (value !== null && typeof value === 'object') Object.values(value).forEach((part) => buffersIn(part, found));
  return found;
}

let started = null;

async function answer(message, post) {
  if (message.init) {
    started = init(message.init).then(() => post({ threads: threads() }));
    started.catch(() => {}); // told by the first task
    return;
  }
  try {
    await started;
    const options = { ...message.options };
    if (options.watched) options.onProgress = (...progress) => post({ progress });
    const value = tasks[message.task](message.args, options);
    post({ value }, [...buffersIn(value)]);
  } catch (error) {
    const { message: text, result, stage, field, element, elementIndex, advice } = error;
    post({ error: { message: text, result, stage, field, element, elementIndex, advice } });
  }
}

if (typeof self !== 'undefined' && typeof self.postMessage === 'function' && typeof self.document === 'undefined') {
  self.onmessage = (event) => answer(event.data, (message, transfer) => self.postMessage(message, transfer ?? []));
} else {
  const threads = 'node:worker_threads';
  const { parentPort } = await import(/* @vite-ignore */ threads);
  parentPort.on('message', (message) => answer(message, (reply, transfer) => parentPort.postMessage(reply, transfer)));
}
