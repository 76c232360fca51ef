// A chart drawn with a pen: for files, and for one quantity over another.
import { number } from './format';
import type { Pen } from './pen';
import { font, type Theme } from './theme';

export interface Curve {
  label: string;
  x: Float64Array;
  y: Float64Array;
  colour: string;
  isDashed: boolean;
  marked: number; // the sample with a dot; -1: none
}
export interface Chart {
  title: string;
  xLabel: string;
  yLabel: string;
  curves: Curve[];
}
export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}
export type Interval = [number, number];

// The least and the largest of all that is finite; null if nothing is.
export function rangeOf(arrays: Float64Array[]): Interval | null {
  let low = Infinity;
  let high = -Infinity;
  for (const values of arrays) {
    for (const value of values) {
      if (value < low && value !== -Infinity) low = value;
      if (value > high && value !== Infinity) high = value;
    }
  }
  return low <= high ? [low, high] : null;
}

// An interval with a margin, that is never empty.
export function padded(range: Interval | null): Interval {
  const [low, high] = range ?? [0, 1];
  const margin = high > low ? 0.06 * (high - low) : 0.1 * Math.abs(low) || 1;
  return [low - margin, high + margin];
}

// Round numbers of an interval, at most about `count`.
export function ticks([low, high]: Interval, count: number): number[] {
  const span = high - low;
  if (!(span > 0) || !Number.isFinite(span)) return [];
  const power = 10 ** Math.floor(Math.log10(span / count));
  const step = power * ([1, 2, 5].find((factor) => factor * power * count >= span) ?? 10);
  const first = Math.ceil(low / step);
  const last = Math.floor(high / step);
  return Array.from({ length: Math.max(last - first + 1, 0) }, (_, i) => (first + i) * step);
}

// As many digits as tell ticks apart.
export function tickLabels(values: number[]): string[] {
  const step = values.length > 1 ? Math.abs((values[1] as number) - (values[0] as number)) : 0;
  const largest = Math.max(...values.map(Math.abs), 0);
  const digits = step > 0 && largest > 0 ? Math.ceil(Math.log10(largest / step)) + 2 : 4;
  const tiny = 1e-9 * step;
  return values.map((value) => number(Math.abs(value) < tiny ? 0 : value, Math.min(Math.max(digits, 3), 15)));
}

const fontSize = 12;
const lineHeight = 16;

interface Frame {
  area: Box;
  x: (value: number) => number;
  y: (value: number) => number;
}

function drawAxes(pen: Pen, { left, top, width, height }: Box, chart: Chart, theme: Theme, legendHeight: number): Frame {
  const xRange = padded(rangeOf(chart.curves.map((curve) => curve.x)));
  const yRange = padded(rangeOf(chart.curves.map((curve) => curve.y)));
  const yTicks = ticks(yRange, Math.max(2, Math.floor(height / 40)));
  const yTexts = tickLabels(yTicks);
  const gutter = 12 + 6.6 * Math.max(...yTexts.map((text) => text.length), 1);
  const header = lineHeight + 8 + legendHeight;
  const area = { left: left + gutter, top: top + header, width: width - gutter - 12, height: height - header - 40 };
  const x = (value: number): number => area.left + ((value - xRange[0]) / (xRange[1] - xRange[0])) * area.width;
  const y = (value: number): number => area.top + area.height - ((value - yRange[0]) / (yRange[1] - yRange[0])) * area.height;
  const xTicks = ticks(xRange, Math.max(2, Math.floor(area.width / 70)));
  pen.strokeStyle = theme.grid;
  pen.lineWidth = 1;
  pen.setLineDash([]);
  pen.beginPath();
  for (const tick of xTicks) {
    pen.moveTo(x(tick), area.top);
    pen.lineTo(x(tick), area.top + area.height);
  }
  for (const tick of yTicks) {
    pen.moveTo(area.left, y(tick));
    pen.lineTo(area.left + area.width, y(tick));
  }
  pen.stroke();
  pen.strokeStyle = theme.muted;
  pen.beginPath();
  pen.moveTo(area.left, area.top);
  pen.lineTo(area.left, area.top + area.height);
  pen.lineTo(area.left + area.width, area.top + area.height);
  pen.stroke();
  pen.fillStyle = theme.muted;
  pen.font = font(fontSize);
  pen.textAlign = 'right';
  pen.textBaseline = 'middle';
  yTicks.forEach((tick, i) => pen.fillText(yTexts[i] as string, area.left - 6, y(tick)));
  pen.textAlign = 'center';
  pen.textBaseline = 'top';
  const below = area.top + area.height;
  const xTexts = tickLabels(xTicks);
  xTicks.forEach((tick, i) => pen.fillText(xTexts[i] as string, x(tick), below + 5));
  pen.fillStyle = theme.ink;
  pen.textAlign = 'right';
  pen.fillText(chart.xLabel, area.left + area.width, below + 22);
  return { area, x, y };
}

