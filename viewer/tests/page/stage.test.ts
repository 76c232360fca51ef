// The stage: what is dragged, turned and pulled is simulated at once, and shown as it is.
import type { Locator, Page } from 'playwright-core';
import { describe, expect, test } from 'vitest';
import { chromiumForFile, desktop, dropSpec, expectTrueDrop, openScene, phone, plotted, settled, specOf, timeOf, type OpenOptions } from './browser';

const browser = chromiumForFile();
const sizes: [string, OpenOptions][] = [
  ['desktop', desktop],
  ['phone', phone],
];

const handle = (page: Page, name: string): Locator => page.locator(`[data-handle="${name}"]`);

async function middle(target: Locator): Promise<[number, number]> {
  await target.scrollIntoViewIfNeeded();
  const box = await target.boundingBox();
  if (!box) throw new Error('it is not on the page');
  return [box.x + 0.5 * box.width, box.y + 0.5 * box.height];
}

async function drag(page: Page, target: Locator, dx: number, dy: number): Promise<void> {
  const [x, y] = await middle(target);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 0.5 * dx, y + 0.5 * dy);
  await page.mouse.move(x + dx, y + dy);
  await page.mouse.up();
}

// The same with a finger.
async function swipe(page: Page, target: Locator, dx: number, dy: number): Promise<void> {
  const [x, y] = await middle(target);
  const client = await page.context().newCDPSession(page);
  const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', points: { x: number; y: number }[]): Promise<unknown> =>
    client.send('Input.dispatchTouchEvent', { type, touchPoints: points });
  await touch('touchStart', [{ x, y }]);
  await touch('touchMove', [{ x: x + 0.5 * dx, y: y + 0.5 * dy }]);
  await touch('touchMove', [{ x: x + dx, y: y + dy }]);
  await touch('touchEnd', []);
}

// Where the picture shows the world: pixels of the body's handle.
const placeOfBody = async (page: Page): Promise<string> => (await handle(page, 'body').getAttribute('style')) ?? '';

describe.each(sizes)('on a %s', (name, options) => {
  const move = name === 'phone' ? swipe : drag;

  test('the handles change the start, and the run follows at once', async () => {
    const page = await browser.open(options);
    const before = await dropSpec(page);
    await move(page, handle(page, 'body'), 40, 30);
    const moved = await dropSpec(page);
    expect(moved.q0[0]).toBeGreaterThan(before.q0[0]);
    expect(moved.q0[1]).toBeLessThan(before.q0[1]);
    expect(moved.q0[2]).toBe(before.q0[2]);
    expect(moved.v0).toEqual(before.v0);
    await expectTrueDrop(page);

    await move(page, handle(page, 'turn'), 0, 30);
    const turned = await dropSpec(page);
    expect(turned.q0[2]).toBeLessThan(moved.q0[2]);
    expect(turned.q0.slice(0, 2)).toEqual(moved.q0.slice(0, 2));
    await expectTrueDrop(page);

    await move(page, handle(page, 'velocity'), 60, -20);
    const pulled = await dropSpec(page);
    // The handle is 30 px beyond the tip of an arrow of 40 px for each m/s.
    const length = Math.hypot(60, 8 + 30 - 20);
    expect(pulled.v0[0]).toBeCloseTo(((60 / length) * (length - 30)) / 40, 1);
    expect(pulled.v0[1]).toBeCloseTo(((-18 / length) * (length - 30)) / 40, 1);
    await expectTrueDrop(page);

    await move(page, handle(page, 'spin'), -25, 10);
    const spun = await dropSpec(page);
    expect(spun.v0[2]).toBeGreaterThan(pulled.v0[2]);
    expect(spun.q0).toEqual(turned.q0);
    await expectTrueDrop(page);
  });

  test('a scene: another body is selected and moved', async () => {
    const page = await browser.open(options);
    await openScene(page, 'billiard');
    const canvas = page.locator('.stage-canvas');
    await canvas.scrollIntoViewIfNeeded();
    const names = await page.evaluate(() => window.tumble.runs.a?.trajectory.body_names ?? []);
    const first = await canvas.getAttribute('aria-label');
    const y = (await plotted(page))['A.y'];
    const box = await canvas.boundingBox();
    if (!box) throw new Error('no stage');
    // Along the middle of the table until another body is met.
    let label = first ?? '';
    for (let x = 0.98 * box.width; x > 0 && label === first; x -= 0.015 * box.width) {
      const at = [box.x + x, box.y + 0.5 * box.height] as const;
      await (name === 'phone' ? page.touchscreen.tap(...at) : page.mouse.click(...at));
      await page.evaluate(() => new Promise(requestAnimationFrame));
      label = (await canvas.getAttribute('aria-label')) ?? '';
    }
    expect(label).not.toBe(first);
    expect(names.some((body) => label.includes(`: ${body} at`))).toBe(true);
    expect((await plotted(page))['A.y']).not.toEqual(y);
    const toml = ((await specOf(page)) as { toml: string }).toml;
    await move(page, handle(page, 'velocity'), 20, -20);
    await settled(page);
    expect(((await specOf(page)) as { toml: string }).toml).not.toBe(toml);
  });

  test('zoom and pan leave the run alone', async () => {
    const page = await browser.open(options);
    const spec = await dropSpec(page);
    const start = await placeOfBody(page);
    await page.locator('#zoom-in').click();
    await expect.poll(() => placeOfBody(page)).not.toBe(start);
    await page.locator('#fit').click();
    await expect.poll(() => placeOfBody(page)).toBe(start);
    const [x, y] = await middle(page.locator('.stage-canvas'));
    if (name === 'desktop') {
      await page.mouse.move(x - 100, y);
      await page.mouse.wheel(0, -300);
      await expect.poll(() => placeOfBody(page)).not.toBe(start);
      await page.locator('#fit').click();
      await expect.poll(() => placeOfBody(page)).toBe(start);
    }
    await move(page, page.locator('.stage-canvas'), 50, 20);
    await expect.poll(() => placeOfBody(page)).not.toBe(start);
    expect(await dropSpec(page)).toEqual(spec);
    expect(await timeOf(page)).toBe(0);
  });
});

