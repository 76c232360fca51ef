// Where the world is in the picture: metres to pixels and back.
import type { Run } from './run';

export class View {
  constructor(
    public scale: number, // [px/m]
    public x: number, // [m] in the middle of the picture
    public y: number,
    public width: number, // [px]
    public height: number,
    public left = 0, // [px] where the picture starts
  ) {}

  toX = (x: number): number => this.left + 0.5 * this.width + (x - this.x) * this.scale;
  toY = (y: number): number => 0.5 * this.height - (y - this.y) * this.scale;
  worldX = (px: number): number => this.x + (px - this.left - 0.5 * this.width) / this.scale;
  worldY = (py: number): number => this.y - (py - 0.5 * this.height) / this.scale;

  in(width: number, height: number, left = 0): View {
    const zoom = Math.min(width / this.width, height / this.height);
    return new View(this.scale * zoom, this.x, this.y, width, height, left);
  }
  // Zooms about a point [px].
  zoomAt(px: number, py: number, factor: number): void {
    const [x, y] = [this.worldX(px), this.worldY(py)];
    this.scale = Math.min(Math.max(this.scale * factor, 1e-3), 1e7);
    this.x += x - this.worldX(px);
    this.y += y - this.worldY(py);
  }
}

interface Bounds {
  left: number;
  right: number;
  bottom: number;
  top: number;
}

// The radius about the origin of a body that holds all of it; 0 for what has no end.
export function radiusOf(run: Run, body: number): number {
  let radius = 0;
  for (const part of run.scene.bodies[body]?.parts ?? []) {
    if (part.kind === 'polygon') {
      for (let i = 0; i < part.points.length; i += 2) {
        radius = Math.max(radius, Math.hypot(part.points[i] as number, part.points[i + 1] as number) + part.rounding);
      }
    } else if (part.kind === 'ellipse') {
      radius = Math.max(radius, Math.hypot(part.pose[0], part.pose[1]) + Math.max(...part.semi_axes));
    }
  }
  return radius;
}

function include(bounds: Bounds, x: number, y: number, radius: number): void {
  bounds.left = Math.min(bounds.left, x - radius);
  bounds.right = Math.max(bounds.right, x + radius);
  bounds.bottom = Math.min(bounds.bottom, y - radius);
  bounds.top = Math.max(bounds.top, y + radius);
}

function boundsOf(run: Run): Bounds {
  const bounds = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  const every = Math.max(1, Math.floor(run.length / 500));
  run.scene.bodies.forEach((body, i) => {
    if (body.kind === 'fixed') return;
    const radius = radiusOf(run, i);
    for (let k = 0; k < run.length; k += every) include(bounds, ...(run.poseAt(k, i).slice(0, 2) as [number, number]), radius);
  });
  for (const body of run.scene.bodies) {
    for (const part of body.parts) {
      if (part.kind !== 'terrain') continue;
      for (let i = 0; i < part.points.length; i += 2) include(bounds, part.points[i] as number, part.points[i + 1] as number, 0);
    }
  }
  if (!Number.isFinite(bounds.left)) return { left: -1, right: 1, bottom: -1, top: 1 };
  return bounds;
}

// The view that shows the whole of some runs.
export function fitted(runs: Run[], width: number, height: number): View {
  const all = runs.map(boundsOf);
  const bounds = {
    left: Math.min(...all.map((b) => b.left)),
    right: Math.max(...all.map((b) => b.right)),
    bottom: Math.min(...all.map((b) => b.bottom)),
    top: Math.max(...all.map((b) => b.top)),
  };
  const margin = 1.16;
  const [w, h] = [Math.max(bounds.right - bounds.left, 1e-6), Math.max(bounds.top - bounds.bottom, 1e-6)];
  const scale = Math.min(width / (w * margin), height / (h * margin));
  return new View(scale, 0.5 * (bounds.left + bounds.right), 0.5 * (bounds.bottom + bounds.top), width, height);
}
