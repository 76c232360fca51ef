// The page: its parts, and how they follow the session.
import type { Module } from 'tumble-engine';
import type { Layer } from './draw';
import { examples } from './examples';
import { type Draw, saveCsv, saveGif, savePng, saveSvg, saveText } from './export';
import { openFiles, readFiles } from './files';
import { number } from './format';
import { Inspector } from './inspector';
import { element, setText } from './markup';
import { dropParameters, dropValues, Parameters, sceneParameters, startParameters, startValues } from './parameters';
import type { Pen } from './pen';
import { Plots, type ShownRun } from './plots';
import { askedFor, documentDrop, Run, type DropSpec, type Spec, type TextFile } from './run';
import { Session, type Slot, type SlotName } from './session';
import { encode, type Shared } from './share';
import { Stage } from './stage';
import { readTheme } from './theme';
import { button, Timeline } from './timeline';

const find = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;

const inspectionInterval = 150; // [ms] while the film runs

export class App {
  private readonly session: Session;
  private readonly stage: Stage;
  private readonly timeline: Timeline;
  private readonly plots: Plots;
  private readonly inspector = new Inspector(find('inspector'));
  private readonly parameters: Parameters;
  private readonly start: Parameters;
  private changed: Parameters; // where a number was changed last
  private active: SlotName = 'a';
  private body = 1;
  private home: Spec = documentDrop; // where Reset leads
  private readonly opening = new Set<SlotName>(); // slots that wait for the first run of what was opened
  private isCancelled = false;
  private lastDuration = Infinity;
  private lastInspection = 0;
  private readonly reducesMotion = matchMedia('(prefers-reduced-motion: reduce)');

  constructor(private readonly engine: Module) {
    this.session = new Session(engine, (name) => this.onRun(name), (share) => this.showProgress(share));
    this.stage = new Stage(find('stage'), {
      onStart: (start) => this.change((spec) => this.session.withStart(spec, this.body, start)),
      onSelect: (body) => this.select(body),
    });
    this.timeline = new Timeline(find('timeline'), {
      onTime: (time) => this.setTime(time),
      onStep: (by) => this.step(by),
      onPlaying: () => this.showMoment(),
    });
    this.plots = new Plots(find('plots'), (time) => {
      if (!this.timeline.isPlaying) this.setTime(time);
    });
    const onValue = (key: string, value: number): void => this.change((spec) => this.session.withParameter(spec, this.body, key, value));
    this.parameters = new Parameters(find('parameters'), (key, value) => {
      this.changed = this.parameters;
      onValue(key, value);
    });
    this.start = new Parameters(find('start'), (key, value) => {
      this.changed = this.start;
      onValue(key, value);
    });
    this.changed = this.parameters;
    this.listen();
  }

  // ---- What is shown ----

  get runs(): { a: Run | null; b: Run | null } {
    return { a: this.session.slots.a?.run ?? null, b: this.session.slots.b?.run ?? null };
  }
  plotted(): Record<string, Float64Array> {
    return this.plots.plotted();
  }
  get time(): number {
    return this.timeline.time;
  }

  open(shared: Shared): void {
    this.home = shared.a;
    this.leave();
    if (shared.b) this.opening.add('b');
    this.session.set('a', shared.a, true);
    const refused = this.session.slots.a?.error;
    if (refused) {  // a link may ask for anything
      if (!this.runs.a) this.session.set('a', documentDrop);
      this.tell(refused.message, true);
    }
    if (shared.b) this.session.set('b', shared.b);
    this.showRuns();
    this.setTime(this.opening.has('a') ? shared.time : Math.min(shared.time, this.duration));
  }

  openTexts(files: TextFile[]): void {
    const opened = openFiles(this.engine, files, this.runs.a);
    this.leave();
    find<HTMLSelectElement>('scene').value = '';
    if (opened instanceof Run) {
      this.home = askedFor(opened);
      this.session.setRun('a', opened);
      this.tell(`A recorded run of ${number(opened.duration)} s. A change of a parameter simulates anew.`);
    } else {
      this.home = { kind: 'scene', toml: opened.toml, solver: 'exact' };
      this.session.set('a', this.home, true);
    }
    this.showRuns();
    this.setTime(0);
  }

  // What is opened next takes the place of all that is shown.
  private leave(): void {
    this.tell('');
    this.active = 'a';
    this.session.drop('b');
    this.opening.clear();
    this.opening.add('a');
    setText(find('toml-error'), '');
  }

