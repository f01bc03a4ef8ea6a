const superscripts = { '-': '⁻', 0: '⁰', 1: '¹', 2: '²', 3: '³', 4: '⁴', 5: '⁵', 6: '⁶', 7: '⁷', 8: '⁸', 9: '⁹' };
const MINUS = '\u2212';

const raise = (exponent) => `10${String(exponent).replace(/./g, (c) => superscripts[c])}`;
const trueMinus = (text) => text.replace('-', MINUS);

/** A number with so many significant digits; powers of ten where plain decimals would not be read. */
export function number(value, digits = 3) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : `${MINUS}∞`;
  if (value === 0) return '0';
  const [mantissa, exponentText] = value.toExponential(digits - 1).split('e');
  const exponent = Number(exponentText);
  if (exponent < -3 || exponent > 5) {
    const m = mantissa.includes('.') ? mantissa.replace(/\.?0+$/, '') : mantissa;
    return trueMinus(`${m}·`) + raise(exponent);
  }
  return trueMinus(value.toFixed(Math.max(0, digits - 1 - exponent)));
}

/** Decimals that write a spacing such as 0.025 exactly. */
function decimalsOf(spacing) {
  let decimals = Math.max(0, -Math.floor(Math.log10(spacing) + 1e-9));
  while (decimals < 8 && Math.abs(spacing * 10 ** decimals - Math.round(spacing * 10 ** decimals)) > 1e-6) decimals++;
  return decimals;
}

/** A tick: as many decimals as its spacing needs. */
export function tick(value, spacing, largest) {
  if (Math.abs(value) < spacing * 1e-6) return '0';
  const exponent = Math.floor(Math.log10(largest) + 1e-9);
  if (exponent < -3 || exponent > 4) {
    const mantissa = value / 10 ** exponent;
    const decimals = Math.min(4, decimalsOf(spacing / 10 ** exponent));
    return `${trueMinus(mantissa.toFixed(decimals))}·${raise(exponent)}`;
  }
  return trueMinus(value.toFixed(decimalsOf(spacing)));
}

export const quantity = (value, unit, digits) => (unit ? `${number(value, digits)}\u202f${unit}` : number(value, digits));

export const axisLabel = ({ label, unit }) => (label && unit ? `${label} (${unit})` : label || unit);

/** The largest of 1, 2, 5 times a power of ten that does not exceed the value. */
export function roundDown(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].find((step) => step * power <= value * (1 + 1e-9)) * power;
}

/** Decimals that show a clock running to `end` at a steady width. */
export function clockDigits(end) {
  const decimals = Math.min(6, Math.max(2, 3 - Math.floor(Math.log10(Math.max(end, 1e-9)))));
  return end >= 1000 ? 1 : decimals;
}
