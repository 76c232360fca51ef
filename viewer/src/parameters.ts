// Sliders with numbers to type. A number that the engine refuses stays in its field with the engine's line below.
import type { SceneInfo, Triple } from 'tumble-engine';
import { element, setText } from './markup';
import type { DropSpec } from './run';

export interface Parameter {
  key: string; // also the field's name in errors of the engine
  label: string;
  unit: string;
  min: number;
  max: number;
  step: number;
  help: string;
}

const place = (label: string, range: number): Omit<Parameter, 'key' | 'label' | 'help'> => ({
  unit: label,
  min: -range,
  max: range,
  step: range / 500,
});

export const startParameters: Parameter[] = [
  { key: 'q0.0', label: 'x', ...place('m', 3), help: 'Start: centre of mass, to the right' },
  { key: 'q0.1', label: 'y', ...place('m', 3), min: 0, help: 'Start: height of the centre of mass' },
  { key: 'q0.2', label: 'θ', ...place('rad', 3.2), help: 'Start: angle, counter-clockwise' },
  { key: 'v0.0', label: 'vx', ...place('m/s', 10), help: 'Start: velocity to the right' },
  { key: 'v0.1', label: 'vy', ...place('m/s', 10), help: 'Start: velocity upwards' },
  { key: 'v0.2', label: 'ω', ...place('rad/s', 30), help: 'Start: spin, counter-clockwise' },
];

export const dropParameters: Parameter[] = [
  { key: 'mu', label: 'μ friction', unit: '', min: 0, max: 1.5, step: 0.01, help: 'Coefficient of friction, ≥ 0' },
  { key: 'eps', label: 'ε restitution', unit: '', min: 0, max: 1, step: 0.01, help: 'Coefficient of restitution, 0 to 1' },
  { key: 'l', label: 'l side', unit: 'm', min: 0.02, max: 1, step: 0.01, help: 'Side of the square, > 0' },
  { key: 'm', label: 'm mass', unit: 'kg', min: 0.05, max: 5, step: 0.05, help: 'Mass, > 0' },
  { key: 'dt', label: 'dt step', unit: 's', min: 0.0005, max: 0.05, step: 0.0005, help: 'Time step, > 0' },
  { key: 'delta', label: 'δ threshold', unit: 'm', min: 0, max: 0.01, step: 0.0001, help: 'Contact threshold and lift of the document’s model, ≥ 0' },
  { key: 'g', label: 'g gravity', unit: 'm/s²', min: 0, max: 25, step: 0.01, help: 'Gravitational acceleration, downwards' },
  { key: 'columns', label: 'columns', unit: '', min: 2, max: 1000, step: 1, help: 'Columns of the trajectory, the start included' },
];

export function sceneParameters(scene: SceneInfo, body: number): { parameters: Parameter[]; values: Record<string, number> } {
  const parameters: Parameter[] = [];
  const values: Record<string, number> = {};
  const add = (parameter: Parameter, value: number): void => {
    parameters.push(parameter);
    values[parameter.key] = value;
  };
  scene.materials.forEach((material, i) => {
    const of = scene.materials.length > 1 ? ` ${material.name}` : '';
    add({ key: `material.${i}.friction`, label: `μ friction${of}`, unit: '', min: 0, max: 1.5, step: 0.01, help: 'Coefficient of friction, ≥ 0' }, material.friction);
    add({ key: `material.${i}.restitution`, label: `e restitution${of}`, unit: '', min: 0, max: 1, step: 0.01, help: 'Coefficient of restitution, 0 to 1' }, material.restitution);
  });
  const shown = scene.bodies[body];
  if (shown?.kind === 'dynamic') {
    add({ key: 'mass', label: `m ${shown.name}`, unit: 'kg', min: 0.01, max: Math.max(5, 4 * shown.mass), step: 0.01, help: 'Mass of the selected body, > 0' }, shown.mass);
  }
  add({ key: 'gravity', label: 'g gravity', unit: 'm/s²', min: 0, max: 25, step: 0.01, help: 'Gravitational acceleration, downwards' }, -(scene.gravity[1] as number));
  add({ key: 'step_size', label: 'h step', unit: 's', min: 0.0001, max: 0.02, step: 0.0001, help: 'Time step, > 0' }, scene.step_size);
  add({ key: 'duration', label: 'duration', unit: 's', min: 0.1, max: 20, step: 0.1, help: 'Simulated time, > 0' }, scene.duration);
  return { parameters, values };
}

