// SPDX-License-Identifier: MIT
//
// What runs in a thread of the pool (threads.js): an instance of the module, which is entered and not left. It imports
// nothing, so that it may be put wherever a page finds it.

/** Functions that tasks never call: JavaScript's listeners, and the growth of the memory, which the first thread sees itself. */
function silentImports(module, memory) {
  const imports = { env: { memory } };
  for (const { module: from, name, kind } of WebAssembly.Module.imports(module)) {
    if (kind === 'function') (imports[from] ??= {})[name] = () => 0;
  }
  return imports;
}

function run({ module, memory, worker, stack }, post) {
  let exports;
  try {
    ({ exports } = new WebAssembly.Instance(module, silentImports(module, memory)));
    exports.js_thread_stack(stack);
  } catch (error) {
    post(String(error));
    return;
  }
  post('ready');
  try {
    exports.js_thread_run(worker);
  } catch (error) {
    exports.js_thread_lost(); // whoever waits for it fails with it
    throw error;
  }
}

if (typeof self !== 'undefined' && typeof self.postMessage === 'function') {
  self.onmessage = (event) => run(event.data, (text) => self.postMessage(text));
} else {
  const threads = 'node:worker_threads'; // not awaited at the top: bundlers make plain scripts of workers
  import(/* @vite-ignore */ threads).then(({ parentPort }) => {
    parentPort.once('message', (message) => run(message, (text) => parentPort.postMessage(text)));
  });
}
