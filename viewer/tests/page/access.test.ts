// For everyone: names, colours, narrow windows, the keyboard; and memory that does not grow.
import type { Page } from 'playwright-core';
import { describe, expect, test } from 'vitest';
import { chromiumForFile, openScene, settled } from './browser';

const browser = chromiumForFile();

async function unfoldAll(page: Page): Promise<void> {
  await page.evaluate(() => {
    for (const details of document.querySelectorAll('details')) details.open = true;
  });
  for (const chip of await page.locator('.plots-bar .plots-chip[aria-pressed=false]:visible').all()) if ((await chip.textContent()) === 'XY') await chip.click();
}

test('every control has a name', async () => {
  const page = await browser.open();
  await page.locator('#compare').click();
  await settled(page);
  await unfoldAll(page);
  await openScene(page, 'stack');
  await unfoldAll(page);
  // As the browser tells it to screen readers.
  const client = await page.context().newCDPSession(page);
  const { nodes } = await client.send('Accessibility.getFullAXTree');
  const roles = new Set(['button', 'slider', 'textbox', 'checkbox', 'combobox', 'image', 'img', 'DisclosureTriangle', 'progressbar', 'region', 'group']);
  const controls = nodes.filter(({ ignored, role }) => !ignored && roles.has(String(role?.value)));
  expect(controls.length).toBeGreaterThan(60);
  const isFormless = (role: unknown): boolean => role === 'group';
  const nameless = controls.filter(({ name, role }) => !isFormless(role?.value) && String(name?.value ?? '').trim() === '');
  const ids = nameless.map(({ backendDOMNodeId }) => backendDOMNodeId).filter((id) => id !== undefined);
  const texts = await Promise.all(ids.map(async (backendNodeId) => (await client.send('DOM.describeNode', { backendNodeId })).node));
  expect(texts.map(({ nodeName, attributes }) => `${nodeName} ${attributes?.join(' ')}`)).toEqual([]);
});

describe.each(['light', 'dark'] as const)('%s', (colorScheme) => {
  test('words are readable', async () => {
    const page = await browser.open({ colorScheme });
    await page.locator('.parameter[data-key="mu"] .entry').fill('-1');
    await unfoldAll(page);
    // Contrast of each text on the colour behind it, by WCAG 2.
    const poor = await page.evaluate(() => {
      const channels = (colour: string): number[] => (colour.match(/[\d.]+/g) ?? []).map(Number);
      const luminance = ([r, g, b]: number[]): number => {
        const [x, y, z] = [r, g, b].map((c) => ((c ?? 0) / 255 <= 0.04045 ? (c ?? 0) / 255 / 12.92 : (((c ?? 0) / 255 + 0.055) / 1.055) ** 2.4)) as [number, number, number];
        return 0.2126 * x + 0.7152 * y + 0.0722 * z;
      };
      const behind = (node: Element | null): number[] => {
        for (let at = node; at; at = at.parentElement) {
          const colour = channels(getComputedStyle(at).backgroundColor);
          if ((colour[3] ?? 1) > 0.99) return colour;
        }
        return [255, 255, 255];
      };
      const result: string[] = [];
      const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
      for (let text = walker.nextNode(); text; text = walker.nextNode()) {
        const parent = text.parentElement;
        if (!parent || !text.textContent?.trim() || !parent.checkVisibility() || /^(SCRIPT|STYLE|OPTION)$/.test(parent.tagName)) continue;
        const [a, b] = [luminance(channels(getComputedStyle(parent).color)), luminance(behind(parent))];
        const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
        if (contrast < 4.5) result.push(`${text.textContent.trim().slice(0, 30)}: ${contrast.toFixed(2)}`);
      }
      return [...new Set(result)];
    });
    expect(poor).toEqual([]);
  });
});

test('dark and light differ, and the button turns one into the other', async () => {
  const light = await (await browser.open({ colorScheme: 'light' })).locator('#stage').screenshot();
  const page = await browser.open({ colorScheme: 'dark' });
  const dark = await page.locator('#stage').screenshot();
  expect(dark.equals(light)).toBe(false);
  await page.locator('#theme').click();
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  expect((await page.locator('#stage').screenshot()).equals(dark)).toBe(false);
  expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe('light');
});

test.each([390, 320])('nothing is wider than a window of %i px', async (width) => {
  const page = await browser.open({ viewport: { width, height: 800 }, hasTouch: true, isMobile: true });
  await page.locator('#compare').click();
  await settled(page);
  await page.locator('.time-slider').fill('0.51');
  await unfoldAll(page);
  const sizes = await page.evaluate(() => ({ page: document.documentElement.scrollWidth, window: document.documentElement.clientWidth, visual: window.innerWidth }));
  expect(sizes).toEqual({ page: width, window: width, visual: width });
});

test('the focus is seen on every control', async () => {
  const page = await browser.open();
  const seen = new Set<string>();
  for (let i = 0; i < 70; ++i) {
    await page.keyboard.press('Tab');
    const focus = await page.evaluate(() => {
      const node = document.activeElement as HTMLElement | null;
      if (!node || node === document.body) return null;
      const shown = node.closest('.file-button') ?? node; // the input itself is hidden there
      const { outlineStyle, outlineWidth } = getComputedStyle(shown);
      return { name: node.id || node.dataset.handle || node.dataset.action || node.getAttribute('aria-label') || node.textContent?.slice(0, 20) || node.tagName, outline: outlineStyle !== 'none' && parseFloat(outlineWidth) >= 1 };
    });
    if (!focus) continue;
    expect(focus.outline, focus.name).toBe(true);
    seen.add(focus.name);
  }
  expect(seen.size).toBeGreaterThan(35);
});

test('1000 simulations take no more memory than 100', async () => {
  // The memory of the module, which it does not show itself.
  const page = await browser.open({
    init: () => {
      const instantiate = WebAssembly.instantiate.bind(WebAssembly) as (...args: unknown[]) => Promise<WebAssembly.WebAssemblyInstantiatedSource | WebAssembly.Instance>;
      Object.assign(WebAssembly, {
        instantiate: async (...args: unknown[]) => {
          const result = await instantiate(...args);
          const { exports } = 'instance' in result ? result.instance : result;
          Object.assign(window, { memoryOfEngine: Object.values(exports).find((value) => value instanceof WebAssembly.Memory) });
          return result;
        },
      });
    },
  });
  const client = await page.context().newCDPSession(page);
  const used = async (): Promise<{ heap: number; engine: number }> => {
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    await client.send('HeapProfiler.collectGarbage');
    const { usedSize } = await client.send('Runtime.getHeapUsage');
    const engine = await page.evaluate(() => (window as unknown as { memoryOfEngine: WebAssembly.Memory }).memoryOfEngine.buffer.byteLength);
    return { heap: usedSize, engine };
  };
  const entry = '.parameter[data-key="mu"] .entry';
  const simulate = (count: number): Promise<void> =>
    page.evaluate(
      ([selector, times]) => {
        const input = document.querySelector(selector) as HTMLInputElement;
        for (let i = 0; i < times; ++i) {
          input.value = String(0.2 + 0.001 * (i % 500));
          input.dispatchEvent(new Event('input'));
        }
      },
      [entry, count] as const,
    );
  await simulate(100);
  const before = await used();
  for (let i = 0; i < 10; ++i) await simulate(100);
  const after = await used();
  expect(after.engine).toBe(before.engine);
  // A run of 150 columns has 40 kB: one in ten that stayed would be 4 MB.
  expect(after.heap - before.heap).toBeLessThan(1_000_000);
});
