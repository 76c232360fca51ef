// The colours of pictures, from the style sheet, so that light and dark have one home.
const names = [
  'paper',
  'ink',
  'muted',
  'grid',
  'ground',
  'body',
  'body-deep',
  'other',
  'other-deep',
  'accent',
  'stick',
  'slip-left',
  'slip-right',
  'open',
] as const;

export type Theme = Record<(typeof names)[number], string>;

export function readTheme(): Theme {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()])) as Theme;
}

// In the order of the codes in contact_mode: open, stick, slip left, slip right.
export const modeColours = (theme: Theme): string[] => [
  theme.open,
  theme.stick,
  theme['slip-left'],
  theme['slip-right'],
];

export const font = (size: number, weight = ''): string => `${weight ? weight + ' ' : ''}${size}px system-ui, sans-serif`;
