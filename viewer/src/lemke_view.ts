// Lemke's method, one pivot at a time.
import type { LemkePage, StepProblem } from 'tumble-engine';
import { number } from './format';
import { element, plain, setFormula, setText } from './markup';

type Pages = Pick<StepProblem, 'pages' | 'end'>;

// The pivot that leaves a page.
export function pivotWords({ pages }: Pages, k: number): string {
  const page = pages[k] as LemkePage;
  if (k === 0) return `${page.entering} enters, ${page.leaving} leaves: its value is the most negative.`;
  const row = page.basis.indexOf(page.leaving as string);
  const ratio = page.ratios[row];
  const smallest = ratio == null ? '' : `: the smallest ratio, ${number(ratio)}`;
  return `${page.entering} enters, the complement of ${page.left}, which left; ${page.leaving} leaves${smallest}.`;
}

export function endWords({ pages, end }: Pages): string {
  const last = pages.at(-1) as LemkePage;
  switch (end) {
    case 'no_pivot':
      return 'p ≥ 0: z = 0 is a solution, no pivot is needed.';
    case 'solved':
      return 'z0 has left: of each pair one variable is basic, and the values solve the problem.';
    case 'stopped':
      return 'Stopped at the allowed number of pivots.';
    case 'ray':
      return `${last.entering} enters, the complement of ${last.left}. No row limits it: a ray, and no solution found.`;
  }
}

export function pageTitle({ pages }: Pages, k: number): string {
  const numPivots = pages.length - 1;
  if (numPivots === 0) return 'No pivot';
  if (k < numPivots) return `Pivot ${k + 1} of ${numPivots}`;
  return numPivots === 1 ? 'After the one pivot' : `After all ${numPivots} pivots`;
}

export const pageWords = (problem: Pages, k: number): string =>
  k + 1 < problem.pages.length ? pivotWords(problem, k) : endWords(problem);

// "f_n" for z1, "" for those without a name of their own.
const meaning = (variable: string, z_names: string[]): string =>
  variable[0] === 'z' ? (z_names[Number(variable.slice(1)) - 1] ?? '') : '';

function button(text: string, label: string, onClick: () => void): HTMLButtonElement {
  const node = element('button', 'inspector-button', text);
  node.type = 'button';
  node.setAttribute('aria-label', label);
  node.addEventListener('click', onClick);
  return node;
}

interface Head {
  node: HTMLElement;
  variable: HTMLElement;
  meaning: HTMLElement;
}

function head(scope: 'col' | 'row'): Head {
  const [variable, small] = [element('span'), element('small')];
  const node = element('th', scope === 'row' ? 'inspector-row-name' : '', variable, small);
  node.scope = scope;
  return { node, variable, meaning: small };
}

interface Line {
  node: HTMLElement;
  basic: Head;
  cells: HTMLElement[];
}

export class LemkeView {
  private readonly title = element('span', 'inspector-pivot');
  private readonly words = element('p', 'inspector-pivot-words');
  private readonly caption = element('span');
  private readonly table = element('table', 'inspector-table inspector-tableau');
  private readonly scroller = element('div', 'inspector-scroll', this.table);
  private readonly previous = button('‹', 'Previous pivot', () => this.go(-1));
  private readonly next = button('›', 'Next pivot', () => this.go(1));
  private columns: Head[] = [];
  private ratio = element('th');
  private lines: Line[] = [];
  private problem: StepProblem | null = null;
  private page = 0;

  constructor(root: HTMLElement) {
    const stepper = element('div', 'inspector-stepper', this.previous, this.title, this.next);
    stepper.setAttribute('role', 'group');
    stepper.setAttribute('aria-label', 'Pivots');
    this.scroller.tabIndex = 0;
    this.scroller.setAttribute('role', 'region');
    this.scroller.setAttribute('aria-label', 'Tableau');
    const note = element('p', 'inspector-note');
    setFormula(
      note,
      'A row reads: basic variable + sum of entries times the variables above = value. Basic variables have unit columns, which are left out; all others are 0.',
    );
    root.append(stepper, this.words, this.scroller, note);
  }

