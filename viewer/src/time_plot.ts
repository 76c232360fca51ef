// One chart over time, with its legend.
import uPlot from 'uplot';
import { rangeOf, tickLabels, type Chart } from './chart';
import { number, withUnit } from './format';
import { aligned, lonely, type Aligned, type CommonTimes, type Line, type Plot } from './plot_lines';
import { font, type Theme } from './theme';

const height = 190;

type Tags = HTMLElementTagNameMap;

function element<Name extends keyof Tags>(name: Name, className: string, text = ''): Tags[Name] {
  const made = document.createElement(name);
  made.className = className;
  made.textContent = text;
  return made;
}

const structureOf = (plot: Plot): string => plot.lines.map((line) => `${line.label}|${line.isDashed}`).join(';');

export function chartOf(plot: Plot): Chart {
  return {
    title: `${plot.title} [${plot.unit}]`,
    xLabel: 'time [s]',
    yLabel: '',
    curves: plot.lines.map((line) => ({ ...line, x: line.run.trajectory.time, y: line.values, marked: -1 })),
  };
}

// For those who do not see the chart.
export function description(plot: Plot): string {
  const lines = plot.lines.map((line) => {
    const range = rangeOf([line.values]);
    if (!range) return `${line.label}: nowhere`;
    return `${line.label} from ${number(range[0])} to ${withUnit(range[1], plot.unit)}`;
  });
  const end = Math.max(...plot.lines.map((line) => line.run.duration));
  return `${plot.title} over ${withUnit(end, 's')}: ${lines.join('; ')}`;
}

export class TimePlot {
  readonly figure = element('figure', 'plot');
  private readonly place = element('div', 'plot-place');
  private readonly legend = element('div', 'plot-legend');
  private readonly now = element('div', 'plot-now');
  private readonly structure: string;
  private values: HTMLOutputElement[] = [];
  private marks: HTMLElement[] = [];
  private chart: uPlot | null = null;
  private width = 0;
  private time = 0;

  constructor(
    private plot: Plot,
    private theme: Theme,
    private readonly onTime: (time: number) => void,
  ) {
    this.structure = structureOf(plot);
    const caption = element('figcaption', '');
    caption.append(element('span', 'plot-title', `${plot.title} [${plot.unit}]`), this.legend);
    for (const line of plot.lines) this.addEntry(line);
    this.place.setAttribute('role', 'img');
    this.figure.append(caption, this.place);
  }

  get id(): string {
    return this.plot.id;
  }

  // Whether the plot has the lines of this chart: then `show` takes it.
  fits(plot: Plot): boolean {
    return plot.id === this.plot.id && plot.title === this.plot.title && structureOf(plot) === this.structure;
  }

  // After the figure is on the page. The times are common to all charts.
  show(plot: Plot, times: CommonTimes, theme: Theme): void {
    const data: uPlot.AlignedData = [times.time, ...plot.lines.map((line) => aligned(line, times))];
    this.plot = plot;
    this.theme = theme;
    this.place.setAttribute('aria-label', description(plot));
    plot.lines.forEach((line, i) => ((this.marks[i] as HTMLElement).style.borderColor = line.colour));
    if (this.chart) this.chart.setData(data);
    else this.create(data);
    this.resize();
  }

  // A time in all lines' runs.
  setTime(time: number): void {
    this.time = time;
    this.plot.lines.forEach((line, i) => {
      const isOver = time > line.run.duration + 1e-9;
      const value = isOver ? NaN : (line.values[line.run.sampleAt(time)] as number);
      const text = Number.isNaN(value) ? number(value) : withUnit(value, this.plot.unit);
      const output = this.values[i] as HTMLOutputElement;
      if (output.textContent !== text) output.textContent = text;
    });
    if (this.chart) this.placeNow(this.chart);
  }

  resize(): void {
    const width = this.place.clientWidth;
    if (width === this.width || width === 0) return;
    this.width = width;
    this.chart?.setSize({ width, height });
  }

  destroy(): void {
    this.chart?.destroy();
    this.figure.remove();
  }

  private addEntry(line: Line): void {
    const entry = element('span', line.isDashed ? 'plot-entry dashed' : 'plot-entry');
    const mark = element('i', '');
    const value = element('output', '');
    // The value changes all the time: no announcements.
    value.setAttribute('aria-live', 'off');
    entry.append(mark, `${line.label} `, value);
    this.legend.append(entry);
    this.marks.push(mark);
    this.values.push(value);
  }

  private placeNow(chart: uPlot): void {
    const x = chart.valToPos(this.time, 'x');
    const isInside = x >= -1 && x <= chart.bbox.width / uPlot.pxRatio + 1;
    this.now.style.visibility = isInside ? '' : 'hidden';
    if (isInside) this.now.style.transform = `translateX(${Math.round(x)}px)`;
  }

  private axis(): uPlot.Axis {
    const grid = { stroke: (): string => this.theme.grid, width: 1 };
    return {
      stroke: () => this.theme.muted,
      font: font(12),
      grid,
      ticks: { ...grid, size: 4 },
      values: (_, splits) => tickLabels(splits),
    };
  }

  private series(i: number): uPlot.Series {
    const colour = (): string => (this.plot.lines[i] as Line).colour;
    return {
      stroke: colour,
      width: 1.6,
      pxAlign: 0,
      ...(this.plot.lines[i]?.isDashed ? { dash: [6, 4] } : {}),
      points: {
        show: true,
        size: 4,
        stroke: colour,
        fill: colour,
        filter: (chart, series) => lonely(chart.data[series] as Aligned),
      },
    };
  }

  private create(data: uPlot.AlignedData): void {
    this.width = this.place.clientWidth;
    const options: uPlot.Options = {
      width: this.width,
      height,
      legend: { show: false },
      cursor: { show: false },
      scales: {
        x: { time: false, range: (_, low, high) => [low, high > low ? high : low + 1] },
        // What is 0 all the time would get a scale up to 100.
        y: { range: (_, low, high) => (low === 0 && high === 0 ? [-1, 1] : uPlot.rangeNum(low, high, 0.1, true)) },
      },
      axes: [
        { ...this.axis(), size: 28 },
        { ...this.axis(), size: (_, texts) => 14 + 7 * Math.max(...(texts ?? []).map((text) => text.length), 3) },
      ],
      series: [{}, ...this.plot.lines.map((_, i) => this.series(i))],
      padding: [8, 12, 0, 0],
      // Scales follow data only when the chart is drawn.
      hooks: { draw: [(chart) => this.placeNow(chart)] },
    };
    this.chart = new uPlot(options, data, this.place);
    const over = this.chart.over;
    over.append(this.now);
    const follow = (event: PointerEvent): void => {
      const chart = this.chart as uPlot;
      const time = chart.posToVal(event.clientX - over.getBoundingClientRect().left, 'x');
      const end = Math.max(...this.plot.lines.map((line) => line.run.duration));
      if (Number.isFinite(time)) this.onTime(Math.min(Math.max(time, 0), end));
    };
    over.addEventListener('pointerdown', (event) => {
      over.setPointerCapture(event.pointerId);
      follow(event);
    });
    // A mouse leads without a press; a finger that only scrolls does not, nor a page that scrolls below the mouse.
    over.addEventListener('pointermove', (event) => {
      if (event.movementX === 0 && event.movementY === 0) return;
      if (event.pointerType === 'mouse' || over.hasPointerCapture(event.pointerId)) follow(event);
    });
  }
}
