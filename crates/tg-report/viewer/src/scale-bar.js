import { h } from './dom.js';
import { quantity, roundDown } from './format.js';

const compact = (metres) => {
  if (metres >= 1000) return quantity(metres / 1000, 'km', 1);
  if (metres >= 1 || metres === 0) return quantity(metres, 'm', 1);
  if (metres >= 0.01) return quantity(metres * 100, 'cm', 1);
  if (metres >= 0.001) return quantity(metres * 1000, 'mm', 1);
  return quantity(metres, 'm', 1);
};

/** How long things are: a bar true at the depth of the view's centre, and the grid's spacing. */
export class ScaleBar {
  constructor() {
    this.grid = h('span', { class: 'grid-note' });
    this.bar = h('i');
    this.text = h('span');
    this.element = h('div', { class: 'scale-bar' }, this.grid, this.text, this.bar);
  }

  setGrid(spacing) {
    this.grid.textContent = `grid ${compact(spacing)}`;
  }

  update(pixelsPerMetre) {
    const length = roundDown(130 / pixelsPerMetre);
    this.text.textContent = compact(length);
    this.bar.style.width = `${length * pixelsPerMetre}px`;
  }
}
