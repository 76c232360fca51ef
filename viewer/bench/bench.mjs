// Measures the page in headless Chromium: start, re-simulation, frames, memory, size.
//   node bench/bench.mjs PAGE OUTPUT.md
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { cpus, loadavg } from 'node:os';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';
import { chromium } from 'playwright-core';

const numStarts = 7; // each with a new browser and profile
const numRounds = 5;
const numChangesPerRound = 200;
const numEngineRunsPerRound = 1000;

const sorted = (values) => [...values].sort((a, b) => a - b);
const quantile = (values, share) => sorted(values)[Math.min(Math.floor(share * values.length), values.length - 1)];
const median = (values) => {
  const inOrder = sorted(values);
  const half = inOrder.length >> 1;
  return inOrder.length % 2 ? inOrder[half] : 0.5 * (inOrder[half - 1] + inOrder[half]);
};

const executablePath = execFileSync('sh', ['-c', 'command -v chromium'], { encoding: 'utf8' }).trim();
const args = ['--no-sandbox', ...['background-networking', 'component-update', 'gpu', 'sync'].map((name) => `--disable-${name}`)];

// Before the page's own scripts: when it is ready, how long callbacks of frames take, how much memory the engine has.
function watch() {
  window.bench = { readyAt: 0, frameWork: 0, memory: null };
  let tumble;
  Object.defineProperty(window, 'tumble', {
    configurable: true,
    get: () => tumble,
    set: (app) => {
      tumble = app;
      window.bench.readyAt = performance.now();
    },
  });
  const request = window.requestAnimationFrame.bind(window);
  window.nextFrame = request;
  window.requestAnimationFrame = (callback) =>
    request((now) => {
      const start = performance.now();
      callback(now);
      window.bench.frameWork += performance.now() - start;
    });
  const instantiate = WebAssembly.instantiate;
  WebAssembly.instantiate = async (...all) => {
    const result = await instantiate(...all);
    const { exports } = result.instance ?? result;
    window.bench.memory = Object.values(exports).find((item) => item instanceof WebAssembly.Memory);
    return result;
  };
}

async function open(browser, file) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, reducedMotion: 'reduce' });
  const page = await context.newPage();
  await page.addInitScript(watch);
  await page.goto(pathToFileURL(file).href);
  await settled(page);
  return page;
}
const settled = (page) =>
  page.waitForFunction(() => window.tumble?.runs.a && document.getElementById('progress').hidden, null, { timeout: 120_000 });

// ---- What is measured ----

async function measureStart(file) {
  const browser = await chromium.launch({ executablePath, args });
  const page = await open(browser, file);
  const times = await page.evaluate(async () => {
    while (performance.getEntriesByName('first-contentful-paint').length === 0) await new Promise((done) => setTimeout(done, 10));
    const [paint] = performance.getEntriesByName('first-contentful-paint');
    return { paint: paint.startTime, ready: window.bench.readyAt };
  });
  await browser.close();
  return times;
}

// The engine without the page, and with the arrays that the page takes. [ms] per run
const measureEngine = (page, numRuns) =>
  page.evaluate((count) => {
    const { engine, runs } = window.tumble;
    const spec = runs.a.spec;
    const time = (use) => {
      const start = performance.now();
      for (let i = 0; i < count; ++i) {
        const run = engine.simulate_drop({ ...spec, mu: 0.2 + 0.0001 * i });
        use(run);
        run.delete();
      }
      return (performance.now() - start) / count;
    };
    const alone = time(() => undefined);
    const withArrays = time((run) => {
      run.trajectory();
      run.record();
    });
    return { alone, withArrays };
  }, numRuns);

// As a hand does it: a number in the field of mu. Until all is updated, and what the next frame draws. [ms] each
const measureChanges = (page, numChanges) =>
  page.evaluate(async (count) => {
    const field = document.getElementById('parameter-mu');
    const turn = () => new Promise((done) => window.nextFrame(() => setTimeout(done, 0)));
    const changes = [];
    for (let i = 0; i < count; ++i) {
      await turn();
      window.bench.frameWork = 0;
      const start = performance.now();
      field.value = String(0.2 + 0.001 * (i % 200));
      field.dispatchEvent(new Event('input', { bubbles: true }));
      await Promise.resolve().then(() => undefined); // charts are drawn in a microtask
      const updated = performance.now() - start;
      await turn();
      changes.push({ updated, drawn: updated + window.bench.frameWork });
    }
    return changes;
  }, numChanges);

// 50 polygons that fall into a box: all are in motion or in contact.
const pile = `tumble = 1
title = "Fifty polygons"
duration = 4
step_size = 0.005
materials.default = { friction = 0.4, restitution = 0.3 }

[[bodies]]
name = "box"
kind = "fixed"
shape = { terrain = [[-1.2, 2.5], [-1, 0], [1, 0], [1.2, 2.5]] }
${[[-0.72, 3], [-0.36, 4], [0, 5], [0.36, 6], [0.72, 8]]
  .map(
    ([x, corners], i) => `
[[bodies]]
name = "polygon ${i}"
shape = { polygon = [${Array.from({ length: corners }, (_, k) => {
      const angle = (2 * Math.PI * k) / corners;
      return `[${(0.11 * Math.cos(angle)).toFixed(6)}, ${(0.11 * Math.sin(angle)).toFixed(6)}]`;
    }).join(', ')}] }
