import { describe, expect, it } from 'vitest';
import {
  direction,
  frictionWords,
  normalWords,
  spinWords,
  stepWords,
  type ContactFacts,
  type StepSource,
} from '../../src/contact_words';

const facts: ContactFacts = {
  mode: 1,
  before: -3.1,
  after: 1.55,
  slip: 0,
  slipsTo: 'to the right',
  P_n: 0.5,
  P_t: 0.02,
  restitution: 0.5,
  friction: 0.3,
  staticFriction: 0.3,
};

describe('what happens along the normal', () => {
  it('tells a bounce with both speeds and the restitution at work', () => {
    expect(normalWords(facts)).toBe('bounces: arrives at −3.1 m/s, leaves at 1.55 m/s (eps = 0.5), with P_n = 0.5 N s');
  });
  it('tells an arrival that does not bounce from rest', () => {
    expect(normalWords({ ...facts, after: 1e-15, restitution: 0 })).toMatch(/^arrives at −3.1 m\/s and stays/);
    expect(normalWords({ ...facts, before: -1e-15, after: 1e-15 })).toBe('rests: P_n = 0.5 N s keeps the bodies apart');
  });
  it('tells what only becomes slower, and what is pushed away', () => {
    expect(normalWords({ ...facts, after: -0.5 })).toMatch(/^is slowed from −3.1 m\/s to −0.5 m\/s/);
    expect(normalWords({ ...facts, before: 0 })).toBe('leaves at 1.55 m/s, pushed by P_n = 0.5 N s');
  });
});

describe('what friction does', () => {
  it('holds below the static limit', () => {
    expect(frictionWords(facts)).toBe('sticks: friction P_t = 0.02 N s, less than the limit 0.15 N s, holds it');
    expect(frictionWords({ ...facts, P_t: -0.15 })).toBe('sticks, but only just: friction P_t = −0.15 N s is at its limit');
    expect(frictionWords({ ...facts, P_t: 0 })).toBe('sticks: no friction is needed');
  });
  it('slips at the limit, against the slip', () => {
    expect(frictionWords({ ...facts, mode: 3, slip: 0.31, P_t: -0.15 })).toBe(
      'slips to the right at 0.31 m/s: friction is at its limit, mu P_n = 0.15 N s, against the slip',
    );
  });
  it('does nothing without friction', () => {
    expect(frictionWords({ ...facts, staticFriction: 0, P_t: 0 })).toContain('no friction either');
    expect(frictionWords({ ...facts, mode: 2, slip: -1, friction: 0 })).toContain('without friction');
  });
});

describe('directions', () => {
  it.each([
    [1, 0, 'to the right'],
    [-1, 0.1, 'to the left'],
    [0, 1, 'up'],
    [0.8, -0.6, 'to the right and down'],
  ])('(%d, %d) is %s', (x, y, text) => expect(direction(x, y)).toBe(text));
});

describe('why it spins', () => {
  it('shows both angular velocities and which way the change turns', () => {
    const words = spinWords('square', { count: 1, arm: [0.0366, -0.1366] }, [0, -5, 0], [0, 2, 13.2]);
    expect(words).toContain('r = (0.0366, −0.137) m');
    expect(words).toContain('does not point through it');
    expect(words).toContain('turns the body counter-clockwise: omega goes from 0 to 13.2 rad/s.');
  });
  it('shows enough digits to tell both apart', () => {
    expect(spinWords('rod', { count: 1, arm: [1, 1] }, [0, 0, 1.3204], [0, 0, 1.3201])).toContain('from 1.3204 to 1.3201');
  });
  it('says when nothing turns', () => {
    expect(spinWords('disc', { count: 1, arm: [0, -1] }, [0, 0, 2], [0, 0, 2])).toContain('omega stays 2 rad/s');
    expect(spinWords('box', { count: 2, arm: [1, -1] }, [0, 0, 0], [0, 0, 1e-17])).toContain('together do not turn it');
  });
});