  show(problem: StepProblem): void {
    this.problem = problem;
    this.page = Math.min(this.page, problem.pages.length - 1);
    this.draw(problem);
  }

  private go(by: number): void {
    const problem = this.problem;
    if (!problem) return;
    this.page = Math.max(0, Math.min(this.page + by, problem.pages.length - 1));
    this.draw(problem);
    this.reveal();
  }

  // Scrolls sideways to the entering column, clear of the names of the rows.
  private reveal(): void {
    const column = this.columns.find(({ node }) => node.classList.contains('inspector-entering'))?.node;
    if (!column) return;
    const { offsetLeft, offsetWidth } = column;
    const names = (this.lines[0] as Line).basic.node.offsetWidth;
    const { scrollLeft, clientWidth } = this.scroller;
    const least = offsetLeft + offsetWidth - clientWidth;
    this.scroller.scrollLeft = Math.max(Math.min(scrollLeft, offsetLeft - names), least);
  }

  private draw(problem: StepProblem): void {
    const page = problem.pages[this.page] as LemkePage;
    if (this.lines.length !== page.basis.length) {
      this.build(page.basis.length);
      requestAnimationFrame(() => this.reveal()); // when it is laid out
    }
    setText(this.title, pageTitle(problem, this.page));
    setFormula(this.words, pageWords(problem, this.page));
    setText(this.caption, this.page === 0 ? 'Start: all w are basic' : `Tableau after pivot ${this.page}`);
    // Not disabled: a button that is loses the focus of the keyboard.
    this.previous.setAttribute('aria-disabled', String(this.page === 0));
    this.next.setAttribute('aria-disabled', String(this.page + 1 === problem.pages.length));
    this.fill(page, problem);
  }

  private fill(page: LemkePage, { z_names, w_names }: StepProblem): void {
    const width = page.columns.length + 1;
    const entering = page.entering === null ? -1 : page.columns.indexOf(page.entering);
    const hasRatios = page.ratios.some((ratio) => ratio !== null);
    const name = (target: Head, variable: string): void => {
      setFormula(target.variable, variable);
      setFormula(target.meaning, meaning(variable, z_names));
      const names = variable[0] === 'z' ? z_names : w_names;
      target.node.title = plain(names[Number(variable.slice(1)) - 1] ?? 'artificial variable');
    };
    this.columns.forEach((target, j) => {
      name(target, page.columns[j] as string);
      target.node.classList.toggle('inspector-entering', j === entering);
    });
    this.ratio.hidden = !hasRatios;
    this.lines.forEach(({ node, basic, cells }, i) => {
      const isLeaving = page.basis[i] === page.leaving;
      name(basic, page.basis[i] as string);
      node.classList.toggle('inspector-leaving', isLeaving);
      cells.forEach((cell, j) => {
        cell.classList.toggle('inspector-entering', j === entering);
        cell.classList.toggle('inspector-pivot-entry', isLeaving && j === entering);
        if (j < width) setText(cell, number(page.entries[width * i + j] as number));
      });
      const last = cells[width] as HTMLElement;
      const ratio = page.ratios[i];
      last.hidden = !hasRatios;
      setText(last, ratio == null ? '–' : number(ratio));
    });
  }

  private build(n: number): void {
    this.columns = Array.from({ length: n + 1 }, () => head('col'));
    const fixed = ['basis', 'value', 'ratio'].map((text) => {
      const node = element('th', '', text);
      node.scope = 'col';
      return node;
    }) as [HTMLElement, HTMLElement, HTMLTableCellElement];
    this.ratio = fixed[2];
    this.lines = Array.from({ length: n }, () => {
      const basic = head('row');
      const cells = Array.from({ length: n + 3 }, () => element('td'));
      return { node: element('tr', '', basic.node, ...cells), basic, cells };
    });
    const heads = element('tr', '', fixed[0], ...this.columns.map(({ node }) => node), fixed[1], fixed[2]);
    const body = element('tbody', '', ...this.lines.map(({ node }) => node));
    this.table.replaceChildren(element('caption', '', this.caption), element('thead', '', heads), body);
  }
}
