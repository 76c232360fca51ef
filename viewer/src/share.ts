// Links: what was asked for, as the part of an address behind the #.
import { documentDrop, type DropSpec, type SceneSpec, type Spec } from './run';

export interface Shared {
  a: Spec;
  b: Spec | null;
  time: number; // [s]
}

export const maxLinkBytes = 2000;
const maxSceneBytes = 1_000_000;

const tripleKeys = ['q0', 'v0'] as const;
const numberKeys = ['l', 'm', 'mu', 'eps', 'dt', 'delta', 'g', 'columns'] as const;

// The shortest decimal with the same bits.
function numeral(key: string, x: number): string {
  if (!Number.isFinite(x)) throw new Error(`${key}: ${x} cannot stand in a link`);
  return Object.is(x, -0) ? '-0' : String(x).replace('e+', 'e');
}

function parseNumber(key: string, text: string): number {
  const x = /^-?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text) ? Number(text) : NaN;
  if (!Number.isFinite(x)) throw new Error(`${key}: "${shortened(text)}" in the link is not a number`);
  return x;
}

const shortened = (text: string): string => (text.length > 20 ? `${text.slice(0, 20)}…` : text);

function dropFields(spec: DropSpec): string[] {
  const fields: string[] = [];
  for (const key of tripleKeys) {
    if (spec[key].some((x, i) => !Object.is(x, documentDrop[key][i]))) {
      fields.push(`${key}=${spec[key].map((x) => numeral(key, x)).join(',')}`);
    }
  }
  for (const key of numberKeys) {
    if (!Object.is(spec[key], documentDrop[key])) fields.push(`${key}=${numeral(key, spec[key])}`);
  }
  if (spec.model === 'scene') fields.push('model=scene');
  return fields;
}

type Bytes = Uint8Array<ArrayBuffer>;

