// The named scenes of the project.
const texts = import.meta.glob('../../scenes/*.toml', { query: '?raw', import: 'default', eager: true }) as Record<string, string>;

export interface Example {
  name: string;
  title: string;
  toml: string;
}

export const examples: Example[] = Object.entries(texts).map(([path, toml]) => {
  const name = path.replace(/^.*\/|\.toml$/g, '');
  return { name, title: /^title = "(.*)"/m.exec(toml)?.[1] ?? name, toml };
});
