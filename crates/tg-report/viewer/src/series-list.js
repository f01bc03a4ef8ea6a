import { h } from './dom.js';

const MANY = 12;
const LISTED = 60;

/** The series of a plot as buttons that show and hide them; long lists get a filter. */
export class SeriesList {
  /** @param {{name:string, swatch:string}[]} entries @param {Set<number>} visible */
  constructor(entries, visible, onChange) {
    Object.assign(this, { entries, visible, onChange });
    this.chips = h('div', { class: 'chips' });
    this.element = h('div', { class: 'series' });
    if (entries.length > MANY) this.element.append(this.makeTools());
    this.element.append(this.chips);
    this.refresh();
  }

  makeTools() {
    this.filter = h('input', { type: 'search', placeholder: `Filter ${this.entries.length} series`, 'aria-label': 'Filter series', oninput: () => this.refresh() });
    this.count = h('span', { class: 'note' });
    const all = (shown) => () => {
      for (const i of this.matching()) shown ? this.visible.add(i) : this.visible.delete(i);
      this.changed();
    };
    const only = () => {
      this.visible.clear();
      all(true)();
    };
    return h('div', { class: 'series-tools' }, this.filter,
      h('button', { type: 'button', class: 'text', title: 'Show only the listed series', onclick: only }, 'Only'),
      h('button', { type: 'button', class: 'text', title: 'Show all listed series', onclick: all(true) }, 'All'),
      h('button', { type: 'button', class: 'text', title: 'Hide all listed series', onclick: all(false) }, 'None'),
      this.count);
  }

  matching() {
    const words = (this.filter?.value ?? '').toLowerCase().split(/\s+/).filter(Boolean);
    const found = [];
    this.entries.forEach((e, i) => {
      if (words.every((w) => e.name.toLowerCase().includes(w))) found.push(i);
    });
    return found;
  }

  changed() {
    this.refresh();
    this.onChange();
  }

  toggle(i) {
    if (!this.visible.delete(i)) this.visible.add(i);
    this.changed();
  }

  refresh() {
    const found = this.matching();
    // What is shown comes first, so that it can be found and switched off.
    if (this.filter) found.sort((a, b) => this.visible.has(b) - this.visible.has(a) || a - b);
    const focused = this.chips.contains(document.activeElement) ? document.activeElement.dataset.index : null;
    this.chips.replaceChildren(...found.slice(0, LISTED).map((i) => {
      const { name, swatch } = this.entries[i];
      return h('button', { type: 'button', class: 'chip', 'data-index': i, 'aria-pressed': this.visible.has(i), title: name, onclick: () => this.toggle(i) },
        h('i', { style: `background:${swatch}` }), h('span', {}, name));
    }));
    if (found.length > LISTED) this.chips.append(h('span', { class: 'note' }, `and ${found.length - LISTED} more`));
    if (!found.length) this.chips.append(h('span', { class: 'note' }, 'No series has that name.'));
    if (focused !== null) this.chips.querySelector(`[data-index="${focused}"]`)?.focus();
    if (this.count) this.count.textContent = `${this.visible.size} shown`;
  }
}
