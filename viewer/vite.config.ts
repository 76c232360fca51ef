import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { deflateSync } from 'node:zlib';
import { viteSingleFile } from 'vite-plugin-singlefile';
import { defineConfig, type Plugin } from 'vitest/config';

const engine = resolve(process.env.TUMBLE_ENGINE ?? '../build-wasm/bindings/wasm');

// The bytes of the engine, deflated: as text in the one file they would take a third more than they do in a file.
function engineBytes(): Plugin {
  const name = 'virtual:engine-bytes';
  return {
    name,
    resolveId: (id) => (id === name ? `\0${name}` : null),
    load: (id) => {
      if (id !== `\0${name}`) return null;
      const bytes = readFileSync(resolve(engine, 'tumble_engine.wasm'));
      return `export default ${JSON.stringify(deflateSync(bytes, { level: 9 }).toString('base64'))};`;
    },
  };
}

export default defineConfig({
  base: './',
  plugins: [engineBytes(), viteSingleFile({ removeViteModuleLoader: true })],
  resolve: { alias: { 'tumble-engine': resolve(engine, 'tumble_engine.mjs') } },
  server: { fs: { allow: ['..'] } },
  build: { target: 'es2022', modulePreload: false, assetsInlineLimit: 100_000_000, chunkSizeWarningLimit: 2000 },
  test: { include: ['tests/**/*.test.ts'], fileParallelism: false, testTimeout: 60_000, hookTimeout: 120_000 },
});
