// The types of tumble_engine.mjs, by hand: the module says nothing of them. Names and units are those of docs/formats.md.

export type Triple = [number, number, number];
export type Failure = { error: string };

// Of the document's drop.
export interface DropParameters {
  l: number;
  m: number;
  mu: number;
  eps: number;
  dt: number;
  delta: number;
  g: number;
  columns: number;
}

// q0 and v0 are (x, y, theta) and (vx, vy, omega).
export interface DropStart extends DropParameters {
  q0: Triple;
  v0: Triple;
}

export interface SceneOptions {
  step_size: number; // [s]; 0: the scene's
  duration: number; // [s]; 0: the scene's
  sample_every: number;
  solver: 'exact' | 'fast';
}

// The arrays of a trajectory as in .npz files, and the sums that are drawn.
export interface TrajectoryArrays {
  scene: string;
  body_names: string[];
  mode_names: string[];
  status: string;
  step_size: number;
  num_steps: number;
  residual: number;
  is_complete: number;
  created_energy: number;
  num_inexact_steps: number;
  time: Float64Array; // T
  pose: Float64Array; // T x B x 3
  velocity: Float64Array; // T x B x 3
  kinetic: Float64Array;
  potential: Float64Array;
  external_work: Float64Array;
  friction_loss: Float64Array;
  impact_loss: Float64Array;
  damping_loss: Float64Array;
  stabilisation_work: Float64Array;
  created: Float64Array;
  mechanical: Float64Array; // kinetic + potential
  total_friction_loss: Float64Array; // since the start
  total_impact_loss: Float64Array;
  contact_offsets: Float64Array; // num_steps + 1
  contact_step: Float64Array; // N
  contact_body_a: Int32Array;
  contact_body_b: Int32Array;
  contact_part_a: Int32Array;
  contact_part_b: Int32Array;
  contact_feature: Float64Array;
  contact_mode: Int32Array;
  contact_point_a: Float64Array; // N x 2
  contact_point_b: Float64Array;
  contact_normal: Float64Array;
  contact_gap: Float64Array;
  contact_normal_velocity: Float64Array;
  contact_tangential_velocity: Float64Array;
  contact_normal_velocity_after: Float64Array;
  contact_tangential_velocity_after: Float64Array;
  contact_normal_impulse: Float64Array;
  contact_friction_impulse: Float64Array;
  contact_restitution: Float64Array;
  contact_law_friction: Float64Array;
  contact_law_static_friction: Float64Array;
  contact_law_restitution: Float64Array;
}

// The arrays of a record of the drop as in .npz files.
export interface RecordArrays extends DropParameters {
  t: Float64Array;
  q: Float64Array; // 3 x T
  v: Float64Array;
  gap: Float64Array;
  corner: Int32Array;
  z: Float64Array; // 4 x T
  mode: Int32Array;
  status: Int32Array;
  residual: Float64Array;
  kinetic: Float64Array;
  potential: Float64Array;
}

// Per sample, of the step that leaves it; NaN where the body has no contact.
export interface BodySeries {
  normal_impulse: Float64Array; // sum [N s]
  friction_impulse: Float64Array; // sum of sizes [N s]
  gap: Float64Array; // the least [m]
}

export interface LemkePage {
  entered: string | null;
  left: string | null;
  entering: string | null;
  leaving: string | null;
  basis: string[];
  columns: string[];
  entries: Float64Array; // n x (n + 2): columns, value
  ratios: (number | null)[];
}

// w = V z + p >= 0, z >= 0, w . z = 0.
export interface StepProblem {
  V: Float64Array; // n x n
  p: Float64Array;
  z: Float64Array;
  w: Float64Array;
  z_names: string[];
  z_units: string[];
  w_names: string[];
  w_units: string[];
  residual: number;
  pages: LemkePage[];
  end: 'no_pivot' | 'solved' | 'stopped' | 'ray';
}

// u' = u + A P of one contact.
export interface ImpulsePlane {
  A_nn: number;
  A_nt: number;
  A_tt: number;
  u_n: number;
  u_t: number;
  u_n_target: number;
  friction: number;
  P_n: number;
  P_t: number;
}

export type ShapeInfo = { material: number; surface_speed: number } & (
  | { kind: 'polygon'; points: Float64Array; rounding: number }
  | { kind: 'ellipse'; semi_axes: number[]; pose: Triple }
  | { kind: 'half_plane'; normal: number[]; offset: number }
  | { kind: 'terrain'; points: Float64Array }
);

export interface BodyInfo {
  name: string;
  kind: 'dynamic' | 'kinematic' | 'fixed';
  mass: number;
  moment_of_inertia: number;
  pose: Triple;
  velocity: Triple;
  parts: ShapeInfo[];
}

export interface SceneInfo {
  title: string;
  bodies: BodyInfo[];
  materials: { name: string; friction: number; static_friction: number; restitution: number }[];
  gravity: number[];
  step_size: number;
  duration: number;
}

export interface SceneEdits {
  bodies?: { index: number; pose?: Triple; velocity?: Triple; mass?: number }[];
  materials?: { index: number; friction?: number; restitution?: number }[];
  gravity?: [number, number];
  step_size?: number;
  duration?: number;
}

// Memory of the module: `delete` gives it back.
export interface Run {
  trajectory(): TrajectoryArrays | Failure;
  record(): RecordArrays | null;
  scene(): SceneInfo | Failure;
  body_series(body: number): BodySeries;
  problem(sample: number): StepProblem | null | Failure;
  impulse_planes(sample: number): ImpulsePlane[] | Failure;
  csv(table: 'record' | 'samples' | 'contacts'): string | Failure;
  delete(): void;
}

export interface SceneRun {
  advance(num_steps: number): number;
  finish(): Run | Failure;
  delete(): void;
}

export interface Module {
  version: string;
  simulate_drop(start: DropStart): Run | Failure;
  drop_as_scene(start: DropStart): string | Failure;
  simulate_scene(toml: string, options: SceneOptions): SceneRun | Failure;
  read_record(text: string, name: string): Run | Failure;
  read_trajectory(
    toml: string,
    samples: string,
    samples_name: string,
    contacts: string,
    contacts_name: string,
  ): Run | Failure;
  describe_scene(toml: string, name: string): SceneInfo | Failure;
  edit_scene(toml: string, edits: SceneEdits): string | Failure;
}

export default function create(options: { wasmBinary: Uint8Array }): Promise<Module>;
