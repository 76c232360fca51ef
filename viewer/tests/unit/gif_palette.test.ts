import { describe, expect, it } from 'vitest';
import { colourCounts, Indexer, paletteOf } from '../../src/gif_palette';

const colour = (r: number, g: number, b: number): number => (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;

describe('palette of a film', () => {
  it('is exact for few colours', () => {
    const counts = new Map<number, number>();
    colourCounts(Uint32Array.of(colour(1, 2, 3), colour(4, 5, 6), colour(4, 5, 6)), counts);
    expect(paletteOf(counts)).toEqual([
      [4, 5, 6],
      [1, 2, 3],
    ]);
  });
  it('keeps areas exact among many colours, and leaves room for what does not change', () => {
    const counts = new Map<number, number>();
    const paper = colour(251, 252, 253);
    colourCounts(new Uint32Array(10_000).fill(paper), counts);
    for (let i = 0; i < 4000; ++i) colourCounts(Uint32Array.of(colour(i % 256, (i * 7) % 256, (i * 31) % 256)), counts);
    const indexer = new Indexer(paletteOf(counts));
    expect(indexer.palette.length).toBeLessThanOrEqual(256);
    expect(indexer.palette[indexer.changes(Uint32Array.of(paper))[0] as number]).toEqual([251, 252, 253]);
  });
  it('writes only what changes', () => {
    const indexer = new Indexer([
      [255, 255, 255],
      [0, 0, 0],
    ]);
    const [white, black] = [colour(255, 255, 255), colour(10, 0, 0)];
    expect([...indexer.changes(Uint32Array.of(white, white, black))]).toEqual([0, 0, 1]);
    expect([...indexer.changes(Uint32Array.of(white, black, white))]).toEqual([2, 1, 0]);
    expect([...indexer.changes(Uint32Array.of(white, black, black))]).toEqual([2, 2, 1]);
  });
});
