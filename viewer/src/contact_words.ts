// What a step does at its contacts, in words. Letters as in formulas, for `setFormula`.
import type { BodyInfo, ShapeInfo, Triple } from 'tumble-engine';
import { number, withUnit } from './format';
import type { Run } from './run';

export type StepSource = Pick<
  Run,
  'trajectory' | 'record' | 'scene' | 'length' | 'contactsOf' | 'poseAt' | 'velocityAt'
>;

export interface ContactText {
  mode: number; // code
  who: string;
  lines: string[];
}

export interface StepWords {
  step: string;
  summary: string; // where there is nothing to list
  noProblem: string; // why there is no complementarity problem to show; '': there is one
  contacts: ContactText[];
  more: number; // contacts that are not listed
  spins: string[];
}

export const maxContacts = 4;
export const modeMarks = ['○', '■', '◀', '▶'];

// Slower than this is at rest [m/s], and turns less than this not at all [rad/s].
const rest = 1e-6;

const short = (x: number, unit = ''): string => withUnit(x, unit, 3);

// What of a shape touches; features as the engine numbers them: corners even, sides odd.
function featureName(part: ShapeInfo | undefined, feature: number): string {
  if (part?.kind !== 'polygon' && part?.kind !== 'terrain') return '';
  const isCorner = feature % 2 === 0;
  return `${isCorner ? 'corner' : 'side'} ${feature >> 1} of `;
}

function touching(body: BodyInfo | undefined, feature: number): string {
  const name = body?.name ?? 'a body';
  return body?.parts.length === 1 ? featureName(body.parts[0], feature) + name : name;
}

// "to the right", "up", "to the left and down".
export function direction(x: number, y: number): string {
  const small = 0.35 * Math.hypot(x, y);
  const across = Math.abs(x) > small ? `to the ${x > 0 ? 'right' : 'left'}` : '';
  const along = Math.abs(y) > small ? (y > 0 ? 'up' : 'down') : '';
  return [across, along].filter(Boolean).join(' and ');
}

export interface ContactFacts {
  mode: number;
  before: number; // normal velocity [m/s]
  after: number;
  slip: number; // tangential velocity after the step [m/s]
  slipsTo: string;
  P_n: number;
  P_t: number;
  restitution: number; // that was at work
  friction: number;
  staticFriction: number;
}

export function normalWords({ before, after, P_n, restitution }: ContactFacts): string {
  const impulse = `P_n = ${short(P_n, 'N s')}`;
  const eps = restitution > 0 ? ` (eps = ${short(restitution)})` : '';
  if (before < -rest && after > rest)
    return `bounces: arrives at ${short(before, 'm/s')}, leaves at ${short(after, 'm/s')}${eps}, with ${impulse}`;
  if (before < -rest && after < -rest)
    return `is slowed from ${short(before, 'm/s')} to ${short(after, 'm/s')} by ${impulse}; the gap closes`;
  if (before < -rest) return `arrives at ${short(before, 'm/s')} and stays: ${impulse} takes all of that, nothing bounces`;
  if (after > rest) return `leaves at ${short(after, 'm/s')}, pushed by ${impulse}`;
  return `rests: ${impulse} keeps the bodies apart`;
}

export function frictionWords(facts: ContactFacts): string {
  const { mode, slip, slipsTo, P_n, P_t, friction, staticFriction } = facts;
  const impulse = `P_t = ${short(P_t, 'N s')}`;
  if (mode !== 1) {
    const slips = `slips ${slipsTo} at ${short(Math.abs(slip), 'm/s')}`.replace('  ', ' ');
    if (friction === 0) return `${slips}, without friction (mu = 0)`;
    return `${slips}: friction is at its limit, mu P_n = ${short(Math.abs(P_t), 'N s')}, against the slip`;
  }
  if (staticFriction === 0) return 'no slip, and no friction either (mu = 0)';
  const limit = staticFriction * P_n;
  if (Math.abs(P_t) <= 1e-9 * limit) return 'sticks: no friction is needed';
  if (Math.abs(P_t) < (1 - 1e-9) * limit)
    return `sticks: friction ${impulse}, less than the limit ${short(limit, 'N s')}, holds it`;
  return `sticks, but only just: friction ${impulse} is at its limit`;
}

