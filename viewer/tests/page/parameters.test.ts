// Numbers that are moved and typed, good and bad.
import type { Locator, Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { chromiumForFile, dropSpec, expectTrueDrop, openScene, plotted, settled, specOf, type OpenOptions } from './browser';

const browser = chromiumForFile();
const row = (page: Page, key: string): Locator => page.locator(`.parameter[data-key="${key}"]`);
const entry = (page: Page, key: string): Locator => row(page, key).locator('.entry');
const line = (page: Page, key: string): Promise<string> => row(page, key).locator('[role=alert]').innerText();

const codes = /Maximum call stack|RuntimeError|BindingError|Aborted|exception|undefined|\[object|std::|memory access|unreachable/;
async function expectNoCode(page: Page): Promise<void> {
  expect(await page.locator('body').innerText()).not.toMatch(codes);
}

test('every slider and every entry changes the run', async () => {
  const page = await browser.open();
  await page.locator('#start-section > summary').click();
  const keys = await page.locator('.parameter').evaluateAll((nodes) => nodes.map((node) => (node as HTMLElement).dataset.key as string));
  expect(keys).toEqual(['mu', 'eps', 'l', 'm', 'dt', 'delta', 'g', 'columns', 'q0.0', 'q0.1', 'q0.2', 'v0.0', 'v0.1', 'v0.2']);
  for (const key of keys) {
    const before = await dropSpec(page);
    await row(page, key).locator('input[type=range]').focus();
    await page.keyboard.press('ArrowRight');
    const after = await dropSpec(page);
    expect(after, key).not.toEqual(before);
    expect(await line(page, key)).toBe('');
  }
  await expectTrueDrop(page);
  const typed = { mu: '0.7', eps: '0,25', l: '.3', m: '1e-1', dt: '0.005', delta: '0', g: '1.62', columns: '300', 'q0.0': '-0', 'q0.1': '1.25', 'q0.2': '−0.5', 'v0.0': '1', 'v0.1': '-2', 'v0.2': ' 3 ' };
  for (const [key, text] of Object.entries(typed)) await entry(page, key).fill(text);
  const spec = await dropSpec(page);
  expect(spec).toMatchObject({ mu: 0.7, eps: 0.25, l: 0.3, m: 0.1, dt: 0.005, delta: 0, g: 1.62, columns: 300, q0: [-0, 1.25, -0.5], v0: [1, -2, 3] });
  await expectTrueDrop(page);
  await page.locator('#reset').click();
  expect((await dropSpec(page)).mu).toBe(0.3);
  await expectTrueDrop(page);
});

test('bad numbers show a line at the field, and the last run stays', async () => {
  const page = await browser.open();
  await page.locator('#start-section > summary').click();
  const before = await plotted(page);
  for (const [key, text] of [['mu', '-1'], ['eps', '1.5'], ['l', '0'], ['m', '-0.3'], ['dt', '0'], ['delta', '-1'], ['columns', '1'], ['columns', '1e300'], ['columns', '20.5'], ['q0.1', '1e400'], ['mu', 'abc'], ['mu', ''], ['mu', 'NaN'], ['mu', '0x'], ['v0.2', 'Infinity']] as const) {
    const good = await entry(page, key).inputValue();
    await entry(page, key).fill(text);
    const message = await line(page, key);
    expect(message, `${key} = ${text}`).not.toBe('');
    expect(message).not.toContain('\n');
    expect(await entry(page, key).getAttribute('aria-invalid'), key).not.toBeNull();
    expect(await plotted(page)).toEqual(before);
    await expectNoCode(page);
    await entry(page, key).fill(good);
    expect(await line(page, key)).toBe('');
    expect(await entry(page, key).getAttribute('aria-invalid')).toBeNull();
  }
  await entry(page, 'mu').fill('-1');
  expect(await line(page, 'mu')).toMatch(/mu.*-1/);
  // Others still work on what stands in the fields.
  await entry(page, 'mu').fill('0.4');
  expect(await line(page, 'mu')).toBe('');
  await expectTrueDrop(page);
});

test('extreme numbers neither freeze the page nor break it', async () => {
  const page = await browser.open();
  await page.locator('#start-section > summary').click();
  for (const [key, text] of [['g', '1e300'], ['v0.0', '1e308'], ['m', '1e-320'], ['dt', '1e-300'], ['l', '1e200'], ['q0.1', '-1e300'], ['mu', '1e308'], ['v0.2', '1e18'], ['columns', '1000000'], ['dt', '1e250'], ['q0.2', '1e22']] as const) {
    await entry(page, key).fill(text);
    await page.locator('#timeline [data-action=step-forward]').click();
    await expectNoCode(page);
    await page.locator('#reset').click();
    expect(await line(page, key)).toBe('');
  }
  await expectTrueDrop(page);
});

test.each<[string, OpenOptions]>([
  ['desktop', {}],
  ['phone', { viewport: { width: 390, height: 844 }, hasTouch: true }],
])('a scene and its text, on a %s', async (_, options) => {
  const page = await browser.open(options);
  await openScene(page, 'slope_slide');
  const toml = async (): Promise<string> => ((await specOf(page)) as { toml: string }).toml;
  const before = await toml();
  await page.locator('.parameter[data-key^="material"] .entry').first().fill('0.125');
  await settled(page);
  expect(await toml()).not.toBe(before);
  await page.locator('.parameter[data-key^="material"] .entry').first().fill('-2');
  expect(await page.locator('.parameter[data-key^="material"] [role=alert]').first().innerText()).toMatch(/friction/);
  await page.locator('.parameter[data-key^="material"] .entry').first().fill('0.25');
  await settled(page);

  await page.locator('#text-section > summary').click();
  const text = page.locator('#toml');
  const good = await text.inputValue();
  expect(good).toContain('0.25');
  const run = await plotted(page);
  await text.fill(`${good}\nfriction = = 3`);
  await page.locator('#apply').click();
  expect(await page.locator('#toml-error').innerText()).toMatch(/^scene\.toml:\d+:\d+: \S.*$/);
  expect(await plotted(page)).toEqual(run);
  await text.fill(good.replace(/^duration = .*$/m, 'duration = 0.5'));
  await page.locator('#apply').click();
  await settled(page);
  expect(await page.locator('#toml-error').innerText()).toBe('');
  expect((await plotted(page))['A.time']?.at(-1)).toBeCloseTo(0.5, 9);
  await expectNoCode(page);
});
