import { h } from './dom.js';

/** The key of the cables' colours. */
export function colourBar(scale) {
  const { from, to, zero } = scale.labels();
  const { taut, slack } = scale.extent;
  const bar = h('div', { class: 'gradient' }, zero === null ? null : h('i', { style: `left:${zero * 100}%` }));
  bar.style.backgroundImage = scale.gradient();
  const name = `Cable tension from ${from} to ${to} newtons`;
  return h('div', { class: 'colour-bar' },
    taut ? h('div', { class: 'key', role: 'img', 'aria-label': name },
      h('span', { class: 'name' }, scale.diverging ? 'Tension (N), compression below 0' : 'Cable tension (N)'),
      h('span', { class: 'end' }, from), bar, h('span', { class: 'end' }, to)) : null,
    slack ? h('div', { class: 'key' }, h('i', { class: 'dashes' }), h('span', {}, 'slack')) : null);
}
