import { describe, expect, it, vi } from 'vitest';
vi.mock('../../src/engine', () => ({ checked: (value: unknown) => value }));
import { quantities, quantity } from '../../src/quantities';
import { handMade } from './hand_made';

const times = [0, 0.1, 0.2];
const available = (run: ReturnType<typeof handMade>, body: number): string[] =>
  quantities.filter((q) => q.values(run, body)).map((q) => q.key);
const of = (key: string, run: ReturnType<typeof handMade>): number[] => [...(quantity(key).values(run, 1) ?? [])];

describe('quantities', () => {
  const series = {
    normal_impulse: Float64Array.of(NaN, 1, 2),
    friction_impulse: Float64Array.of(NaN, 0.5, 0.25),
    gap: Float64Array.of(NaN, 0, -1e-6),
  };
  const live = handMade(times, { series });
  const record = { gap: Float64Array.of(3, 2, 1), z: Float64Array.of(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12) };
  const drop = handMade(times, { record });

  it('have keys of their own', () => {
    expect(new Set(quantities.map((q) => q.key)).size).toBe(quantities.length);
    expect(() => quantity('colour')).toThrow('colour: no such quantity');
  });
  it('take each component of the body that is asked for', () => {
    for (const [i, key] of ['x', 'y', 'angle', 'vx', 'vy', 'omega'].entries()) {
      expect(of(key, live)).toEqual([i, 100 + i, 200 + i]);
    }
    expect([...(quantity('y').values(live, 0) ?? [])]).toEqual([0, 0, 0]);
    expect(quantity('y').values(live, 2)).toBeNull();
  });
  it('are the very arrays of the engine where it has them', () => {
    expect(quantity('time').values(live, 1)).toBe(live.trajectory.time);
    expect(quantity('mechanical').values(live, 1)).toBe(live.trajectory.mechanical);
    expect(quantity('total_friction_loss').values(live, 1)).toBe(live.trajectory.total_friction_loss);
    expect(quantity('normal_impulse').values(live, 1)).toBe(series.normal_impulse);
    expect(quantity('gap').values(live, 1)).toBe(series.gap);
    expect(quantity('gap').values(drop, 1)).toBe(record.gap);
  });
  it('of the drop: forces are rows of z, losses are unknown', () => {
    expect(of('f_n', drop)).toEqual([1, 2, 3]);
    expect(of('f_t1', drop)).toEqual([4, 5, 6]);
    expect(of('f_t2', drop)).toEqual([7, 8, 9]);
    expect(of('lambda', drop)).toEqual([10, 11, 12]);
    expect(quantity('total_impact_loss').values(drop, 1)).toBeNull();
    expect(quantity('normal_impulse').values(drop, 1)).toBeNull();
    expect(quantity('f_n').values(drop, 0)).toBeNull();
  });
  it('of a scene: impulses instead of forces', () => {
    expect(available(live, 1)).toContain('friction_impulse');
    expect(available(live, 1)).not.toContain('f_n');
  });
});
