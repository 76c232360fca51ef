import { describe, expect, it } from 'vitest';
import { axisUnit, bounces, drawImpulsePlane, fitted, planeRange, planeWords, ticks, type Range } from '../../src/impulse_plane';
import { SvgPen } from '../../src/pen';
import type { Theme } from '../../src/theme';

// A = I: without coupling. Restitution ends at P_n = 3, compression at 2, sticking is P_t = 0.5.
const plane = { A_nn: 1, A_nt: 0, A_tt: 1, u_n: -2, u_t: -0.5, u_n_target: 1, friction: 0.3, P_n: 3, P_t: 0.5 };

const holds = ({ t, n }: Range, P_t: number, P_n: number): boolean =>
  t[0] < P_t && P_t < t[1] && n[0] < P_n && P_n < n[1];

describe('the range of the impulse plane', () => {
  it('holds origin, solution and crossings', () => {
    const range = planeRange(plane);
    for (const [P_t, P_n] of [[0, 0], [0.5, 3], [0.5, 2], [0, 2], [0.9, 3], [-0.9, 3], [0.5, 0.5 / 0.3]] as const)
      expect(holds(range, P_t, P_n)).toBe(true);
  });
  it('leaves out crossings that are far', () => {
    const range = planeRange({ ...plane, A_nt: 0.999 });
    expect(Math.max(...range.t, ...range.n)).toBeLessThan(20);
  });
  it('is finite and not empty where there is nothing to see', () => {
    const range = planeRange({ ...plane, u_n: 0, u_t: 0, u_n_target: 0, P_n: 0, P_t: 0, friction: 0 });
    expect(range.t[1] - range.t[0]).toBeGreaterThan(0);
    expect([...range.t, ...range.n].every(Number.isFinite)).toBe(true);
  });
  it('scales with the impulses', () => {
    const k = 1e-6;
    const small = { ...plane, u_n: -2 * k, u_t: -0.5 * k, u_n_target: k, P_n: 3 * k, P_t: 0.5 * k };
    expect(planeRange(small).n[1]).toBeCloseTo(k * planeRange(plane).n[1], 15);
  });
  it('is fitted to the picture with equal scales', () => {
    const { t, n } = fitted(planeRange(plane), 300, 200);
    expect((t[1] - t[0]) / 300).toBeCloseTo((n[1] - n[0]) / 200, 12);
  });
});

describe('ticks', () => {
  it('are round and within the range', () => expect(ticks([-0.11, 0.35], 4)).toEqual([0, 0.2]));
  it('are none for an empty range', () => expect(ticks([1, 1], 4)).toEqual([]));
});

describe('the unit of the axes', () => {
  it('is N s, or a power of ten of it', () => {
    expect(axisUnit({ t: [-1, 1], n: [0, 0.03] })).toEqual({ size: 1, text: 'N s' });
    expect(axisUnit({ t: [-2e-5, 2e-5], n: [0, 9e-5] })).toEqual({ size: 1e-5, text: '10⁻⁵ N s' });
  });
});

describe('the plane in one sentence', () => {
  it('says where the solution lies', () => {
    expect(planeWords(plane)).toBe(
      'Impulse plane: the solution, P_t = 0.5 N s, P_n = 3 N s, lies inside the friction cone (mu = 0.3) and on the line of its target (restitution) and the line of sticking.',
    );
    expect(planeWords({ ...plane, P_t: 0.9 })).toContain('on the edge of the friction cone');
  });
  it('knows when both normal lines are one', () => {
    expect(bounces({ ...plane, u_n_target: 1e-17 })).toBe(false);
    expect(planeWords({ ...plane, u_n_target: 0, P_n: 2 })).toContain('on the line where compression ends and the line of sticking');
  });
});

describe('the picture', () => {
  const theme = new Proxy({}, { get: (_, name) => String(name) }) as Theme;
  const texts = (of: typeof plane): string[] => {
    const pen = new SvgPen(340, 260);
    drawImpulsePlane(pen, 340, 260, of, theme);
    return [...pen.toString().matchAll(/>([^<]+)<\/text>/g)].map((match) => match[1] as string);
  };
  it('names every line', () => {
    expect(texts(plane)).toEqual(
      expect.arrayContaining(['compression', 'restitution', 'sticking', 'friction cone', 'P', 'Pₜ [N s]', 'Pₙ [N s]']),
    );
  });
  it('does not speak of restitution where a gap closes', () => {
    expect(texts({ ...plane, u_n_target: -1, P_n: 1 })).toContain('gap closes');
  });
  it('says which line is far away', () => {
    expect(texts({ ...plane, u_t: -100 })).toContain('outside: sticking');
  });
  it('has one normal line where nothing bounces', () => {
    expect(texts({ ...plane, u_n_target: 0, P_n: 2 })).toContain('compression ends');
  });
});
