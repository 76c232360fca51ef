// A run: what was asked for, and all that the engine says of it. Live runs and recorded ones are the same here.
import type {
  BodySeries,
  DropStart,
  ImpulsePlane,
  Module,
  RecordArrays,
  Run as EngineRun,
  SceneInfo,
  SceneRun,
  StepProblem,
  TrajectoryArrays,
  Triple,
} from 'tumble-engine';
import { checked } from './engine';

export interface DropSpec extends DropStart {
  kind: 'drop';
  model: 'document' | 'scene'; // the document's, or the general step on the same square
}
export interface SceneSpec {
  kind: 'scene';
  toml: string;
  solver: 'exact' | 'fast';
}
export interface TextFile {
  name: string;
  text: string;
}
export interface RecordedSpec {
  kind: 'recorded';
  files: TextFile[];
}
export type Spec = DropSpec | SceneSpec | RecordedSpec;

// The document's start and parameters.
export const documentDrop: DropSpec = {
  kind: 'drop',
  model: 'document',
  q0: [0, 1.5, 0.5235987755982988],
  v0: [0, -0.2, 0],
  l: 0.2,
  m: 0.3,
  mu: 0.3,
  eps: 0.5,
  dt: 0.01,
  delta: 0.001,
  g: 9.81,
  columns: 150,
};

export class Run {
  readonly trajectory: TrajectoryArrays;
  readonly record: RecordArrays | null;
  readonly scene: SceneInfo;
  readonly numBodies: number;
  private readonly series = new Map<number, BodySeries>();

  constructor(
    readonly spec: Spec,
    readonly handle: EngineRun,
  ) {
    try {
      this.trajectory = checked(handle.trajectory());
      this.record = handle.record();
      this.scene = checked(handle.scene());
    } catch (error) {
      handle.delete();
      throw error;
    }
    this.numBodies = this.scene.bodies.length;
  }

  get length(): number {
    return this.trajectory.time.length;
  }
  get duration(): number {
    return this.trajectory.time[this.length - 1] ?? 0;
  }
  // The last sample that is not after a time.
  sampleAt(time: number): number {
    const times = this.trajectory.time;
    let low = 0;
    let high = times.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if ((times[middle] as number) <= time + 1e-12) low = middle;
      else high = middle - 1;
    }
    return low;
  }
  poseAt(sample: number, body: number): Triple {
    const at = 3 * (sample * this.numBodies + body);
    const pose = this.trajectory.pose;
    return [pose[at] as number, pose[at + 1] as number, pose[at + 2] as number];
  }
  velocityAt(sample: number, body: number): Triple {
    const at = 3 * (sample * this.numBodies + body);
    const velocity = this.trajectory.velocity;
    return [velocity[at] as number, velocity[at + 1] as number, velocity[at + 2] as number];
  }
  // Rows of the contact arrays that belong to the step that leaves a sample.
  contactsOf(sample: number): { first: number; last: number } {
    const { time, step_size, contact_offsets } = this.trajectory;
    const step = Math.round((time[sample] as number) / step_size);
    if (step + 1 >= contact_offsets.length) return { first: 0, last: 0 };
    return { first: contact_offsets[step] as number, last: contact_offsets[step + 1] as number };
  }
  // One component of a body over all samples; 0 to 2: pose, 3 to 5: velocity.
  component(body: number, component: number): Float64Array {
    const from = component < 3 ? this.trajectory.pose : this.trajectory.velocity;
    const values = new Float64Array(this.length);
    for (let k = 0; k < values.length; ++k) {
      values[k] = from[3 * (k * this.numBodies + body) + (component % 3)] as number;
    }
    return values;
  }
  bodySeries(body: number): BodySeries {
    let series = this.series.get(body);
    if (!series) this.series.set(body, (series = this.handle.body_series(body)));
    return series;
  }
  problem(sample: number): StepProblem | null {
    return checked(this.handle.problem(sample));
  }
  impulsePlanes(sample: number): ImpulsePlane[] {
    return checked(this.handle.impulse_planes(sample));
  }
  release(): void {
    this.handle.delete();
  }
}

// What a recorded run may have been asked for by: what a change of it starts from. Whether that gives the same bits, only
// those know who recorded it.
export function askedFor(run: Run): DropSpec | SceneSpec {
  const { record, trajectory } = run;
  if (!record) return { kind: 'scene', toml: trajectory.scene, solver: 'exact' };
  const { l, m, mu, eps, dt, delta, g, columns } = record;
  return { kind: 'drop', model: 'document', q0: run.poseAt(0, 1), v0: run.velocityAt(0, 1), l, m, mu, eps, dt, delta, g, columns };
}

// At most so many samples are simulated.
const maxSamples = 20_000;

export function simulateDrop(engine: Module, spec: DropSpec): Run {
  if (spec.columns > maxSamples) throw new Error(`columns: must be at most ${maxSamples} in this page, got ${spec.columns}`);
  return new Run(spec, checked(engine.simulate_drop(spec)));
}

export function startScene(engine: Module, toml: string, solver: 'exact' | 'fast'): SceneRun {
  const { duration, step_size } = checked(engine.describe_scene(toml, 'scene'));
  const sample_every = Math.max(1, Math.ceil(duration / step_size / maxSamples));
  return checked(engine.simulate_scene(toml, { step_size: 0, duration: 0, sample_every, solver }));
}

// The first step alone: what there is to see until the rest is computed.
export function firstStep(engine: Module, spec: SceneSpec): Run {
  const { step_size } = checked(engine.describe_scene(spec.toml, 'scene'));
  const options = { step_size, duration: step_size, sample_every: 1, solver: spec.solver };
  const simulation = checked(engine.simulate_scene(spec.toml, options));
  simulation.advance(1);
  const run = new Run(spec, checked(simulation.finish()));
  simulation.delete();
  return run;
}

// The first dynamic body: the one whose motion is shown at first.
export function firstDynamic(scene: SceneInfo): number {
  return Math.max(
    scene.bodies.findIndex((body) => body.kind === 'dynamic'),
    0,
  );
}
