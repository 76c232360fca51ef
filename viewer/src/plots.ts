// The plots below the picture: charts over time, and one quantity over another.
import 'uplot/dist/uPlot.min.css';
import './plots.css';
import { drawChart } from './chart';
import type { Pen } from './pen';
import { availableGroups, commonTimes, differencesOf, plotsOf, whyNoDifference, type Plot, type ShownRun } from './plot_lines';
import { groups, type Group } from './quantities';
import { readTheme } from './theme';
import { chartOf, TimePlot } from './time_plot';
import { XyPlot } from './xy_plot';

export { drawXy } from './chart';
export type { ShownRun } from './plot_lines';

// All plots as one picture.
export interface Drawing {
  width: number;
  height: number;
  draw: (pen: Pen, width: number, height: number) => void;
}

type Chip = Group | 'XY';
const atFirst: Chip[] = ['Height', 'Angle', 'Velocities', 'Energy', 'Contact'];

export class Plots {
  private readonly bar = document.createElement('div');
  private readonly note = document.createElement('p');
  private readonly grid = document.createElement('div');
  private readonly chips = new Map<Chip, HTMLButtonElement>();
  private readonly chosen = new Set<Chip>(atFirst);
  private readonly xy = new XyPlot();
  private charts: TimePlot[] = [];
  private runs: ShownRun[] = [];
  private body = 0;
  private time = 0;
  private isDifference = false;
  private isDue = false; // something was to show while there was no room
  private theme = readTheme();

  constructor(
    private readonly root: HTMLElement,
    private readonly onTime: (time: number) => void,
  ) {
    root.classList.add('plots');
    this.bar.className = 'plots-bar';
    this.bar.setAttribute('role', 'group');
    this.bar.setAttribute('aria-label', 'Plots');
    this.note.className = 'plots-note';
    this.note.setAttribute('role', 'status');
    this.note.hidden = true;
    this.grid.className = 'plots-grid';
    root.append(this.bar, this.note, this.grid);
    for (const name of [...groups, 'XY'] as Chip[]) this.addChip(name);
    new ResizeObserver(() => this.resize()).observe(root);
  }

  show(runs: ShownRun[], body: number): void {
    this.runs = runs;
    this.body = body;
    this.update();
  }

  setTime(time: number): void {
    this.time = time;
    if (this.root.clientWidth === 0) return;
    for (const chart of this.charts) chart.setTime(time);
    if (this.chosen.has('XY')) this.xy.setTime(time);
  }

  // A - B in place of the values, where there are two runs.
  setDifference(on: boolean): void {
    this.isDifference = on;
    this.update();
  }

  refreshTheme(): void {
    this.theme = readTheme();
    this.update();
  }

  // The numbers on show, by `${label}.${key}`.
  plotted(): Record<string, Float64Array> {
    const lines = this.plots().flatMap((plot) => plot.lines);
    const times = this.runs.map(({ label, run }) => [`${label}.time`, run.trajectory.time] as const);
    return {
      ...Object.fromEntries([...times, ...lines.map((line) => [line.key, line.values] as const)]),
      ...(this.chosen.has('XY') ? this.xy.plotted() : {}),
    };
  }

  drawing(): Drawing {
    const charts = [...this.plots().map(chartOf), ...(this.chosen.has('XY') ? [this.xy.chart()] : [])];
    const columns = charts.length > 1 ? 2 : 1;
    const rows = Math.max(Math.ceil(charts.length / columns), 1);
    const draw = (pen: Pen, width: number, height: number): void => {
      const box = { width: width / columns, height: height / rows };
      charts.forEach((chart, i) => {
        const [left, top] = [(i % columns) * box.width, Math.floor(i / columns) * box.height];
        drawChart(pen, { ...box, left, top }, chart, this.theme);
      });
    };
    return { width: 520 * columns, height: 280 * rows, draw };
  }

  private plots(): Plot[] {
    const chosen = this.chosen as Set<Group>;
    const [a, b] = this.runs;
    const isPossible = a && b && whyNoDifference(a.run, b.run) === '';
    return this.isDifference && isPossible
      ? differencesOf(a, b, this.body, chosen, this.theme)
      : plotsOf(this.runs, this.body, chosen, this.theme);
  }

  private update(): void {
    this.isDue = this.root.clientWidth === 0;
    if (this.isDue || this.runs.length === 0) return;
    const available = new Set<Chip>([...availableGroups(this.runs, this.body), 'XY']);
    for (const [name, chip] of this.chips) chip.hidden = !available.has(name);
    const plots = this.plots();
    this.note.textContent = this.remark(plots);
    this.note.hidden = this.note.textContent === '';
    this.place(plots);
    if (this.chosen.has('XY')) {
      if (this.xy.figure.parentElement !== this.grid) this.grid.append(this.xy.figure);
      this.xy.show(this.runs, this.body, this.theme);
    } else this.xy.figure.remove();
    this.setTime(this.time);
  }

  // What is missing of a difference, and why.
  private remark(plots: Plot[]): string {
    const [a, b] = this.runs;
    if (!this.isDifference || !a || !b) return '';
    const missing = groups.filter((group) => this.chosen.has(group) && !plots.some((plot) => plot.id.startsWith(`${group}/`)));
    const remark = missing.map((group) => `No difference of ${group}: the runs have no such quantity in common.`).join(' ');
    return whyNoDifference(a.run, b.run) || remark;
  }

  // Charts that fit are kept: only their numbers change.
  private place(plots: Plot[]): void {
    const old = this.charts;
    this.charts = plots.map(
      (plot) => old.find((chart) => chart.fits(plot)) ?? new TimePlot(plot, this.theme, this.onTime),
    );
    for (const chart of old) if (!this.charts.includes(chart)) chart.destroy();
    this.charts.forEach((chart, i) => {
      const there = this.grid.children[i] ?? null;
      if (there !== chart.figure) this.grid.insertBefore(chart.figure, there);
    });
    const times = commonTimes(this.runs.map(({ run }) => run));
    this.charts.forEach((chart, i) => chart.show(plots[i] as Plot, times, this.theme));
  }

  private resize(): void {
    if (this.isDue) this.update();
    for (const chart of this.charts) chart.resize();
    if (this.chosen.has('XY')) this.xy.draw();
    this.setTime(this.time);
  }

  private addChip(name: Chip): void {
    const chip = document.createElement('button');
    chip.type = 'button';
    chip.className = 'plots-chip';
    chip.textContent = name;
    chip.setAttribute('aria-pressed', String(this.chosen.has(name)));
    chip.addEventListener('click', () => {
      if (!this.chosen.delete(name)) this.chosen.add(name);
      chip.setAttribute('aria-pressed', String(this.chosen.has(name)));
      this.update();
    });
    this.chips.set(name, chip);
    this.bar.append(chip);
  }
}
