// The film, the time line and what the panel says of a step.
import type { Locator, Page } from 'playwright-core';
import { describe, expect, test } from 'vitest';
import { chromiumForFile, desktop, openScene, phone, settled, timeOf, type OpenOptions } from './browser';

const browser = chromiumForFile();
const act = (page: Page, name: string): Locator => page.locator(`[data-action="${name}"]`);
const slider = (page: Page): Locator => page.locator('.time-slider');
const section = (page: Page, title: string): Locator => page.locator('.inspector-section', { has: page.locator(`h3:text-is("${title}")`) });

test.each<[string, OpenOptions]>([
  ['desktop', desktop],
  ['phone', phone],
])('play, pause, step, scrub, loop, on a %s', async (name, options) => {
  const page = await browser.open(options);
  expect(await timeOf(page)).toBe(0);
  await act(page, 'play').click();
  expect(await act(page, 'play').getAttribute('aria-label')).toBe('Pause');
  await page.waitForFunction(() => window.tumble.time > 0.02);
  await act(page, 'play').click();
  const paused = await timeOf(page);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  expect(await timeOf(page)).toBe(paused);

  // Steps go from sample to sample.
  const sampleAt = (time: number): Promise<number> => page.evaluate((t) => window.tumble.runs.a?.sampleAt(t) ?? -1, time);
  const sample = await sampleAt(paused);
  await act(page, 'step-forward').click();
  expect(await sampleAt(await timeOf(page))).toBe(sample + 1);
  await act(page, 'step-back').click();
  await act(page, 'step-back').click();
  expect(await sampleAt(await timeOf(page))).toBe(sample - 1);

  await slider(page).focus();
  await page.keyboard.press('ArrowRight');
  expect(await sampleAt(await timeOf(page))).toBe(sample);
  await page.keyboard.press('PageUp');
  expect(await sampleAt(await timeOf(page))).toBe(sample + 10);
  await page.keyboard.press('End');
  expect(await timeOf(page)).toBeCloseTo(1.49, 9);
  await page.keyboard.press('ArrowRight');
  expect(await timeOf(page)).toBeCloseTo(1.49, 9);
  await page.keyboard.press('Home');
  expect(await timeOf(page)).toBe(0);
  const box = await slider(page).boundingBox();
  if (!box) throw new Error('no time line');
  const middle = [box.x + 0.5 * box.width, box.y + 0.5 * box.height] as const;
  await (name === 'phone' ? page.touchscreen.tap(...middle) : page.mouse.click(...middle));
  expect(await timeOf(page)).toBeGreaterThan(0.6);
  expect(await timeOf(page)).toBeLessThan(0.9);
  expect(await slider(page).getAttribute('aria-valuetext')).toMatch(/^0\.[678]\d\d s of 1\.49 s$/);

  // At its end the film stops, or with loop begins anew.
  await page.locator('.time-speed').selectOption('2');
  await slider(page).fill('1.45');
  await act(page, 'play').click();
  await page.waitForFunction(() => window.tumble.time >= 1.49 - 1e-9);
  await expect.poll(() => act(page, 'play').getAttribute('aria-label')).toBe('Play');
  await page.locator('.time-loop input').check();
  await slider(page).fill('1.3');
  await act(page, 'play').click();
  await page.waitForFunction(() => window.tumble.time > 0 && window.tumble.time < 1);
  expect(await act(page, 'play').getAttribute('aria-label')).toBe('Pause');
  await act(page, 'play').click();
});

test('the film starts by itself, but not where motion is unwelcome', async () => {
  const still = await browser.open({ reducedMotion: 'reduce' });
  expect(await act(still, 'play').getAttribute('aria-label')).toBe('Play');
  expect(await timeOf(still)).toBe(0);
  const moving = await browser.open({ reducedMotion: 'no-preference' });
  await moving.waitForFunction(() => window.tumble.time > 0);
  expect(await act(moving, 'play').getAttribute('aria-label')).toBe('Pause');
});

