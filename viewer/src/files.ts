// Files of runs: those inside the page, and those that are opened.
import type { Module } from 'tumble-engine';
import { checked, inflate } from './engine';
import { Run, type TextFile } from './run';

const maxBytes = 50_000_000;

function tooLarge(name: string, bytes: number): Error {
  return new Error(`${name}: it has ${Math.ceil(bytes / 1e6)} MB, the page opens files of at most ${maxBytes / 1e6} MB`);
}

export async function embeddedFiles(): Promise<TextFile[]> {
  const elements = document.querySelectorAll<HTMLScriptElement>('script[type="text/plain"].tumble-file');
  return Promise.all(
    Array.from(elements, async (element) => {
      const name = element.dataset.name ?? '';
      try {
        const bytes = await inflate((element.textContent ?? '').trim());
        return { name, text: new TextDecoder('utf-8', { fatal: true }).decode(bytes) };
      } catch {
        throw new Error(`${name}: this file inside the page is cut off or damaged`);
      }
    }),
  );
}

// The texts of files that were dropped or chosen.
export async function readFiles(files: Iterable<File>): Promise<TextFile[]> {
  return Promise.all(
    Array.from(files, async (file) => {
      if (file.size > maxBytes) throw tooLarge(file.name, file.size);
      return { name: file.name, text: await file.text() };
    }),
  );
}

type Kind = 'scene' | 'drop' | 'samples' | 'contacts';
const titles: Record<Kind, string> = {
  scene: 'scene',
  drop: 'record of a drop',
  samples: 'table of samples',
  contacts: 'table of contacts',
};
const expected = 'expected a scene (.toml) or a .csv that tumble run or tumble drop wrote';

function kindOf({ name, text }: TextFile): Kind {
  if (text.length > maxBytes) throw tooLarge(name, text.length);
  if (/\.toml$/i.test(name)) return 'scene';
  const table = /^# tumble (drop|samples|contacts) \d+\r?$/.exec(text.slice(0, text.indexOf('\n')))?.[1];
  if (!table) throw new Error(`${name}: ${expected}${/\.csv$/i.test(name) ? ', whose first line is "# tumble ..."' : ''}`);
  return table as Kind;
}

function byKind(files: TextFile[]): Map<Kind, TextFile> {
  const found = new Map<Kind, TextFile>();
  for (const file of files) {
    const kind = kindOf(file);
    const other = found.get(kind);
    if (other) throw new Error(`${file.name}: ${other.name} is a ${titles[kind]}, too; open one run at a time`);
    found.set(kind, file);
  }
  return found;
}

// The names of bodies in the first line of a table of samples that is not a comment, in their order.
export function bodiesOfSamples(text: string): string[] {
  const header = /^[^#\r\n].*$/m.exec(text)?.[0] ?? '';
  const cells = header.matchAll(/"((?:[^"]|"")*)"|[^,\r]+/g);
  const columns = Array.from(cells, ([all, quoted]) => quoted?.replaceAll('""', '"') ?? all);
  const ending = '.omega [rad/s]';
  return columns.filter((column) => column.endsWith(ending)).map((column) => column.slice(0, -ending.length));
}

// The scene of the run that is shown, if its bodies are those of the table.
function sceneFor(samples: TextFile, current: Run | null): string {
  const names = bodiesOfSamples(samples.text);
  const own = current?.trajectory.body_names.filter((_, i) => current.scene.bodies[i]?.kind !== 'fixed');
  const isSame = own?.length === names.length && own.every((name, i) => name === names[i]);
  if (current && isSame) return current.trajectory.scene;
  const others = current ? `, and the scene that is shown has not its bodies (${names.join(', ')})` : '';
  throw new Error(`${samples.name}: its scene is missing${others}; open it together with its .toml`);
}

function openTables(engine: Module, found: Map<Kind, TextFile>, current: Run | null): Run {
  const [scene, samples, contacts] = [found.get('scene'), found.get('samples'), found.get('contacts')];
  if (!samples) throw new Error(`${contacts?.name}: its table of samples (.csv) is missing; open both together`);
  const toml = scene?.text ?? sceneFor(samples, current);
  const files = [scene ?? { name: 'scene.toml', text: toml }, samples, ...(contacts ? [contacts] : [])];
  const run = engine.read_trajectory(toml, samples.text, samples.name, contacts?.text ?? '', contacts?.name ?? '');
  return new Run({ kind: 'recorded', files }, checked(run));
}

// What files are: a run that was recorded, or a scene to simulate. Throws an Error "file: what is wrong".
export function openFiles(engine: Module, files: TextFile[], current: Run | null): Run | { toml: string } {
  if (files.length === 0) throw new Error(`No file: ${expected}`);
  const found = byKind(files);
  const record = found.get('drop');
  if (record) {
    const other = files.find((file) => file !== record);
    if (other) throw new Error(`${other.name}: it does not belong to ${record.name}; open a ${titles.drop} alone`);
    return new Run({ kind: 'recorded', files }, checked(engine.read_record(record.text, record.name)));
  }
  const scene = found.get('scene');
  if (scene && found.size === 1) return { toml: scene.text };
  return openTables(engine, found, current);
}
