// The stage: the picture, and the handles by which the start of a body is changed, with mouse, finger or keys.
import type { Triple } from 'tumble-engine';
import { number } from './format';
import { element } from './markup';
import { arrow, type Pen } from './pen';
import { drawPicture, type DrawOptions, type Layer } from './draw';
import type { Run } from './run';
import { readTheme } from './theme';
import { fitted, radiusOf, View } from './view';

export interface Start {
  pose: Triple;
  velocity: Triple;
}

export interface StageEvents {
  onStart: (start: Start) => void; // the start of the selected body was changed
  onSelect: (body: number) => void;
}

type HandleName = 'body' | 'turn' | 'velocity' | 'spin';
const names: Record<HandleName, string> = {
  body: 'Place of the body',
  turn: 'Angle of the body',
  velocity: 'Velocity of the body',
  spin: 'Spin of the body',
};

const velocityPixels = 40; // [px] of an arrow per m/s
const beyondTip = 30; // [px] from the tip of that arrow to its handle: clear of the body's handle
const spinTurn = 0.12; // [rad] of the spin's arc per rad/s
const degree = Math.PI / 180;

export class Stage {
  readonly canvas = element('canvas', 'stage-canvas');
  private readonly handles = new Map<HandleName, HTMLButtonElement>();
  private view = new View(100, 0, 0.8, 600, 400);
  private isFitted = false;
  private layers: Layer[] = [];
  private isSideBySide = false;
  private start: Start | null = null;
  private pane = 0; // of the run that starts there, side by side
  private radius = 0.1;
  private options: DrawOptions = { ghosts: true, contacts: true, selected: 1, fade: 0 };
  private isDue = false;
  private readonly pointers = new Map<number, [number, number]>();

