// Files that are opened and saved, and pages that the command line writes.
import type { Page } from 'playwright-core';
import { describe, expect, test } from 'vitest';
import { chooseAllPlots, chromiumForFile, documentDrop, dropArguments, dropCsv, dropSpec, expectedOfDrop, expectedOfScene, expectPlotted, expectSameText, expectTrueDrop, newFile, openScene, runScene, save, sceneFile, settled, tumble, writeNewFile } from './browser';

const browser = chromiumForFile();
const changed = { ...documentDrop, mu: 0.55, v0: [1, -0.5, 3] as [number, number, number], columns: 180 };
const open = (page: Page, ...files: string[]): Promise<void> => page.locator('#open').setInputFiles(files);
const told = (page: Page): Promise<string> => page.locator('#message').innerText();
const dynamicBody = (page: Page): Promise<string> =>
  page.evaluate(() => {
    const run = window.tumble.runs.a;
    return run?.trajectory.body_names[run.scene.bodies.findIndex(({ kind }) => kind === 'dynamic')] ?? '';
  });

describe('files that are opened', () => {
  test('a record of a drop, which is then changed', async () => {
    const csv = dropCsv(changed);
    const page = await browser.open();
    await open(page, writeNewFile(csv, 'csv'));
    await expect.poll(() => told(page)).toMatch(/^A recorded run of 1\.79 s/);
    await chooseAllPlots(page);
    await expectPlotted(page, expectedOfDrop(csv));
    const [saved] = await save(page, 'csv');
    expectSameText(saved?.text ?? '', csv, 'drop.csv');
    // A link would simulate anew, which need not give what was recorded.
    await page.locator('#share').click();
    await expect.poll(() => told(page)).toBe('A recorded run does not fit into a link. Share its files instead.');
    await page.locator('.parameter[data-key="mu"] .entry').fill('0.2');
    expect(await dropSpec(page)).toEqual({ ...changed, mu: 0.2 });
    await expectTrueDrop(page);
  });

  test('the tables of a run with their scene, and dropped on the page', async () => {
    const tables = runScene(sceneFile('ellipse_drop'));
    const page = await browser.open();
    await open(page, tables.files.samples, tables.files.contacts, sceneFile('ellipse_drop'));
    await expect.poll(() => told(page)).toMatch(/^A recorded run of/);
    await chooseAllPlots(page);
    await expectPlotted(page, expectedOfScene(tables, await dynamicBody(page)));

    const again = await browser.open();
    await openScene(again, 'ellipse_drop');
    const texts = [{ name: 'run.csv', text: tables.samples }];
    await again.evaluate((files) => {
      const transfer = new DataTransfer();
      for (const { name, text } of files) transfer.items.add(new File([text], name));
      document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
    }, texts);
    await expect.poll(() => told(again)).toMatch(/^A recorded run of/);
    const header = tables.contacts.split('\n').find((row) => !row.startsWith('#')) ?? ''; // there are no contacts
    await expectPlotted(again, expectedOfScene({ samples: tables.samples, contacts: header }, await dynamicBody(again)));
  });

  test('a scene, after a comparison', async () => {
    const page = await browser.open();
    await page.locator('#compare').click();
    await settled(page);
    await open(page, sceneFile('conveyor'));
    await page.waitForFunction(() => window.tumble.runs.a?.spec.kind === 'scene');
    await settled(page);
    await chooseAllPlots(page);
    await expectPlotted(page, expectedOfScene(runScene(sceneFile('conveyor')), await dynamicBody(page)));
    await page.locator('.parameter[data-key="gravity"] .entry').fill('3');
    await settled(page);
    expect(await page.evaluate(() => window.tumble.runs.a?.scene.gravity[1])).toBe(-3);
  });

  test('what is not a run: one readable line, and the last run stays', async () => {
    const page = await browser.open();
    const csv = dropCsv(changed);
    const png = Uint8Array.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0, 1, 2, 3]);
    const line = csv.split('\n').findIndex((text) => text.startsWith('5,'));
    const cases: [string, RegExp][] = [
      [writeNewFile(png, 'png'), /\.png: expected a scene/],
      [writeNewFile('a,b\n1,2\n', 'csv'), /\.csv: expected .*first line/],
      [writeNewFile(csv.replace(/^5,0\.05/m, '5,abc'), 'csv'), new RegExp(`\\.csv:${line + 1}\\b.*abc`)],
      [writeNewFile(csv.slice(0, csv.length / 2), 'csv'), /\.csv:/],
      [writeNewFile('# tumble drop 1\n', 'csv'), /\.csv/],
      [writeNewFile('tumble = 1\nduration = \n', 'toml'), /\d+:\d+: /],
      [writeNewFile('', 'toml'), /./],
      [runScene(sceneFile('backspin')).files.contacts, /table of samples .* is missing/],
      [runScene(sceneFile('backspin')).files.samples, /scene is missing/],
    ];
    for (const [file, expected] of cases) {
      await page.evaluate(() => window.tumble.tell(''));
      await open(page, file);
      await expect.poll(() => told(page)).toMatch(expected);
      const text = await told(page);
      expect(text).not.toMatch(/\n|WebAssembly|\[object/);
      expect(await page.locator('#message.is-error').count()).toBe(1);
      expect((await dropSpec(page)).mu).toBe(0.3);
    }
    await expectTrueDrop(page);
  });
});

