// What the page is about: one run or two, each from its spec, and how a change of a spec becomes a new run.
import type { Module, SceneEdits, SceneInfo, SceneRun, Triple } from 'tumble-engine';
import { checked } from './engine';
import { askedFor, firstDynamic, firstStep, Run, simulateDrop, startScene, type DropSpec, type Spec } from './run';
import type { Start } from './stage';

export type SlotName = 'a' | 'b';

export interface SlotError {
  field: string;
  message: string;
}

export interface Slot {
  spec: Spec; // as asked for, also where the engine refused it
  run: Run | null; // the last that went well
  error: SlotError | null;
}

interface Job {
  spec: Spec;
  simulation: SceneRun;
  share: number; // done
}

// What a line of the engine is about, as the key of a parameter: "materials[0].friction: ...", "bodies[1] 'block': mass: ...", "m, l: ...".
function fieldOf(message: string): string {
  const material = /^materials\[(\d+)\]\.(\w+):/.exec(message);
  if (material) return `material.${material[1]}.${material[2]}`;
  return /^(?:bodies\[\d+\](?: '.*?')?(?:\.|: ))?(\w+)(?:, \w+)*:/.exec(message)?.[1] ?? '';
}

// A slice of a long simulation: short enough for the page to stay awake.
const sliceTime = 12; // [ms]

export class Session {
  readonly slots: Record<SlotName, Slot | null> = { a: null, b: null };
  private readonly jobs: Record<SlotName, Job | null> = { a: null, b: null };
  private readonly infos = new WeakMap<Spec, SceneInfo>();
  private isWorking = false;

  constructor(
    private readonly engine: Module,
    private readonly onRun: (slot: SlotName) => void, // there is a new run, or an error in place of one
    private readonly onProgress: (share: number) => void, // 0 to 1; 1: nothing goes on
  ) {}

  // Simulates anew. What takes longer than a slice goes on behind; a newer spec ends it. Until then the run before is
  // shown, or, of another scene, the first step.
  set(name: SlotName, spec: Spec, isOther = false): void {
    this.cancel(name);
    const slot = (this.slots[name] ??= { spec, run: null, error: null });
    slot.spec = spec;
    try {
      slot.error = null;
      if (spec.kind === 'drop' && spec.model === 'document') return this.take(name, simulateDrop(this.engine, spec));
      if (spec.kind === 'recorded') return;
      const toml = spec.kind === 'drop' ? checked(this.engine.drop_as_scene(spec)) : spec.toml;
      const simulation = startScene(this.engine, toml, spec.kind === 'scene' ? spec.solver : 'exact');
      this.jobs[name] = { spec, simulation, share: 0 };
      this.work();
      if (isOther && this.jobs[name] && spec.kind === 'scene') this.take(name, firstStep(this.engine, spec));
    } catch (error) {
      this.fail(name, error);
    }
  }
  // A run that is there already.
  setRun(name: SlotName, run: Run): void {
    this.cancel(name);
    this.slots[name] ??= { spec: run.spec, run: null, error: null };
    this.take(name, run);
  }
  drop(name: SlotName): void {
    this.cancel(name);
    const run = this.slots[name]?.run;
    this.slots[name] = null;
    run?.release();
  }

  // ---- Changes of a spec ----

