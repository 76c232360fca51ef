// Elements, and the letters of formulas as a book prints them.

export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  className = '',
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const node = document.createElement(tag);
  if (className) node.className = className;
  node.append(...children);
  return node;
}

export function setText(node: Node, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}

export interface Piece {
  text: string;
  level: 'base' | 'sub' | 'sup';
}

const letters: Record<string, string> = { lambda: 'λ', mu: 'μ', eps: 'ε', omega: 'ω', delta: 'δ' };
const circled = '①②③④⑤⑥⑦⑧⑨';

// "u_n' + eps u_n", "P_t- 2", "z1": subscripts, Greek letters, and contacts by a number in a circle.
export function pieces(text: string): Piece[] {
  const result: Piece[] = [];
  const add = (piece: string, level: Piece['level'] = 'base'): void => {
    const last = result.at(-1);
    if (last?.level === level) last.text += piece;
    else if (piece) result.push({ text: piece, level });
  };
  const numbered = text.replace(/^(.*[A-Za-z_|+'-].*) ([1-9])$/, (_, name: string, i: string) => `${name} ${circled[Number(i) - 1]}`);
  const token = /\b(lambda|mu|eps|omega|delta)\b|\b([A-Za-z])_([a-z]{1,2}\d?)([+-]?)('?)|\b([wz])(\d+)\b| - /g;
  let from = 0;
  for (const match of numbered.matchAll(token)) {
    add(numbered.slice(from, match.index));
    from = match.index + match[0].length;
    const [all, greek, letter, subscript, sign, prime, variable, number] = match;
    if (all === ' - ') add(' − ');
    else if (greek) add(letters[greek] as string);
    else if (variable) {
      add(variable);
      add(number as string, 'sub');
    } else {
      add(letter as string);
      add(subscript as string, 'sub');
      add((sign as string).replace('-', '−'), 'sup');
      if (prime) add('′');
    }
  }
  add(numbered.slice(from));
  return result;
}

export const plain = (text: string): string => pieces(text).map((piece) => piece.text).join('');

const shown = new WeakMap<Element, string>();

// As setText, with the letters of `pieces`.
export function setFormula(node: Element, text: string): void {
  if (shown.get(node) === text) return;
  shown.set(node, text);
  node.replaceChildren(...pieces(text).map(({ text: t, level }) => (level === 'base' ? t : element(level, '', t))));
}
