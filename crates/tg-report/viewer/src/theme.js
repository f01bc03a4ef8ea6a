const dark = window.matchMedia('(prefers-color-scheme: dark)');
const listeners = [];

/** Colours live in the style sheet; canvases read them here. */
export function theme() {
  const style = getComputedStyle(document.documentElement);
  return { name: dark.matches ? 'dark' : 'light', colour: (name) => style.getPropertyValue(`--${name}`).trim() };
}

export function onThemeChange(listener) {
  listeners.push(listener);
}

dark.addEventListener('change', () => listeners.forEach((listener) => listener(theme())));

/** Series colours, told apart by colour-blind readers; further series repeat them with another dash. */
const palettes = {
  light: ['#0b6bb8', '#d1540a', '#0a8f6a', '#b8478f', '#b98900', '#4a9fd8', '#6650a4', '#5d6673'],
  dark: ['#5ab0f2', '#ff8f52', '#3ecb9c', '#ee93c6', '#f2c14b', '#a5d8ff', '#b6a3f2', '#a9b4c2'],
};
const dashes = [null, [6, 3], [2, 2], [9, 3, 2, 3]];

export function seriesStyle(index) {
  const palette = palettes[theme().name];
  return { colour: palette[index % palette.length], dash: dashes[Math.floor(index / palette.length) % dashes.length] };
}

/** The line of a series as a CSS background, dashes and all. */
export function seriesSwatch(index) {
  const { colour, dash } = seriesStyle(index);
  if (!dash) return colour;
  let at = 0;
  const stops = dash.map((length, i) => `${i % 2 ? 'transparent' : colour} ${at}px ${(at += length)}px`);
  return `repeating-linear-gradient(to right, ${stops.join(', ')})`;
}
