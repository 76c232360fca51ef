// V, p, z and w of a complementarity problem as a table, with the one of each pair that is not 0 marked.
import type { StepProblem } from 'tumble-engine';
import { number, withUnit } from './format';
import { element, plain, setFormula, setText } from './markup';

// Of a pair (z_i, w_i): which is not 0.
export type Nonzero = 'z' | 'w' | 'none';

// What is left of sums that vanish is nothing beside their terms.
const roundOff = 1e-9;

export function nonzeroOfPairs({ V, p, z, w, z_units }: StepProblem): Nonzero[] {
  const n = z.length;
  return Array.from(z, (z_i, i) => {
    let termSize = Math.abs(p[i] as number);
    for (let j = 0; j < n; ++j) termSize += Math.abs((V[n * i + j] as number) * (z[j] as number));
    const largest = Math.max(...Array.from(z).filter((_, j) => z_units[j] === z_units[i]).map(Math.abs));
    const zPart = largest > 0 ? Math.abs(z_i) / largest : 0;
    const wPart = termSize > 0 ? Math.abs(w[i] as number) / termSize : 0;
    if (Math.max(zPart, wPart) <= roundOff) return 'none';
    return zPart >= wPart ? 'z' : 'w';
  });
}

export function pairWords(nonzero: Nonzero, i: number): string {
  if (nonzero === 'none') return `z${i + 1} = 0 and w${i + 1} = 0`;
  const [large, small] = nonzero === 'z' ? ['z', 'w'] : ['w', 'z'];
  return `${large}${i + 1} > 0, so ${small}${i + 1} = 0`;
}

const mark = '●';

interface Cell {
  node: HTMLElement;
  value: HTMLElement;
  dot: HTMLElement;
}

interface Row {
  V: HTMLElement[];
  p: HTMLElement;
  z: Cell;
  w: Cell;
  says: HTMLElement;
}

function column(scope: 'col' | 'colgroup', text: string, span = 1): HTMLTableCellElement {
  const head = element('th');
  head.scope = scope;
  head.colSpan = span;
  setFormula(head, text);
  return head;
}

function valueCell(): Cell {
  const [dot, value] = [element('span', 'inspector-dot'), element('span')];
  dot.setAttribute('aria-hidden', 'true');
  return { node: element('td', '', dot, value), value, dot };
}

function showValue({ node, value, dot }: Cell, name: string, x: number, unit: string, isNonzero: boolean): void {
  setText(value, withUnit(isNonzero ? x : 0, unit));
  setText(dot, isNonzero ? mark : '');
  node.classList.toggle('inspector-nonzero', isNonzero);
  node.title = `${plain(name)} = ${withUnit(x, unit)}${isNonzero ? ': the one of its pair that is not 0' : x === 0 ? '' : ', round-off'}`;
}

export class LcpTable {
  private readonly caption = element('span');
  private readonly table = element('table', 'inspector-table');
  private readonly matrix = element('table', 'inspector-table');
  private readonly relation = element('p', 'inspector-note');
  private rows: Row[] = [];
  private names = '';

  constructor(root: HTMLElement) {
    for (const [table, label] of [[this.table, 'The pairs of this step'], [this.matrix, 'V and p of this step']] as const) {
      const scroller = element('div', 'inspector-scroll', table);
      scroller.tabIndex = 0;
      scroller.setAttribute('role', 'region');
      scroller.setAttribute('aria-label', label);
      root.append(scroller);
    }
    root.append(this.relation);
  }

  show(problem: StepProblem): void {
    const names = [...problem.z_names, ...problem.w_names].join();
    if (names !== this.names) this.build(problem);
    this.names = names;
    const nonzero = nonzeroOfPairs(problem);
    this.rows.forEach((row, i) => this.fill(row, i, problem, nonzero[i] as Nonzero));
    setFormula(this.relation, `w = V z + p, z ≥ 0, w ≥ 0, z · w = 0; residual ${number(problem.residual, 2)}`);
  }

  private fill(row: Row, i: number, problem: StepProblem, nonzero: Nonzero): void {
    const { V, p, z, w, z_names, z_units, w_names, w_units } = problem;
    row.V.forEach((cell, j) => setText(cell, number(V[row.V.length * i + j] as number)));
    setText(row.p, number(p[i] as number));
    showValue(row.z, z_names[i] as string, z[i] as number, z_units[i] as string, nonzero === 'z');
    showValue(row.w, w_names[i] as string, w[i] as number, w_units[i] as string, nonzero === 'w');
    setFormula(row.says, pairWords(nonzero, i));
  }

  // Two tables, for a narrow panel: the pairs, which are what one wants to see, then what they are made of.
  private build({ z_names, w_names }: StepProblem): void {
    setFormula(this.caption, `Of each pair of z and w one is 0; ${mark} marks the one that is not.`);
    this.rows = z_names.map(() => ({
      V: z_names.map(() => element('td')),
      p: element('td'),
      z: valueCell(),
      w: valueCell(),
      says: element('td', 'inspector-says'),
    }));
    const named = (name: string): HTMLTableCellElement => {
      const head = element('th', 'inspector-row-name');
      head.scope = 'row';
      setFormula(head, name);
      return head;
    };
    const symbol = (name: string): HTMLElement => {
      const cell = element('td', 'inspector-symbol');
      setFormula(cell, name);
      return cell;
    };
    const pairs = this.rows.map((row, i) =>
      element('tr', '', named(z_names[i] as string), row.z.node, symbol(w_names[i] as string), row.w.node, row.says),
    );
    this.table.replaceChildren(
      element('caption', '', this.caption),
      element('thead', '', element('tr', '', column('colgroup', 'z', 2), column('colgroup', 'w', 2), column('col', 'the pair'))),
      element('tbody', '', ...pairs),
    );
    const matrix = this.rows.map((row, i) => element('tr', '', named(w_names[i] as string), ...row.V, row.p));
    const first = column('col', 'w = V z + p');
    this.matrix.replaceChildren(
      element('caption', '', element('span', '', 'V, times z, and p')),
      element('thead', '', element('tr', '', first, ...z_names.map((name) => column('col', name)), column('col', 'p'))),
      element('tbody', '', ...matrix),
    );
  }
}