test('a pointer over a plot leads the time, unless the film is playing', async () => {
  const page = await browser.open();
  const plot = page.locator('.plot .u-over').first();
  await plot.scrollIntoViewIfNeeded();
  const box = await plot.boundingBox();
  if (!box) throw new Error('no plot');
  await page.mouse.move(box.x, box.y - 60);
  for (const share of [0.25, 0.75]) {
    await page.mouse.move(box.x + share * box.width, box.y + 40);
    expect(await timeOf(page)).toBeGreaterThan((share - 0.03) * 1.49);
    expect(await timeOf(page)).toBeLessThan((share + 0.03) * 1.49);
  }
  await page.locator('.time-speed').selectOption('0.02');
  await page.locator('.time-slider').fill('0.1');
  await act(page, 'play').click();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 40);
  expect(await timeOf(page)).toBeLessThan(0.6);
});

describe('what a step decides', () => {
  // The first step of the document's drop with a contact, by the engine's own arrays.
  const toImpact = (page: Page): Promise<number> =>
    page.evaluate(() => {
      const { record, trajectory } = window.tumble.runs.a ?? {};
      const k = record?.mode.findIndex((mode) => mode !== 0) ?? -1;
      const slide = document.querySelector('.time-slider') as HTMLInputElement;
      slide.value = String(trajectory?.time[k]);
      slide.dispatchEvent(new Event('input'));
      return k;
    });

  test('words, table and pivots of an impact', async () => {
    const page = await browser.open();
    const words = section(page, 'The contact in words');
    await expect.poll(() => words.innerText()).toContain('No contact');
    const k = await toImpact(page);
    expect(k).toBeGreaterThan(0);
    await expect.poll(() => words.innerText()).toContain(`Step ${k + 1}`);
    expect(await words.innerText()).toMatch(/slip|stick/);
    expect(await section(page, 'Impulse plane').locator('canvas').getAttribute('aria-label')).toMatch(/\d/);

    await section(page, 'The complementarity problem').locator('summary').click();
    const table = section(page, 'The complementarity problem').locator('table').first();
    await table.waitFor();
    const cells = await page.evaluate((sample) => {
      const problem = window.tumble.runs.a?.problem(sample);
      return problem && { n: problem.z.length, z: [...problem.z], w: [...problem.w] };
    }, k);
    if (!cells) throw new Error('no problem');
    expect(await table.locator('tbody tr').count()).toBe(cells.n);
    // One of each pair is marked.
    for (let i = 0; i < cells.n; ++i) {
      const row = table.locator('tbody tr').nth(i);
      const isMarked = Math.max(Math.abs(cells.z[i] as number), Math.abs(cells.w[i] as number)) > 1e-9;
      expect(await row.locator('.inspector-nonzero').count()).toBe(isMarked ? 1 : 0);
      expect(await row.locator('.inspector-says').innerText()).toMatch(/0/);
    }

    await section(page, 'Lemke’s pivots').locator('summary').click();
    const lemke = section(page, 'Lemke’s pivots');
    const said = new Set<string>();
    const next = lemke.getByRole('button', { name: 'Next pivot' });
    for (let i = 0; i < 20 && (await next.getAttribute('aria-disabled')) !== 'true'; ++i) {
      said.add(await lemke.locator('.inspector-pivot-words').innerText());
      await next.click();
    }
    expect(await lemke.locator('.inspector-pivot-words').innerText()).toContain('has left: of each pair one variable is basic');
    expect(said.size).toBeGreaterThan(1);
    const previous = lemke.getByRole('button', { name: 'Previous pivot' });
    for (let i = 0; i < 20 && (await previous.getAttribute('aria-disabled')) !== 'true'; ++i) await previous.click();
    expect(await lemke.locator('.inspector-pivot').innerText()).toMatch(/^Pivot 1 of \d+$/);
  });

  test('many contacts: one plane for each', async () => {
    const page = await browser.open();
    await openScene(page, 'stack');
    await page.locator('.time-slider').fill('1');
    const choice = section(page, 'Impulse plane').locator('select');
    await expect.poll(() => choice.locator('option').count()).toBeGreaterThan(3);
    const before = await section(page, 'Impulse plane').locator('canvas').getAttribute('aria-label');
    await choice.selectOption({ index: 3 });
    expect(await section(page, 'Impulse plane').locator('canvas').getAttribute('aria-label')).not.toBe(before);
    await section(page, 'The complementarity problem').locator('summary').click();
    await settled(page);
    expect(await section(page, 'The complementarity problem').innerText()).toMatch(/residual|problem/);
  });
});