// A box on a slope that is the second body; `count` contacts in step 1, none in step 2.
function source(count: number, normal: [number, number], mode: number): StepSource {
  const each = (value: number): Float64Array => new Float64Array(count).fill(value);
  const square = { kind: 'polygon', points: new Float64Array(8), rounding: 0, material: 0, surface_speed: 0 };
  const plane = { kind: 'half_plane', normal: [0, 1], offset: 0, material: 0, surface_speed: 0 };
  return {
    length: 3,
    record: null,
    scene: { bodies: [{ name: 'box', kind: 'dynamic', parts: [square] }, { name: 'floor', kind: 'fixed', parts: [plane] }] },
    trajectory: {
      time: Float64Array.of(0, 0.01, 0.02),
      step_size: 0.01,
      contact_step: each(1),
      contact_body_a: new Int32Array(count).fill(0),
      contact_body_b: new Int32Array(count).fill(1),
      contact_feature: each(4 * 65536 + 1), // corner 2 of a
      contact_mode: new Int32Array(count).fill(mode),
      contact_point_a: new Float64Array(2 * count),
      contact_point_b: new Float64Array(2 * count),
      contact_normal: Float64Array.from({ length: 2 * count }, (_, i) => normal[i % 2] as number),
      contact_normal_velocity: each(0),
      contact_normal_velocity_after: each(0),
      contact_tangential_velocity_after: each(0.25),
      contact_normal_impulse: each(1),
      contact_friction_impulse: each(-0.3),
      contact_restitution: each(0),
      contact_law_friction: each(0.3),
      contact_law_static_friction: each(0.3),
    },
    contactsOf: (sample: number) => (sample === 0 ? { first: 0, last: count } : { first: count, last: count }),
    poseAt: () => [0, 1, 0],
    velocityAt: (sample: number) => [0, 0, sample],
  } as unknown as StepSource;
}

describe('a step in words', () => {
  it('tells of the body that moves, whichever of the two it is', () => {
    // The normal points down from the box to the floor, its right is -x. The floor slips along it seen from the box.
    const [contact] = stepWords(source(1, [0, -1], 3), 0).contacts;
    expect(contact?.who).toBe('corner 2 of box touches floor');
    expect(contact?.lines[1]).toMatch(/^slips to the right at 0.25 m\/s/);
  });
  it('lists four contacts and counts the others', () => {
    const words = stepWords(source(7, [0, -1], 1), 0);
    expect(words.contacts).toHaveLength(4);
    expect(words.more).toBe(3);
    expect(words.noProblem).toMatch(/^7 contacts at once make a problem of 28 rows/);
    expect(words.spins).toEqual([
      'box: the impulses at its 7 contacts together turn it counter-clockwise: omega goes from 0 to 1 rad/s.',
    ]);
  });
  it('has a line for steps without contact, and for the end', () => {
    expect(stepWords(source(1, [0, -1], 1), 1).summary).toMatch(/^No contact at work/);
    expect(stepWords(source(1, [0, -1], 1), 2).summary).toMatch(/^The run ends here/);
  });
  it('does not tell of one step where samples are further apart', () => {
    const run = source(1, [0, -1], 1);
    run.trajectory.step_size = 0.001;
    const words = stepWords(run, 0);
    expect(words.noProblem).toContain('10 steps later');
    expect(words.spins).toEqual([]);
  });
});

describe("the document's model", () => {
  const record = { gap: [0.0004, 0.42, 0], corner: [2, 0, 0], delta: 0.001 };
  const run = { ...source(0, [0, 1], 0), record } as unknown as StepSource;
  it('tells a corner within delta that needs no force', () => {
    const [contact] = stepWords(run, 0).contacts;
    expect(contact?.mode).toBe(0);
    expect(contact?.who).toContain('corner 2');
    expect(contact?.lines[0]).toContain('no force is needed');
  });
  it('tells free flight', () => {
    expect(stepWords(run, 1).summary).toBe(
      'No contact: only gravity acts. The LCP is not even formed (gap 0.42 m, threshold delta = 0.001 m).',
    );
  });
});
