// Colours of animated GIFs: one palette for all pictures. A colour is a pixel as a canvas has it, 0xAABBGGRR.
import { quantize } from 'gifenc';

const maxColours = 255; // one of the 256 is for pixels that do not change
const maxExact = 24;
const maxWeight = 64;

export function colourCounts(pixels: Uint32Array, counts: Map<number, number>): void {
  for (let from = 0; from < pixels.length; ) {
    const colour = pixels[from] as number;
    let to = from + 1;
    while (to < pixels.length && pixels[to] === colour) ++to;
    counts.set(colour, (counts.get(colour) ?? 0) + to - from);
    from = to;
  }
}

const channels = (colour: number): [number, number, number] => [colour & 255, (colour >> 8) & 255, (colour >> 16) & 255];

function nearest(palette: number[][], colour: number): number {
  const [r, g, b] = channels(colour);
  let best = 0;
  let least = Infinity;
  for (const [index, [red, green, blue]] of palette.entries()) {
    const distance = (r - (red as number)) ** 2 + (g - (green as number)) ** 2 + (b - (blue as number)) ** 2;
    if (distance >= least) continue;
    least = distance;
    best = index;
  }
  return best;
}

// The most frequent colours exactly, since they are areas; the rest, blends at edges, by quantisation.
export function paletteOf(counts: Map<number, number>): number[][] {
  const colours = [...counts].sort((a, b) => b[1] - a[1] || a[0] - b[0]);
  if (colours.length <= maxColours) return colours.map(([colour]) => channels(colour));
  const exact = colours.slice(0, maxExact).map(([colour]) => channels(colour));
  const rest: number[] = [];
  for (const [colour, count] of colours.slice(maxExact)) {
    // Rare colours count for more than their share, or brief things would lose theirs.
    const weight = Math.min(Math.ceil(Math.sqrt(count)), maxWeight);
    for (let i = 0; i < weight; ++i) rest.push(colour);
  }
  const bytes = new Uint8Array(Uint32Array.from(rest).buffer);
  return [...exact, ...quantize(bytes, maxColours - maxExact)];
}

export class Indexer {
  readonly palette: number[][];
  readonly transparent: number;
  private readonly indices = new Map<number, number>();
  private previous: Uint8Array | null = null;

  constructor(private readonly colours: number[][]) {
    this.transparent = colours.length;
    this.palette = [...colours, [0, 0, 0]];
  }

  // Places in the palette; `transparent` where the picture before had the same.
  changes(pixels: Uint32Array): Uint8Array {
    const present = this.indexed(pixels);
    const previous = this.previous;
    this.previous = present;
    return previous ? present.map((index, at) => (index === previous[at] ? this.transparent : index)) : present;
  }

  private indexed(pixels: Uint32Array): Uint8Array {
    const result = new Uint8Array(pixels.length);
    for (let from = 0; from < pixels.length; ) {
      const colour = pixels[from] as number;
      let to = from + 1;
      while (to < pixels.length && pixels[to] === colour) ++to;
      result.fill(this.indexOf(colour), from, to);
      from = to;
    }
    return result;
  }

  private indexOf(colour: number): number {
    let index = this.indices.get(colour);
    if (index === undefined) this.indices.set(colour, (index = nearest(this.colours, colour)));
    return index;
  }
}
