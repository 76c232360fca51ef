// A link holds the run: opened anew, it gives the same bits.
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { chooseAllPlots, chromiumForFile, dropSpec, expectSameBits, expectTrueDrop, openScene, plotted, settled, timeOf, type Chromium } from './browser';

const browser = chromiumForFile();

async function shared(page: Page): Promise<string> {
  await page.locator('#share').click();
  await page.waitForFunction(() => location.hash !== '' && !document.getElementById('message')?.hidden);
  const { hash, href } = await page.evaluate(() => ({ hash: location.hash, href: location.href }));
  expect(await page.locator('#message.is-error').count()).toBe(0);
  expect(new TextEncoder().encode(hash).length).toBeLessThan(2000);
  expect(href.endsWith(hash)).toBe(true);
  return hash;
}

async function expectSameRun(chromium: Chromium, page: Page): Promise<Page> {
  const hash = await shared(page);
  const again = await chromium.open({ hash });
  await chooseAllPlots(page);
  await chooseAllPlots(again);
  const [one, two] = [await plotted(page), await plotted(again)];
  expect(Object.keys(two)).toEqual(Object.keys(one));
  for (const [key, values] of Object.entries(one)) expectSameBits(two[key], values, key);
  expect(await timeOf(again)).toBe(await timeOf(page));
  return again;
}

test('a drop that was changed in every way', async () => {
  const page = await browser.open();
  await page.locator('#start-section > summary').click();
  const typed = { mu: '0.1234567890123', eps: '0.1', l: '0.31', m: '1.7', dt: '0.007', delta: '1e-7', g: '1.62', columns: '333', 'q0.0': '-0.1', 'q0.1': '1.7', 'q0.2': '2.718281828459045', 'v0.0': '-0', 'v0.1': '1e-17', 'v0.2': '-12' };
  for (const [key, text] of Object.entries(typed)) await page.locator(`.parameter[data-key="${key}"] .entry`).fill(text);
  await page.locator('.time-slider').fill('0.7');
  await page.locator('[data-action=step-forward]').click();
  const again = await expectSameRun(browser, page);
  await expectTrueDrop(again);
});

test('the general step beside the document’s model', async () => {
  const page = await browser.open();
  await page.locator('.parameter[data-key="mu"] .entry').fill('0.77');
  await page.locator('#compare').click();
  await settled(page);
  await page.locator('.parameter[data-key="eps"] .entry').fill('0.9');
  await settled(page);
  const again = await expectSameRun(browser, page);
  expect(await again.locator('#compare').getAttribute('aria-pressed')).toBe('true');
  expect(Object.keys(await plotted(again)).some((key) => key.startsWith('B.'))).toBe(true);
});

test('a scene that was changed', async () => {
  const page = await browser.open();
  await openScene(page, 'rocking_block');
  await page.locator('[data-handle="turn"]').focus();
  await page.keyboard.press('ArrowLeft');
  await settled(page);
  await page.locator('.parameter[data-key="material.0.friction"] .entry').fill('0.31');
  await settled(page);
  await expectSameRun(browser, page);
});

test('the address is followed when it changes', async () => {
  const page = await browser.open();
  await page.evaluate(() => (location.hash = '#mu=0.9&t=0.5'));
  await page.waitForFunction(() => window.tumble.time === 0.5);
  await expectTrueDrop(page);
});

const broken: [string, RegExp][] = [
  ['#mu=abc', /^mu: .*not a number/],
  ['#mu=-1', /^mu: .*-1/],
  ['#nonsense', /^link: /],
  ['#scene=%%%', /^scene: /],
  ['#scene=AAAA', /^scene: .*damaged/],
  ['#q0=1,2', /^q0: .*three/],
  ['#columns=1e300', /^columns: /],
  ['#columns=1000000', /^columns: /],
  ['#t=-1', /^t: /],
  ['#b=mu%3Dx', /^b: mu: /],
  [`#${'x'.repeat(5000)}`, /^link: .*2000/],
  ['#mu=1e308', /friction: must be in \[0, 1000000\], got 1e\+308$/],
];

async function expectOneLine(page: Page, expected: RegExp): Promise<void> {
  const message = page.locator('#message');
  await expect.poll(() => message.innerText()).toMatch(expected);
  expect(await message.isVisible()).toBe(true);
  const text = await message.innerText();
  expect(text).not.toContain('\n');
  expect(text.length).toBeLessThan(200);
}

test.each(broken.slice(0, 2))('a page that is opened with the broken link %s', async (hash, expected) => {
  const page = await browser.open({ hash });
  await expectOneLine(page, expected);
  // And the document's drop is there.
  await expectTrueDrop(page);
});

test('broken links one after the other, and a good one at the end', async () => {
  const page = await browser.open();
  for (const [hash, expected] of broken) {
    await page.evaluate((to) => (location.hash = to), hash);
    await expectOneLine(page, expected);
  }
  await page.evaluate(() => (location.hash = '#mu=0.25'));
  await expect.poll(() => page.locator('#message').isVisible()).toBe(false);
  await expectTrueDrop(page);
  expect((await dropSpec(page)).mu).toBe(0.25);
});

test('a scene too large for a link says so', async () => {
  const page = await browser.open();
  await openScene(page, 'backspin');
  await page.locator('#text-section > summary').click();
  const bodies = Array.from({ length: 60 }, (_, i) => `[[bodies]]\nname = "b${i}"\nshape = { disc = ${Math.sin(i + 1) ** 2 + 0.1} }\nposition = [${3 * i}, ${Math.cos(i)}]\nmass = ${2 + Math.sin(7 * i)}\n`);
  await page.locator('#toml').fill(`tumble = 1\nduration = 0.01\n${bodies.join('\n')}`);
  await page.locator('#apply').click();
  await settled(page);
  await page.locator('#share').click();
  await expect.poll(() => page.locator('#message').innerText()).toMatch(/too much for a link/);
});