  constructor(
    private readonly root: HTMLElement,
    private readonly events: StageEvents,
  ) {
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'img');
    root.append(this.canvas);
    for (const name of Object.keys(names) as HandleName[]) this.addHandle(name);
    this.listen();
    new ResizeObserver(() => this.resize()).observe(root);
  }

  // `layer` is the one whose start the handles change.
  show(layers: Layer[], isSideBySide: boolean, start: Start | null, layer: number, options: DrawOptions): void {
    const first = layers[0];
    this.layers = layers;
    this.isSideBySide = isSideBySide && layers.length > 1;
    this.start = start;
    this.pane = this.isSideBySide ? layer : 0;
    this.options = options;
    if (first) this.radius = radiusOf(first.run, options.selected);
    if (!this.isFitted) this.fit();
    this.request();
  }

  fit(): void {
    const [width, height] = this.paneSize();
    if (this.layers.length === 0 || width < 2) return;
    this.view = fitted(
      this.layers.map((layer) => layer.run),
      width,
      height,
    );
    this.isFitted = true;
    this.request();
  }
  // The next run is fitted anew.
  forgetView(): void {
    this.isFitted = false;
  }
  zoom(factor: number): void {
    this.view.zoomAt(0.5 * this.view.width, 0.5 * this.view.height, factor);
    this.request();
  }

  // What is on the stage, for files and films, at other sizes and times.
  draw(pen: Pen, width: number, height: number, layers = this.layers): void {
    const theme = readTheme();
    pen.fillStyle = theme.paper;
    pen.beginPath();
    pen.rect(0, 0, width, height);
    pen.fill();
    const panes = this.isSideBySide ? layers.map((layer) => [layer]) : [layers];
    panes.forEach((shown, i) => {
      const view = this.view.in(width / panes.length, height, (i * width) / panes.length);
      drawPicture(pen, view, shown, this.options, theme);
    });
  }

  private paneSize(): [number, number] {
    const count = this.isSideBySide ? this.layers.length : 1;
    return [this.root.clientWidth / count, this.root.clientHeight];
  }

  private resize(): void {
    const ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(this.root.clientWidth * ratio);
    this.canvas.height = Math.round(this.root.clientHeight * ratio);
    const [width, height] = this.paneSize();
    if (this.isFitted && width > 1) this.view = this.view.in(width, height);
    else this.fit();
    this.paint();
  }

  private request(): void {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.paint();
    });
  }

  private paint(): void {
    const context = this.canvas.getContext('2d');
    if (!context || this.layers.length === 0) return;
    const ratio = window.devicePixelRatio || 1;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.draw(context, this.root.clientWidth, this.root.clientHeight);
    this.drawHandles(context);
    this.placeHandles();
    this.describe();
  }

  // For those who cannot see it.
  private describe(): void {
    const first = this.layers[0] as Layer;
    const body = first.run.scene.bodies[this.options.selected];
    const [x, y, angle] = first.run.poseAt(first.sample, this.options.selected);
    const time = number(first.run.trajectory.time[first.sample] as number);
    const text = `${first.run.scene.title || 'Scene'} at ${time} s: ${body?.name ?? ''} at x ${number(x)} m, y ${number(y)} m, angle ${number(angle)} rad`;
    if (this.canvas.getAttribute('aria-label') !== text) this.canvas.setAttribute('aria-label', text);
  }

  // ---- Handles ----

  private get startView(): View {
    const { width, height } = this.view;
    return this.view.in(width, height, this.pane * width);
  }

  private handlePoints(): Record<HandleName, [number, number]> | null {
    if (!this.start) return null;
    const { pose, velocity } = this.start;
    const view = this.startView;
    const [px, py] = [view.toX(pose[0]), view.toY(pose[1])];
    const reach = this.reach();
    const spin = pose[2] + Math.PI / 2 + spinTurn * velocity[2];
    const speed = Math.hypot(velocity[0], velocity[1]);
    const [right, up] = speed > 0 ? [velocity[0] / speed, velocity[1] / speed] : [0, -1];
    return {
      body: [px, py],
      turn: [px + reach * Math.cos(pose[2]), py - reach * Math.sin(pose[2])],
      velocity: [px + velocityPixels * velocity[0] + beyondTip * right, py - velocityPixels * velocity[1] - beyondTip * up],
      spin: [px + reach * Math.cos(spin), py - reach * Math.sin(spin)],
    };
  }
  private reach(): number {
    return Math.max(this.radius * this.view.scale, 18) + 22;
  }

  private drawHandles(pen: CanvasRenderingContext2D): void {
    const points = this.handlePoints();
    if (!points || !this.start) return;
    const theme = readTheme();
    const [px, py] = points.body;
    pen.save();
    pen.strokeStyle = theme.accent;
    pen.fillStyle = theme.accent;
    pen.lineWidth = 1;
    pen.setLineDash([2, 3]);
    pen.beginPath();
    pen.moveTo(px, py);
    pen.lineTo(...points.turn);
    pen.stroke();
    // The arc of the spin, from where no spin would be.
    const from = this.start.pose[2] + Math.PI / 2;
    const to = from + spinTurn * this.start.velocity[2];
    pen.setLineDash([]);
    pen.beginPath();
    pen.arc(px, py, this.reach(), -from, -to, to > from);
    pen.stroke();
    const [vx, vy] = this.start.velocity;
    const tip: [number, number] = [px + velocityPixels * vx, py - velocityPixels * vy];
    if (vx !== 0 || vy !== 0) arrow(pen, px, py, ...tip, 2);
    pen.setLineDash([2, 3]);
    pen.beginPath();
    pen.moveTo(...tip);
    pen.lineTo(...points.velocity);
    pen.stroke();
    pen.restore();
  }

  private placeHandles(): void {
    const points = this.handlePoints();
    for (const [name, handle] of this.handles) {
      handle.hidden = !points;
      if (!points || !this.start) continue;
      const [x, y] = points[name];
      handle.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      const { pose, velocity } = this.start;
      const text = {
        body: `x ${number(pose[0])} m, y ${number(pose[1])} m`,
        turn: `${number(pose[2])} rad, ${number(pose[2] / degree)} degrees`,
        velocity: `${number(velocity[0])} m/s to the right, ${number(velocity[1])} m/s up`,
        spin: `${number(velocity[2])} rad/s`,
      }[name];
      handle.setAttribute('aria-valuetext', text);
      handle.setAttribute('aria-valuenow', String({ body: pose[0], turn: pose[2], velocity: velocity[0], spin: velocity[2] }[name]));
      handle.title = `${names[name]}: ${text}. Drag, or use the arrow keys.`;
    }
  }

  private addHandle(name: HandleName): void {
    const handle = element('button', `handle handle-${name}`);
    handle.type = 'button';
    handle.hidden = true;
    handle.dataset.handle = name;
    handle.setAttribute('role', 'slider');
    handle.setAttribute('aria-label', names[name]);
    handle.addEventListener('keydown', (event) => this.onKey(name, event));
    handle.addEventListener('pointerdown', (down) => {
      down.preventDefault();
      handle.focus();
      handle.setPointerCapture(down.pointerId);
      const from = this.handlePoints()?.[name] ?? [0, 0];
      const [dx, dy] = this.local(down);
      const offset: [number, number] = [from[0] - dx, from[1] - dy];
      const move = (event: PointerEvent): void => {
        const [x, y] = this.local(event);
        this.drag(name, x + offset[0], y + offset[1]);
      };
      const end = (): void => {
        handle.removeEventListener('pointermove', move);
        handle.removeEventListener('pointerup', end);
        handle.removeEventListener('pointercancel', end);
      };
      handle.addEventListener('pointermove', move);
      handle.addEventListener('pointerup', end);
      handle.addEventListener('pointercancel', end);
    });
    this.handles.set(name, handle);
    this.root.append(handle);
  }

  private local(event: PointerEvent | WheelEvent): [number, number] {
    const box = this.root.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  private change(pose: Triple, velocity: Triple): void {
    this.events.onStart({ pose, velocity });
  }

  private drag(name: HandleName, x: number, y: number): void {
    if (!this.start) return;
    const { pose, velocity } = this.start;
    const view = this.startView;
    const [px, py] = [view.toX(pose[0]), view.toY(pose[1])];
    // To a tenth of a millimetre and of a degree: nobody means more digits with a mouse.
    const round = (value: number, digits = 4): number => Number(value.toFixed(digits));
    if (name === 'body') this.change([round(view.worldX(x)), round(view.worldY(y)), pose[2]], velocity);
    if (name === 'velocity') {
      const distance = Math.hypot(x - px, py - y);
      const share = distance > beyondTip ? (distance - beyondTip) / distance / velocityPixels : 0;
      this.change(pose, [round(share * (x - px), 2), round(share * (py - y), 2), velocity[2]]);
    }
    if (name === 'turn' || name === 'spin') {
      const angle = Math.atan2(py - y, x - px);
      const now = name === 'turn' ? pose[2] : pose[2] + Math.PI / 2 + spinTurn * velocity[2];
      let by = angle - now;
      by -= 2 * Math.PI * Math.round(by / (2 * Math.PI));
      if (name === 'turn') this.change([pose[0], pose[1], round(pose[2] + by)], velocity);
      else this.change(pose, [velocity[0], velocity[1], round(velocity[2] + by / spinTurn, 2)]);
    }
  }

  private onKey(name: HandleName, event: KeyboardEvent): void {
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!way || !this.start) return;
    event.preventDefault();
    event.stopPropagation();
    const [dx, dy] = way as [number, number];
    const times = event.shiftKey ? 10 : 1;
    const { pose, velocity } = this.start;
    const add = (value: number, by: number): number => Number((value + by).toFixed(6));
    if (name === 'body') this.change([add(pose[0], 0.01 * times * dx), add(pose[1], 0.01 * times * dy), pose[2]], velocity);
    if (name === 'velocity') this.change(pose, [add(velocity[0], 0.1 * times * dx), add(velocity[1], 0.1 * times * dy), velocity[2]]);
    // Left is counter-clockwise.
    if (name === 'turn') this.change([pose[0], pose[1], pose[2] + degree * times * (dy - dx)], velocity);
    if (name === 'spin') this.change(pose, [velocity[0], velocity[1], add(velocity[2], 0.1 * times * (dy - dx))]);
  }

  // ---- Pan, zoom, select ----

  private listen(): void {
    this.canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      const [x, y] = this.local(event);
      this.view.zoomAt(x % this.view.width, y, Math.exp(-0.0015 * event.deltaY));
      this.request();
    }, { passive: false });
    this.canvas.addEventListener('pointerdown', (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, this.local(event));
      if (this.pointers.size === 1) this.selectAt(...this.local(event));
    });
    this.canvas.addEventListener('pointermove', (event) => this.onMove(event));
    for (const name of ['pointerup', 'pointercancel'] as const) {
      this.canvas.addEventListener(name, (event) => this.pointers.delete(event.pointerId));
    }
    this.canvas.addEventListener('keydown', (event) => {
      const [dx, dy] = { ArrowLeft: [-30, 0], ArrowRight: [30, 0], ArrowUp: [0, -30], ArrowDown: [0, 30] }[event.key] ?? [0, 0];
      if (event.key === '+' || event.key === '=') this.zoom(1.25);
      else if (event.key === '-') this.zoom(0.8);
      else if (event.key === '0') this.fit();
      else if (dx !== 0 || dy !== 0) this.pan(-dx, -dy);
      else return;
      event.preventDefault();
    });
  }

  private pan(dx: number, dy: number): void {
    this.view.x -= dx / this.view.scale;
    this.view.y += dy / this.view.scale;
    this.request();
  }

  private onMove(event: PointerEvent): void {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const now = this.local(event);
    const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {  // two fingers
      const [was, is] = [before, now].map(([x, y]) => Math.hypot(x - other[0], y - other[1])) as [number, number];
      this.view.zoomAt(0.5 * (now[0] + other[0]), 0.5 * (now[1] + other[1]), is / Math.max(was, 1));
    }
    const share = other ? 0.5 : 1;
    this.pan(share * (now[0] - before[0]), share * (now[1] - before[1]));
    this.pointers.set(event.pointerId, now);
  }

  private selectAt(px: number, py: number): void {
    const layer = this.layers[0];
    if (!layer) return;
    const [x, y] = [this.view.worldX(px), this.view.worldY(py)];
    const run: Run = layer.run;
    let [best, distance] = [-1, Infinity];
    run.scene.bodies.forEach((body, i) => {
      if (body.kind !== 'dynamic') return;
      const [bx, by] = run.poseAt(layer.sample, i);
      const d = Math.hypot(x - bx, y - by);
      if (d < Math.max(radiusOf(run, i), 8 / this.view.scale) && d < distance) [best, distance] = [i, d];
    });
    if (best >= 0 && best !== this.options.selected) this.events.onSelect(best);
  }
}