  edited(spec: Spec, edits: SceneEdits): Spec {
    if (spec.kind !== 'scene') return spec;
    return { ...spec, toml: checked(this.engine.edit_scene(spec.toml, edits)) };
  }
  withStart(spec: Spec, body: number, { pose, velocity }: Start): Spec {
    if (spec.kind === 'drop') return { ...spec, q0: pose, v0: velocity };
    return this.edited(spec, { bodies: [{ index: body, pose, velocity }] });
  }
  withParameter(spec: Spec, body: number, key: string, value: number): Spec {
    const [kind, index, name] = key.split('.');
    if (spec.kind === 'drop') {
      if (kind === 'q0' || kind === 'v0') {
        const triple = [...spec[kind]] as Triple;
        triple[Number(index)] = value;
        return { ...spec, [kind]: triple };
      }
      return { ...spec, [key]: value } as DropSpec;
    }
    if (spec.kind !== 'scene') return spec;
    if (kind === 'material') return this.edited(spec, { materials: [{ index: Number(index), [name as string]: value }] });
    if (key === 'mass') return this.edited(spec, { bodies: [{ index: body, mass: value }] });
    if (key === 'gravity') {
      const [gx] = checked(this.engine.describe_scene(spec.toml, 'scene')).gravity;
      return this.edited(spec, { gravity: [gx as number, -value] });
    }
    if (kind === 'q0' || kind === 'v0') {
      const info = checked(this.engine.describe_scene(spec.toml, 'scene')).bodies[body];
      if (!info) return spec;
      const start: Start = { pose: [...info.pose], velocity: [...info.velocity] };
      (kind === 'q0' ? start.pose : start.velocity)[Number(index)] = value;
      return this.withStart(spec, body, start);
    }
    return this.edited(spec, { [key]: value } as SceneEdits);
  }
  asked({ spec, run }: Slot): Spec {
    return spec.kind === 'recorded' && run ? askedFor(run) : spec;
  }
  // The scene that is asked for, which may be ahead of the run that is shown.
  sceneOf(slot: Slot): SceneInfo | null {
    if (slot.spec.kind !== 'scene') return slot.run?.scene ?? null;
    let info = this.infos.get(slot.spec);
    if (!info) this.infos.set(slot.spec, (info = checked(this.engine.describe_scene(slot.spec.toml, 'scene'))));
    return info;
  }
  // Where the handles of a body are.
  startOf(slot: Slot | null, body: number): Start | null {
    if (!slot?.run) return null;
    const spec = this.asked(slot);
    if (spec.kind === 'drop') return { pose: spec.q0, velocity: spec.v0 };
    const info = this.sceneOf(slot)?.bodies[body];
    return info?.kind === 'dynamic' ? { pose: info.pose, velocity: info.velocity } : null;
  }
  firstBody(): number {
    const run = this.slots.a?.run;
    return run ? firstDynamic(run.scene) : 0;
  }
  fail(name: SlotName, error: unknown): void {
    const slot = this.slots[name];
    if (!slot) return;
    // The engine's own exceptions come without words.
    const message = error instanceof Error ? error.message : 'This cannot be shown: a number is beyond the range of scenes, or the memory was not enough.';
    slot.error = { field: fieldOf(message), message };
    this.onRun(name);
  }

  private take(name: SlotName, run: Run): void {
    const slot = this.slots[name] as Slot;
    const old = slot.run;
    slot.run = run;
    slot.spec = run.spec;
    slot.error = null;
    this.onRun(name);
    if (old && old !== run) old.release();
  }

  private cancel(name: SlotName): void {
    this.jobs[name]?.simulation.delete();
    this.jobs[name] = null;
  }

  private work(): void {
    this.slice();
    if (this.isWorking || !this.hasJob()) return;
    this.isWorking = true;
    const again = (): void => {
      this.slice();
      this.isWorking = this.hasJob();
      if (this.isWorking) setTimeout(again, 0);
    };
    setTimeout(again, 0);
  }
  private hasJob(): boolean {
    return this.jobs.a !== null || this.jobs.b !== null;
  }
  private slice(): void {
    const end = performance.now() + sliceTime;
    for (const name of ['a', 'b'] as const) {
      let job = this.jobs[name];
      while (job && performance.now() < end) {
        this.advance(name, job);
        job = this.jobs[name];
      }
    }
    this.onProgress(Math.min(this.jobs.a?.share ?? 1, this.jobs.b?.share ?? 1));
  }
  private advance(name: SlotName, job: Job): void {
    try {
      job.share = job.simulation.advance(1);
      if (job.share === 1) this.finish(name, job);
    } catch (error) {
      this.cancel(name);
      this.fail(name, error);
    }
  }
  private finish(name: SlotName, job: Job): void {
    this.jobs[name] = null;
    try {
      const run = new Run(job.spec, checked(job.simulation.finish()));
      this.take(name, run);
    } catch (error) {
      this.fail(name, error);
    }
    job.simulation.delete();
  }
}
