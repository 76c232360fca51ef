import { describe, expect, it } from 'vitest';
import { drawChart, padded, rangeOf, tickLabels, ticks } from '../../src/chart';
import { arrow, SvgPen } from '../../src/pen';
import type { Theme } from '../../src/theme';

const drawn = (draw: (pen: SvgPen) => void): string => {
  const pen = new SvgPen(100, 50);
  draw(pen);
  return pen.toString();
};

describe('SvgPen', () => {
  it('makes a file of its size', () => {
    expect(drawn(() => undefined)).toMatch(/^<svg xmlns="http:\/\/www\.w3\.org\/2000\/svg" width="100" height="50" viewBox="0 0 100 50">/);
  });
  it('fills and strokes paths with the present style', () => {
    const svg = drawn((pen) => {
      pen.beginPath();
      pen.moveTo(1, 2);
      pen.lineTo(3.456, 4);
      pen.closePath();
      pen.fillStyle = '#123456';
      pen.globalAlpha = 0.5;
      pen.fill();
      pen.setLineDash([4, 2]);
      pen.lineWidth = 2;
      pen.stroke();
    });
    expect(svg).toContain('<path d="M1 2L3.46 4Z" fill="#123456" opacity="0.5"/>');
    expect(svg).toContain('stroke-width="2"');
    expect(svg).toContain('stroke-dasharray="4 2"');
  });
  it('restores what was saved, dashes and clips too', () => {
    const svg = drawn((pen) => {
      pen.save();
      pen.beginPath();
      pen.rect(0, 0, 10, 10);
      pen.clip();
      pen.setLineDash([1]);
      pen.fillStyle = '#ff0000';
      pen.fill();
      pen.restore();
      pen.beginPath();
      pen.moveTo(0, 0);
      pen.lineTo(1, 1);
      pen.stroke();
      pen.fill();
    });
    const [clipped, line, filled] = svg.split('\n').filter((text) => text.startsWith('<path'));
    expect(clipped).toContain('fill="#ff0000" clip-path="url(#clip1)"');
    expect(line).not.toMatch(/dash|clip/);
    expect(filled).toContain('fill="#000"');
  });
  it('draws a full circle', () => {
    const svg = drawn((pen) => {
      pen.beginPath();
      pen.arc(10, 10, 5, 0, 2 * Math.PI);
      pen.fill();
    });
    expect(svg).toContain('d="M15 10A5 5 0 0 1 5 10A5 5 0 0 1 15 10"');
  });
  it('shows text as it is, with places as on a canvas', () => {
    const svg = drawn((pen) => {
      pen.font = '600 10px system-ui, sans-serif';
      pen.textAlign = 'right';
      pen.textBaseline = 'middle';
      pen.fillText('<a & "b">', 5, 6);
    });
    expect(svg).toContain('x="5" y="9.5" fill="#000" text-anchor="end" font-size="10" font-family="system-ui, sans-serif" font-weight="600"');
    expect(svg).toContain('>&lt;a &amp; &quot;b&quot;&gt;</text>');
  });
  it('draws arrows that are long enough', () => {
    expect(drawn((pen) => arrow(pen, 0, 0, 0.1, 0, 1))).not.toContain('path');
    expect(drawn((pen) => arrow(pen, 0, 0, 20, 0, 1)).match(/<path/g)).toHaveLength(2);
  });
});

describe('charts', () => {
  it('have round ticks inside the range', () => {
    expect(ticks([0.02, 1.01], 5)).toEqual([0.2, 0.4, 0.6000000000000001, 0.8, 1]);
    expect(tickLabels(ticks([0.02, 1.01], 5))).toEqual(['0.2', '0.4', '0.6', '0.8', '1']);
    expect(tickLabels(ticks([1000, 1000.03], 3))).toEqual(['1000', '1000.01', '1000.02', '1000.03']);
    expect(ticks([1, 1], 5)).toEqual([]);
    expect(ticks([0, Infinity], 5)).toEqual([]);
  });
  it('know ranges of what is finite', () => {
    expect(rangeOf([Float64Array.of(NaN, 2, -Infinity), Float64Array.of(-1, Infinity)])).toEqual([-1, 2]);
    expect(rangeOf([Float64Array.of(NaN)])).toBeNull();
    for (const range of [null, [0, 0], [5, 5], [-1, 1]] as const) {
      const [low, high] = padded(range && [...range]);
      expect(high).toBeGreaterThan(low);
    }
  });
  it('draw gaps as gaps and lone points as dots', () => {
    const theme = new Proxy({}, { get: () => '#000000' }) as Theme;
    const curve = { label: 'f', colour: '#1f5fa8', isDashed: false, marked: 3 };
    const x = Float64Array.of(0, 1, 2, 3, 4, 5);
    const y = Float64Array.of(1, NaN, 2, 3, NaN, NaN);
    const chart = { title: 'Force', xLabel: 'time [s]', yLabel: '', curves: [{ ...curve, x, y }] };
    const svg = drawn((pen) => drawChart(pen, { left: 0, top: 0, width: 300, height: 200 }, chart, theme));
    const line = svg.split('\n').find((text) => text.includes('stroke="#1f5fa8"')) ?? '';
    expect(line.match(/M/g)).toHaveLength(2);
    expect(line.match(/L/g)).toHaveLength(1);
    expect(svg).not.toContain('NaN');
    expect(svg.match(/fill="#1f5fa8"/g)).toHaveLength(2); // the lone point and the mark
  });
});
