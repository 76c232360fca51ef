// What can be plotted: the engine's numbers, each with its name and unit.
import type { Run } from './run';

export const groups = ['Height', 'Angle', 'Position x', 'Velocities', 'Spin', 'Energy', 'Gap', 'Contact'] as const;
export type Group = (typeof groups)[number];

export interface Quantity {
  key: string;
  label: string;
  unit: string;
  group: Group | 'Time';
  // One number per sample, NaN where there is none; null: the run has no such quantity of the body.
  values(run: Run, body: number): Float64Array | null;
}

type TrajectoryKey = 'kinetic' | 'potential' | 'mechanical' | 'total_friction_loss' | 'total_impact_loss';
type SeriesKey = 'normal_impulse' | 'friction_impulse';

const isDynamic = (run: Run, body: number): boolean => run.scene.bodies[body]?.kind === 'dynamic';

// 0 to 2: x, y, angle; 3 to 5: their velocities.
const component =
  (index: number) =>
  (run: Run, body: number): Float64Array | null =>
    body in run.scene.bodies ? run.component(body, index) : null;

const energy =
  (key: TrajectoryKey) =>
  (run: Run): Float64Array =>
    run.trajectory[key];

// The document's drop says nothing of losses.
const loss =
  (key: TrajectoryKey) =>
  (run: Run): Float64Array | null =>
    run.record ? null : run.trajectory[key];

// A row of z of the document's drop.
const reaction =
  (row: number) =>
  (run: Run, body: number): Float64Array | null =>
    run.record && isDynamic(run, body) ? run.record.z.subarray(row * run.length, (row + 1) * run.length) : null;

const impulse =
  (key: SeriesKey) =>
  (run: Run, body: number): Float64Array | null =>
    run.record || !(body in run.scene.bodies) ? null : run.bodySeries(body)[key];

function gap(run: Run, body: number): Float64Array | null {
  if (run.record) return isDynamic(run, body) ? run.record.gap : null;
  return body in run.scene.bodies ? run.bodySeries(body).gap : null;
}

export const quantities: readonly Quantity[] = [
  { key: 'time', label: 'time', unit: 's', group: 'Time', values: (run) => run.trajectory.time },
  { key: 'y', label: 'height y', unit: 'm', group: 'Height', values: component(1) },
  { key: 'angle', label: 'angle', unit: 'rad', group: 'Angle', values: component(2) },
  { key: 'x', label: 'x', unit: 'm', group: 'Position x', values: component(0) },
  { key: 'vx', label: 'vx', unit: 'm/s', group: 'Velocities', values: component(3) },
  { key: 'vy', label: 'vy', unit: 'm/s', group: 'Velocities', values: component(4) },
  { key: 'omega', label: 'spin ω', unit: 'rad/s', group: 'Spin', values: component(5) },
  { key: 'mechanical', label: 'mechanical', unit: 'J', group: 'Energy', values: energy('mechanical') },
  { key: 'kinetic', label: 'kinetic', unit: 'J', group: 'Energy', values: energy('kinetic') },
  { key: 'potential', label: 'potential', unit: 'J', group: 'Energy', values: energy('potential') },
  { key: 'total_friction_loss', label: 'lost to friction', unit: 'J', group: 'Energy', values: loss('total_friction_loss') },
  { key: 'total_impact_loss', label: 'lost to impacts', unit: 'J', group: 'Energy', values: loss('total_impact_loss') },
  { key: 'gap', label: 'gap', unit: 'm', group: 'Gap', values: gap },
  { key: 'f_n', label: 'normal force', unit: 'N', group: 'Contact', values: reaction(0) },
  { key: 'f_t1', label: 'friction t1', unit: 'N', group: 'Contact', values: reaction(1) },
  { key: 'f_t2', label: 'friction t2', unit: 'N', group: 'Contact', values: reaction(2) },
  { key: 'lambda', label: 'slip λ', unit: 'm/s', group: 'Contact', values: reaction(3) },
  { key: 'normal_impulse', label: 'normal impulse', unit: 'N s', group: 'Contact', values: impulse('normal_impulse') },
  { key: 'friction_impulse', label: 'friction impulse', unit: 'N s', group: 'Contact', values: impulse('friction_impulse') },
];

export function quantity(key: string): Quantity {
  const found = quantities.find((q) => q.key === key);
  if (!found) throw new Error(`${key}: no such quantity`);
  return found;
}
