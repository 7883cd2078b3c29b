// Runs the browser tests. Without a browser or the page it says so and ends with 77, which a caller may take for
// "skipped"; a run in which no test ran fails.

import { existsSync } from 'node:fs';
import { run } from 'node:test';
import { spec } from 'node:test/reporters';
import { fileURLToPath } from 'node:url';
import { CHROMIUM, PAGE } from './harness.mjs';

if (!CHROMIUM) {
  console.error('viewer tests: SKIPPED, no Chromium is installed (apt-get install chromium, or name one in CHROMIUM)');
  process.exit(77);
}
if (!existsSync(PAGE)) {
  console.error('viewer tests: the page is not built; make viewer-page does it');
  process.exit(1);
}
const files = ['viewer.test.mjs', 'levels.test.mjs', 'page.test.mjs', 'bundle.test.mjs'].map((name) => fileURLToPath(new URL(name, import.meta.url)));
const begin = Date.now();
let passed = 0;
let failed = 0;
const stream = run({ files, concurrency: 2, timeout: 900_000, testNamePatterns: process.argv[2] ? [process.argv[2]] : undefined });
stream.on('test:pass', (event) => { if (event.skip === undefined && event.details?.type !== 'suite') passed++; });
stream.on('test:fail', () => { failed++; });
stream.on('end', () => {
  console.log(`viewer tests: ${passed} passed, ${failed} failed, ${Math.round((Date.now() - begin) / 1000)} s`);
  if (failed > 0 || passed === 0) process.exitCode = 1;
});
stream.compose(spec).pipe(process.stdout);
