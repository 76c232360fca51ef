// Play, pause, step, slow motion, loop, and the time line to scrub.
import { number } from './format';
import { element, setText } from './markup';

export interface TimelineEvents {
  onTime: (time: number) => void;
  onStep: (by: number) => void; // samples
  onPlaying: (isPlaying: boolean) => void;
}

const speeds = [0.02, 0.05, 0.1, 0.25, 0.5, 1, 2];

export class Timeline {
  time = 0;
  isPlaying = false;
  private duration = 1;
  private last = 0;
  private readonly play = button('Play', '▶', 'play');
  private readonly slider = element('input', 'time-slider');
  private readonly speed = element('select', 'time-speed');
  private readonly loop = element('input');
  private readonly text = element('output', 'time-text');

  constructor(
    root: HTMLElement,
    private readonly events: TimelineEvents,
  ) {
    const back = button('One step back', '|◀', 'step-back');
    const forward = button('One step forward', '▶|', 'step-forward');
    this.slider.type = 'range';
    this.slider.min = '0';
    this.slider.step = 'any';
    this.slider.setAttribute('aria-label', 'Time [s]');
    this.speed.setAttribute('aria-label', 'Speed of the film');
    for (const speed of speeds) this.speed.append(new Option(speed === 1 ? 'real time' : `${speed}×`, String(speed)));
    this.speed.value = '0.25';
    this.loop.type = 'checkbox';
    const loop = element('label', 'time-loop', this.loop, 'Loop');
    root.append(back, this.play, forward, this.slider, this.text, this.speed, loop);
    back.addEventListener('click', () => events.onStep(-1));
    forward.addEventListener('click', () => events.onStep(1));
    this.play.addEventListener('click', () => this.toggle());
    this.slider.addEventListener('input', () => {
      const time = Number(this.slider.value); // a pause puts the slider back
      this.pause();
      events.onTime(time);
    });
    // A range moves by its step; here that is a sample.
    this.slider.addEventListener('keydown', (event) => {
      const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 }[event.key];
      if (by === undefined) return;
      event.preventDefault();
      this.pause();
      events.onStep(by);
    });
  }

  setDuration(duration: number): void {
    this.duration = duration;
    this.slider.max = String(duration);
  }
  setTime(time: number): void {
    this.time = time;
    this.slider.value = String(time);
    const text = `${time.toFixed(3)} s of ${number(this.duration)} s`;
    setText(this.text, text);
    this.slider.setAttribute('aria-valuetext', text);
  }
  toggle(): void {
    if (this.isPlaying) this.pause();
    else this.start();
  }
  pause(): void {
    this.isPlaying = false;
    this.showPlaying();
  }
  start(): void {
    if (this.time >= this.duration - 1e-9) this.events.onTime(0);
    this.isPlaying = true;
    this.last = performance.now();
    this.showPlaying();
    requestAnimationFrame(this.frame);
  }
  get filmSpeed(): number {
    return Number(this.speed.value);
  }

  private showPlaying(): void {
    const label = this.isPlaying ? 'Pause' : 'Play';
    this.play.textContent = this.isPlaying ? '❚❚' : '▶';
    this.play.title = label;
    this.play.setAttribute('aria-label', label);
    this.events.onPlaying(this.isPlaying);
  }

  private readonly frame = (now: number): void => {
    if (!this.isPlaying) return;
    let time = this.time + Math.max(0, now - this.last) * 1e-3 * this.filmSpeed;
    this.last = now;
    if (time >= this.duration) {
      if (this.loop.checked) time = 0;
      else {
        this.events.onTime(this.duration);
        this.pause();
        return;
      }
    }
    this.events.onTime(time);
    requestAnimationFrame(this.frame);
  };
}

export function button(label: string, text: string, name: string): HTMLButtonElement {
  const result = element('button', 'button', text);
  result.type = 'button';
  result.title = label;
  result.setAttribute('aria-label', label);
  result.dataset.action = name;
  return result;
}