function drawTitle(pen: Pen, { left, top, width }: Box, chart: Chart, theme: Theme): void {
  pen.fillStyle = theme.ink;
  pen.textBaseline = 'top';
  pen.textAlign = 'left';
  pen.font = font(fontSize + 1, '600');
  pen.fillText(chart.title, left + 8, top + 4);
  pen.font = font(fontSize);
  pen.textAlign = 'right';
  pen.fillText(chart.yLabel, left + width - 12, top + 4);
}

interface Entry {
  curve: Curve;
  left: number;
  row: number;
}

// Where the names of the curves stand, in as many rows as they need.
function legendOf(chart: Chart, width: number): Entry[] {
  const entries: Entry[] = [];
  let left = 0;
  let row = 0;
  for (const curve of chart.curves.length > 1 ? chart.curves : []) {
    const needed = 40 + 6.6 * curve.label.length;
    if (left > 0 && left + needed > width) {
      left = 0;
      ++row;
    }
    entries.push({ curve, left, row });
    left += needed;
  }
  return entries;
}

function drawLegend(pen: Pen, left: number, top: number, entries: Entry[], theme: Theme): void {
  pen.textAlign = 'left';
  pen.textBaseline = 'middle';
  for (const entry of entries) {
    const x = left + entry.left;
    const y = top + (entry.row + 0.5) * lineHeight;
    setLine(pen, entry.curve);
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(x + 20, y);
    pen.stroke();
    pen.fillStyle = theme.ink;
    pen.fillText(entry.curve.label, x + 25, y);
  }
}

function setLine(pen: Pen, curve: Curve): void {
  pen.strokeStyle = curve.colour;
  pen.fillStyle = curve.colour;
  pen.lineWidth = 1.6;
  pen.lineJoin = 'round';
  pen.setLineDash(curve.isDashed ? [6, 4] : []);
}

function dot(pen: Pen, x: number, y: number, radius: number): void {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fill();
}

// A line through what is finite; a dot where a number stands alone.
function drawCurve(pen: Pen, frame: Frame, curve: Curve): void {
  setLine(pen, curve);
  const isAt = (k: number): boolean => Number.isFinite(curve.x[k]) && Number.isFinite(curve.y[k]);
  const alone: number[] = [];
  pen.beginPath();
  for (let k = 0; k < curve.x.length; ++k) {
    if (!isAt(k)) continue;
    const [x, y] = [frame.x(curve.x[k] as number), frame.y(curve.y[k] as number)];
    if (isAt(k - 1)) pen.lineTo(x, y);
    else {
      pen.moveTo(x, y);
      if (!isAt(k + 1)) alone.push(k);
    }
  }
  pen.stroke();
  pen.setLineDash([]);
  for (const k of alone) dot(pen, frame.x(curve.x[k] as number), frame.y(curve.y[k] as number), 2);
}

export function drawChart(pen: Pen, box: Box, chart: Chart, theme: Theme): void {
  const entries = legendOf(chart, box.width - 20);
  const legendHeight = entries.length > 0 ? ((entries.at(-1) as Entry).row + 1) * lineHeight : 0;
  if (box.width < 80 || box.height < 80 + legendHeight) return;
  pen.save();
  drawTitle(pen, box, chart, theme);
  drawLegend(pen, box.left + 8, box.top + lineHeight + 6, entries, theme);
  const frame = drawAxes(pen, box, chart, theme, legendHeight);
  for (const curve of chart.curves) drawCurve(pen, frame, curve);
  for (const { x, y, marked, colour } of chart.curves) {
    if (!Number.isFinite(x[marked]) || !Number.isFinite(y[marked])) continue;
    const at = [frame.x(x[marked] as number), frame.y(y[marked] as number)] as const;
    pen.fillStyle = theme.paper;
    dot(pen, ...at, 6);
    pen.fillStyle = colour;
    dot(pen, ...at, 4.5);
  }
  pen.restore();
}

// One quantity over another on paper of its own.
export function drawXy(pen: Pen, width: number, height: number, chart: Chart, theme: Theme): void {
  pen.fillStyle = theme.paper;
  pen.beginPath();
  pen.rect(0, 0, width, height);
  pen.fill();
  drawChart(pen, { left: 0, top: 0, width, height }, chart, theme);
}
