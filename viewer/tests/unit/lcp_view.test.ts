import type { LemkePage, StepProblem } from 'tumble-engine';
import { describe, expect, it } from 'vitest';
import { nonzeroOfPairs, pairWords } from '../../src/lcp_table';
import { endWords, pageTitle, pageWords, pivotWords } from '../../src/lemke_view';
import { pieces, plain } from '../../src/markup';

function problem(z: number[], w: number[], units: string[]): StepProblem {
  const n = z.length;
  const V = Float64Array.from({ length: n * n }, (_, k) => (k % (n + 1) === 0 ? 2 : 0));
  const p = Float64Array.from(z, (z_i, i) => (w[i] as number) - 2 * z_i);
  return { V, p, z: Float64Array.from(z), w: Float64Array.from(w), z_units: units } as StepProblem;
}

describe('which of a pair is not 0', () => {
  it('is z where w is round-off, and the other way round', () => {
    const pairs = nonzeroOfPairs(problem([225, 0, 44, 1e-14], [3e-15, 0.5, -9e-16, 23], ['N', 'N', 'N', 'm/s']));
    expect(pairs.slice(0, 3)).toEqual(['z', 'w', 'z']);
  });
  it('measures z by its unit', () => {
    const pairs = nonzeroOfPairs(problem([1e9, 1e-3], [0, 0], ['N', 'm/s']));
    expect(pairs).toEqual(['z', 'z']);
  });
  it('may be none', () => {
    expect(nonzeroOfPairs(problem([0, 1], [0, 0], ['N', 'N']))).toEqual(['none', 'z']);
  });
  it('has its words', () => {
    expect(pairWords('z', 0)).toBe('z1 > 0, so w1 = 0');
    expect(pairWords('w', 2)).toBe('w3 > 0, so z3 = 0');
    expect(pairWords('none', 1)).toBe('z2 = 0 and w2 = 0');
  });
});

function page(over: Partial<LemkePage>): LemkePage {
  return { entered: null, left: null, entering: null, leaving: null, basis: [], columns: [], entries: new Float64Array(), ratios: [], ...over };
}
const start = page({ entering: 'z0', leaving: 'w1', basis: ['w1', 'w2'], ratios: [null, null] });
const second = page({ entered: 'z0', left: 'w1', entering: 'z1', leaving: 'w2', basis: ['z0', 'w2'], ratios: [3, 0.12] });
const last = page({ entered: 'z1', left: 'z0', basis: ['z1', 'w2'], ratios: [null, null] });

describe("Lemke's pivots", () => {
  const solved = { pages: [start, second, last], end: 'solved' as const };
  it('say what enters, what leaves and why', () => {
    expect(pivotWords(solved, 0)).toBe('z0 enters, w1 leaves: its value is the most negative.');
    expect(pivotWords(solved, 1)).toBe('z1 enters, the complement of w1, which left; w2 leaves: the smallest ratio, 0.12.');
    expect(pageWords(solved, 2)).toMatch(/^z0 has left/);
  });
  it('are counted', () => {
    expect([0, 1, 2].map((k) => pageTitle(solved, k))).toEqual(['Pivot 1 of 2', 'Pivot 2 of 2', 'After all 2 pivots']);
    expect(pageTitle({ pages: [start], end: 'no_pivot' }, 0)).toBe('No pivot');
  });
  it('end in words', () => {
    const ray = { pages: [start, page({ entered: 'z0', left: 'w1', entering: 'z1' })], end: 'ray' as const };
    expect(endWords(ray)).toBe('z1 enters, the complement of w1. No row limits it: a ray, and no solution found.');
    expect(endWords({ pages: [start], end: 'no_pivot' })).toContain('no pivot is needed');
    expect(endWords({ pages: [start], end: 'stopped' })).toContain('Stopped');
  });
});

describe('letters of formulas', () => {
  it('have subscripts, primes and Greek', () => {
    expect(pieces("u_n' + eps u_n")).toEqual([
      { text: 'u', level: 'base' },
      { text: 'n', level: 'sub' },
      { text: '′ + ε u', level: 'base' },
      { text: 'n', level: 'sub' },
    ]);
    expect(plain('mu f_n - f_t1 - f_t2')).toBe('μ fn − ft1 − ft2');
    expect(plain('lambda')).toBe('λ');
  });
  it('count contacts in circles', () => {
    expect(plain('P_t- 2')).toBe('Pt− ②');
    expect(plain('slip - u_t 1')).toBe('slip − ut ①');
    expect(plain('mu P_n - |P_t| 4')).toBe('μ Pn − |Pt| ④');
  });
  it('leave other text alone', () => {
    expect(plain('turns counter-clockwise in step 3.')).toBe('turns counter-clockwise in step 3.');
  });
});
