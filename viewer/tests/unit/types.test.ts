import { execFileSync } from 'node:child_process';
import { expect, test } from 'vitest';

test('the types of page, module and tests fit together', () => {
  expect(() => execFileSync('npx', ['tsc', '--noEmit'], { encoding: 'utf8' })).not.toThrow();
}, 120_000);
