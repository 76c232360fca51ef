import { readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { expect, test } from 'vitest';
import { pageFile } from './browser';

test('the page is one file of at most 300 kB compressed, which names nothing to load', () => {
  const page = readFileSync(pageFile);
  expect(gzipSync(page, { level: 9 }).length).toBeLessThanOrEqual(300_000);
  const text = page.toString('utf8');
  expect(text.split('<!--tumble-run-->').length).toBe(2);
  expect(text).not.toMatch(/<(script|link|img)[^>]+(src|href)="(?!data:)/);
});
