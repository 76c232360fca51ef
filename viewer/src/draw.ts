// The picture of a run at a time. Live runs, recorded ones, films and SVG files are all drawn here.
import type { Triple } from 'tumble-engine';
import { number } from './format';
import { isRound, outlinesOf, type Outline } from './outline';
import { arrow, type Pen } from './pen';
import type { Run } from './run';
import { font, modeColours, type Theme } from './theme';
import { radiusOf, type View } from './view';

export interface Layer {
  run: Run;
  sample: number;
  isOther: boolean; // the second of two runs
  label: string;
}

export interface DrawOptions {
  ghosts: boolean;
  contacts: boolean;
  selected: number; // body
  fade: number; // [s] for which a contact stays to be seen while playing; 0: only that of the step shown
}

interface Shapes {
  outlines: Outline[][];
  radii: number[];
  largestImpulse: number;
}

const shapes = new WeakMap<Run, Shapes>();

function shapesOf(run: Run): Shapes {
  let found = shapes.get(run);
  if (!found) {
    let largestImpulse = 0;
    const { contact_normal_impulse: normal, contact_friction_impulse: friction } = run.trajectory;
    for (let i = 0; i < normal.length; ++i) {
      largestImpulse = Math.max(largestImpulse, Math.hypot(normal[i] as number, friction[i] as number));
    }
    found = {
      outlines: run.scene.bodies.map(outlinesOf),
      radii: run.scene.bodies.map((_, i) => radiusOf(run, i)),
      largestImpulse,
    };
    shapes.set(run, found);
  }
  return found;
}

export function drawPicture(pen: Pen, view: View, layers: Layer[], options: DrawOptions, theme: Theme): void {
  pen.save();
  pen.beginPath();
  pen.rect(view.left, 0, view.width, view.height);
  pen.clip();
  drawGrid(pen, view, theme);
  const first = layers[0];
  if (first) drawFixed(pen, view, first, theme);
  for (const layer of layers) {
    if (options.ghosts) drawGhosts(pen, view, layer, options, theme);
    drawBodies(pen, view, layer, options, theme);
  }
  if (options.contacts) for (const layer of layers) drawContacts(pen, view, layer, options, theme);
  pen.restore();
}

// ---- Grid ----

function step(view: View): number {
  const wanted = 80 / view.scale;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return power * ([1, 2, 5, 10].find((f) => f * power >= wanted) as number);
}

function drawGrid(pen: Pen, view: View, theme: Theme): void {
  const size = step(view);
  const [left, right] = [view.worldX(view.left), view.worldX(view.left + view.width)];
  const [bottom, top] = [view.worldY(view.height), view.worldY(0)];
  pen.setLineDash([]);
  pen.lineWidth = 1;
  pen.strokeStyle = theme.grid;
  pen.fillStyle = theme.muted;
  pen.font = font(11);
  pen.textBaseline = 'bottom';
  pen.textAlign = 'center';
  for (let i = Math.ceil(left / size); i * size <= right; ++i) {
    line(pen, view.toX(i * size), 0, view.toX(i * size), view.height);
    const margin = Math.min(view.toX(i * size) - view.left, view.left + view.width - view.toX(i * size));
    if (margin > 24) pen.fillText(number(i * size, 6), view.toX(i * size), view.height - 4);
  }
  pen.textBaseline = 'middle';
  pen.textAlign = 'left';
  for (let i = Math.ceil(bottom / size); i * size <= top; ++i) {
    line(pen, view.left, view.toY(i * size), view.left + view.width, view.toY(i * size));
    if (view.toY(i * size) < view.height - 24) pen.fillText(`${number(i * size, 6)} m`, view.left + 6, view.toY(i * size) - 8);
  }
}

function line(pen: Pen, x0: number, y0: number, x1: number, y1: number): void {
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.stroke();
}

// ---- Bodies ----

