// Serves the built page, and the module with threads that it fetches, to this machine's browsers.

import { createServer } from 'node:http';
import { readFileSync } from 'node:fs';

const FILES = {
  '/': ['text/html; charset=utf-8', new URL('../build/viewer/viewer.html', import.meta.url)],
  '/talus-threads.wasm': ['application/wasm', new URL('../js/dist/talus-threads.wasm', import.meta.url)],
};
const port = Number(process.env.PORT ?? 5173);
const server = createServer((request, response) => {
  const file = FILES[new URL(request.url, 'http://localhost').pathname];
  if (!file) {
    response.writeHead(404).end();
    return;
  }
  // The last two isolate the page, which threads and exact clocks need.
  response.writeHead(200, {
    'content-type': file[0], 'cache-control': 'no-store',
    'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp',
  });
  response.end(readFileSync(file[1]));
});
server.on('error', (error) => {
  console.error(`viewer: ${error.message}; another port: make viewer PORT=8080`);
  process.exit(1);
});
server.listen(port, '127.0.0.1', () => console.log(`viewer: http://localhost:${server.address().port}/ (Ctrl-C ends it)`));