mass = 0.3
position = [${x}, ${0.4 + 0.03 * i}]
angle = ${0.2 * i}
copies = { count = 10, step = [0.004, 0.27] }`,
  )
  .join('\n')}
`;

// [ms] until it is simulated, in slices that keep the page awake
const simulatePile = (page) =>
  page.evaluate(async (toml) => {
    const start = performance.now();
    window.tumble.open({ a: { kind: 'scene', toml, solver: 'exact' }, b: null, time: 0 });
    while (window.tumble.runs.a.spec.toml !== toml || window.tumble.runs.a.duration < 1) await new Promise((done) => setTimeout(done, 5));
    return performance.now() - start;
  }, pile);

// The film in real time: between frames, and in the page's own callbacks [ms].
async function measureFilm(page, hasContacts) {
  await page.locator('#contacts').setChecked(hasContacts);
  return page.evaluate(async () => {
    const slider = document.querySelector('.time-slider');
    slider.value = '0';
    slider.dispatchEvent(new Event('input'));
    document.querySelector('.time-speed').value = '1';
    const { duration } = window.tumble.runs.a;
    const intervals = [];
    const work = [];
    document.querySelector('[data-action=play]').click();
    let last = await new Promise(window.nextFrame);
    window.bench.frameWork = 0;
    while (window.tumble.time < duration - 0.1) {
      const now = await new Promise(window.nextFrame);
      intervals.push(now - last);
      work.push(window.bench.frameWork);
      window.bench.frameWork = 0;
      last = now;
    }
    return { intervals, work };
  });
}

// Bytes that are in use when all garbage is gone.
async function memoryOf(page) {
  const session = await page.context().newCDPSession(page);
  for (let i = 0; i < 3; ++i) await session.send('HeapProfiler.collectGarbage');
  const { usedSize } = await session.send('Runtime.getHeapUsage');
  await session.detach();
  const engine = await page.evaluate(() => window.bench.memory?.buffer.byteLength ?? NaN);
  return { script: usedSize, engine };
}

// ---- The table ----

async function measure(file) {
  const starts = [];
  for (let i = 0; i < numStarts; ++i) starts.push(await measureStart(file));

  const browser = await chromium.launch({ executablePath, args });
  try {
    const page = await open(browser, file);
    await measureChanges(page, 50); // compiled and warm
    const memory = [['at first', await memoryOf(page)]];
    const changes = [];
    for (let i = 0; i < numRounds; ++i) {
      changes.push(...(await measureChanges(page, numChangesPerRound)));
      memory.push([`after ${changes.length} changes`, await memoryOf(page)]);
    }
    const engine = [];
    for (let i = 0; i < numRounds; ++i) engine.push(await measureEngine(page, numEngineRunsPerRound));
    memory.push([`after ${2 * numRounds * numEngineRunsPerRound} more runs of the engine`, await memoryOf(page)]);
    const simulated = await simulatePile(page);
    const films = { with: await measureFilm(page, true), without: await measureFilm(page, false) };
    return { starts, changes, engine, memory, simulated, films, version: browser.version() };
  } finally {
    await browser.close();
  }
}

function table(file, { starts, changes, engine, memory, simulated, films, version }) {
  const bytes = readFileSync(file);
  const ms = (x) => `${x.toFixed(x < 1 ? 3 : 1)} ms`;
  const kB = (x) => `${(x / 1000).toFixed(0)} kB`;
  const both = (values) => [ms(median(values)), ms(quantile(values, 0.95))];
  const worst = (values) => [ms(median(values)), ms(Math.max(...values))];
  const rows = [
    ['first paint, cold file, new profile', ...worst(starts.map(({ paint }) => paint))],
    ['until all is there and the engine has run', ...worst(starts.map(({ ready }) => ready))],
    ['the drop, engine alone', ...worst(engine.map(({ alone }) => alone))],
    ['the drop, engine and all its arrays', ...worst(engine.map(({ withArrays }) => withArrays))],
    ['the drop, page updated', ...both(changes.map(({ updated }) => updated))],
    ['the drop, page updated and drawn', ...both(changes.map(({ drawn }) => drawn))],
    ['film of 50 polygons: from frame to frame', ...both(films.with.intervals)],
    ['film of 50 polygons: script per frame', ...both(films.with.work)],
    ['film of 50 polygons without *contacts*: from frame to frame', ...both(films.without.intervals)],
    ['film of 50 polygons without *contacts*: script per frame', ...both(films.without.work)],
    ['50 polygons, 800 exact steps in slices', ms(simulated), ''],
  ];
  const lines = rows.map((row) => `| ${row.join(' | ')} |`);
  const memoryLines = memory.map(([what, { script, engine: inEngine }]) => `| ${what} | ${kB(script)} | ${kB(inEngine)} |`);
  return `Chromium ${version}, headless, without a graphics processor; ${cpus()[0].model}, load ${loadavg()[0].toFixed(1)} on ${cpus().length} cores.

| what | median | 95 %, of start and engine the slowest |
|---|---|---|
${lines.join('\n')}

| memory in use, garbage collected | script | engine |
|---|---|---|
${memoryLines.join('\n')}

Size of the page: ${kB(bytes.length)}, ${kB(gzipSync(bytes, { level: 9 }).length)} compressed by gzip -9.
`;
}

const [page, output] = process.argv.slice(2);
if (!page || !output) {
  console.error('usage: node bench/bench.mjs PAGE OUTPUT.md');
  process.exit(2);
}
const text = table(resolve(page), await measure(resolve(page)));
writeFileSync(output, text);
console.log(text);