function trace(pen: Pen, view: View, points: number[], [x, y, angle]: Triple, isClosed: boolean): void {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  pen.beginPath();
  for (let i = 0; i < points.length; i += 2) {
    const [u, v] = [points[i] as number, points[i + 1] as number];
    const [px, py] = [view.toX(x + c * u - s * v), view.toY(y + s * u + c * v)];
    if (i === 0) pen.moveTo(px, py);
    else pen.lineTo(px, py);
  }
  if (isClosed) pen.closePath();
}

// Ground is solid on the right of its direction: a band of short lines there.
function drawGround(pen: Pen, view: View, points: number[], [x, y, angle]: Triple, theme: Theme): void {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  pen.strokeStyle = theme.ground;
  pen.lineWidth = 2;
  trace(pen, view, points, [x, y, angle], false);
  pen.stroke();
  pen.lineWidth = 1;
  pen.globalAlpha = 0.55;
  pen.beginPath();
  for (let i = 0; i + 3 < points.length; i += 2) {
    const ends = [points.slice(i, i + 2), points.slice(i + 2, i + 4)].map(([u = 0, v = 0]) => [
      view.toX(x + c * u - s * v),
      view.toY(y + s * u + c * v),
    ]) as [[number, number], [number, number]];
    hatch(pen, view, ends[0], ends[1]);
  }
  pen.stroke();
  pen.globalAlpha = 1;
}

function hatch(pen: Pen, view: View, [x0, y0]: [number, number], [x1, y1]: [number, number]): void {
  const length = Math.hypot(x1 - x0, y1 - y0);
  const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
  const [nx, ny] = [-uy, ux]; // to the right in the picture, whose y points down
  // Only the part that can be seen.
  const middle = (view.left + 0.5 * view.width - x0) * ux + (0.5 * view.height - y0) * uy;
  const reach = Math.hypot(view.width, view.height);
  const spacing = 9;
  for (let d = Math.max(0, Math.ceil((middle - reach) / spacing) * spacing); d < Math.min(length, middle + reach); d += spacing) {
    pen.moveTo(x0 + d * ux, y0 + d * uy);
    pen.lineTo(x0 + (d - 6) * ux + 8 * nx, y0 + (d - 6) * uy + 8 * ny);
  }
}

function drawFixed(pen: Pen, view: View, { run, sample }: Layer, theme: Theme): void {
  const { outlines } = shapesOf(run);
  run.scene.bodies.forEach((body, i) => {
    if (body.kind !== 'fixed') return;
    for (const outline of outlines[i] as Outline[]) drawFixedPart(pen, view, outline, run.poseAt(sample, i), theme);
  });
}

function drawFixedPart(pen: Pen, view: View, outline: Outline, pose: Triple, theme: Theme): void {
  if (outline.kind === 'ground') return drawGround(pen, view, outline.points, pose, theme);
  trace(pen, view, outline.points, pose, outline.kind === 'closed');
  pen.strokeStyle = theme.ground;
  pen.lineWidth = outline.kind === 'wall' ? 2.5 : 1.5;
  if (outline.kind === 'closed') {
    pen.fillStyle = theme.grid;
    pen.fill();
  }
  pen.stroke();
}

const colours = (layer: Layer, theme: Theme): { fill: string; deep: string } =>
  layer.isOther ? { fill: theme.other, deep: theme['other-deep'] } : { fill: theme.body, deep: theme['body-deep'] };

function drawBodies(pen: Pen, view: View, layer: Layer, options: DrawOptions, theme: Theme): void {
  const { run, sample } = layer;
  const { outlines, radii } = shapesOf(run);
  const { fill, deep } = colours(layer, theme);
  run.scene.bodies.forEach((body, i) => {
    if (body.kind === 'fixed') return;
    const pose = run.poseAt(sample, i);
    for (const outline of outlines[i] as Outline[]) {
      if (outline.kind === 'ground') {
        drawGround(pen, view, outline.points, pose, theme);
        continue;
      }
      trace(pen, view, outline.points, pose, outline.kind === 'closed');
      pen.fillStyle = body.kind === 'dynamic' ? fill : theme.grid;
      pen.globalAlpha = layer.isOther ? 0.5 : 1;
      if (outline.kind === 'closed') pen.fill();
      pen.globalAlpha = 1;
      pen.strokeStyle = body.kind === 'dynamic' ? deep : theme.ground;
      pen.lineWidth = i === options.selected ? 2 : 1.25;
      pen.setLineDash(layer.isOther ? [5, 3] : []);
      pen.stroke();
      pen.setLineDash([]);
    }
    drawMark(pen, view, pose, (radii[i] as number) * view.scale, isRound(body), deep);
  });
}

