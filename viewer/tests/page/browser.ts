// Chromium with the built page, and the command line beside it, of which every number must be the same.
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { chromium, type Browser, type BrowserContextOptions, type Download, type Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, expect } from 'vitest';
import type { App } from '../../src/app';
import { documentDrop, type DropSpec, type Spec } from '../../src/run';

declare global {
  interface Window {
    tumble: App;
  }
}

const here = fileURLToPath(new URL('.', import.meta.url));
const root = resolve(here, '../../..');
const build = process.env.TUMBLE_BUILD ?? join(root, 'build');
export const program = join(build, 'bin/tumble');
export const pageFile = process.env.TUMBLE_PAGE_UNDER_TEST ?? join(root, 'out/tumble.html');
export const sceneFile = (name: string): string => join(root, 'scenes', `${name}.toml`);
export const sceneText = (name: string): string => readFileSync(sceneFile(name), 'utf8');

export const desktop = { viewport: { width: 1280, height: 900 } };
export const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 };

export interface OpenOptions extends BrowserContextOptions {
  hash?: string;
  file?: string;
  init?: () => void; // runs before the page's own scripts
}

export interface Chromium {
  open(options?: OpenOptions): Promise<Page>;
}

// One browser for a file of tests. Pages are closed after each test, and none may have thrown anything.
export function chromiumForFile(): Chromium {
  let browser: Browser;
  const errors: string[] = [];
  beforeAll(async () => {
    const executablePath = execFileSync('sh', ['-c', 'command -v chromium'], { encoding: 'utf8' }).trim();
    const off = ['background-networking', 'component-update', 'gpu', 'sync'].map((name) => `--disable-${name}`);
    browser = await chromium.launch({ executablePath, args: ['--no-sandbox', ...off] });
  });
  afterEach(async () => {
    await Promise.all(browser.contexts().map((context) => context.close()));
    expect(errors.splice(0)).toEqual([]);
  });
  afterAll(() => browser.close());
  return {
    async open({ hash = '', file = pageFile, init, ...options } = {}) {
      const context = await browser.newContext({ reducedMotion: 'reduce', colorScheme: 'light', ...desktop, ...options });
      context.setDefaultTimeout(20_000);
      const page = await context.newPage();
      page.on('pageerror', (error) => errors.push(String(error)));
      page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
      if (init) await page.addInitScript(init);
      await page.goto(pathToFileURL(file).href + hash);
      await settled(page);
      return page;
    },
  };
}

// Until the page is there and nothing is being simulated.
export async function settled(page: Page): Promise<void> {
  const failure = await page.waitForFunction(() => {
    const message = document.getElementById('message')?.textContent ?? '';
    if (message.startsWith('The page could not start')) return message;
    return window.tumble?.runs.a && document.getElementById('progress')?.hidden ? 'settled' : null;
  });
  expect(await failure.jsonValue()).toBe('settled');
}

export async function openSpec(page: Page, a: Spec, b: Spec | null = null, time = 0): Promise<void> {
  await page.evaluate((shared) => window.tumble.open(shared), { a, b, time });
  await settled(page);
}
export const openScene = (page: Page, name: string): Promise<void> =>
  openSpec(page, { kind: 'scene', toml: sceneText(name), solver: 'exact' });

export const timeOf = (page: Page): Promise<number> => page.evaluate(() => window.tumble.time);
export const specOf = (page: Page, slot: 'a' | 'b' = 'a'): Promise<Spec> =>
  page.evaluate((name) => window.tumble.runs[name]?.spec as Spec, slot);
export async function dropSpec(page: Page, slot: 'a' | 'b' = 'a'): Promise<DropSpec> {
  const spec = await specOf(page, slot);
  if (spec.kind !== 'drop') throw new Error(`a drop was expected, not a ${spec.kind}`);
  return spec;
}

// ---- Numbers ----

export async function chooseAllPlots(page: Page): Promise<void> {
  const chips = page.locator('.plots-bar .plots-chip:visible');
  for (const chip of await chips.all()) if ((await chip.getAttribute('aria-pressed')) === 'false') await chip.click();
}