// The one that moves is told of, seen from the other.
function contactText(run: StepSource, row: number): ContactText {
  const t = run.trajectory;
  const [a, b] = [t.contact_body_a[row] as number, t.contact_body_b[row] as number];
  const [bodyA, bodyB] = [run.scene.bodies[a], run.scene.bodies[b]];
  const feature = t.contact_feature[row] as number;
  const nameA = touching(bodyA, Math.floor(feature / 65536));
  const nameB = run.record ? `corner ${feature} of ${bodyB?.name}` : touching(bodyB, feature % 65536);
  const isA = bodyA?.kind === 'dynamic' && bodyB?.kind !== 'dynamic';
  const other = isA ? bodyB : bodyA;
  const mode = t.contact_mode[row] as number;
  // The tangent is the normal turned right; slip to the right is along it for b.
  const side = (mode === 3 ? 1 : -1) * (isA ? -1 : 1);
  const [nx, ny] = [t.contact_normal[2 * row] as number, t.contact_normal[2 * row + 1] as number];
  const facts: ContactFacts = {
    mode,
    before: t.contact_normal_velocity[row] as number,
    after: t.contact_normal_velocity_after[row] as number,
    slip: t.contact_tangential_velocity_after[row] as number,
    slipsTo: direction(side * ny, -side * nx),
    P_n: t.contact_normal_impulse[row] as number,
    P_t: t.contact_friction_impulse[row] as number,
    restitution: t.contact_restitution[row] as number,
    friction: t.contact_law_friction[row] as number,
    staticFriction: t.contact_law_static_friction[row] as number,
  };
  const moving = other?.parts.some((part) => part.surface_speed !== 0) ? ` (seen from the moving surface of ${other.name})` : '';
  const who = isA ? `${nameA} touches ${nameB}` : `${nameB} touches ${nameA}`;
  return { mode, who, lines: [normalWords(facts), frictionWords(facts) + moving] };
}

// In the document's model a corner within delta takes part in the LCP, which may say that no force is needed.
function closeText(run: StepSource, sample: number): ContactText | null {
  const record = run.record;
  if (!record || !((record.gap[sample] as number) < record.delta)) return null;
  const gap = `the gap, ${short(record.gap[sample] as number, 'm')}, is less than delta = ${short(record.delta, 'm')}`;
  const body = run.scene.bodies.find(({ kind }) => kind === 'dynamic');
  return {
    mode: 0,
    who: `corner ${record.corner[sample]} of ${body?.name ?? 'the square'} is near the ground`,
    lines: [`${gap}, so the LCP is solved; but no force is needed: the corner moves away already`],
  };
}

function noContact(run: StepSource, sample: number): string {
  const { record, trajectory } = run;
  if (record) {
    const [gap, delta] = [short(record.gap[sample] as number, 'm'), short(record.delta, 'm')];
    return `No contact: only gravity acts. The LCP is not even formed (gap ${gap}, threshold delta = ${delta}).`;
  }
  if (trajectory.contact_step.length === 0) return 'No contact in this run, or none was recorded.';
  return 'No contact at work: the bodies move freely, and no complementarity problem is solved.';
}

interface Touch {
  count: number;
  arm: [number, number];
}

// Of each dynamic body, in the order in which contacts name it.
function touches(run: StepSource, sample: number): Map<number, Touch> {
  const { first, last } = run.contactsOf(sample);
  const t = run.trajectory;
  const result = new Map<number, Touch>();
  for (let row = first; row < last; ++row) {
    for (const [bodies, points] of [
      [t.contact_body_b, t.contact_point_b],
      [t.contact_body_a, t.contact_point_a],
    ] as const) {
      const body = bodies[row] as number;
      if (run.scene.bodies[body]?.kind !== 'dynamic') continue;
      const touch = result.get(body);
      const [x, y] = run.poseAt(sample, body);
      if (touch) ++touch.count;
      else result.set(body, { count: 1, arm: [(points[2 * row] as number) - x, (points[2 * row + 1] as number) - y] });
    }
  }
  return result;
}