async function piped(bytes: Bytes, through: CompressionStream | DecompressionStream, most: number): Promise<Bytes> {
  const reader = new Blob([bytes]).stream().pipeThrough(through).getReader();
  const parts: Bytes[] = [];
  let length = 0;
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    length += part.value.length;
    if (length > most) {
      await reader.cancel();
      throw new RangeError(`more than ${most} bytes`);
    }
    parts.push(part.value);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

async function pack(text: string): Promise<string> {
  const bytes = await piped(new TextEncoder().encode(text), new CompressionStream('deflate'), Infinity);
  const characters = Array.from(bytes, (byte) => String.fromCharCode(byte)).join('');
  return btoa(characters).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

async function unpack(text: string): Promise<string> {
  if (!/^[\w-]+$/.test(text)) throw new Error('scene: the link is damaged: it holds characters that are not of base64url');
  try {
    const base64 = text.replaceAll('-', '+').replaceAll('_', '/');
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const inflated = await piped(bytes, new DecompressionStream('deflate'), maxSceneBytes);
    return new TextDecoder('utf-8', { fatal: true, ignoreBOM: true }).decode(inflated);
  } catch (error) {
    if (error instanceof RangeError) throw new Error('scene: the scene in the link is larger than 1 MB');
    throw new Error('scene: the link is cut off or damaged');
  }
}

async function sceneFields(spec: SceneSpec): Promise<string[]> {
  if (spec.toml === '') throw new Error('scene: it is empty');
  return [`scene=${await pack(spec.toml)}`, ...(spec.solver === 'fast' ? ['solver=fast'] : [])];
}

async function specFields(spec: Spec): Promise<string[]> {
  if (spec.kind === 'recorded') throw new Error('A recorded run does not fit into a link. Share its files instead.');
  return spec.kind === 'drop' ? dropFields(spec) : sceneFields(spec);
}

// For location.hash, without the #. Throws what cannot be in a link.
export async function encode({ a, b, time }: Shared): Promise<string> {
  const fields = await specFields(a);
  if (time !== 0) fields.push(`t=${numeral('t', time)}`);
  if (b) fields.push(`b=${encodeURIComponent((await specFields(b)).join('&'))}`);
  const link = fields.join('&');
  if (link.length > maxLinkBytes) {
    const size = `${link.length} bytes of at most ${maxLinkBytes}`;
    throw new Error(`This is too much for a link: ${size}. Save the scene as a file instead.`);
  }
  return link;
}

function fieldsOf(text: string): Map<string, string> {
  const fields = new Map<string, string>();
  for (const field of text === '' ? [] : text.split('&')) {
    const at = field.indexOf('=');
    if (at < 1) throw new Error(`link: "${shortened(field)}" is not of the form name=value`);
    const key = field.slice(0, at);
    if (fields.has(key)) throw new Error(`${shortened(key)}: it stands twice in the link`);
    try {
      fields.set(key, decodeURIComponent(field.slice(at + 1)));
    } catch {
      throw new Error(`${shortened(key)}: the link is cut off or damaged`);
    }
  }
  return fields;
}

// What is left after the known ones are taken.
function refuseOthers(fields: Map<string, string>, kind: string): void {
  for (const key of fields.keys()) throw new Error(`${shortened(key)}: a link of ${kind} has no such field`);
}

function take(fields: Map<string, string>, key: string): string | undefined {
  const value = fields.get(key);
  fields.delete(key);
  return value;
}

// One of two words, of which a link holds only the one that is not usual.
function takeWord<Word extends string>(fields: Map<string, string>, key: string, usual: Word, other: Word): Word {
  const value = take(fields, key) ?? usual;
  if (value !== usual && value !== other) {
    throw new Error(`${key}: it must be ${usual} or ${other}, not "${shortened(value)}"`);
  }
  return value as Word;
}

function parseDrop(fields: Map<string, string>): DropSpec {
  const spec: DropSpec = { ...documentDrop, q0: [...documentDrop.q0], v0: [...documentDrop.v0] };
  for (const key of tripleKeys) {
    const numbers = take(fields, key)?.split(',');
    if (!numbers) continue;
    if (numbers.length !== 3) throw new Error(`${key}: it must be three numbers with commas, got ${numbers.length}`);
    const [x, y, z] = numbers.map((text) => parseNumber(key, text)) as [number, number, number];
    spec[key] = [x, y, z];
  }
  for (const key of numberKeys) {
    const text = take(fields, key);
    if (text !== undefined) spec[key] = parseNumber(key, text);
  }
  if (!Number.isInteger(spec.columns)) throw new Error(`columns: it must be a whole number, not ${spec.columns}`);
  spec.model = takeWord<DropSpec['model']>(fields, 'model', 'document', 'scene');
  refuseOthers(fields, 'a drop');
  return spec;
}

async function parseSpec(fields: Map<string, string>): Promise<Spec> {
  const packed = take(fields, 'scene');
  if (packed === undefined) return parseDrop(fields);
  const solver = takeWord<SceneSpec['solver']>(fields, 'solver', 'exact', 'fast');
  refuseOthers(fields, 'a scene');
  return { kind: 'scene', toml: await unpack(packed), solver };
}

// Of location.hash, with or without the #. Throws an Error "field: what is wrong".
export async function decode(hash: string): Promise<Shared> {
  const text = hash.replace(/^#/, '');
  if (text.length > maxLinkBytes) throw new Error(`link: it has more than ${maxLinkBytes} bytes`);
  const fields = fieldsOf(text);
  const t = take(fields, 't');
  const inner = take(fields, 'b');
  const time = t === undefined ? 0 : parseNumber('t', t);
  if (time < 0) throw new Error(`t: it must not be negative, got ${t}`);
  const a = await parseSpec(fields);
  try {
    return { a, b: inner === undefined ? null : await parseSpec(fieldsOf(inner)), time };
  } catch (error) {
    throw new Error(`b: ${(error as Error).message}`);
  }
}