// All that is plotted, with its bits.
export async function plotted(page: Page): Promise<Record<string, Float64Array>> {
  const texts = await page.evaluate(() => {
    const base64 = (values: Float64Array): string => {
      const bytes = new Uint8Array(values.slice().buffer);
      let text = '';
      for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
      return btoa(text);
    };
    return Object.entries(window.tumble.plotted()).map(([key, values]) => [key, base64(values)] as const);
  });
  return Object.fromEntries(
    texts.map(([key, text]) => {
      const bytes = Uint8Array.from(Buffer.from(text, 'base64'));
      return [key, new Float64Array(bytes.buffer)] as const;
    }),
  );
}

export function expectSameBits(actual: ArrayLike<number> | undefined, expected: ArrayLike<number>, what: string): void {
  expect(actual?.length, what).toBe(expected.length);
  const k = Array.from(expected).findIndex((x, i) => !Object.is(x, actual?.[i]));
  if (k >= 0) expect.fail(`${what}[${k}] is ${actual?.[k]}, not ${expected[k]}`);
}

export function expectSameText(actual: string, expected: string, what: string): void {
  if (actual === expected) return;
  const [a, b] = [actual.split('\n'), expected.split('\n')];
  const k = b.findIndex((line, i) => line !== a[i]);
  expect.fail(`${what}, line ${k + 1}: "${a[k]}", not "${b[k]}"`);
}

// ---- The command line ----

