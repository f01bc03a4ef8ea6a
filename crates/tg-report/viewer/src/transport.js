import { h, icon, iconButton } from './dom.js';
import { clockDigits } from './format.js';

const speeds = [0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10];

/** A play button that shows what a press will do. */
export function playButton(onclick) {
  const button = h('button', { type: 'button', class: 'icon play', onclick });
  const update = (playing) => {
    const label = playing ? 'Pause (space)' : 'Play (space)';
    if (button.title === label) return;
    button.title = label;
    button.setAttribute('aria-label', label);
    button.replaceChildren(icon(playing ? 'pause' : 'play'));
  };
  update(false);
  return { button, update };
}

/** The controls of the motion: play, scrub, time, speed, loop. */
export function transport(clock) {
  const STEPS = 10000;
  const digits = clockDigits(clock.end);
  const show = (t) => t.toFixed(digits).replace('-', '\u2212');
  const { button, update } = playButton(() => clock.toggle());
  const scrub = h('input', { type: 'range', class: 'scrub', min: 0, max: STEPS, step: 1, value: 0, 'aria-label': 'Time' });
  scrub.addEventListener('input', () => {
    clock.playing = false;
    clock.seek(clock.start + ((clock.end - clock.start) * scrub.value) / STEPS);
  });
  const time = h('output', { class: 'time', 'aria-label': 'Current time' });
  const speed = h('select', { 'aria-label': 'Speed', title: 'Speed' },
    speeds.map((s) => h('option', { value: s, selected: s === 1 }, `${s}×`)));
  speed.addEventListener('change', () => {
    clock.speed = Number(speed.value);
  });
  const loop = iconButton('loop', 'Repeat', () => {
    clock.loop = !clock.loop;
    loop.setAttribute('aria-pressed', clock.loop);
  });
  loop.setAttribute('aria-pressed', clock.loop);
  const total = show(clock.end);
  clock.listen(() => {
    const at = clock.end > clock.start ? (clock.time - clock.start) / (clock.end - clock.start) : 0;
    scrub.value = Math.round(at * STEPS);
    scrub.style.setProperty('--at', `${at * 100}%`);
    const text = show(clock.time);
    scrub.setAttribute('aria-valuetext', `${text} of ${total} seconds`);
    time.textContent = `${text.padStart(total.length, '\u2007')} / ${total}\u202fs`;
    update(clock.playing);
  });
  return h('div', { class: 'transport' }, button, scrub, h('div', { class: 'transport-end' }, time, speed, loop));
}