describe('pages that the command line writes', () => {
  test('of a drop', async () => {
    const file = newFile('html');
    tumble(...dropArguments(changed), '-o', file);
    const page = await browser.open({ file });
    await chooseAllPlots(page);
    await expectPlotted(page, expectedOfDrop(dropCsv(changed)));
  });

  test.each(['ellipse_drop', 'newtons_cradle'])('of the scene %s', async (name) => {
    const file = newFile('html');
    tumble('run', sceneFile(name), '-o', file);
    const page = await browser.open({ file });
    await chooseAllPlots(page);
    await expectPlotted(page, expectedOfScene(runScene(sceneFile(name)), await dynamicBody(page)));
    expect(await page.locator('#message.is-error').count()).toBe(0);
  });
});

// ---- What is saved ----

// Size and how many colours a picture has, by the browser's own decoder.
async function decoded(page: Page, bytes: Buffer, type: string): Promise<{ width: number; height: number; colours: number }> {
  return page.evaluate(
    async ([base64, kind]) => {
      const image = new Image();
      image.src = `data:${kind};base64,${base64}`;
      await image.decode();
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [image.width, image.height];
      const pen = canvas.getContext('2d') as CanvasRenderingContext2D;
      pen.drawImage(image, 0, 0);
      const pixels = new Uint32Array(pen.getImageData(0, 0, image.width, image.height).data.buffer);
      return { width: image.width, height: image.height, colours: new Set(pixels).size };
    },
    [bytes.toString('base64'), type] as const,
  );
}

// Blocks of a GIF: sizes, number of pictures, number of rounds (0: for ever).
function readGif(bytes: Buffer): { width: number; height: number; numFrames: number; rounds: number | null } {
  expect(bytes.subarray(0, 6).toString()).toBe('GIF89a');
  const tableSize = (flags: number): number => (flags & 0x80 ? 3 * 2 ** ((flags & 7) + 1) : 0);
  let at = 13 + tableSize(bytes[10] as number);
  let [numFrames, rounds]: [number, number | null] = [0, null];
  const skipBlocks = (): void => {
    while (bytes[at] !== 0) at += (bytes[at] as number) + 1;
    ++at;
  };
  while (bytes[at] !== 0x3b) {
    if (bytes[at] === 0x21) {
      if (bytes.subarray(at + 3, at + 14).toString() === 'NETSCAPE2.0') rounds = bytes.readUInt16LE(at + 16);
      at += 2;
    } else {
      expect(bytes[at]).toBe(0x2c);
      ++numFrames;
      at += 11 + tableSize(bytes[at + 9] as number);
    }
    skipBlocks();
  }
  return { width: bytes.readUInt16LE(6), height: bytes.readUInt16LE(8), numFrames, rounds };
}

describe('files that are saved', () => {
  test('pictures', async () => {
    const page = await browser.open();
    await page.locator('.time-slider').fill('0.6');
    const [png] = await save(page, 'png');
    expect(png?.name).toMatch(/\.png$/);
    const picture = await decoded(page, png?.bytes ?? Buffer.alloc(0), 'image/png');
    expect([picture.width, picture.height]).toEqual([1920, 1200]);
    expect(picture.colours).toBeGreaterThan(20);
    for (const item of ['svg', 'plots-svg']) {
      const [svg] = await save(page, item);
      expect(svg?.name).toMatch(/\.svg$/);
      const { error, marks } = await page.evaluate((text) => {
        const xml = new DOMParser().parseFromString(text, 'image/svg+xml');
        return { error: xml.querySelector('parsererror')?.textContent ?? '', marks: xml.querySelectorAll('path, line, polyline, text').length };
      }, svg?.text ?? '');
      expect(error).toBe('');
      expect(marks).toBeGreaterThan(10);
      expect((await decoded(page, svg?.bytes ?? Buffer.alloc(0), 'image/svg+xml')).colours).toBeGreaterThan(20);
    }
  });

  test('films', async () => {
    const page = await browser.open();
    await page.locator('.parameter[data-key="columns"] .entry').fill('41');
    await page.locator('.time-speed').selectOption('1');
    const [gif] = await save(page, 'gif');
    expect(gif?.name).toMatch(/\.gif$/);
    // 0.4 s with 25 pictures a second, and the last one.
    expect(readGif(gif?.bytes ?? Buffer.alloc(0))).toEqual({ width: 640, height: 400, numFrames: 11, rounds: 0 });
    expect((await decoded(page, gif?.bytes ?? Buffer.alloc(0), 'image/gif')).colours).toBeGreaterThan(10);
  });

  test('a film is cancelled', async () => {
    const page = await browser.open();
    await page.locator('.time-speed').selectOption('0.02');
    await page.locator('#save-menu > summary').click();
    await page.locator('[data-save="gif"]').click();
    await page.locator('[data-action="cancel-film"]').click();
    await expect.poll(() => told(page)).toBe('The film was not saved.');
    await settled(page);
  });
});
