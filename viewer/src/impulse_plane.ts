// The plane of the impulses of one contact: P_t to the right, P_n up, in equal scales, so that the cone has its angle.
import type { ImpulsePlane } from 'tumble-engine';
import { number, withUnit } from './format';
import { arrow, type Pen } from './pen';
import { font, type Theme } from './theme';

export type Point = [number, number]; // (P_t, P_n) [N s], or pixels

// t P_t + n P_n + u = 0
export interface Line {
  t: number;
  n: number;
  u: number;
}

export interface PlaneLines {
  compression: Line;
  restitution: Line;
  sticking: Line;
}

export function planeLines(plane: ImpulsePlane): PlaneLines {
  const { A_nn, A_nt, A_tt, u_n, u_t, u_n_target } = plane;
  return {
    compression: { t: A_nt, n: A_nn, u: u_n },
    restitution: { t: A_nt, n: A_nn, u: u_n - u_n_target },
    sticking: { t: A_tt, n: A_nt, u: u_t },
  };
}

// Velocities are told apart down to this part of the largest that occurs.
const relativeTolerance = 1e-6;

function isOn(line: Line, [P_t, P_n]: Point): boolean {
  const size = Math.abs(line.t * P_t) + Math.abs(line.n * P_n) + Math.abs(line.u);
  return Math.abs(line.t * P_t + line.n * P_n + line.u) <= relativeTolerance * size;
}

// Where nothing bounces, both are one line.
export function bounces(plane: ImpulsePlane): boolean {
  return Math.abs(plane.u_n_target) > relativeTolerance * Math.abs(plane.u_n);
}

function crossing(a: Line, b: Line): Point {
  const determinant = a.t * b.n - a.n * b.t;
  return [(a.n * b.u - b.n * a.u) / determinant, (b.t * a.u - a.t * b.u) / determinant];
}

export interface Range {
  t: [number, number];
  n: [number, number];
}

// All that is to be seen, with a margin: origin, solution, and the crossings of lines, cone and axes that are not far.
export function planeRange(plane: ImpulsePlane): Range {
  const { compression, restitution, sticking } = planeLines(plane);
  const solution: Point = [plane.P_t, plane.P_n];
  const edges = [-plane.friction, plane.friction].map((slope) => ({ t: 1, n: -slope, u: 0 }));
  const axis: Line = { t: 1, n: 0, u: 0 };
  const alone = [crossing(compression, axis), crossing(restitution, axis)];
  const sizes = [solution, ...alone].map((p) => Math.hypot(...p)).filter((size) => Number.isFinite(size) && size > 0);
  const size = sizes.length > 0 ? Math.max(...sizes) : Math.abs(plane.u_t / plane.A_tt) || 1;
  const crossings = [...alone, crossing(sticking, { t: 0, n: 1, u: 0 })];
  for (const line of [compression, restitution]) crossings.push(crossing(line, sticking));
  for (const edge of edges) {
    for (const line of [compression, restitution, sticking]) crossings.push(crossing(line, edge));
  }
  const isNear = ([P_t, P_n]: Point): boolean => Math.hypot(P_t, P_n) <= 2.5 * size && P_n >= -0.1 * size;
  const points: Point[] = [[0, 0], solution, ...crossings.filter(isNear)];
  const range = (values: number[]): [number, number] => [Math.min(...values), Math.max(...values)];
  const [t, n] = [range(points.map((p) => p[0])), range(points.map((p) => p[1]))];
  const margin = 0.14 * Math.max(t[1] - t[0], n[1] - n[0], 0.5 * size);
  return { t: [t[0] - margin, t[1] + margin], n: [n[0] - margin, n[1] + margin] };
}

// Grown to the shape of the picture, about its middle.
export function fitted({ t, n }: Range, width: number, height: number): Range {
  const scale = Math.max((t[1] - t[0]) / width, (n[1] - n[0]) / height);
  const around = ([from, to]: [number, number], length: number): [number, number] => {
    const extra = 0.5 * (length - (to - from));
    return [from - extra, to + extra];
  };
  return { t: around(t, scale * width), n: around(n, scale * height) };
}