const folder = mkdtempSync(join(tmpdir(), 'tumble-page-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));
let numFiles = 0;
export const newFile = (ending: string): string => join(folder, `${++numFiles}.${ending}`);
export function writeNewFile(text: string | Uint8Array, ending: string): string {
  const file = newFile(ending);
  writeFileSync(file, text);
  return file;
}

// Status 3 is a run with a numerical failure: it is written all the same.
export function tumble(...args: string[]): void {
  const env = { ...process.env, TUMBLE_PAGE: pageFile };
  const { status, stderr, error } = spawnSync(program, [...args, '--quiet', '--force'], { encoding: 'utf8', env });
  if (error || (status !== 0 && status !== 3)) throw new Error(`tumble ${args.join(' ')}: ${error?.message ?? stderr}`);
}

export function dropArguments(spec: DropSpec): string[] {
  const { q0, v0, l, m, mu, eps, dt, delta, g, columns } = spec;
  // A template would drop the sign of -0.
  const text = (x: number): string => (Object.is(x, -0) ? '-0' : String(x));
  const options = { q0: q0.map(text).join(), v0: v0.map(text).join(), side: l, mass: m, friction: mu, restitution: eps, step: dt, delta, gravity: g };
  return ['drop', ...Object.entries(options).map(([name, value]) => `--${name}=${typeof value === 'number' ? text(value) : value}`), `--steps=${columns - 1}`];
}

export function dropCsv(spec: DropSpec): string {
  const file = newFile('csv');
  tumble(...dropArguments(spec), '-o', file);
  return readFileSync(file, 'utf8');
}

export interface SceneTables {
  samples: string;
  contacts: string;
  files: { samples: string; contacts: string };
}
export function runScene(file: string): SceneTables {
  const samples = newFile('csv');
  const contacts = newFile('contacts.csv');
  tumble('run', file, '-o', samples, '-o', contacts);
  return { samples: readFileSync(samples, 'utf8'), contacts: readFileSync(contacts, 'utf8'), files: { samples, contacts } };
}

// ---- Tables ----

// Columns without their units; words stay NaN.
export function columnsOf(csv: string): Map<string, number[]> {
  const [header, ...rows] = csv.split('\n').filter((line) => line !== '' && !line.startsWith('#'));
  const names = (header as string).split(',').map((name) => name.replace(/ \[.*\]$/, ''));
  const columns = names.map(() => [] as number[]);
  for (const row of rows) row.split(',').forEach((cell, j) => columns[j]?.push(Number(cell)));
  return new Map(names.map((name, j) => [name, columns[j] as number[]]));
}

const dropKeys = { time: 't', x: 'x', y: 'y', angle: 'theta', vx: 'vx', vy: 'vy', omega: 'omega', gap: 'gap', f_n: 'f_n', f_t1: 'f_t1', f_t2: 'f_t2', lambda: 'lambda', kinetic: 'kinetic', potential: 'potential' };

const sumOf = (a: number[], b: number[]): number[] => a.map((x, k) => x + (b[k] as number));

// What the page has to plot for a record of a drop.
export function expectedOfDrop(csv: string): Record<string, number[]> {
  const columns = columnsOf(csv);
  const column = (name: string): number[] => columns.get(name) ?? expect.fail(`no column ${name}`);
  const entries = Object.entries(dropKeys).map(([key, name]) => [key, column(name)] as const);
  return { ...Object.fromEntries(entries), mechanical: sumOf(column('kinetic'), column('potential')) };
}

const running = (values: number[]): number[] => {
  let sum = 0;
  return values.map((x) => (sum += x));
};

// Of the steps that leave the samples: sums over the contacts of a body, and its least gap.
function contactSeries(csv: string, body: string, numSamples: number): Record<string, number[]> {
  const [header, ...rows] = csv.split('\n').filter((line) => line !== '' && !line.startsWith('#'));
  const names = (header as string).split(',').map((name) => name.replace(/ \[.*\]$/, ''));
  const at = (name: string): number => names.indexOf(name);
  const series = { normal_impulse: new Array<number>(numSamples).fill(NaN), friction_impulse: new Array<number>(numSamples).fill(NaN), gap: new Array<number>(numSamples).fill(NaN) };
  for (const row of rows) {
    const cells = row.split(',');
    if (cells[at('body_a')] !== body && cells[at('body_b')] !== body) continue;
    const k = Number(cells[at('step')]) - 1;
    const [normal, friction, gap] = ['normal_impulse', 'friction_impulse', 'gap'].map((name) => Number(cells[at(name)])) as [number, number, number];
    const isFirst = Number.isNaN(series.gap[k]);
    series.normal_impulse[k] = (isFirst ? 0 : (series.normal_impulse[k] as number)) + normal;
    series.friction_impulse[k] = (isFirst ? 0 : (series.friction_impulse[k] as number)) + Math.abs(friction);
    series.gap[k] = isFirst ? gap : Math.min(series.gap[k] as number, gap);
  }
  return series;
}

// What the page has to plot for a body of a scene.
export function expectedOfScene({ samples, contacts }: Pick<SceneTables, 'samples' | 'contacts'>, body: string): Record<string, number[]> {
  const columns = columnsOf(samples);
  const column = (name: string): number[] => columns.get(name) ?? expect.fail(`no column ${name}`);
  const motion = ['x', 'y', 'angle', 'vx', 'vy', 'omega'].map((key) => [key, column(`${body}.${key}`)] as const);
  const time = column('t');
  return {
    ...Object.fromEntries(motion),
    time,
    kinetic: column('kinetic'),
    potential: column('potential'),
    mechanical: sumOf(column('kinetic'), column('potential')),
    total_friction_loss: running(column('friction_loss')),
    total_impact_loss: running(column('impact_loss')),
    ...contactSeries(contacts, body, time.length),
  };
}

// Every plotted array against the command line's, and none is left out.
export async function expectPlotted(page: Page, expected: Record<string, number[]>, label = 'A'): Promise<void> {
  const shown = await plotted(page);
  const own = Object.keys(shown).filter((key) => key.startsWith(`${label}.`));
  expect(own.length).toBeGreaterThan(3);
  for (const key of own) {
    const values = expected[key.slice(label.length + 1)];
    if (!values) expect.fail(`${key} is plotted, but the command line has no such column`);
    expectSameBits(shown[key], values, key);
  }
}

// What is on the page is the command line's run of the same start.
export async function expectTrueDrop(page: Page, slot: 'a' | 'b' = 'a'): Promise<void> {
  const spec = await dropSpec(page, slot);
  if (spec.model !== 'document') throw new Error('only for the document’s model');
  await expectPlotted(page, expectedOfDrop(dropCsv(spec)), slot.toUpperCase());
}

// ---- Files that the page saves ----

export interface Saved {
  name: string;
  bytes: Buffer;
  text: string;
}
export async function save(page: Page, item: string, numFilesSaved = 1): Promise<Saved[]> {
  const downloads: Download[] = [];
  const listen = (download: Download): number => downloads.push(download);
  page.on('download', listen);
  await page.locator('#save-menu > summary').click();
  await page.locator(`[data-save="${item}"]`).click();
  await expect.poll(() => downloads.length, { timeout: 30_000 }).toBe(numFilesSaved);
  page.off('download', listen);
  return Promise.all(
    downloads.map(async (download) => {
      const bytes = readFileSync(await download.path());
      return { name: download.suggestedFilename(), bytes, text: bytes.toString('utf8') };
    }),
  );
}

export { documentDrop };
