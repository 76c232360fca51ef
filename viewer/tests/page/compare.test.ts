// Two runs beside each other.
import { expect, test } from 'vitest';
import { chooseAllPlots, chromiumForFile, dropSpec, expectedOfScene, expectPlotted, expectSameBits, expectTrueDrop, openScene, phone, plotted, runScene, save, settled, specOf, writeNewFile } from './browser';

const browser = chromiumForFile();

test('two sets of parameters', async () => {
  const page = await browser.open();
  expect(await page.locator('#slots').isVisible()).toBe(false);
  await page.locator('#compare').click();
  await settled(page);
  expect(await page.locator('#compare').getAttribute('aria-pressed')).toBe('true');
  expect((await dropSpec(page, 'b')).model).toBe('scene');
  await page.locator('#model').selectOption('document');
  await page.locator('.parameter[data-key="mu"] .entry').fill('0.9');
  await page.locator('[data-handle="velocity"]').focus();
  await page.keyboard.press('ArrowRight');
  const [a, b] = [await dropSpec(page), await dropSpec(page, 'b')];
  expect(a.mu).toBe(0.3);
  expect(b.mu).toBe(0.9);
  expect(b.v0).toEqual([0.1, -0.2, 0]);
  expect(a.v0).toEqual([0, -0.2, 0]);
  await chooseAllPlots(page);
  await expectTrueDrop(page, 'a');
  await expectTrueDrop(page, 'b');
  // The controls follow the slot.
  await page.locator('#slot-a').click();
  expect(await page.locator('.parameter[data-key="mu"] .entry').inputValue()).toBe('0.3');
  await page.locator('.parameter[data-key="mu"] .entry').fill('0.1');
  expect((await dropSpec(page, 'b')).mu).toBe(0.9);
  await expectTrueDrop(page, 'a');

  const both = await plotted(page);
  await page.locator('#difference').check();
  const difference = await plotted(page);
  const keys = Object.keys(difference).filter((key) => key.startsWith('A - B.'));
  expect(keys.length).toBeGreaterThan(8);
  for (const key of keys) {
    const name = key.slice('A - B.'.length);
    const [of, to] = [both[`A.${name}`], both[`B.${name}`]];
    if (!of || !to) expect.fail(`${name} is not plotted of both`);
    expectSameBits(difference[key], of.map((x, k) => x - (to[k] as number)), key);
  }
  await page.locator('#difference').uncheck();
  await page.locator('#compare').click();
  expect(await page.locator('#slots').isVisible()).toBe(false);
  expect(Object.keys(await plotted(page)).every((key) => key.startsWith('A.'))).toBe(true);
});

test('the general step beside the document’s model has the command line’s bits', async () => {
  const page = await browser.open();
  const [scene] = await (async () => {
    await page.locator('#model').selectOption('scene');
    await settled(page);
    const saved = await save(page, 'toml');
    await page.locator('#model').selectOption('document');
    await settled(page);
    return saved;
  })();
  await page.locator('#compare').click();
  await settled(page);
  await chooseAllPlots(page);
  const body = await page.evaluate(() => window.tumble.runs.b?.trajectory.body_names[1] ?? '');
  await expectPlotted(page, expectedOfScene(runScene(writeNewFile(scene?.bytes ?? '', 'toml')), body), 'B');
  await expectTrueDrop(page, 'a');
});

test.each([
  ['desktop', {}],
  ['phone', phone],
])('side by side, on a %s', async (_, options) => {
  const page = await browser.open(options);
  await page.locator('#compare').click();
  await settled(page);
  await page.locator('.time-slider').fill('1.2');
  const shot = (): Promise<Buffer> => page.locator('#stage').screenshot();
  const overlaid = await shot();
  await page.locator('#side').check();
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  expect((await shot()).equals(overlaid)).toBe(false);
  // The handles are in the picture of the run that they change.
  const isRight = async (): Promise<boolean> => {
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    const [stage, handle] = [await page.locator('#stage').boundingBox(), await page.locator('[data-handle="body"]').boundingBox()];
    if (!stage || !handle) throw new Error('no stage');
    return handle.x > stage.x + 0.5 * stage.width;
  };
  expect(await isRight()).toBe(true);
  await page.locator('[data-handle="body"]').hover();
  await page.mouse.down();
  const [x, y] = await page.locator('[data-handle="body"]').boundingBox().then((box) => [(box?.x ?? 0) + 35, (box?.y ?? 0) + 30]);
  await page.mouse.move(x as number, y as number);
  await page.mouse.up();
  await settled(page);
  expect((await dropSpec(page, 'b')).q0[0]).toBeGreaterThan(0.01);
  expect((await dropSpec(page, 'b')).q0[0]).toBeLessThan(1);
  expect((await dropSpec(page, 'a')).q0[0]).toBe(0);
  await page.locator('#slot-a').click();
  expect(await isRight()).toBe(false);
  await page.locator('#compare').click();
  await settled(page);
});

test('scenes are compared, and a difference that cannot be is said', async () => {
  const page = await browser.open();
  await openScene(page, 'slope_slide');
  await page.locator('#compare').click();
  await settled(page);
  await page.locator('.parameter[data-key="material.0.friction"] .entry').fill('0.05');
  await settled(page);
  const [a, b] = [await specOf(page, 'a'), await specOf(page, 'b')];
  expect(a).not.toEqual(b);
  await chooseAllPlots(page);
  const shown = await plotted(page);
  expect(shown['A.x']).not.toEqual(shown['B.x']);
  await page.locator('#difference').check();
  expect(Object.keys(await plotted(page))).toContain('A - B.y');
  await page.locator('.parameter[data-key="step_size"] .entry').fill('0.002');
  await settled(page);
  expect(await page.locator('.plots-note').innerText()).toMatch(/^No difference: /);
});