export const dropValues = (spec: DropSpec): Record<string, number> => {
  const { mu, eps, l, m, dt, delta, g, columns } = spec;
  return { mu, eps, l, m, dt, delta, g, columns };
};

export const startValues = (pose: Triple, velocity: Triple): Record<string, number> =>
  Object.fromEntries([...pose.map((x, i) => [`q0.${i}`, x]), ...velocity.map((x, i) => [`v0.${i}`, x])]) as Record<string, number>;

// The shortest text that reads back to the same number.
const fullText = (x: number): string => (Object.is(x, -0) ? '-0' : String(x));

class Row {
  readonly node: HTMLElement;
  private readonly slider = element('input');
  private readonly entry = element('input', 'entry');
  private readonly error = element('p', 'field-error');

  constructor(
    readonly parameter: Parameter,
    onValue: (value: number) => void,
    onBad: (key: string, message: string) => void,
  ) {
    const { key, label, unit, min, max, step, help } = parameter;
    const id = `parameter-${key.replaceAll('.', '-')}`;
    Object.assign(this.slider, { type: 'range', min: String(min), max: String(max), step: String(step) });
    this.slider.setAttribute('aria-label', `${help}${unit ? ` [${unit}]` : ''}`);
    Object.assign(this.entry, { type: 'text', inputMode: 'decimal', id, autocomplete: 'off', spellcheck: false });
    this.error.id = `${id}-error`;
    this.error.setAttribute('role', 'alert');
    this.entry.setAttribute('aria-describedby', this.error.id);
    const name = element('label', '', label);
    name.htmlFor = id;
    name.title = help;
    this.node = element('div', 'parameter', name, this.slider, this.entry, element('span', 'unit', unit), this.error);
    this.node.dataset.key = key;
    this.slider.addEventListener('input', () => {
      this.entry.value = this.slider.value;
      onValue(Number(this.slider.value));
    });
    this.entry.addEventListener('input', () => {
      const text = this.entry.value.trim().replace(',', '.').replace('−', '-');
      const value = text === '' ? NaN : Number(text);
      if (Number.isFinite(value)) onValue(value);
      else onBad(key, `${label}: must be a number, got "${this.entry.value}"`);
    });
  }

  show(value: number): void {
    if (document.activeElement !== this.entry || Number(this.entry.value) !== value) this.entry.value = fullText(value);
    this.slider.value = String(value);
  }
  fail(message: string): void {
    setText(this.error, message);
    this.entry.toggleAttribute('aria-invalid', message !== '');
  }
}

export class Parameters {
  private rows: Row[] = [];
  private keys = '';
  private changed = '';
  private readonly general = element('p', 'field-error');

  constructor(
    private readonly root: HTMLElement,
    private readonly onValue: (key: string, value: number) => void,
  ) {
    this.general.setAttribute('role', 'alert');
  }

  show(parameters: Parameter[], values: Record<string, number>): void {
    const keys = parameters.map(({ key, label }) => key + label).join();
    if (keys !== this.keys) {
      this.keys = keys;
      const bad = (key: string, message: string): void => this.fail(key, message);
      const change = (key: string, value: number): void => {
        this.changed = key;
        this.onValue(key, value);
      };
      this.rows = parameters.map((p) => new Row(p, (value) => change(p.key, value), bad));
      this.root.replaceChildren(...this.rows.map((row) => row.node), this.general);
    }
    for (const row of this.rows) {
      const value = values[row.parameter.key];
      if (value !== undefined) row.show(value);
    }
  }
  // A line at the field, else at the one that was changed last, else below all. '' takes all lines away.
  fail(field: string, message: string): void {
    const rowOf = (key: string): Row | undefined => this.rows.find((row) => row.parameter.key === key);
    const failed = rowOf(field) ?? rowOf(this.changed);
    for (const row of this.rows) row.fail(row === failed ? message : '');
    setText(this.general, failed ? '' : message);
  }
  has(key: string): boolean {
    return this.rows.some((row) => row.parameter.key === key);
  }
}