const turns = (before: Triple, after: Triple): boolean =>
  Math.abs(after[2] - before[2]) > rest * Math.max(1, Math.abs(before[2]));

// With as many digits as tell the two apart.
function fromTo(from: number, to: number): string {
  let digits = 3;
  while (digits < 9 && number(from, digits) === number(to, digits)) ++digits;
  return `from ${number(from, digits)} to ${number(to, digits)}`;
}

export function spinWords(name: string, touch: Touch, before: Triple, after: Triple): string {
  const [from, to] = [before[2], after[2]];
  const omega = `${to > from ? 'counter-clockwise' : 'clockwise'}: omega goes ${fromTo(from, to)} rad/s`;
  const isKept = !turns(before, after);
  const kept = `omega stays ${short(Math.abs(from) > rest ? from : 0, 'rad/s')}`;
  if (touch.count > 1) {
    const impulses = `${name}: the impulses at its ${touch.count} contacts`;
    return isKept ? `${impulses} together do not turn it: ${kept}.` : `${impulses} together turn it ${omega}.`;
  }
  const arm = `r = (${short(touch.arm[0])}, ${short(touch.arm[1])}) m from the centre of mass`;
  if (isKept) return `${name}: the impulse acts at ${arm} and points through it: ${kept}.`;
  return `${name}: the impulse acts at ${arm} and does not point through it. So it turns the body ${omega}.`;
}

// Of many bodies only those that are turned are worth a sentence.
function spinsOf(run: StepSource, sample: number): string[] {
  const touched = [...touches(run, sample)];
  const velocities = (body: number): [Triple, Triple] => [run.velocityAt(sample, body), run.velocityAt(sample + 1, body)];
  const told = touched.length > 1 ? touched.filter(([body]) => turns(...velocities(body))) : touched;
  if (told.length === 0 && touched.length > 1) return [`None of the ${touched.length} bodies with contacts is turned.`];
  return told.slice(0, maxContacts).map(([body, touch]) => {
    const name = run.scene.bodies[body]?.name ?? `body ${body}`;
    return spinWords(name, touch, ...velocities(body));
  });
}

export function stepWords(run: StepSource, sample: number): StepWords {
  const { time, step_size } = run.trajectory;
  const from = time[sample] as number;
  const words: StepWords = { step: '', summary: '', noProblem: '', contacts: [], more: 0, spins: [] };
  if (sample + 1 >= run.length) {
    words.step = `The last sample, t = ${number(from)} s`;
    words.summary = 'The run ends here: no step leaves this sample.';
    words.noProblem = 'The run ends here.';
    return words;
  }
  const to = time[sample + 1] as number;
  const numSteps = Math.round((to - from) / step_size);
  const step = Math.round(from / step_size) + 1;
  words.step = `Step ${step}, from t = ${number(from)} to ${number(from + step_size)} s`;
  const { first, last } = run.contactsOf(sample);
  for (let row = first; row < Math.min(last, first + maxContacts); ++row) words.contacts.push(contactText(run, row));
  words.more = Math.max(last - first - maxContacts, 0);
  if (first === last) {
    const close = closeText(run, sample);
    if (close) words.contacts.push(close);
    else words.summary = noContact(run, sample);
  }
  const numContacts = words.contacts.length + words.more;
  if (numContacts === 0) words.noProblem = 'No contact in this step.';
  if (words.more > 0)
    words.noProblem = `${numContacts} contacts at once make a problem of ${4 * numContacts} rows, too many to show; up to ${maxContacts} contacts are shown.`;
  if (numSteps > 1) {
    words.noProblem = `The next sample is ${numSteps} steps later: the problem of one step cannot be shown.`;
    return words;
  }
  words.spins = spinsOf(run, sample);
  return words;
}
