import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { compress } from 'lzma1';
import { viteSingleFile } from 'vite-plugin-singlefile';
import { defineConfig, type Plugin } from 'vitest/config';

const engine = resolve(process.env.TUMBLE_ENGINE ?? '../build-wasm/bindings/wasm');

// The bytes of the engine by LZMA: a fifth smaller than what browsers inflate by themselves.
function engineBytes(): Plugin {
  const name = 'virtual:engine-bytes';
  return {
    name,
    resolveId: (id) => (id === name ? `\0${name}` : null),
    load: (id) => {
      if (id !== `\0${name}`) return null;
      const bytes = compress(readFileSync(resolve(engine, 'tumble_engine.wasm')), 9);
      return `export default ${JSON.stringify(Buffer.from(bytes).toString('base64'))};`;
    },
  };
}

// Without blanks between tags, and without comments but the place where a run goes.
function shortPage(): Plugin {
  const shorten = (html: string): string => html.replace(/<!--(?!tumble-run).*?-->/gs, '').replace(/>\s+</g, '><');
  return { name: 'short-page', transformIndexHtml: { order: 'pre', handler: shorten } };
}

export default defineConfig({
  base: './',
  plugins: [engineBytes(), shortPage(), viteSingleFile({ removeViteModuleLoader: true })],
  resolve: {
    alias: {
      'tumble-engine': resolve(engine, 'tumble_engine.mjs'),
      // Its front door brings the encoder along.
      'lzma1-decoder': resolve('node_modules/lzma1/lib/decoder.js'),
      'lzma1-streams': resolve('node_modules/lzma1/lib/streams.js'),
    },
  },
  server: { fs: { allow: ['..'] } },
  build: { target: 'es2022', modulePreload: false, assetsInlineLimit: 100_000_000, chunkSizeWarningLimit: 2000 },
  test: { include: ['tests/**/*.test.ts'], fileParallelism: false, retry: 1, testTimeout: 60_000, hookTimeout: 120_000 },
});
