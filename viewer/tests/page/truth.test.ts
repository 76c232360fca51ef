// The numbers of the page are those of the command line, bit for bit.
import { describe, expect, test } from 'vitest';
import type { DropSpec } from '../../src/run';
import {
  chooseAllPlots,
  chromiumForFile,
  documentDrop,
  dropCsv,
  expectedOfDrop,
  expectedOfScene,
  expectPlotted,
  expectSameText,
  openScene,
  openSpec,
  pageFile,
  runScene,
  save,
  sceneFile,
  settled,
  writeNewFile,
} from './browser';

const browser = chromiumForFile();

const drops: [string, Partial<DropSpec>][] = [
  ['the document’s start', {}],
  ['flat', { q0: [0, 0.8, 0], v0: [1.5, 0, 0] }],
  ['on a corner', { q0: [-0.3, 1, Math.PI / 4], v0: [0, -1, 0] }],
  ['spinning', { q0: [0.1, 1.2, -0.7], v0: [-2.5, 3, 25] }],
  ['all parameters', { q0: [1, 2, 3], v0: [-1, 2, -3], l: 0.37, m: 1.7, mu: 0.61, eps: 0.23, dt: 0.0047, delta: 0.0021, g: 3.71, columns: 401 }],
  ['no friction', { q0: [0, 1, 0.2], mu: 0, columns: 300 }],
  ['sticking', { v0: [4, -3, 0], mu: 12.5, eps: 0 }],
  ['elastic, nothing to stop it', { eps: 1, mu: 0, delta: 0, columns: 500 }],
  ['no threshold', { q0: [0, 0.3, 1e-9], v0: [0.5, 0, 0], delta: 0, dt: 0.002, columns: 800 }],
  ['no weight', { g: 0, v0: [0.3, -2, 5] }],
  ['starts below the ground', { q0: [0, -0.05, 0.1], v0: [1, -5, 2] }],
  ['huge and tiny', { q0: [1e6, 1.4142135623730951, 1e3], v0: [1e-300, -1e-5, -0], m: 1e-9, columns: 200 }],
];

describe('the document’s drop', () => {
  test.each([0, 1, 2])('the document’s start and eleven others, part %i of 3', async (part) => {
    const page = await browser.open();
    await chooseAllPlots(page);
    for (const [name, changes] of drops.filter((_, i) => i % 3 === part)) {
      const spec: DropSpec = { ...documentDrop, ...changes };
      const csv = dropCsv(spec);
      await openSpec(page, spec);
      await expectPlotted(page, expectedOfDrop(csv));
      const [file] = await save(page, 'csv');
      expect(file?.name).toBe('drop.csv');
      expectSameText(file?.text ?? '', csv, `drop.csv: ${name}`);
    }
  });

  test('by the general step, as the scene that the page saves', async () => {
    const page = await browser.open();
    await page.locator('#model').selectOption('scene');
    await settled(page);
    await chooseAllPlots(page);
    const [scene] = await save(page, 'toml');
    const tables = runScene(writeNewFile(scene?.bytes ?? '', 'toml'));
    const body = /^name = "(.*)"\nshape = \{ (?:polygon|rectangle)/m.exec(scene?.text ?? '')?.[1] ?? 'square';
    await expectPlotted(page, expectedOfScene(tables, body));
    const [samples, contacts] = await save(page, 'csv', 2);
    expectSameText(samples?.text ?? '', tables.samples, 'samples');
    expectSameText(contacts?.text ?? '', tables.contacts, 'contacts');
  });
});

describe('scenes', () => {
  test.each(['dominoes', 'wall_and_ball', 'rocking_block', 'ellipse_drop', 'conveyor', 'newtons_cradle', 'tilting_table', 'backspin'])('%s', async (name) => {
    const tables = runScene(sceneFile(name));
    const page = await browser.open();
    await openScene(page, name);
    await chooseAllPlots(page);
    const body = await page.evaluate(() => {
      const run = window.tumble.runs.a;
      return run?.trajectory.body_names[run.scene.bodies.findIndex(({ kind }) => kind === 'dynamic')] ?? '';
    });
    await expectPlotted(page, expectedOfScene(tables, body));
    const [samples, contacts] = await save(page, 'csv', 2);
    expectSameText(samples?.text ?? '', tables.samples, 'samples');
    expectSameText(contacts?.text ?? '', tables.contacts, 'contacts');
  });
});

test('nothing is asked of the network', async () => {
  const page = await browser.open();
  const requests: string[] = [];
  page.on('request', (request) => requests.push(request.url()));
  await page.reload();
  await settled(page);
  await openScene(page, 'ellipse_drop');
  await page.locator('#compare').click();
  await settled(page);
  await page.locator('#share').click();
  await save(page, 'png');
  await save(page, 'svg');
  await page.locator('#theme').click();
  expect(requests.length).toBeGreaterThan(0);
  const isOwn = (url: string): boolean => /^(blob|data):/.test(url) || decodeURI(new URL(url).pathname) === pageFile;
  expect(requests.filter((url) => !isOwn(url))).toEqual([]);
});
