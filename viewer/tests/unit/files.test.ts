import { beforeEach, describe, expect, it, vi } from 'vitest';
vi.mock('../../src/engine', () => ({
  checked: (value: { error?: string }) => {
    if (value.error) throw new Error(value.error);
    return value;
  },
  inflate: () => Promise.reject(new Error('not here')),
}));
import { csvFiles, fileName, frameTimes } from '../../src/export';
import { bodiesOfSamples, openFiles, readFiles } from '../../src/files';
import { Run } from '../../src/run';
import type { Module } from 'tumble-engine';
import { engine as described, handMade } from './hand_made';

const header = 't [s],kinetic [J],box.x [m],box.y [m],box.angle [rad],box.vx [m/s],box.vy [m/s],box.omega [rad/s]\n';
const scene = { name: 'a.toml', text: 'tumble = 1\n' };
const samples = { name: 'a.csv', text: `# tumble samples 1\n# title = x\n${header}` };
const contacts = { name: 'a.contacts.csv', text: '# tumble contacts 1\n' };
const record = { name: 'drop.csv', text: '# tumble drop 1\r\n# l = 0.2 m\r\n' };
const current = handMade([0, 0.1]);

const handle = { trajectory: () => current.trajectory, record: () => null, scene: () => current.scene };
const read_record = vi.fn((..._: string[]): unknown => handle);
const read_trajectory = vi.fn((..._: string[]): unknown => handle);
const engine = { ...described, read_record, read_trajectory } as unknown as Module;

describe('openFiles', () => {
  beforeEach(() => vi.clearAllMocks());

  it('takes one scene as something to simulate', () => {
    expect(openFiles(engine, [scene], null)).toEqual({ toml: scene.text });
  });
  it('reads a record of a drop, also with CR LF', () => {
    const run = openFiles(engine, [record], current);
    expect(run).toBeInstanceOf(Run);
    expect((run as Run).spec).toEqual({ kind: 'recorded', files: [record] });
    expect(read_record).toHaveBeenCalledWith(record.text, 'drop.csv');
  });
  it('reads tables with their scene, in any order', () => {
    const run = openFiles(engine, [contacts, samples, scene], null) as Run;
    expect(read_trajectory).toHaveBeenCalledWith(scene.text, samples.text, 'a.csv', contacts.text, 'a.contacts.csv');
    expect(csvFiles(run)).toEqual([scene, samples, contacts]);
  });
  it('reads samples alone with the scene that is shown', () => {
    openFiles(engine, [samples], current);
    expect(read_trajectory).toHaveBeenCalledWith('tumble = 1\n', samples.text, 'a.csv', '', '');
  });
  it('passes errors of the engine on', () => {
    read_record.mockReturnValueOnce({ error: 'drop.csv:2:1: expected # l' });
    expect(() => openFiles(engine, [record], null)).toThrow('drop.csv:2:1: expected # l');
  });
  it.each([
    ['nothing', [], 'No file'],
    ['another file', [{ name: 'photo.png', text: '\u0089PNG' }], 'photo.png: expected a scene (.toml) or a .csv'],
    ['another table', [{ name: 'b.csv', text: 'a,b\n1,2\n' }], 'b.csv: expected a scene (.toml) or a .csv that tumble run'],
    ['an empty table', [{ name: 'b.csv', text: '' }], 'b.csv: expected'],
    ['two scenes', [scene, { ...scene, name: 'b.toml' }], 'b.toml: a.toml is a scene, too'],
    ['a record with a scene', [scene, record], 'a.toml: it does not belong to drop.csv'],
    ['contacts alone', [contacts], 'a.contacts.csv: its table of samples (.csv) is missing'],
    ['contacts with a scene', [contacts, scene], 'a.contacts.csv: its table of samples'],
    ['samples of other bodies', [{ ...samples, text: samples.text.replaceAll('box.', 'ball.') }], 'has not its bodies (ball)'],
    ['a table of 51 MB', [{ name: 'b.csv', text: ' '.repeat(50_000_001) }], 'b.csv: it has 51 MB, the page opens files of at most 50 MB'],
  ])('refuses %s', (_, files, message) => {
    expect(() => openFiles(engine, files, current)).toThrow(message);
  });
  it('refuses samples without any scene', () => {
    expect(() => openFiles(engine, [samples], null)).toThrow('a.csv: its scene is missing; open it together with its .toml');
  });
  it('does not read what is too large', async () => {
    const file = { name: 'b.csv', size: 60e6, text: () => Promise.reject(new Error('was read')) } as unknown as File;
    await expect(readFiles([file])).rejects.toThrow('b.csv: it has 60 MB');
  });
});

describe('bodiesOfSamples', () => {
  it('knows quoted names', () => {
    const text = '# tumble samples 1\r\n# title = a\r\nt [s],a.omega [rad/s],"b, ""c"".x [m]","b, ""c"".omega [rad/s]"\r\n0,1,2,3\r\n';
    expect(bodiesOfSamples(text)).toEqual(['a', 'b, "c"']);
  });
  it('finds none in a file of comments', () => expect(bodiesOfSamples('# tumble samples 1\n# a')).toEqual([]));
});

describe('export', () => {
  it('names files after the title', () => {
    expect(fileName('Drop of a square of side 0.2 m', 'png')).toBe('drop-of-a-square-of-side-0.2-m.png');
    expect(fileName('../../etc/passwd', 'csv')).toBe('etc-passwd.csv');
    expect(fileName('Größe: <1>', 'gif')).toBe('größe-1.gif');
    expect(fileName('', 'svg')).toBe('tumble.svg');
  });
  it('gives the tables of live runs', () => {
    expect(csvFiles(handMade([0]))).toEqual([
      { name: 'two-boxes.csv', text: 'samples of this run\n' },
      { name: 'two-boxes.contacts.csv', text: 'contacts of this run\n' },
    ]);
    expect(csvFiles(handMade([0], { record: {} }))).toEqual([{ name: 'drop.csv', text: 'record of this run\n' }]);
  });
  it('ends films with the end of the run', () => {
    expect(frameTimes(0.2, 0.1, 1)).toEqual([0, 0.1, 0.2]);
    expect(frameTimes(0.25, 0.1, 1)).toEqual([0, 0.1, 0.2, 0.25]);
    expect(frameTimes(0.4, 0.1, 2)).toEqual([0, 0.2, 0.4]);
    expect(frameTimes(0, 0.1, 1)).toEqual([0]);
  });
});
