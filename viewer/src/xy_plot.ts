// One quantity over another.
import { drawXy, rangeOf, type Chart, type Interval } from './chart';
import { number, withUnit } from './format';
import type { ShownRun } from './plot_lines';
import { quantities, quantity, type Quantity } from './quantities';
import type { Theme } from './theme';

const presets = [
  { name: 'Phase plane: angle, spin', x: 'angle', y: 'omega' },
  { name: 'height, vy', x: 'y', y: 'vy' },
];
const height = 280;

const named = (q: Quantity): string => `${q.label} [${q.unit}]`;

export class XyPlot {
  readonly figure = document.createElement('figure');
  x = 'angle';
  y = 'omega';
  private readonly canvas = document.createElement('canvas');
  private readonly selects: { x: HTMLSelectElement; y: HTMLSelectElement };
  private runs: ShownRun[] = [];
  private body = 0;
  private time = 0;
  private theme: Theme | null = null;

  constructor() {
    this.figure.className = 'plot';
    this.canvas.className = 'plot-xy';
    this.canvas.style.height = `${height}px`;
    this.canvas.setAttribute('role', 'img');
    const bar = document.createElement('div');
    bar.className = 'plot-xy-bar';
    this.selects = { x: this.addSelect(bar, 'x'), y: this.addSelect(bar, 'y') };
    for (const preset of presets) this.addPreset(bar, preset);
    const caption = document.createElement('figcaption');
    caption.append(bar);
    this.figure.append(caption, this.canvas);
  }

  show(runs: ShownRun[], body: number, theme: Theme): void {
    this.runs = runs;
    this.body = body;
    this.theme = theme;
    this.offer();
    this.draw();
  }

  setTime(time: number): void {
    this.time = time;
    this.draw();
  }

  chart(): Chart {
    const [x, y] = [quantity(this.x), quantity(this.y)];
    const curves = this.runs.flatMap(({ run, label, colour, isOther }) => {
      const [xs, ys] = [x.values(run, this.body), y.values(run, this.body)];
      return xs && ys ? [{ label, x: xs, y: ys, colour, isDashed: isOther, marked: run.sampleAt(this.time) }] : [];
    });
    return { title: `${y.label} over ${x.label}`, xLabel: named(x), yLabel: named(y), curves };
  }

  plotted(): Record<string, Float64Array> {
    const plotted: Record<string, Float64Array> = {};
    for (const { run, label } of this.runs) {
      for (const key of [this.x, this.y]) {
        const values = quantity(key).values(run, this.body);
        if (values) plotted[`${label}.${key}`] = values;
      }
    }
    return plotted;
  }

  draw(): void {
    const width = this.canvas.clientWidth;
    const pen = this.canvas.getContext('2d');
    if (!pen || !this.theme || width === 0) return;
    const ratio = window.devicePixelRatio || 1;
    const size = [Math.round(width * ratio), Math.round(height * ratio)] as const;
    if (this.canvas.width !== size[0] || this.canvas.height !== size[1]) [this.canvas.width, this.canvas.height] = size;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    drawXy(pen, width, height, this.chart(), this.theme);
  }

  private describe(): void {
    const { title, curves } = this.chart();
    const [x, y] = [quantity(this.x), quantity(this.y)];
    const [xs, ys] = [rangeOf(curves.map((curve) => curve.x)), rangeOf(curves.map((curve) => curve.y))];
    const words = (range: Interval | null, unit: string): string =>
      range ? `${number(range[0])} to ${withUnit(range[1], unit)}` : 'nothing';
    this.canvas.setAttribute('aria-label', `${title}: ${words(ys, y.unit)} over ${words(xs, x.unit)}`);
  }

  // Only what a run has can be chosen.
  private offer(): void {
    const keys = quantities.filter((q) => this.runs.some(({ run }) => q.values(run, this.body))).map((q) => q.key);
    for (const axis of ['x', 'y'] as const) {
      if (!keys.includes(this[axis]) && keys[0]) this[axis] = keys[0];
      const select = this.selects[axis];
      if (Array.from(select.options, (option) => option.value).join() !== keys.join()) {
        select.replaceChildren(...keys.map((key) => new Option(named(quantity(key)), key)));
      }
      select.value = this[axis];
    }
    this.describe();
  }

  private choose(x: string, y: string): void {
    this.x = x;
    this.y = y;
    this.offer();
    this.draw();
  }

  private addSelect(bar: HTMLElement, axis: 'x' | 'y'): HTMLSelectElement {
    const label = document.createElement('label');
    const select = document.createElement('select');
    select.addEventListener('change', () => this.choose(this.selects.x.value, this.selects.y.value));
    label.append(`${axis.toUpperCase()} `, select);
    bar.append(label);
    return select;
  }

  private addPreset(bar: HTMLElement, { name, x, y }: (typeof presets)[number]): void {
    const button = document.createElement('button');
    button.type = 'button';
    button.className = 'plots-chip';
    button.textContent = name;
    button.addEventListener('click', () => this.choose(x, y));
    bar.append(button);
  }
}
