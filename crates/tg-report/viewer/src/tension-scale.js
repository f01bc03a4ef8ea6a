import { oklabToSrgb } from './oklab.js';
import { number, quantity } from './format.js';

/**
 * Colour maps as stops [lightness, chroma, hue], evenly spaced. Lightness changes steadily, so the order shows without
 * hue (colour-blind readers, grey prints); the end that carries most stands out most from the background.
 */
const maps = {
  light: {
    sequential: [[0.76, 0.1, 225], [0.67, 0.14, 255], [0.57, 0.2, 295], [0.48, 0.22, 340], [0.38, 0.16, 385]],
    diverging: [[0.4, 0.11, 250], [0.58, 0.13, 240], [0.72, 0.015, 240], [0.6, 0.17, 45], [0.42, 0.13, 35]],
  },
  dark: {
    sequential: [[0.52, 0.16, 265], [0.6, 0.2, 295], [0.69, 0.2, 345], [0.79, 0.15, 410], [0.91, 0.15, 460]],
    diverging: [[0.88, 0.09, 225], [0.7, 0.13, 240], [0.48, 0.015, 240], [0.72, 0.16, 50], [0.88, 0.12, 75]],
  },
};

const STEPS = 256;

function table(stops) {
  const rgb = new Float32Array(STEPS * 3);
  for (let i = 0; i < STEPS; i++) {
    const at = (i / (STEPS - 1)) * (stops.length - 1);
    const k = Math.min(stops.length - 2, Math.floor(at));
    const w = at - k;
    // Mixed straight across the colour plane: by hue, the way from blue to orange would lead through green.
    const across = (of) => of(stops[k]) * (1 - w) + of(stops[k + 1]) * w;
    const a = across(([, chroma, hue]) => chroma * Math.cos((hue * Math.PI) / 180));
    const b = across(([, chroma, hue]) => chroma * Math.sin((hue * Math.PI) / 180));
    rgb.set(oklabToSrgb(across(([lightness]) => lightness), a, b), i * 3);
  }
  return rgb;
}

/** The extent of the tension of taut cables over all that the page shows. */
export function tensionExtent(sets) {
  let low = Infinity;
  let high = -Infinity;
  let slack = false;
  for (const set of sets) {
    for (let i = 0; i < set.tension.length; i++) {
      if (set.slack[i]) slack = true;
      else if (Number.isFinite(set.tension[i])) {
        low = Math.min(low, set.tension[i]);
        high = Math.max(high, set.tension[i]);
      }
    }
  }
  if (!(low <= high)) return { low: 0, high: 0, slack, taut: false };
  // Single-precision noise about zero is not compression.
  if (low < 0 && low > -1e-5 * high) low = 0;
  if (high > 0 && high < -1e-5 * low) high = 0;
  return { low, high, slack, taut: true };
}

/** Maps a tension to a colour: sequential, or diverging about zero as soon as anything pushes. */
export class TensionScale {
  constructor(extent, theme) {
    this.extent = extent;
    this.diverging = extent.low < 0;
    let { low, high } = extent;
    if (this.diverging) {
      high = Math.max(-low, high);
      low = -high;
    } else if (high - low < 1e-4 * high) low = 0;
    this.low = low;
    this.high = high;
    this.rgb = table(maps[theme][this.diverging ? 'diverging' : 'sequential']);
  }

  index(tension) {
    const span = this.high - this.low;
    const at = span > 0 ? (tension - this.low) / span : 1;
    return Math.round(Math.min(1, Math.max(0, at || 0)) * (STEPS - 1));
  }

  css(tension) {
    const i = this.index(tension) * 3;
    return `rgb(${Array.from(this.rgb.subarray(i, i + 3), (c) => Math.round(c * 255)).join(' ')})`;
  }

  /** The part of the map in use, as a CSS gradient. */
  gradient() {
    const [from, to] = this.shown();
    const stops = Array.from({ length: 17 }, (_, i) => this.css(from + ((to - from) * i) / 16));
    return `linear-gradient(to right, ${stops.join(', ')})`;
  }

  shown() {
    return this.diverging ? [this.extent.low, Math.max(0, this.extent.high)] : [this.low, this.high];
  }

  describe(tension, slack) {
    if (slack) return 'slack';
    return quantity(tension, 'N', 4) + (tension < 0 && this.diverging ? ' (compression)' : '');
  }

  labels() {
    const [from, to] = this.shown();
    return { from: number(from), to: number(to), zero: from < 0 && to > 0 ? -from / (to - from) : null };
  }
}
