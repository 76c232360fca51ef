import { deflateSync } from 'node:zlib';
import { describe, expect, it, vi } from 'vitest';
vi.mock('../../src/engine', () => ({ checked: (value: unknown) => value }));
import { documentDrop, type DropSpec, type SceneSpec } from '../../src/run';
import { decode, encode, maxLinkBytes } from '../../src/share';

const drop = (changes: Partial<DropSpec>): DropSpec => ({ ...documentDrop, ...changes });
const scene = (toml: string): SceneSpec => ({ kind: 'scene', toml, solver: 'exact' });
const again = async (shared: Parameters<typeof encode>[0]): Promise<unknown> => decode(`#${await encode(shared)}`);
const packed = (bytes: Uint8Array | string): string => deflateSync(bytes).toString('base64url');

describe('links', () => {
  it('hold only what differs from the document', async () => {
    expect(await encode({ a: documentDrop, b: null, time: 0 })).toBe('');
    expect(await encode({ a: drop({ q0: [0, 1.5, 0.52], mu: 0.6 }), b: null, time: 0.4 })).toBe('q0=0,1.5,0.52&mu=0.6&t=0.4');
    expect(await decode('')).toEqual({ a: documentDrop, b: null, time: 0 });
    expect(await decode('#')).toEqual({ a: documentDrop, b: null, time: 0 });
  });
  it('bring back the same bits', async () => {
    const odd = [-0, 1e-300, 0.1 + 0.2, 5e-324, Number.MAX_VALUE, 1e21, -1 / 3, Number.MIN_VALUE, 2 ** 53 + 2];
    for (const x of odd) {
      const shared = { a: drop({ q0: [x, 1, 2], v0: [0, x, -0], mu: x, g: -x }), b: null, time: Math.abs(x) };
      // toEqual tells 0 from -0.
      expect(await again(shared)).toEqual(shared);
    }
  });
  it('hold both runs, of either kind', async () => {
    const toml = 'tumble = 1\ntitle = "Kiste & Größe = 1%"\n';
    const second: SceneSpec = { ...scene(toml), solver: 'fast' };
    for (const [a, b] of [
      [drop({ eps: 0.25 }), documentDrop],
      [drop({ model: 'scene' }), drop({ model: 'scene', columns: 300 })],
      [scene(toml), second],
      [documentDrop, scene(toml)],
    ] as const) {
      expect(await again({ a, b, time: 1.25 })).toEqual({ a, b, time: 1.25 });
    }
  });
  it('are refused where they would be too long or say too little', async () => {
    const noise = Array.from({ length: 600 }, (_, k) => Math.sin(k)).join(',');
    await expect(encode({ a: scene(noise), b: null, time: 0 })).rejects.toThrow(/^This is too much for a link: \d+ bytes/);
    await expect(encode({ a: { kind: 'recorded', files: [] }, b: null, time: 0 })).rejects.toThrow('recorded run');
    await expect(encode({ a: drop({ mu: NaN }), b: null, time: 0 })).rejects.toThrow('mu: NaN');
    await expect(encode({ a: scene(''), b: null, time: 0 })).rejects.toThrow('scene');
  });

  const whole = packed('tumble = 1\n'.repeat(20) + 'title = "something"\n');
  it.each([
    ['mu=abc', 'mu: "abc" in the link is not a number'],
    ['mu=', 'mu: "" in the link is not a number'],
    ['mu=Infinity', 'mu: "Infinity"'],
    ['mu=1e999', 'mu: "1e999"'],
    ['mu=0x10', 'mu: "0x10"'],
    ['mu= 1', 'mu: " 1"'],
    ['q0=1,2', 'q0: it must be three numbers with commas, got 2'],
    ['q0=1,,2', 'q0: ""'],
    ['q0=1,2,3,4', 'got 4'],
    ['columns=1.5', 'columns: it must be a whole number'],
    ['model=magic', 'model: it must be document or scene, not "magic"'],
    ['t=-1', 't: it must not be negative'],
    ['mu', 'link: "mu" is not of the form'],
    ['=1', 'link: "=1"'],
    ['mu=1&mu=2', 'mu: it stands twice'],
    ['colour=red', 'colour: a link of a drop has no such field'],
    ['__proto__=1', '__proto__: a link of a drop'],
    ['kind=recorded', 'kind: a link of a drop'],
    ['mu=%E0%A4%A', 'mu: the link is cut off or damaged'],
    ['b=mu%3Dx', 'b: mu: "x"'],
    ['b=t%3D1', 'b: t: a link of a drop'],
    ['b=b%3D', 'b: b: a link of a drop'],
    ['scene=', 'scene: the link is damaged'],
    ['scene=a*b', 'scene: the link is damaged'],
    ['scene=AAAA', 'scene: the link is cut off or damaged'],
    [`scene=${whole.slice(0, -1)}`, 'scene: the link is cut off or damaged'],
    [`scene=${whole.slice(0, -8)}`, 'scene: the link is cut off or damaged'],
    [`scene=${packed(Uint8Array.of(0xff, 0xfe))}`, 'scene: the link is cut off or damaged'],
    [`scene=${packed(new Uint8Array(1_000_001))}`, 'scene: the scene in the link is larger than 1 MB'],
    [`scene=${whole}&mu=1`, 'mu: a link of a scene has no such field'],
    [`scene=${whole}&solver=magic`, 'solver: it must be exact or fast'],
    [`mu=${'1'.repeat(maxLinkBytes)}`, 'link: it has more than 2000 bytes'],
  ])('%s is refused', async (link, message) => {
    const error = await decode(`#${link}`).then(
      () => null,
      (reason: Error) => reason,
    );
    expect(error?.message).toContain(message);
    expect(error?.message).not.toContain('\n');
  });
});