  tell(text: string, isError = false): void {
    const message = find('message');
    setText(message, text);
    message.hidden = text === '';
    message.classList.toggle('is-error', isError);
  }

  private get slot(): Slot | null {
    return this.session.slots[this.active];
  }

  private layers(time: number): Layer[] {
    const layers: Layer[] = [];
    for (const name of ['a', 'b'] as const) {
      const run = this.session.slots[name]?.run;
      if (run) layers.push({ run, sample: run.sampleAt(time), isOther: name === 'b', label: name.toUpperCase() });
    }
    return layers;
  }

  private get duration(): number {
    return Math.max(this.runs.a?.duration ?? 0, this.runs.b?.duration ?? 0);
  }

  private onRun(name: SlotName): void {
    if (!this.session.slots[name]?.error && this.opening.delete(name)) {
      this.stage.forgetView();
      if (name === 'a') this.body = this.session.firstBody();
    }
    this.showRuns();
  }

  private showRuns(): void {
    const { a, b } = this.runs;
    if (!a) {
      const error = this.session.slots.a?.error;
      return error ? this.tell(error.message, true) : undefined;
    }
    if (!a.scene.bodies[this.body] || a.scene.bodies[this.body]?.kind === 'fixed') this.body = this.session.firstBody();
    if (this.duration > 20 * this.lastDuration) this.stage.forgetView(); // more than the first step is there
    this.lastDuration = this.duration;
    this.timeline.setDuration(this.duration);
    this.showControls();
    const theme = readTheme();
    const shown: ShownRun[] = [{ run: a, label: 'A', colour: theme['body-deep'], isOther: false }];
    if (b) shown.push({ run: b, label: 'B', colour: theme['other-deep'], isOther: true });
    this.plots.show(shown, this.body);
    this.setTime(Math.min(this.timeline.time, this.duration));
    this.showFacts(a);
  }

  private showMoment(): void {
    const layers = this.layers(this.timeline.time);
    const { isPlaying, time } = this.timeline;
    const options = {
      ghosts: find<HTMLInputElement>('ghosts').checked,
      contacts: find<HTMLInputElement>('contacts').checked,
      selected: this.body,
      fade: isPlaying ? 0.3 * this.timeline.filmSpeed + 0.02 : 0,
    };
    this.timeline.setTime(time);
    this.stage.show(layers, find<HTMLInputElement>('side').checked, this.session.startOf(this.slot, this.body), this.active === 'a' ? 0 : 1, options);
    this.plots.setTime(time);
    // Nobody reads sixty texts a second.
    const now = performance.now();
    if (isPlaying && now - this.lastInspection < inspectionInterval) return;
    this.lastInspection = now;
    const run = this.slot?.run ?? null;
    this.inspector.show(run, run?.sampleAt(time) ?? 0);
  }

  private showControls(): void {
    const slot = this.slot;
    if (!slot?.run) return;
    const { run } = slot;
    const spec = this.session.asked(slot);
    const start = this.session.startOf(slot, this.body);
    if (spec.kind === 'drop') {
      this.parameters.show(dropParameters, dropValues(spec));
    } else {
      const { parameters, values } = sceneParameters(this.session.sceneOf(slot) ?? run.scene, this.body);
      this.parameters.show(parameters, values);
    }
    if (start) this.start.show(startParameters, startValues(start.pose, start.velocity));
    find('start-section').hidden = !start;
    const model = find<HTMLSelectElement>('model');
    model.hidden = spec.kind !== 'drop';
    if (spec.kind === 'drop') model.value = spec.model;
    find('text-section').hidden = spec.kind !== 'scene';
    const toml = find<HTMLTextAreaElement>('toml');
    if (spec.kind === 'scene' && document.activeElement !== toml) toml.value = spec.toml;
    const hasTwo = this.session.slots.b !== null;
    find('slots').hidden = find('compare-tools').hidden = !hasTwo;
    find('compare').setAttribute('aria-pressed', String(hasTwo));
    for (const name of ['a', 'b'] as const) find(`slot-${name}`).setAttribute('aria-pressed', String(name === this.active));
    this.showErrors();
  }

  private showErrors(): void {
    const error = this.slot?.error ?? null;
    const place = !error || this.parameters.has(error.field) ? this.parameters : this.changed;
    for (const part of [this.parameters, this.start]) part.fail(error?.field ?? '', part === place ? (error?.message ?? '') : '');
    if (error && place === this.start) find<HTMLDetailsElement>('start-section').open = true;
  }