// What lets a rotation be read.
function drawMark(pen: Pen, view: View, [x, y, angle]: Triple, radius: number, isSpoke: boolean, colour: string): void {
  if (radius < 4) return;
  const [px, py] = [view.toX(x), view.toY(y)];
  const length = (isSpoke ? 1 : 0.45) * radius;
  pen.strokeStyle = colour;
  pen.fillStyle = colour;
  pen.lineWidth = 1.25;
  line(pen, px, py, px + length * Math.cos(angle), py - length * Math.sin(angle));
  pen.beginPath();
  pen.arc(px, py, Math.min(2.5, 0.2 * radius), 0, 2 * Math.PI);
  pen.fill();
}

// ---- Ghosts: where bodies were, at equal times, and their paths ----

function drawGhosts(pen: Pen, view: View, layer: Layer, options: DrawOptions, theme: Theme): void {
  const { run } = layer;
  const { outlines } = shapesOf(run);
  const { deep } = colours(layer, theme);
  const moving = run.scene.bodies.map((body, i) => ({ body, i })).filter(({ body }) => body.kind === 'dynamic');
  const shown = moving.length > 8 ? moving.filter(({ i }) => i === options.selected) : moving;
  const every = Math.max(1, Math.round(0.1 / Math.max(run.duration / Math.max(run.length - 1, 1), 1e-9)), Math.ceil(run.length / 60));
  pen.strokeStyle = deep;
  pen.lineWidth = 1;
  for (const { i } of shown) {
    pen.globalAlpha = 0.22;
    for (let k = 0; k < run.length; k += every) {
      for (const outline of outlines[i] as Outline[]) {
        trace(pen, view, outline.points, run.poseAt(k, i), outline.kind === 'closed');
        pen.stroke();
      }
    }
    pen.globalAlpha = 0.6;
    pen.setLineDash(layer.isOther ? [3, 3] : [1, 3]);
    drawPath(pen, view, run, i);
    pen.setLineDash([]);
    // The start is where the handles are.
    pen.globalAlpha = 0.8;
    pen.setLineDash([4, 3]);
    for (const outline of outlines[i] as Outline[]) {
      trace(pen, view, outline.points, run.poseAt(0, i), outline.kind === 'closed');
      pen.stroke();
    }
    pen.setLineDash([]);
    pen.globalAlpha = 1;
  }
}

function drawPath(pen: Pen, view: View, run: Run, body: number): void {
  pen.beginPath();
  let [lastX, lastY] = [NaN, NaN];
  for (let k = 0; k < run.length; ++k) {
    const [x, y] = run.poseAt(k, body);
    const [px, py] = [view.toX(x), view.toY(y)];
    if (k > 0 && Math.hypot(px - lastX, py - lastY) < 1) continue;
    if (k === 0) pen.moveTo(px, py);
    else pen.lineTo(px, py);
    [lastX, lastY] = [px, py];
  }
  pen.stroke();
}

// ---- Contacts: impulse, friction cone, slip ----

const mostArrows = 60; // of steps that fade; more are a fog, and slow

function count(run: Run, sample: number): number {
  const { first, last } = run.contactsOf(sample);
  return last - first;
}

function drawContacts(pen: Pen, view: View, layer: Layer, options: DrawOptions, theme: Theme): void {
  const { run, sample } = layer;
  const now = run.trajectory.time[sample] as number;
  let first = sample;
  let numDrawn = count(run, sample);
  while (first > 0 && now - (run.trajectory.time[first - 1] as number) < options.fade) {
    numDrawn += count(run, first - 1);
    if (numDrawn > mostArrows) break;
    --first;
  }
  for (let k = first; k <= sample; ++k) {
    const age = now - (run.trajectory.time[k] as number);
    const { first: from, last } = run.contactsOf(k);
    // Of many contacts at once, arrows alone.
    for (let row = from; row < last; ++row) {
      pen.globalAlpha = k === sample ? 1 : 0.5 * (1 - age / options.fade);
      drawContact(pen, view, layer, row, k === sample && last - from <= 6, theme);
    }
  }
  pen.globalAlpha = 1;
}

