// Shapes as lines: what the engine says of a body, as polygons in its frame.
import type { BodyInfo, ShapeInfo } from 'tumble-engine';

export interface Outline {
  kind: 'closed' | 'wall' | 'ground';
  points: number[]; // x, y, x, y, ... [m]
}

const arcSteps = 10; // of a rounded corner
const roundSteps = 48; // of a disc or an ellipse
const far = 1e4; // [m]: half a half-plane's line

function rounded(points: Float64Array, rounding: number): number[] {
  const n = points.length / 2;
  if (rounding === 0) return [...points];
  if (n === 1) return circle(points[0] as number, points[1] as number, rounding, rounding, 0);
  const outline: number[] = [];
  const at = (i: number): [number, number] => [points[2 * (i % n)] as number, points[2 * (i % n) + 1] as number];
  for (let i = 0; i < n; ++i) {
    const [px, py] = at(i + n - 1);
    const [x, y] = at(i);
    const [nx, ny] = at(i + 1);
    // From the outward normal of the side before to that of the side behind, counter-clockwise.
    const from = Math.atan2(-(x - px), y - py);
    let turn = Math.atan2(-(nx - x), ny - y) - from;
    while (turn < 0) turn += 2 * Math.PI;
    for (let k = 0; k <= arcSteps; ++k) {
      const angle = from + (turn * k) / arcSteps;
      outline.push(x + rounding * Math.cos(angle), y + rounding * Math.sin(angle));
    }
  }
  return outline;
}

function circle(x: number, y: number, a: number, b: number, angle: number): number[] {
  const outline: number[] = [];
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  for (let k = 0; k < roundSteps; ++k) {
    const [u, v] = [a * Math.cos((2 * Math.PI * k) / roundSteps), b * Math.sin((2 * Math.PI * k) / roundSteps)];
    outline.push(x + c * u - s * v, y + s * u + c * v);
  }
  return outline;
}

function outlineOfPart(part: ShapeInfo): Outline {
  switch (part.kind) {
    case 'polygon':
      return {
        kind: part.points.length === 4 && part.rounding === 0 ? 'wall' : 'closed',
        points: rounded(part.points, part.rounding),
      };
    case 'ellipse': {
      const [x, y, angle] = part.pose;
      return { kind: 'closed', points: circle(x, y, part.semi_axes[0] as number, part.semi_axes[1] as number, angle) };
    }
    case 'half_plane': {
      const [nx, ny] = part.normal as [number, number];
      const [x, y] = [part.offset * nx, part.offset * ny];
      return { kind: 'ground', points: [x - far * ny, y + far * nx, x + far * ny, y - far * nx] };
    }
    case 'terrain':
      return { kind: 'ground', points: [...part.points] };
  }
}

export const outlinesOf = (body: BodyInfo): Outline[] => body.parts.map(outlineOfPart);

// A disc shows how it is turned by a spoke.
export const isRound = (body: BodyInfo): boolean =>
  body.parts.every((part) => part.kind === 'polygon' && part.points.length === 2);
