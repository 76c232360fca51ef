import { describe, expect, it, vi } from 'vitest';
vi.mock('../../src/engine', () => ({ checked: (value: unknown) => value }));
import { aligned, commonTimes, differencesOf, lonely, plotsOf, whyNoDifference, type Line, type ShownRun } from '../../src/plot_lines';
import type { Group } from '../../src/quantities';
import type { Theme } from '../../src/theme';
import { handMade } from './hand_made';

const theme = { 'slip-left': '#b64e00', stick: '#00755c', 'slip-right': '#8a3792', open: '#77818b' } as Theme;
const shown = (run: ReturnType<typeof handMade>, label: string): ShownRun => ({
  run,
  label,
  colour: label === 'A' ? '#1f5fa8' : '#8f5b12',
  isOther: label === 'B',
});
const series = {
  normal_impulse: Float64Array.of(NaN, 1),
  friction_impulse: Float64Array.of(NaN, 1),
  gap: Float64Array.of(NaN, 1),
};
const record = { gap: Float64Array.of(1, 2), z: new Float64Array(8) };
const drop = shown(handMade([0, 0.1], { record }), 'A');
const scene = shown(handMade([0, 0.1], { series }), 'B');

describe('plotsOf', () => {
  it('has one plot for each unit of a group', () => {
    const plots = plotsOf([drop, scene], 1, new Set<Group>(['Contact', 'Velocities']), theme);
    expect(plots.map((plot) => plot.id)).toEqual(['Velocities/m/s', 'Contact/N', 'Contact/m/s', 'Contact/N s']);
    expect(plots[0]?.lines.map((line) => line.key)).toEqual(['A.vx', 'B.vx', 'A.vy', 'B.vy']);
  });
  it('dashes the other run and gives it its colour', () => {
    const [plot] = plotsOf([drop, scene], 1, new Set<Group>(['Height']), theme);
    expect(plot?.lines.map((line) => [line.colour, line.isDashed])).toEqual([
      ['#1f5fa8', false],
      ['#8f5b12', true],
    ]);
  });
});

describe('differencesOf', () => {
  it('takes B from A, for what both have', () => {
    const moved = shown(handMade([0, 0.1], { series, trajectory: { kinetic: Float64Array.of(1, 1) } }), 'B');
    const [energy] = differencesOf(drop, moved, 1, new Set<Group>(['Energy']), theme);
    expect(energy?.lines.map((line) => line.key)).toEqual(['A - B.mechanical', 'A - B.kinetic', 'A - B.potential']);
    expect([...(energy?.lines[1]?.values ?? [])]).toEqual([-0.75, 0.25]);
  });
  it('is refused with a reason', () => {
    expect(whyNoDifference(drop.run, scene.run)).toBe('');
    expect(whyNoDifference(drop.run, handMade([0]))).toContain('2 samples, the other 1');
    expect(whyNoDifference(drop.run, handMade([0, 0.1], { trajectory: { step_size: 0.05 } }))).toContain('0.1 s and 0.05 s');
    expect(whyNoDifference(drop.run, handMade([0, 0.2]))).toContain('same times');
  });
});

describe('common times', () => {
  const line = (run: ReturnType<typeof handMade>, ...values: number[]): Line => ({
    key: '',
    label: '',
    run,
    values: Float64Array.from(values),
    colour: '',
    isDashed: false,
  });
  it('are the times themselves where the runs agree', () => {
    const times = commonTimes([drop.run, scene.run]);
    expect(times.time).toBe(drop.run.trajectory.time);
    expect(aligned(line(scene.run, NaN, 7), times)).toEqual([null, 7]);
  });
  it('are merged in order where they do not', () => {
    const [a, b] = [handMade([0, 0.2, 0.4]), handMade([0, 0.1, 0.2, 0.5])];
    const times = commonTimes([a, b, a]);
    expect([...times.time]).toEqual([0, 0.1, 0.2, 0.4, 0.5]);
    expect(aligned(line(a, 1, NaN, 3), times)).toEqual([1, undefined, null, 3, undefined]);
    expect(aligned(line(b, 1, 2, 3, 4), times)).toEqual([1, 2, 3, undefined, 4]);
  });
});

describe('lonely', () => {
  it('finds numbers between gaps', () => {
    expect(lonely([null, 1, null, 2, 3, null, 4])).toEqual([1, 6]);
    expect(lonely([1, undefined, null, undefined, 2, undefined])).toEqual([0, 4]);
    expect(lonely([1, undefined, 2, null])).toEqual([]);
    expect(lonely([])).toEqual([]);
  });
});