  private showFacts(run: Run): void {
    const { status, residual, num_steps, is_complete, num_inexact_steps, created_energy } = run.trajectory;
    const worst = run.record ? run.record.residual.reduce((largest, x) => Math.max(largest, x), 0) : residual;
    const parts = [`${num_steps} steps`, `status ${status}`, `largest residual ${number(worst, 2)}`];
    if (!is_complete) parts.push('ended early');
    if (num_inexact_steps > 0) parts.push(`${num_inexact_steps} inexact steps`);
    if (created_energy > 0) parts.push(`created ${number(created_energy)} J`);
    setText(find('facts'), `${run.scene.title || 'Scene'}: ${parts.join(', ')}. Computed by Tumble ${this.engine.version} in this page; nothing is sent anywhere.`);
  }

  private showProgress(share: number): void {
    const progress = find<HTMLProgressElement>('progress');
    progress.hidden = share >= 1;
    progress.value = share;
  }

  // ---- What changes it ----

  private change(to: (spec: Spec) => Spec): void {
    const slot = this.slot;
    if (!slot) return;
    try {
      this.session.set(this.active, to(this.session.asked(slot)));
      this.showControls();
      this.showMoment();
    } catch (error) {
      this.session.fail(this.active, error);
    }
  }

  private setTime(time: number): void {
    this.timeline.setTime(time);
    this.showMoment();
  }

  private step(by: number): void {
    const run = this.slot?.run;
    if (!run) return;
    this.timeline.pause();
    const sample = Math.min(Math.max(run.sampleAt(this.timeline.time) + by, 0), run.length - 1);
    this.setTime(run.trajectory.time[sample] as number);
  }

  private select(body: number): void {
    this.body = body;
    this.showRuns();
  }

  private compare(): void {
    if (this.session.slots.b) {
      this.active = 'a';
      this.session.drop('b');
      this.showRuns();
      return;
    }
    const slot = this.session.slots.a;
    if (!slot) return;
    const spec = this.session.asked(slot);
    // The other model is what one wants to see beside a drop first.
    const other: Spec = spec.kind === 'drop' ? { ...spec, model: spec.model === 'document' ? 'scene' : 'document' } : spec;
    this.session.set('b', other);
    this.active = 'b';
    this.showRuns();
  }

  private async share(): Promise<void> {
    try {
      const { a, b } = this.session.slots;
      if (!a) return;
      const hash = await encode({ a: a.spec, b: b?.spec ?? null, time: this.timeline.time });
      history.replaceState(null, '', `#${hash}`);
      await navigator.clipboard?.writeText(location.href).catch(() => undefined);
      this.tell(`The address of this page now holds the run (${hash.length} bytes), and is in the clipboard where that is allowed.`);
    } catch (error) {
      this.tell((error as Error).message, true);
    }
  }

  private async openList(list: FileList | null | undefined): Promise<void> {
    if (!list?.length) return;
    try {
      this.tell('');
      this.openTexts(await readFiles([...list]));
    } catch (error) {
      this.tell((error as Error).message, true);
    }
  }

  // ---- Files ----

  private async film(): Promise<void> {
    const run = this.runs.a;
    if (!run) return;
    this.timeline.pause();
    this.isCancelled = false;
    const cancel = button('Cancel', 'Cancel', 'cancel-film');
    cancel.addEventListener('click', () => (this.isCancelled = true));
    find('message').replaceChildren('Drawing the film ', cancel);
    find('message').hidden = false;
    const draw = (pen: Pen, width: number, height: number, time: number): void =>
      this.stage.draw(pen, width, height, this.layers(time));
    const isSaved = await saveGif(draw, run.duration, {
      width: 640,
      height: 400,
      fps: 25,
      speed: this.timeline.filmSpeed,
      title: run.scene.title,
      onProgress: (share) => this.showProgress(share),
      isCancelled: () => this.isCancelled,
    });
    this.showProgress(1);
    this.tell(isSaved ? '' : 'The film was not saved.');
  }