export function ticks([from, to]: [number, number], about: number): number[] {
  const raw = (to - from) / about;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = ([1, 2, 5, 10].find((k) => k * power >= raw) ?? 10) * power;
  if (!(step > 0)) return [];
  const values: number[] = [];
  for (let k = Math.ceil(from / step); k * step <= to; ++k) values.push(Number((k * step).toPrecision(12)));
  return values;
}

const superscript = (power: number): string =>
  String(power).replace(/./g, (c) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(c)] ?? '⁻');

// Ticks stay short: very small and very large impulses are counted in a power of ten.
export function axisUnit({ t, n }: Range): { size: number; text: string } {
  const power = Math.floor(Math.log10(Math.max(...[...t, ...n].map(Math.abs))));
  if (power >= -2 && power < 4) return { size: 1, text: 'N s' };
  return { size: Number(`1e${power}`), text: `10${superscript(power)} N s` };
}

// Where nothing bounces, the target is what closes the gap.
const targetName = (plane: ImpulsePlane): string => (plane.u_n_target > 0 ? 'restitution' : 'gap closes');

// What there is to see, in one sentence.
export function planeWords(plane: ImpulsePlane): string {
  const { P_t, P_n, friction } = plane;
  const P: Point = [P_t, P_n];
  const solution = `P_t = ${withUnit(P_t, 'N s', 3)}, P_n = ${withUnit(P_n, 'N s', 3)}`;
  if (P_n === 0) return `Impulse plane: the solution is the origin, no impulse is needed (mu = ${number(friction, 3)}).`;
  const { compression, restitution, sticking } = planeLines(plane);
  const slack = friction * P_n - Math.abs(P_t);
  const cone = slack > relativeTolerance * friction * P_n ? 'inside' : 'on the edge of';
  const on = [
    isOn(restitution, P) && (bounces(plane) ? `the line of its target (${targetName(plane)})` : 'the line where compression ends'),
    bounces(plane) && isOn(compression, P) && 'the line where compression ends',
    isOn(sticking, P) && 'the line of sticking',
  ].filter(Boolean);
  const where = on.length > 0 ? ` and on ${on.join(' and ')}` : '';
  return `Impulse plane: the solution, ${solution}, lies ${cone} the friction cone (mu = ${number(friction, 3)})${where}.`;
}

interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}
type Segment = [number, number, number, number];

// The part of a segment in a box.
function clipped([x0, y0, x1, y1]: Segment, box: Box): Segment | null {
  let [from, to] = [0, 1];
  for (const [start, change, low, high] of [
    [x0, x1 - x0, box.left, box.right],
    [y0, y1 - y0, box.top, box.bottom],
  ] as const) {
    if (Math.abs(change) < 1e-9) {
      if (start < low || start > high) return null;
      continue;
    }
    const [a, b] = [(low - start) / change, (high - start) / change];
    from = Math.max(from, Math.min(a, b));
    to = Math.min(to, Math.max(a, b));
  }
  if (from >= to) return null;
  return [x0 + from * (x1 - x0), y0 + from * (y1 - y0), x0 + to * (x1 - x0), y0 + to * (y1 - y0)];
}

// A segment that is longer than the range.
function long(line: Line, { t, n }: Range): [Point, Point] {
  const norm = line.t ** 2 + line.n ** 2;
  const middle: Point = [0.5 * (t[0] + t[1]), 0.5 * (n[0] + n[1])];
  const off = (line.t * middle[0] + line.n * middle[1] + line.u) / norm;
  const foot: Point = [middle[0] - off * line.t, middle[1] - off * line.n];
  const reach = (t[1] - t[0] + n[1] - n[0]) / Math.sqrt(norm);
  return [
    [foot[0] - reach * line.n, foot[1] + reach * line.t],
    [foot[0] + reach * line.n, foot[1] - reach * line.t],
  ];
}

interface Label {
  text: string;
  colour: string;
  at: Segment; // along which it may stand
}

const textSize = 12;
const letterWidth = 0.64; // [textSize], of a wide bold font: a pen does not measure text

