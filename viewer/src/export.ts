// Files of what is shown, saved as downloads.
import { GIFEncoder } from 'gifenc';
import { checked } from './engine';
import { colourCounts, Indexer, paletteOf } from './gif_palette';
import { SvgPen, type Pen } from './pen';
import type { Run, TextFile } from './run';
import { readTheme } from './theme';

export type Draw = (pen: Pen, width: number, height: number) => void;
export type DrawFrame = (pen: Pen, width: number, height: number, time: number) => void;

export interface FilmOptions {
  width: number;
  height: number;
  fps: number;
  speed: number; // seconds of the run in a second of the film
  title: string;
  onProgress: (part: number) => void; // 0 to 1
  isCancelled: () => boolean;
}

const lastFrame = 0.8; // [s] for which the last picture stays
const maxFps = 25;

// A title as the name of a file.
export function fileName(title: string, ending: string): string {
  const name = title
    .normalize('NFKC')
    .replace(/[^\p{L}\p{N}.]+/gu, '-')
    .replace(/^[-.]+|[-.]+$/g, '')
    .slice(0, 80);
  return `${(name || 'tumble').toLowerCase()}.${ending}`;
}

function save(parts: BlobPart, type: string, name: string): void {
  const url = URL.createObjectURL(new Blob([parts], { type }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  // The browser reads the bytes after the click.
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

interface Canvas {
  canvas: HTMLCanvasElement;
  pen: CanvasRenderingContext2D;
}

function canvasOf(width: number, height: number, scale: number): Canvas {
  const canvas = document.createElement('canvas');
  canvas.width = Math.round(width * scale);
  canvas.height = Math.round(height * scale);
  const pen = canvas.getContext('2d', { alpha: false, willReadFrequently: true });
  if (!pen) throw new Error(`The browser has no canvas of ${canvas.width} x ${canvas.height}`);
  pen.scale(scale, scale);
  return { canvas, pen };
}

function drawPaper(pen: Pen, width: number, height: number): void {
  pen.fillStyle = readTheme().paper;
  pen.beginPath();
  pen.rect(0, 0, width, height);
  pen.fill();
}

// With two pixels for each unit of length.
export async function savePng(draw: Draw, width: number, height: number, title: string): Promise<void> {
  const { canvas, pen } = canvasOf(width, height, 2);
  drawPaper(pen, width, height);
  draw(pen, width, height);
  const blob = await new Promise<Blob | null>((done) => canvas.toBlob(done, 'image/png'));
  if (!blob) throw new Error('The browser could not make the picture');
  save(blob, 'image/png', fileName(title, 'png'));
}

export function svgText(draw: Draw, width: number, height: number, paper: string): string {
  const pen = new SvgPen(width, height);
  pen.fillStyle = paper;
  pen.beginPath();
  pen.rect(0, 0, width, height);
  pen.fill();
  draw(pen, width, height);
  return pen.toString();
}

export function saveSvg(draw: Draw, width: number, height: number, title: string): void {
  save(svgText(draw, width, height, readTheme().paper), 'image/svg+xml', fileName(title, 'svg'));
}

// The tables of a run, as the command line writes them; of a recorded run the texts that were read.
export function csvFiles(run: Run): TextFile[] {
  if (run.spec.kind === 'recorded') return run.spec.files;
  if (run.record) return [{ name: 'drop.csv', text: checked(run.handle.csv('record')) }];
  const title = run.scene.title;
  return [
    { name: fileName(title, 'csv'), text: checked(run.handle.csv('samples')) },
    { name: fileName(title, 'contacts.csv'), text: checked(run.handle.csv('contacts')) },
  ];
}

export function saveCsv(run: Run): void {
  for (const { name, text } of csvFiles(run)) save(text, /\.csv$/i.test(name) ? 'text/csv' : 'text/plain', name);
}

export function saveText(text: string, name: string): void {
  save(text, 'text/plain', name);
}

// Times of pictures, in the run; the last one is its end.
export function frameTimes(duration: number, secondsPerFrame: number, speed: number): number[] {
  const count = Math.ceil(duration / speed / secondsPerFrame - 1e-9);
  return [...Array.from({ length: Math.max(count, 0) }, (_, k) => k * secondsPerFrame * speed), duration];
}

const pause = (): Promise<void> => new Promise((done) => setTimeout(done));

// Calls `work` for each item, with pauses in which the page stays awake. False: cancelled.
async function inSteps<Item>(
  items: Item[],
  work: (item: Item, index: number) => void,
  options: FilmOptions,
  [from, to]: [number, number],
): Promise<boolean> {
  let since = performance.now();
  for (const [index, item] of items.entries()) {
    if (options.isCancelled()) return false;
    work(item, index);
    if (performance.now() - since < 12) continue;
    options.onProgress(from + ((to - from) * (index + 1)) / items.length);
    await pause();
    since = performance.now();
  }
  return !options.isCancelled();
}

// At most so many pictures are looked at for their colours.
const maxLooks = 150;

// The bytes of an animated GIF; null if it was cancelled. One palette for all pictures, and only what changes is
// written: nothing flickers.
export async function gifBytes(
  drawFrame: DrawFrame,
  duration: number,
  options: FilmOptions,
): Promise<Uint8Array<ArrayBuffer> | null> {
  const { width, height } = { width: Math.round(options.width), height: Math.round(options.height) };
  const { pen } = canvasOf(width, height, 1);
  const pixelsAt = (time: number): Uint32Array => {
    pen.save();
    drawPaper(pen, width, height);
    drawFrame(pen, width, height, time);
    pen.restore();
    return new Uint32Array(pen.getImageData(0, 0, width, height).data.buffer);
  };
  // GIF counts hundredths of a second.
  const delay = Math.round(100 / Math.min(options.fps, maxFps)) / 100;
  const times = frameTimes(duration, delay, options.speed);
  const looks = times.filter((_, k) => k % Math.ceil(times.length / maxLooks) === 0 || k === times.length - 1);
  const counts = new Map<number, number>();
  const first = (0.4 * looks.length) / times.length;
  if (!(await inSteps(looks, (time) => colourCounts(pixelsAt(time), counts), options, [0, first]))) return null;
  const indexer = new Indexer(paletteOf(counts));
  const encoder = GIFEncoder();
  const writeFrame = (time: number, k: number): void => {
    const seconds = k === times.length - 1 ? lastFrame : delay;
    const changes = indexer.changes(pixelsAt(time));
    const frame = { delay: 1000 * seconds, transparent: k > 0, transparentIndex: indexer.transparent, dispose: 1 };
    encoder.writeFrame(changes, width, height, k === 0 ? { ...frame, palette: indexer.palette, repeat: 0 } : frame);
  };
  if (!(await inSteps(times, writeFrame, options, [first, 1]))) return null;
  encoder.finish();
  options.onProgress(1);
  return Uint8Array.from(encoder.bytes());
}

// False: cancelled.
export async function saveGif(drawFrame: DrawFrame, duration: number, options: FilmOptions): Promise<boolean> {
  const bytes = await gifBytes(drawFrame, duration, options);
  if (bytes) save(bytes, 'image/gif', fileName(options.title, 'gif'));
  return bytes !== null;
}