  private fillSaveMenu(): void {
    const title = (): string => this.runs.a?.scene.title ?? 'tumble';
    const draw: Draw = (pen, width, height) => this.stage.draw(pen, width, height);
    const items: [string, string, () => unknown][] = [
      ['png', 'Picture (PNG)', () => savePng(draw, 960, 600, title())],
      ['svg', 'Picture (SVG)', () => saveSvg(draw, 960, 600, title())],
      ['plots-svg', 'Plots (SVG)', () => {
        const drawing = this.plots.drawing();
        saveSvg(drawing.draw, drawing.width, drawing.height, `${title()} plots`);
      }],
      ['csv', 'Numbers (CSV)', () => this.runs.a && saveCsv(this.runs.a)],
      ['toml', 'Scene (TOML)', () => this.runs.a && saveText(this.runs.a.trajectory.scene, 'scene.toml')],
      ['gif', 'Film (GIF)', () => this.film()],
    ];
    for (const [name, label, save] of items) {
      const item = element('button', 'menu-item', label);
      item.type = 'button';
      item.dataset.save = name;
      item.addEventListener('click', () => {
        find<HTMLDetailsElement>('save-menu').open = false;
        void Promise.resolve()
          .then(save)
          .catch((error: Error) => this.tell(error.message, true));
      });
      find('save').append(item);
    }
  }

  // ---- Controls ----

  private listen(): void {
    const scene = find<HTMLSelectElement>('scene');
    scene.append(new Option('The document’s drop', 'drop'));
    for (const example of examples) scene.append(new Option(example.title, example.name));
    scene.append(new Option('(from a file or a link)', '', false, false));
    scene.addEventListener('change', () => {
      const example = examples.find(({ name }) => name === scene.value);
      this.open({ a: example ? { kind: 'scene', toml: example.toml, solver: 'exact' } : documentDrop, b: null, time: 0 });
    });
    find('model').addEventListener('change', (event) => {
      const model = (event.target as HTMLSelectElement).value as DropSpec['model'];
      this.change((spec) => (spec.kind === 'drop' ? { ...spec, model } : spec));
    });
    const onClick = (id: string, act: () => void): void => find(id).addEventListener('click', act);
    onClick('compare', () => this.compare());
    onClick('share', () => void this.share());
    onClick('slot-a', () => this.activate('a'));
    onClick('slot-b', () => this.activate('b'));
    onClick('reset', () => this.session.set(this.active, this.home));
    onClick('apply', () => this.apply());
    onClick('zoom-in', () => this.stage.zoom(1.25));
    onClick('zoom-out', () => this.stage.zoom(0.8));
    onClick('fit', () => this.stage.fit());
    onClick('theme', () => this.toggleTheme());
    for (const id of ['ghosts', 'contacts']) find(id).addEventListener('change', () => this.showMoment());
    find('side').addEventListener('change', () => {
      this.stage.forgetView();
      this.showMoment();
    });
    find('difference').addEventListener('change', (event) => this.plots.setDifference((event.target as HTMLInputElement).checked));
    const open = find<HTMLInputElement>('open');
    open.addEventListener('change', () => {
      void this.openList(open.files).then(() => (open.value = ''));
    });
    document.addEventListener('dragover', (event) => event.preventDefault());
    document.addEventListener('drop', (event) => {
      event.preventDefault();
      void this.openList(event.dataTransfer?.files);
    });
    document.addEventListener('keydown', (event) => this.onKey(event));
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.refreshTheme());
    this.fillSaveMenu();
  }

  private activate(name: SlotName): void {
    this.active = name;
    this.showControls();
    this.showMoment();
  }

  private apply(): void {
    const toml = find<HTMLTextAreaElement>('toml');
    const error = find('toml-error');
    setText(error, '');
    try {
      const text = toml.value;
      const failure = this.engine.describe_scene(text, 'scene.toml');
      if ('error' in failure) throw new Error(failure.error);
      this.stage.forgetView();
      this.session.set(this.active, { kind: 'scene', toml: text, solver: 'exact' }, true);
    } catch (caught) {
      setText(error, (caught as Error).message);
    }
  }

  private toggleTheme(): void {
    const root = document.documentElement;
    root.dataset.theme = root.dataset.theme === 'dark' ? 'light' : 'dark';
    this.refreshTheme();
  }
  private refreshTheme(): void {
    this.plots.refreshTheme();
    this.showRuns();
  }

  // Space plays, comma and point step, wherever nothing is typed.
  private onKey(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|TEXTAREA|SELECT)$/.test(target.tagName)) return;
    if (event.key === ' ' && target.tagName !== 'BUTTON' && target.tagName !== 'SUMMARY') this.timeline.toggle();
    else if (event.key === ',') this.step(-1);
    else if (event.key === '.') this.step(1);
    else return;
    event.preventDefault();
  }

  // The film starts by itself where that is welcome.
  welcome(): void {
    if (!this.reducesMotion.matches) this.timeline.start();
  }
}