function drawContact(pen: Pen, view: View, layer: Layer, row: number, inFull: boolean, theme: Theme): void {
  const { run } = layer;
  const t = run.trajectory;
  const P_n = t.contact_normal_impulse[row] as number;
  const P_t = t.contact_friction_impulse[row] as number;
  const at = (array: Float64Array): [number, number] => [array[2 * row] as number, array[2 * row + 1] as number];
  const [nx, ny] = at(t.contact_normal);
  const [tx, ty] = [ny, -nx]; // the normal turned right
  // On the body that the arrow pushes: where they overlap, as in the document's model, the other surface is elsewhere.
  const pushesB = run.scene.bodies[t.contact_body_b[row] as number]?.kind === 'dynamic';
  const [x, y] = at(pushesB ? t.contact_point_b : t.contact_point_a);
  const [px, py] = [view.toX(x), view.toY(y)];
  const colour = modeColours(theme)[t.contact_mode[row] as number] as string;
  const longest = Math.min(110, 0.3 * view.height);
  const scale = longest / Math.max(shapesOf(run).largestImpulse, 1e-300);
  // Roots, so that a rest's small impulses are seen beside an impact's.
  const size = Math.hypot(P_n, P_t);
  const length = size > 0 ? Math.max(Math.sqrt(size * scale * longest), 6) : 0;
  const [ix, iy] = size > 0 ? [(P_n * nx + P_t * tx) / size, (P_n * ny + P_t * ty) / size] : [0, 0];
  if (inFull) drawCone(pen, px, py, [nx, ny], t.contact_law_friction[row] as number, Math.max(length, 34) + 12, colour);
  pen.strokeStyle = colour;
  pen.fillStyle = colour;
  arrow(pen, px, py, px + length * ix, py - length * iy, 2.5);
  pen.beginPath();
  pen.arc(px, py, 3, 0, 2 * Math.PI);
  pen.fill();
  if (inFull) drawSlip(pen, px, py, [tx, ty], t.contact_tangential_velocity_after[row] as number, theme);
}

function drawCone(pen: Pen, px: number, py: number, [nx, ny]: [number, number], mu: number, size: number, colour: string): void {
  const angle = Math.atan(mu);
  const alpha = pen.globalAlpha;
  const edge = (turn: number): [number, number] => {
    const [c, s] = [Math.cos(turn), Math.sin(turn)];
    return [px + size * (c * nx - s * ny), py - size * (s * nx + c * ny)];
  };
  pen.beginPath();
  pen.moveTo(px, py);
  pen.lineTo(...edge(angle));
  pen.lineTo(...edge(-angle));
  pen.closePath();
  pen.globalAlpha = 0.13 * alpha;
  pen.fillStyle = colour;
  pen.fill();
  pen.globalAlpha = 0.7 * alpha;
  pen.strokeStyle = colour;
  pen.lineWidth = 1;
  line(pen, px, py, ...edge(angle));
  line(pen, px, py, ...edge(-angle));
  pen.globalAlpha = alpha;
}

// The slip velocity after the step, of b seen from a, below the contact.
function drawSlip(pen: Pen, px: number, py: number, [tx, ty]: [number, number], slip: number, theme: Theme): void {
  if (Math.abs(slip) < 1e-9) return;
  const length = Math.sign(slip) * Math.min(20 + 22 * Math.abs(slip), 80);
  const [ox, oy] = [12 * ty, 12 * tx]; // off the surface, on the side of a
  pen.strokeStyle = theme.ink;
  pen.fillStyle = theme.ink;
  arrow(pen, px + ox, py + oy, px + ox + length * tx, py + oy - length * ty, 1.5);
}