// Beside its segment, where it covers least; null if nothing fits.
function placed(label: Label, area: Box, labels: Box[], segments: Segment[], axes: Segment[]): Box | null {
  const [width, height] = [letterWidth * textSize * label.text.length, textSize + 2];
  const [x0, y0, x1, y1] = label.at;
  let best: Box | null = null;
  let least = Infinity;
  for (let k = 0; k <= 24; ++k) {
    const along = k / 24;
    const [x, y] = [x0 + along * (x1 - x0), y0 + along * (y1 - y0)];
    for (const dx of [5, -width - 5, -width / 2]) {
      for (const dy of [-height - 4, 4, -height / 2]) {
        const box = { left: x + dx, right: x + dx + width, top: y + dy, bottom: y + dy + height };
        if (box.left < area.left || box.right > area.right || box.top < area.top || box.bottom > area.bottom) continue;
        const overlaps = labels.filter(
          (other) =>
            box.left < other.right && other.left < box.right && box.top < other.bottom && other.top < box.bottom,
        ).length;
        const covers = segments.filter((segment) => clipped(segment, box)).length;
        const crosses = axes.filter((segment) => clipped(segment, box)).length;
        const cost = 100 * overlaps + 10 * covers + 3 * crosses + Math.abs(along - 0.75);
        if (cost < least) [best, least] = [box, cost];
      }
    }
  }
  return least < 100 ? best : null;
}

function drawLabels(
  pen: Pen,
  labels: Label[],
  area: Box,
  segments: Segment[],
  axes: Segment[],
  theme: Theme,
): void {
  const boxes: Box[] = [];
  pen.font = font(textSize, '600');
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  for (const label of labels) {
    const box = placed(label, area, boxes, segments, axes);
    if (!box) continue;
    boxes.push(box);
    pen.save();
    pen.globalAlpha = 0.8;
    pen.fillStyle = theme.paper;
    pen.beginPath();
    pen.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    pen.fill();
    pen.restore();
    pen.fillStyle = label.colour;
    pen.fillText(label.text, (box.left + box.right) / 2, (box.top + box.bottom) / 2);
  }
}

type Map2 = (p: Point) => Point;

function drawAxes(pen: Pen, range: Range, area: Box, at: Map2, theme: Theme): void {
  const unit = axisUnit(range);
  const tick = (value: number): string => number(value / unit.size, 3);
  pen.font = font(11);
  pen.lineWidth = 1;
  pen.setLineDash([]);
  const rule = (value: number, x0: number, y0: number, x1: number, y1: number): void => {
    pen.strokeStyle = value === 0 ? theme.muted : theme.grid;
    pen.beginPath();
    pen.moveTo(x0, y0);
    pen.lineTo(x1, y1);
    pen.stroke();
  };
  pen.fillStyle = theme.muted;
  pen.textAlign = 'center';
  pen.textBaseline = 'top';
  for (const value of ticks(range.t, (area.right - area.left) / 65)) {
    const x = at([value, 0])[0];
    rule(value, x, area.top, x, area.bottom);
    pen.fillText(tick(value), x, area.bottom + 4);
  }
  pen.textAlign = 'right';
  pen.textBaseline = 'middle';
  for (const value of ticks(range.n, (area.bottom - area.top) / 45)) {
    const y = at([0, value])[1];
    rule(value, area.left, y, area.right, y);
    pen.fillText(tick(value), area.left - 5, y);
  }
  pen.fillStyle = theme.ink;
  pen.textBaseline = 'top';
  pen.fillText(`Pₜ [${unit.text}]`, area.right, area.bottom + 19);
  pen.textAlign = 'left';
  pen.fillText(`Pₙ [${unit.text}]`, 4, 2);
}

function drawCone(pen: Pen, friction: number, range: Range, at: Map2, theme: Theme): Segment[] {
  const height = 2 * Math.max(range.n[1], 0);
  const [tip, left, right] = [at([0, 0]), at([-friction * height, height]), at([friction * height, height])];
  pen.beginPath();
  pen.moveTo(...left);
  pen.lineTo(...tip);
  pen.lineTo(...right);
  pen.save();
  pen.globalAlpha = 0.14;
  pen.fillStyle = theme.muted;
  pen.fill();
  pen.restore();
  pen.strokeStyle = theme.muted;
  pen.lineWidth = 1;
  pen.setLineDash([]);
  pen.stroke();
  return [
    [...tip, ...left],
    [...tip, ...right],
  ];
}

