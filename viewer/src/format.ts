// Numbers for reading.
export function number(x: number, digits = 4): string {
  if (!Number.isFinite(x)) return Number.isNaN(x) ? '–' : x > 0 ? '∞' : '−∞';
  const size = Math.abs(x);
  const text = x === 0 ? '0' : size >= 1e-3 && size < 1e5 ? shortest(x.toPrecision(digits)) : shortest(x.toExponential(digits - 1));
  return text.replaceAll('-', '−').replace('e+', 'e');
}

function shortest(text: string): string {
  return text.includes('.') ? text.replace(/\.?0+(?=e|$)/, '') : text;
}

export const withUnit = (x: number, unit: string, digits = 4): string => (unit ? `${number(x, digits)} ${unit}` : number(x, digits));
