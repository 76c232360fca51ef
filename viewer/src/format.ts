// Numbers for reading.
export function number(x: number, digits = 4): string {
  if (!Number.isFinite(x)) return Number.isNaN(x) ? '–' : x > 0 ? '∞' : '−∞';
  const size = Math.abs(x);
  const text = x === 0 ? '0' : size >= 1e-3 && size < 1e5 ? shortest(x.toPrecision(digits)) : x.toExponential(digits - 1);
  return text.replace('-', '−').replace(/e\+?(−?)/, 'e$1');
}

function shortest(text: string): string {
  return text.includes('.') && !text.includes('e') ? text.replace(/\.?0+$/, '') : text;
}

export const withUnit = (x: number, unit: string, digits = 4): string => (unit ? `${number(x, digits)} ${unit}` : number(x, digits));
