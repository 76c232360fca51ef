// docs/tutorials/viewer.md, followed sentence by sentence. It is the script of this test:
//   Open `tumble.html#...`   Press **name**   Type `value` into **label**   Tick **label**   Unfold **title**
//   > what the page says         12.3<!-- the expression in the numbers of the page of which this is the value -->
//   ![...](viewer-name.png)      a picture of the page, taken here; UPDATE_PICTURES=1 puts it beside the text
// Runs A and B are `Readings` in expressions.
import { mkdtempSync, readFileSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import type { Locator, Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { chromiumForFile, pageFile, settled } from './browser';

const folder = resolve(fileURLToPath(new URL('.', import.meta.url)), '../../../docs/tutorials');
const tutorial = readFileSync(join(folder, 'viewer.md'), 'utf8');
const pictures = process.env.UPDATE_PICTURES ? folder : mkdtempSync(join(tmpdir(), 'tumble-tutorial-'));
const browser = chromiumForFile();

// ---- The text ----

interface Step {
  kind: 'open' | 'press' | 'type' | 'tick' | 'unfold' | 'quote' | 'number' | 'picture';
  words: string[];
  line: number;
}

const grammar: [Step['kind'], RegExp][] = [
  ['open', /\bopen\s+`tumble\.html(#[^`]*)`/iy],
  ['press', /\bpress\s+\*\*([^*]+)\*\*/iy],
  ['type', /\btype\s+`([^`]*)`\s+into\s+\*\*([^*]+)\*\*/iy],
  ['tick', /\btick\s+\*\*([^*]+)\*\*/iy],
  ['unfold', /\bunfold\s+\*\*([^*]+)\*\*/iy],
  ['quote', /^> (.*(?:\n> .*)*)/my],
  ['number', /([+−]?\d+(?:\.\d+)?)(?: [a-z]+)?<!-- (.+?) -->/y],
  ['picture', /!\[[^\]]*\]\(([^)]+)\)/y],
];

// The steps, and what is left of the text between them.
function read(text: string): { steps: Step[]; rest: string } {
  const steps: Step[] = [];
  let rest = '';
  let at = 0;
  while (at < text.length) {
    const found = grammar.find(([, pattern]) => ((pattern.lastIndex = at), pattern.test(text)));
    if (!found) {
      rest += text[at++];
      continue;
    }
    const [kind, pattern] = found;
    pattern.lastIndex = at;
    const words = (pattern.exec(text) as RegExpExecArray).slice(1);
    steps.push({ kind, words, line: text.slice(0, at).split('\n').length });
    at = pattern.lastIndex;
  }
  return { steps, rest };
}

// As the page's own text: no tags, single spaces.
const plain = (text: string): string => text.replace(/\n> /g, ' ').replace(/<[^>]*>/g, '').replace(/\s+/g, ' ').trim();

// ---- The page ----

// Of a run, by time: the numbers that the page draws. Runs in the page.
function readings(name: 'a' | 'b') {
  const run = window.tumble.runs[name];
  if (!run) throw new Error(`there is no run ${name.toUpperCase()}`);
  const component = (index: number) => (t: number): number => run.component(1, index)[run.sampleAt(t)] as number;
  const all = { vx: 3, vy: 4, omega: 5 };
  // The first contact of the step that leaves the sample.
  const row = (t: number): number => run.contactsOf(run.sampleAt(t)).first;
  const arm = (t: number, axis: 0 | 1): number => {
    const b = run.trajectory.contact_body_b[row(t)];
    const point = b === 1 ? run.trajectory.contact_point_b : run.trajectory.contact_point_a;
    return (point[2 * row(t) + axis] as number) - (run.poseAt(run.sampleAt(t), 1)[axis] as number);
  };
  const times = Array.from(run.trajectory.time);
  const record = (): NonNullable<typeof run.record> => {
    if (!run.record) throw new Error('only the document’s model has this');
    return run.record;
  };
  return {
    time: (t: number): number => times[run.sampleAt(t)] as number,
    x: component(0),
    y: component(1),
    omega: component(5),
    P_n: (t: number): number => run.trajectory.contact_normal_impulse[row(t)] as number,
    P_t: (t: number): number => run.trajectory.contact_friction_impulse[row(t)] as number,
    r_x: (t: number): number => arm(t, 0),
    r_y: (t: number): number => arm(t, 1),
    z: (i: number, t: number): number => record().z[(i - 1) * run.length + run.sampleAt(t)] as number,
    gap: (t: number): number => record().gap[run.sampleAt(t)] as number,
    nextContact: (t: number): number => times.find((time, k) => time >= t && record().gap[k]! < record().delta) as number,
    most: (key: keyof typeof all, from: number, to: number): number =>
      Math.max(...times.map((time, k) => (time >= from && time <= to ? Math.abs(run.component(1, all[key])[k] as number) : 0))),
    // From when on nothing moves.
    restsFrom: (): number => {
      const moves = times.map((_, k) => run.velocityAt(k, 1).some((v) => Math.abs(v) > 1e-9));
      return times[moves.lastIndexOf(true) + 1] as number;
    },
    mu: run.record?.mu,
    delta: run.record?.delta,
  };
}

async function value(page: Page, expression: string): Promise<number> {
  const of = (name: string): string => `${/\bB\b/.test(expression) || name === 'a' ? `readings('${name}')` : 'null'}`;
  return page.evaluate<number>(`(() => { ${readings}; const A = ${of('a')}, B = ${of('b')}; return ${expression}; })()`);
}

