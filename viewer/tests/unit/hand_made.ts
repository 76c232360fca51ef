// Runs written by hand, for tests without the engine.
import { Run, type Spec } from '../../src/run';
import type { BodySeries, Module, RecordArrays, Run as EngineRun, SceneInfo, TrajectoryArrays } from 'tumble-engine';

export const scene = {
  title: 'Two boxes',
  bodies: [
    { name: 'floor', kind: 'fixed' },
    { name: 'box', kind: 'dynamic' },
  ],
} as unknown as SceneInfo;

export const engine = { describe_scene: () => scene } as unknown as Module;

interface Parts {
  trajectory?: Partial<TrajectoryArrays>;
  record?: Partial<RecordArrays>;
  series?: BodySeries;
  spec?: Spec;
}

// Body 1 has the numbers 100 k + 0 to 5 as its pose and velocity in sample k.
export function handMade(times: number[], parts: Parts = {}): Run {
  const numbers = (first: number): Float64Array =>
    Float64Array.from(times.flatMap((_, k) => [0, 0, 0, ...[0, 1, 2].map((i) => 100 * k + first + i)]));
  const trajectory = {
    scene: 'tumble = 1\n',
    body_names: scene.bodies.map((body) => body.name),
    step_size: 0.1,
    time: Float64Array.from(times),
    pose: numbers(0),
    velocity: numbers(3),
    kinetic: Float64Array.from(times, (_, k) => k + 0.25),
    potential: Float64Array.from(times, (_, k) => k + 0.5),
    mechanical: Float64Array.from(times, (_, k) => 2 * k + 0.75),
    total_friction_loss: Float64Array.from(times, (_, k) => -k),
    total_impact_loss: Float64Array.from(times, (_, k) => -2 * k),
    ...parts.trajectory,
  };
  const handle = {
    trajectory: () => trajectory,
    record: () => parts.record ?? null,
    scene: () => scene,
    body_series: () => parts.series,
    csv: (table: string) => `${table} of this run\n`,
  };
  const spec: Spec = parts.spec ?? { kind: 'scene', toml: '', solver: 'exact' };
  return new Run(spec, handle as unknown as EngineRun);
}