function drawSolution(pen: Pen, from: Point, to: Point, theme: Theme): void {
  pen.strokeStyle = theme.ink;
  pen.fillStyle = theme.ink;
  arrow(pen, ...from, ...to, 2);
  pen.beginPath();
  pen.arc(...to, 4.5, 0, 2 * Math.PI);
  pen.fill();
  pen.beginPath();
  pen.arc(...to, 1.8, 0, 2 * Math.PI);
  pen.fillStyle = theme.paper;
  pen.fill();
}

function styles(plane: ImpulsePlane, theme: Theme): { line: Line; name: string; colour: string; dash: number[] }[] {
  const { compression, restitution, sticking } = planeLines(plane);
  const isOne = !bounces(plane);
  const stick = { line: sticking, name: 'sticking', colour: theme.stick, dash: [2, 4] };
  const end = { line: compression, name: isOne ? 'compression ends' : 'compression', colour: theme['body-deep'], dash: [] };
  if (isOne) return [end, stick];
  return [end, { line: restitution, name: targetName(plane), colour: theme['other-deep'], dash: [8, 4] }, stick];
}

export function drawImpulsePlane(pen: Pen, width: number, height: number, plane: ImpulsePlane, theme: Theme): void {
  const area: Box = { left: 46, top: 20, right: width - 10, bottom: height - 36 };
  const range = fitted(planeRange(plane), area.right - area.left, area.bottom - area.top);
  const scale = (area.right - area.left) / (range.t[1] - range.t[0]);
  const at: Map2 = ([P_t, P_n]) => [area.left + scale * (P_t - range.t[0]), area.bottom - scale * (P_n - range.n[0])];
  pen.save();
  pen.fillStyle = theme.paper;
  pen.beginPath();
  pen.rect(0, 0, width, height);
  pen.fill();
  drawAxes(pen, range, area, at, theme);
  pen.save();
  pen.beginPath();
  pen.rect(area.left, area.top, area.right - area.left, area.bottom - area.top);
  pen.clip();
  const cone = drawCone(pen, plane.friction, range, at, theme);
  const segments = [...cone];
  const labels: Label[] = [];
  const outside: string[] = [];
  pen.lineCap = 'round';
  for (const { line, name, colour, dash } of styles(plane, theme)) {
    const [from, to] = long(line, range).map(at) as [Point, Point];
    const segment = clipped([...from, ...to], area);
    if (!segment) {
      outside.push(name);
      continue;
    }
    pen.strokeStyle = colour;
    pen.lineWidth = 2;
    pen.setLineDash(dash);
    pen.beginPath();
    pen.moveTo(segment[0], segment[1]);
    pen.lineTo(segment[2], segment[3]);
    pen.stroke();
    segments.push(segment);
    labels.push({ text: name, colour, at: segment });
  }
  const [origin, solution] = [at([0, 0]), at([plane.P_t, plane.P_n])];
  drawSolution(pen, origin, solution, theme);
  segments.push([...origin, ...solution]);
  labels.push({ text: 'P', colour: theme.ink, at: [...solution, ...solution] });
  const edge = clipped(cone[1] as Segment, area);
  if (edge) labels.push({ text: plane.friction > 0 ? 'friction cone' : 'no friction', colour: theme.muted, at: edge });
  pen.restore();
  const axes: Segment[] = [
    [area.left, origin[1], area.right, origin[1]],
    [origin[0], area.top, origin[0], area.bottom],
  ];
  drawLabels(pen, labels.reverse(), area, segments, axes, theme);
  if (outside.length > 0) {
    pen.font = font(11);
    pen.fillStyle = theme.muted;
    pen.textAlign = 'right';
    pen.textBaseline = 'top';
    pen.fillText(`outside: ${outside.join(', ')}`, area.right, 3);
  }
  pen.restore();
}
