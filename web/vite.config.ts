// One page in one file: scripts, styles, worker and both WebAssembly modules are put into the HTML, so that it opens
// from disk. `talus view` fills a level into it.

import { defineConfig, type Plugin } from 'vite';
import { fileURLToPath } from 'node:url';

const at = (path: string): string => fileURLToPath(new URL(path, import.meta.url));

function oneFile(): Plugin {
  return {
    name: 'one-file',
    enforce: 'post',
    apply: 'build',
    generateBundle(_, bundle) {
      const page = Object.values(bundle).find((file) => file.type === 'asset' && file.fileName.endsWith('.html'));
      if (page?.type !== 'asset') throw new Error('no page was built');
      let html = String(page.source);
      const put = (mark: RegExp, text: string): void => {
        if (!mark.test(html)) throw new Error(`the page has no ${mark}`);
        html = html.replace(mark, () => text);
      };
      for (const [name, file] of Object.entries(bundle)) {
        if (file.type === 'chunk') {
          // A module script runs after the page is parsed, wherever it stands.
          const code = file.code.replace(/<\/(script)/gi, '<\\/$1').replace(/<!--/g, '<\\!--');
          put(new RegExp(`<script[^>]*src="[^"]*${file.fileName}"[^>]*></script>`), `<script type="module">${code}</script>`);
          delete bundle[name];
        } else if (file.fileName.endsWith('.css')) {
          put(new RegExp(`<link[^>]*href="[^"]*${file.fileName}"[^>]*>`), `<style>${String(file.source)}</style>`);
          delete bundle[name];
        } else if (file !== page) {
          throw new Error(`${file.fileName} would not be in the page`);
        }
      }
      page.source = html;
      page.fileName = 'viewer.html';
    },
  };
}

/** The page hands the module to its workers: the package's own addresses of it would put it into each of them again. */
function noOwnModule(): Plugin {
  return {
    name: 'no-own-module',
    enforce: 'pre',
    transform(code, id) {
      if (!id.includes('/js/src/')) return undefined;
      return code.replace(/new URL\('\.\.\/dist\/[^']+', import\.meta\.url\)/g, 'undefined').replace(/import\.meta\.url/g, 'undefined');
    },
  };
}

export default defineConfig({
  base: './',
  resolve: { alias: { talus: at('src/engine/talus.js'), '#wasm': at('../js/dist') } },
  server: { fs: { allow: [at('..')] } },
  worker: { format: 'iife', plugins: () => [noOwnModule()], rollupOptions: { output: { inlineDynamicImports: true } } },
  plugins: [noOwnModule(), oneFile()],
  build: {
    target: 'es2022',
    outDir: at('../build/viewer'),
    emptyOutDir: false,
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    cssCodeSplit: false,
    modulePreload: false,
    reportCompressedSize: false,
    chunkSizeWarningLimit: 4000,
    rollupOptions: { output: { inlineDynamicImports: true } },
  },
});
