// Serves the built page to this machine's browsers.

import { createServer } from 'node:http';
import { readFileSync } from 'node:fs';

const page = new URL('../build/viewer/viewer.html', import.meta.url);
const port = Number(process.env.PORT ?? 5173);
const server = createServer((request, response) => {
  if (new URL(request.url, 'http://localhost').pathname !== '/') {
    response.writeHead(404).end();
    return;
  }
  // Threads and exact clocks need these; nothing else is fetched by the page.
  response.writeHead(200, {
    'content-type': 'text/html; charset=utf-8', 'cache-control': 'no-store',
    'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp',
  });
  response.end(readFileSync(page));
});
server.on('error', (error) => {
  console.error(`viewer: ${error.message}; another port: make viewer PORT=8080`);
  process.exit(1);
});
server.listen(port, '127.0.0.1', () => console.log(`viewer: http://localhost:${port}/ (Ctrl-C ends it)`));
