// The panel of what one step decides: its contacts in words, the impulse plane, the LCP, and Lemke's pivots.
import type { ImpulsePlane, StepProblem } from 'tumble-engine';
import { maxContacts, modeMarks, stepWords, type StepWords } from './contact_words';
import { drawImpulsePlane, planeWords } from './impulse_plane';
import './inspector.css';
import { LcpTable } from './lcp_table';
import { LemkeView } from './lemke_view';
import { element, plain, setFormula, setText } from './markup';
import type { Run } from './run';
import { readTheme } from './theme';

const modeClasses = ['open', 'stick', 'slip-left', 'slip-right'];

// A part of the panel that is filled only while it is open.
class Section {
  readonly content = element('div');
  readonly body: HTMLElement;
  private readonly details: HTMLDetailsElement;
  private readonly note = element('p', 'inspector-note');

  constructor(root: HTMLElement, title: string, isOpen: boolean, onOpen: () => void) {
    this.body = element('div', 'inspector-body', this.note, this.content);
    this.details = element('details', 'inspector-section', element('summary', '', element('h3', '', title)), this.body);
    this.details.open = isOpen;
    this.details.addEventListener('toggle', onOpen);
    root.append(this.details);
  }

  get isOpen(): boolean {
    return this.details.open;
  }
  // Instead of the content; '': the content.
  tell(text: string, isError = false): void {
    setFormula(this.note, text);
    this.note.hidden = text === '';
    this.note.classList.toggle('inspector-error', isError);
    this.content.hidden = text !== '';
  }
}

class ContactCard {
  private readonly badge = element('span', 'inspector-mode');
  private readonly who = element('span', 'inspector-who');
  private readonly list = element('ul');
  readonly node = element('article', 'inspector-contact', element('p', '', this.badge, ' ', this.who), this.list);

  show(mode: number, modeName: string, who: string, lines: string[]): void {
    this.node.dataset.mode = modeClasses[mode] ?? 'open';
    setText(this.badge, `${modeMarks[mode] ?? ''} ${modeName}`);
    setText(this.who, who);
    fillList(this.list, lines);
  }
}

function fillList(list: HTMLElement, lines: string[]): void {
  while (list.children.length < lines.length) list.append(element('li'));
  while (list.children.length > lines.length) list.lastChild?.remove();
  lines.forEach((line, i) => setFormula(list.children[i] as Element, line));
}

class WordsView {
  private readonly step = element('p', 'inspector-step');
  private readonly summary = element('p');
  private readonly cards = Array.from({ length: maxContacts }, () => new ContactCard());
  private readonly more = element('p', 'inspector-note');
  private readonly spinTitle = element('h4', '', 'Why does it spin?');
  private readonly spins = element('ul', 'inspector-spins');

  constructor(root: HTMLElement) {
    root.append(this.step, this.summary, ...this.cards.map(({ node }) => node), this.more, this.spinTitle, this.spins);
  }

  show(words: StepWords, modeNames: string[]): void {
    setText(this.step, words.step);
    setFormula(this.summary, words.summary);
    this.summary.hidden = words.summary === '';
    this.cards.forEach((card, i) => {
      const contact = words.contacts[i];
      card.node.hidden = !contact;
      if (contact) card.show(contact.mode, modeNames[contact.mode] ?? '', contact.who, contact.lines);
    });
    setText(this.more, `and ${words.more} more`);
    this.more.hidden = words.more === 0;
    fillList(this.spins, words.spins);
    this.spinTitle.hidden = words.spins.length === 0;
    this.spins.hidden = words.spins.length === 0;
  }
}

class PlaneView {
  private readonly select = element('select');
  private readonly choice = element('label', 'inspector-choice', 'Contact ', this.select);
  private readonly canvas = element('canvas', 'inspector-plane');
  private planes: ImpulsePlane[] = [];

