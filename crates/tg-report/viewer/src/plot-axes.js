import { axisLabel, tick } from './format.js';

const FONT = '11px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif';
const PER_LETTER = 6.3;

/** The same width for most plots, so that their time axes stand beneath each other. */
const width = (values) => Math.max(54, 12 + PER_LETTER * Math.max(0, ...(values ?? []).map((v) => String(v ?? '').length)));

function common(theme) {
  const line = { stroke: theme.colour('line'), width: 1 };
  return { font: FONT, stroke: theme.colour('ink-2'), grid: line, ticks: { ...line, size: 4 }, gap: 4 };
}

function tickTexts(u, splits, axis, space, spacing) {
  const largest = Math.max(...splits.map((s) => Math.abs(s ?? 0)), Number.MIN_VALUE);
  return splits.map((s) => (s === null ? '' : tick(s, spacing, largest)));
}

export const xAxis = (theme, x) => ({
  ...common(theme), values: tickTexts, space: 56, size: 24, label: axisLabel(x), labelSize: 18, labelFont: FONT,
});

export const yAxis = (theme) => ({ ...common(theme), values: tickTexts, space: 30, size: (u, values) => width(values) });

const shorten = (name) => (name.length > 17 ? `${name.slice(0, 16)}…` : name);

/** One line of the axis per strip, named. */
export const rowAxis = (theme, names) => ({
  ...common(theme),
  grid: { show: false },
  ticks: { show: false },
  splits: () => names().map((_, i) => i + 0.5),
  values: () => names().map(shorten),
  size: () => width(names().map(shorten)),
  filter: (u, splits) => splits,
});