// ---- The pictures ----

interface Picture {
  of: (page: Page) => Locator; // what is on it
  width?: number; // of the window [px]
  scale?: number; // pixels of the picture for one of the page
  prepare?: (page: Page) => Promise<void>;
}

// The wheel over the ground below the place of the drop.
async function zoomToImpact(page: Page): Promise<void> {
  const box = await page.locator('#stage').boundingBox();
  if (!box) throw new Error('there is no stage');
  await page.mouse.move(box.x + 0.33 * box.width, box.y + 0.97 * box.height);
  await page.mouse.wheel(0, -900);
}

const shots: Record<string, Picture> = {
  'viewer-page.png': { of: (page) => page.locator('html'), width: 1280, scale: 0.7 },
  'viewer-spin.png': { of: (page) => page.locator('#stage'), prepare: zoomToImpact },
  'viewer-slip.png': { of: (page) => page.locator('.inspector-plane'), width: 1280 },
  'viewer-friction.png': { of: (page) => page.locator('#stage') },
  'viewer-lcp.png': { of: (page) => page.locator('#inspector .inspector-scroll').first() },
  'viewer-rest.png': { of: (page) => page.locator('#stage'), prepare: (page) => page.getByLabel('side by side').check() },
};
const maxBytes = 600_000;

// In a window of its own, so that nothing here changes what the next steps find.
async function take(page: Page, name: string): Promise<void> {
  const shot = shots[name];
  if (!shot) throw new Error(`${name}: nothing says what is on this picture`);
  const { of, width = 900, scale = 1, prepare } = shot;
  const hash = await page.evaluate(() => location.hash);
  const own = await browser.open({ hash, viewport: { width, height: 900 }, deviceScaleFactor: scale });
  await prepare?.(own);
  for (const title of await page.locator('#inspector details[open] h3').allTextContents()) {
    const details = own.locator('#inspector details:not([open])', { hasText: title });
    if ((await details.count()) > 0) await details.locator('summary').click();
  }
  await own.evaluate(() => scrollTo(0, 0));
  await own.waitForTimeout(300); // the parts follow the window's size
  const box = await of(own).boundingBox();
  if (!box) throw new Error(`${name}: what is on it is not there`);
  const file = join(pictures, name);
  await own.screenshot({ path: file, clip: { ...box, height: Math.min(box.height, 900) }, fullPage: true });
  expect(await numColours(own, file), `${name} shows something`).toBeGreaterThan(50);
  await own.context().close();
}

async function numColours(page: Page, file: string): Promise<number> {
  return page.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext('2d') as CanvasRenderingContext2D;
    context.drawImage(image, 0, 0);
    return new Set(new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer)).size;
  }, readFileSync(file).toString('base64'));
}

// ---- The walk ----

async function follow(page: Page, { kind, words, line }: Step): Promise<void> {
  const [first, second] = words as [string, string];
  const place = `viewer.md:${line}`;
  switch (kind) {
    case 'open':
      await page.evaluate(() => history.replaceState(null, '', '#'));
      await page.goto(pathToFileURL(pageFile).href + first);
      // The address is followed without loading anew.
      await expect.poll(() => page.evaluate(() => location.hash)).toBe(first);
      await settled(page);
      break;
    case 'press':
      await page.getByRole('button', { name: first, exact: true }).click();
      break;
    case 'type':
      await page.getByLabel(second, { exact: true }).fill(first);
      break;
    case 'tick':
      await page.getByLabel(first, { exact: true }).check();
      break;
    case 'unfold':
      await page.locator('summary', { hasText: first }).click();
      break;
    case 'quote':
      await expect.poll(async () => plain(await page.locator('aside').innerText()), { message: place }).toContain(plain(first));
      break;
    case 'number': {
      const digits = first.split('.')[1]?.length ?? 0;
      const exact = await value(page, second);
      const rounding = 0.5 * 10 ** -digits * (1 + 1e-9);
      expect(Math.abs(exact - Number(first.replace('−', '-'))), `${place}: ${second} is ${exact}, not ${first}`).toBeLessThanOrEqual(rounding);
      break;
    }
    case 'picture':
      await take(page, first);
  }
  await settled(page);
}

test('the page does and says what the tutorial says, and looks like its pictures', async () => {
  const page = await browser.open();
  const { steps } = read(tutorial);
  expect(new Set(steps.map(({ kind }) => kind)).size).toBe(grammar.length);
  for (const step of steps) await follow(page, step);
  const taken = steps.filter(({ kind }) => kind === 'picture').map(({ words: [name] }) => name as string);
  expect(taken.sort()).toEqual(Object.keys(shots).sort());
  for (const where of [pictures, folder]) {
    expect(taken.reduce((sum, name) => sum + statSync(join(where, name)).size, 0), where).toBeLessThan(maxBytes);
  }
});

test('every number of the tutorial is checked', () => {
  // Besides what is typed and formulas.
  const rest = read(tutorial).rest.replace(/`[^`]*`/g, '').replace(/^ {4}.*$/gm, '').replace(/\]\([^)]*\)/g, '');
  const unit = String.raw`(?:mm|mJ|J|m|m/s|rad/s|rad|s|N|N s|N m s|kg m²)\b`;
  const unchecked = rest.match(new RegExp(String.raw`.*(?:\d\.\d|\d ${unit}).*`, 'g'));
  expect(unchecked ?? []).toEqual([]);
});
