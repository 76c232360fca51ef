// What pictures are drawn with: the part of a canvas context that has a twin in SVG, so that one drawing code makes both.
export type Pen = Pick<
  CanvasRenderingContext2D,
  | 'fillStyle'
  | 'strokeStyle'
  | 'lineWidth'
  | 'lineCap'
  | 'lineJoin'
  | 'globalAlpha'
  | 'font'
  | 'textAlign'
  | 'textBaseline'
  | 'save'
  | 'restore'
  | 'setLineDash'
  | 'beginPath'
  | 'moveTo'
  | 'lineTo'
  | 'closePath'
  | 'rect'
> & {
  arc(x: number, y: number, radius: number, start: number, end: number): void;
  fill(): void;
  stroke(): void;
  // Everything until `restore` shows only inside the present path.
  clip(): void;
  fillText(text: string, x: number, y: number): void;
};

interface Style {
  fillStyle: string | CanvasGradient | CanvasPattern;
  strokeStyle: string | CanvasGradient | CanvasPattern;
  lineWidth: number;
  lineCap: CanvasLineCap;
  lineJoin: CanvasLineJoin;
  globalAlpha: number;
  font: string;
  textAlign: CanvasTextAlign;
  textBaseline: CanvasTextBaseline;
  dash: number[];
  clip: string;
}

// Control characters have no place in XML.
const escaped = (text: string): string =>
  text.replace(/[\u0000-\u0008\u000b\u000c\u000e-\u001f]/g, '').replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c] as string);

const short = (x: number): string => String(Math.round(x * 100) / 100);

// Draws into the text of an SVG file.
export class SvgPen implements Pen {
  fillStyle: Style['fillStyle'] = '#000';
  strokeStyle: Style['strokeStyle'] = '#000';
  lineWidth = 1;
  lineCap: CanvasLineCap = 'butt';
  lineJoin: CanvasLineJoin = 'miter';
  globalAlpha = 1;
  font = '12px sans-serif';
  textAlign: CanvasTextAlign = 'start';
  textBaseline: CanvasTextBaseline = 'alphabetic';
  private dash: number[] = [];
  private clipId = '';
  private path = '';
  private numClips = 0;
  private readonly saved: Style[] = [];
  private readonly elements: string[] = [];

  constructor(
    readonly width: number,
    readonly height: number,
  ) {}

  save(): void {
    const { fillStyle, strokeStyle, lineWidth, lineCap, lineJoin, globalAlpha, font, textAlign, textBaseline } = this;
    const line = { lineWidth, lineCap, lineJoin, dash: this.dash, clip: this.clipId };
    this.saved.push({ fillStyle, strokeStyle, globalAlpha, font, textAlign, textBaseline, ...line });
  }
  restore(): void {
    const style = this.saved.pop();
    if (!style) return;
    const { dash, clip, ...rest } = style;
    Object.assign(this, rest);
    this.dash = dash;
    this.clipId = clip;
  }
  setLineDash(dash: number[]): void {
    this.dash = dash;
  }
  beginPath(): void {
    this.path = '';
  }
  // A canvas takes no notice of what is not finite.
  moveTo(x: number, y: number): void {
    if (!Number.isFinite(x + y)) return;
    this.path += `M${short(x)} ${short(y)}`;
  }
  lineTo(x: number, y: number): void {
    if (!Number.isFinite(x + y)) return;
    this.path += `${this.path ? 'L' : 'M'}${short(x)} ${short(y)}`;
  }
  closePath(): void {
    this.path += 'Z';
  }
  rect(x: number, y: number, width: number, height: number): void {
    this.path += `M${short(x)} ${short(y)}h${short(width)}v${short(height)}h${short(-width)}Z`;
  }
  // Counter-clockwise in the file's y down is a falling angle; end > start, as a canvas has it by default.
  arc(x: number, y: number, radius: number, start: number, end: number): void {
    const at = (angle: number): [number, number] => [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
    // An arc of SVG is less than a full turn: two halves.
    const middle = 0.5 * (start + end);
    this.lineTo(...at(start));
    for (const [from, to] of [
      [start, middle],
      [middle, end],
    ] as const) {
      const [px, py] = at(to);
      const large = Math.abs(to - from) > Math.PI ? 1 : 0;
      this.path += `A${short(radius)} ${short(radius)} 0 ${large} ${to > from ? 1 : 0} ${short(px)} ${short(py)}`;
    }
  }
  fill(): void {
    this.add(`<path d="${this.path}" fill="${this.fillStyle}"${this.common()}/>`);
  }
  stroke(): void {
    const dash = this.dash.length > 0 ? ` stroke-dasharray="${this.dash.join(' ')}"` : '';
    const line = `stroke-width="${short(this.lineWidth)}" stroke-linecap="${this.lineCap}" stroke-linejoin="${this.lineJoin}"`;
    this.add(`<path d="${this.path}" fill="none" stroke="${this.strokeStyle}" ${line}${dash}${this.common()}/>`);
  }
  clip(): void {
    const id = `clip${++this.numClips}`;
    const inside = this.clipId ? ` clip-path="url(#${this.clipId})"` : '';
    this.elements.push(`<clipPath id="${id}"${inside}><path d="${this.path}"/></clipPath>`);
    this.clipId = id;
  }
  fillText(text: string, x: number, y: number): void {
    const [, weight = '', size = '12', family = 'sans-serif'] =
      /^(?:(bold|\d+) )?([\d.]+)px (.*)$/.exec(this.font) ?? [];
    const anchor = { center: 'middle', right: 'end', end: 'end', left: 'start', start: 'start' }[this.textAlign];
    const shift = { middle: 0.35, top: 0.8, hanging: 0.8, bottom: -0.2, alphabetic: 0, ideographic: 0 }[this.textBaseline];
    const font = `font-size="${size}" font-family="${escaped(family)}"${weight ? ` font-weight="${weight}"` : ''}`;
    const at = `x="${short(x)}" y="${short(y + shift * Number(size))}"`;
    this.add(`<text ${at} fill="${this.fillStyle}" text-anchor="${anchor}" ${font}${this.common()}>${escaped(text)}</text>`);
  }
  toString(): string {
    const size = `width="${this.width}" height="${this.height}" viewBox="0 0 ${this.width} ${this.height}"`;
    return `<svg xmlns="http://www.w3.org/2000/svg" ${size}>\n${this.elements.join('\n')}\n</svg>\n`;
  }

  private common(): string {
    const opacity = this.globalAlpha < 1 ? ` opacity="${short(this.globalAlpha)}"` : '';
    return opacity + (this.clipId ? ` clip-path="url(#${this.clipId})"` : '');
  }
  private add(element: string): void {
    this.elements.push(element);
  }
}

export function arrow(pen: Pen, x0: number, y0: number, x1: number, y1: number, width: number): void {
  const length = Math.hypot(x1 - x0, y1 - y0);
  if (length < 0.5) return;
  const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
  const head = Math.min(4 * width + 2, 0.6 * length);
  pen.lineWidth = width;
  pen.setLineDash([]);
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1 - 0.8 * head * ux, y1 - 0.8 * head * uy);
  pen.stroke();
  pen.beginPath();
  pen.moveTo(x1, y1);
  pen.lineTo(x1 - head * ux + 0.45 * head * uy, y1 - head * uy - 0.45 * head * ux);
  pen.lineTo(x1 - head * ux - 0.45 * head * uy, y1 - head * uy + 0.45 * head * ux);
  pen.closePath();
  pen.fill();
}