test('two fingers zoom', async () => {
  const page = await browser.open(phone);
  const start = await placeOfBody(page);
  const [x, y] = await middle(page.locator('.stage-canvas'));
  const client = await page.context().newCDPSession(page);
  for (const apart of [30, 50, 80]) {
    const touchPoints = [-1, 1].map((side, id) => ({ x: x + side * apart, y: y + 60, id }));
    await client.send('Input.dispatchTouchEvent', { type: apart === 30 ? 'touchStart' : 'touchMove', touchPoints });
  }
  await client.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await expect.poll(() => placeOfBody(page)).not.toBe(start);
});

test('the keyboard alone does all of it', async () => {
  const page = await browser.open();
  const focused = (): Promise<string> => page.evaluate(() => (document.activeElement as HTMLElement | null)?.dataset.handle ?? '');
  const tabTo = async (name: string): Promise<void> => {
    for (let i = 0; i < 40 && (await focused()) !== name; ++i) await page.keyboard.press('Tab');
    expect(await focused()).toBe(name);
  };
  const start = await dropSpec(page);
  await tabTo('body');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Shift+ArrowUp');
  expect((await dropSpec(page)).q0).toEqual([0.01, 1.6, start.q0[2]]);
  await tabTo('turn');
  await page.keyboard.press('ArrowLeft');
  expect((await dropSpec(page)).q0[2]).toBeGreaterThan(start.q0[2]);
  await tabTo('velocity');
  await page.keyboard.press('Shift+ArrowRight');
  await page.keyboard.press('ArrowDown');
  expect((await dropSpec(page)).v0).toEqual([1, -0.3, 0]);
  await tabTo('spin');
  await page.keyboard.press('ArrowUp');
  expect((await dropSpec(page)).v0[2]).toBe(0.1);
  await expectTrueDrop(page);
  expect(await page.locator('[data-handle="spin"]').getAttribute('aria-valuetext')).toBe('0.1 rad/s');
  // Also from a handle, the keys of the film work.
  await page.keyboard.press('.');
  expect(await timeOf(page)).toBe(0.01);
  await page.keyboard.press('.');
  await page.keyboard.press(',');
  expect(await timeOf(page)).toBe(0.01);
  await page.locator('.stage-canvas').focus();
  await page.keyboard.press(' ');
  await page.waitForFunction(() => window.tumble.time > 0.02);
  await page.keyboard.press(' ');
  const place = await placeOfBody(page);
  await page.keyboard.press('+');
  await expect.poll(() => placeOfBody(page)).not.toBe(place);
  await page.keyboard.press('0');
  await page.keyboard.press('ArrowLeft');
  await expect.poll(() => placeOfBody(page)).not.toBe(place);
});
