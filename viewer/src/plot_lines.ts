// Which lines are in which chart.
import { groups, quantities, type Group, type Quantity } from './quantities';
import type { Run } from './run';
import type { Theme } from './theme';

export interface ShownRun {
  run: Run;
  label: string;
  colour: string;
  isOther: boolean;
}
export interface Line {
  key: string; // `${label of the run}.${key of the quantity}`
  label: string;
  run: Run;
  values: Float64Array;
  colour: string;
  isDashed: boolean;
}
// Lines of one group in one unit.
export interface Plot {
  id: string;
  title: string;
  unit: string;
  lines: Line[];
}

const digitsOf = (hex: string): number[] | null =>
  /^#[0-9a-f]{6}$/i.test(hex) ? [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16)) : null;

// Two parts of a colour and one of another.
function mixed(a: string, b: string): string {
  const [from, to] = [digitsOf(a), digitsOf(b)];
  if (!from || !to) return a;
  const digits = from.map((digit, i) => Math.round((2 * digit + (to[i] as number)) / 3));
  return `#${digits.map((digit) => digit.toString(16).padStart(2, '0')).join('')}`;
}

// The first line of a chart has the colour of its run, the others colours of their own; those of the other run lean to its.
function lineColour(shown: ShownRun, index: number, theme: Theme): string {
  const others = [theme.stick, theme['slip-right'], theme.open, theme['slip-left']];
  if (index === 0) return shown.colour;
  const own = others[(index - 1) % others.length] as string;
  return shown.isOther ? mixed(own, shown.colour) : own;
}

export function availableGroups(runs: ShownRun[], body: number): Group[] {
  return groups.filter((group) => quantities.some((q) => q.group === group && runs.some(({ run }) => q.values(run, body))));
}

const unitsOf = (group: Group): string[] => [...new Set(quantities.filter((q) => q.group === group).map((q) => q.unit))];

function plotsBy(chosen: ReadonlySet<Group>, linesOf: (quantity: Quantity, index: number) => Line[], title: string): Plot[] {
  const plots = groups
    .filter((group) => chosen.has(group))
    .flatMap((group) =>
      unitsOf(group).map((unit) => ({
        id: `${group}/${unit}`,
        title: group + title,
        unit,
        lines: quantities.filter((q) => q.group === group && q.unit === unit).flatMap(linesOf),
      })),
    );
  return plots.filter((plot) => plot.lines.length > 0);
}

export function plotsOf(runs: ShownRun[], body: number, chosen: ReadonlySet<Group>, theme: Theme): Plot[] {
  return plotsBy(
    chosen,
    (quantity, index) =>
      runs.flatMap((shown) => {
        const values = quantity.values(shown.run, body);
        if (!values) return [];
        const label = runs.length > 1 ? `${shown.label}: ${quantity.label}` : quantity.label;
        const colour = lineColour(shown, index, theme);
        return [{ key: `${shown.label}.${quantity.key}`, label, run: shown.run, values, colour, isDashed: shown.isOther }];
      }),
    '',
  );
}

// Why two runs have no difference; '' if they have.
export function whyNoDifference(a: Run, b: Run): string {
  const [of, to] = [a.trajectory, b.trajectory];
  if (of.step_size !== to.step_size) return `No difference: the time steps are ${of.step_size} s and ${to.step_size} s.`;
  if (a.length !== b.length) return `No difference: one run has ${a.length} samples, the other ${b.length}.`;
  if (of.time.some((time, k) => time !== to.time[k])) return 'No difference: the samples are not at the same times.';
  return '';
}

export function differencesOf(a: ShownRun, b: ShownRun, body: number, chosen: ReadonlySet<Group>, theme: Theme): Plot[] {
  return plotsBy(
    chosen,
    (quantity, index) => {
      const [of, to] = [quantity.values(a.run, body), quantity.values(b.run, body)];
      if (!of || !to) return [];
      const values = of.map((value, k) => value - (to[k] as number));
      const key = `${a.label} - ${b.label}.${quantity.key}`;
      return [{ key, label: quantity.label, run: a.run, values, colour: lineColour(a, index, theme), isDashed: false }];
    },
    `, ${a.label} − ${b.label}`,
  );
}

// Times of two runs in one rising row, and which sample of each is there (-1: none).
export interface CommonTimes {
  time: Float64Array;
  samples: Map<Run, Int32Array | null>; // null: all of them, one by one
}

const isSame = (a: Float64Array, b: Float64Array): boolean => a.length === b.length && a.every((x, k) => x === b[k]);

export function commonTimes(runs: Run[]): CommonTimes {
  const [a, b] = [...new Set(runs)];
  if (!a) return { time: new Float64Array(0), samples: new Map() };
  const first = a.trajectory.time;
  if (!b) return { time: first, samples: new Map([[a, null]]) };
  const second = b.trajectory.time;
  if (isSame(first, second)) {
    return {
      time: first,
      samples: new Map([
        [a, null],
        [b, null],
      ]),
    };
  }
  const time: number[] = [];
  const at: [number[], number[]] = [[], []];
  for (let i = 0, j = 0; i < first.length || j < second.length; ) {
    const now = Math.min(first[i] ?? Infinity, second[j] ?? Infinity);
    time.push(now);
    at[0].push(first[i] === now ? i++ : -1);
    at[1].push(second[j] === now ? j++ : -1);
  }
  return {
    time: Float64Array.from(time),
    samples: new Map([
      [a, Int32Array.from(at[0])],
      [b, Int32Array.from(at[1])],
    ]),
  };
}

// Values for uPlot: null is a gap, undefined a time that belongs to the other run alone.
export type Aligned = Float64Array | (number | null | undefined)[];

export function aligned(line: Line, times: CommonTimes): Aligned {
  const samples = times.samples.get(line.run);
  const values = line.values;
  if (!samples && values.every(Number.isFinite)) return values;
  const result = new Array<number | null | undefined>(times.time.length);
  for (let k = 0; k < result.length; ++k) {
    const sample = samples ? (samples[k] as number) : k;
    const value = values[sample] as number;
    if (sample >= 0) result[k] = Number.isFinite(value) ? value : null;
  }
  return result;
}

// Places of numbers that stand alone between gaps: a line would not show them.
export function lonely(values: ArrayLike<number | null | undefined>): number[] {
  const places: number[] = [];
  let before: number | null = null; // the last value that is not undefined
  let candidate = -1;
  for (let k = 0; k < values.length; ++k) {
    const value = values[k];
    if (value === undefined) continue;
    if (value === null && candidate >= 0) places.push(candidate);
    candidate = value !== null && before === null ? k : -1;
    before = value;
  }
  if (candidate >= 0) places.push(candidate);
  return places;
}