  constructor(root: HTMLElement) {
    const legend = element('p', 'inspector-note');
    setFormula(
      legend,
      "P is what the contact gave. It lies in the friction cone |P_t| ≤ mu P_n. On the lines: compression, u_n' = 0; restitution, or closing of the gap, u_n' is its target; sticking, u_t' = 0.",
    );
    this.canvas.setAttribute('role', 'img');
    root.append(this.choice, this.canvas, legend);
    this.select.addEventListener('change', () => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    new MutationObserver(() => this.draw()).observe(document.documentElement, { attributeFilter: ['data-theme'] });
  }

  get plane(): ImpulsePlane | null {
    return this.planes[Math.max(this.select.selectedIndex, 0)] ?? this.planes[0] ?? null;
  }

  show(planes: ImpulsePlane[], names: string[]): void {
    this.planes = planes;
    this.choice.hidden = planes.length < 2;
    const options = planes.map((_, i) => `${i + 1}${names[i] ? `: ${names[i]}` : ''}`);
    const chosen = Math.max(this.select.selectedIndex, 0);
    while (this.select.options.length > options.length) this.select.remove(options.length);
    options.forEach((text, i) => {
      const option = this.select.options[i];
      if (option) setText(option, text);
      else this.select.add(new Option(text));
    });
    this.select.selectedIndex = Math.min(chosen, options.length - 1);
    this.draw();
  }

  private draw(): void {
    const plane = this.plane;
    const width = this.canvas.clientWidth;
    const context = this.canvas.getContext('2d');
    if (!plane || !context || width === 0) return;
    const height = this.canvas.clientHeight;
    const ratio = window.devicePixelRatio || 1;
    const [pixelWidth, pixelHeight] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.canvas.width !== pixelWidth) this.canvas.width = pixelWidth;
    if (this.canvas.height !== pixelHeight) this.canvas.height = pixelHeight;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    drawImpulsePlane(context, width, height, plane, readTheme());
    this.canvas.setAttribute('aria-label', plain(planeWords(plane)));
  }
}

export class Inspector {
  private readonly sections: { section: Section; fill: (run: Run) => string }[] = [];
  private readonly plane: PlaneView;
  private run: Run | null = null;
  private sample = -1;
  private cached: { words?: StepWords; problem?: StepProblem | null } = {};

  constructor(root: HTMLElement) {
    root.classList.add('inspector');
    const add = (title: string, isOpen: boolean): Section => new Section(root, title, isOpen, () => this.update());
    const [words, plane, table, lemke] = [
      add('The contact in words', true),
      add('Impulse plane', true),
      add('The complementarity problem', false),
      add('Lemke’s pivots', false),
    ];
    const wordsView = new WordsView(words.content);
    this.plane = new PlaneView(plane.content);
    const tableView = new LcpTable(table.content);
    const lemkeView = new LemkeView(lemke.content);
    this.sections.push({ section: words, fill: (run) => this.fillWords(run, wordsView) });
    this.sections.push({ section: plane, fill: (run) => this.fillPlane(run) });
    this.sections.push({ section: table, fill: (run) => this.fillProblem(run, tableView) });
    this.sections.push({ section: lemke, fill: (run) => this.fillProblem(run, lemkeView) });
    this.update();
  }

  show(run: Run | null, sample: number): void {
    if (run === this.run && sample === this.sample) return;
    this.run = run;
    this.sample = sample;
    this.cached = {};
    this.update();
  }

  // The plane that is seen, for export.
  get shownPlane(): ImpulsePlane | null {
    return this.run ? this.plane.plane : null;
  }

  private update(): void {
    for (const { section, fill } of this.sections) {
      if (!section.isOpen) continue;
      try {
        section.tell(this.run ? fill(this.run) : 'No run yet.');
      } catch (error) {
        section.tell(error instanceof Error ? error.message : String(error), true);
      }
    }
  }

  private words(run: Run): StepWords {
    return (this.cached.words ??= stepWords(run, this.sample));
  }

  // Each returns what to say instead, '' if all is shown.
  private fillWords(run: Run, view: WordsView): string {
    view.show(this.words(run), run.trajectory.mode_names);
    return '';
  }

  private fillPlane(run: Run): string {
    const planes = run.impulsePlanes(this.sample);
    const names = this.words(run).contacts.map(({ who }) => who);
    this.plane.show(planes, names);
    return planes.length > 0 ? '' : this.words(run).noProblem || 'No impulse in this step.';
  }

  private fillProblem(run: Run, view: LcpTable | LemkeView): string {
    if (this.cached.problem === undefined) this.cached.problem = run.problem(this.sample);
    const problem = this.cached.problem;
    if (problem) view.show(problem);
    return problem ? '' : this.words(run).noProblem || 'No complementarity problem in this step.';
  }
}
