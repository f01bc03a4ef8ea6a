import { configurationState } from './assembly.js';
import { Extent } from './extent.js';
import { h, iconButton } from './dom.js';
import { quantity } from './format.js';
import { tensionExtent } from './tension-scale.js';

const LEAST = 165;

/** Columns that make the cells largest; beyond what fits, the grid scrolls. */
function columns(count, width, height) {
  let best = { columns: 1, side: 0 };
  for (let n = 1; n <= count; n++) {
    const side = Math.min(width / n, (height / Math.ceil(count / n)) * 1.05);
    if (side > best.side) best = { columns: n, side };
  }
  return best.side >= LEAST ? { columns: best.columns, fits: true } : { columns: Math.max(1, Math.floor(width / LEAST)), fits: false };
}

const verdict = (stable) => (stable === null ? null : stable ? 'stable' : 'unstable');

/** Energies that are zero but for rounding are said to be zero. */
function withoutNoise(list) {
  const largest = Math.max(...list.map((s) => Math.abs(s.energy ?? 0)));
  return list.map((s) => (s.energy !== null && Math.abs(s.energy) < 1e-14 * largest ? { ...s, energy: 0 } : s));
}

/** Equilibria: all side by side, or one enlarged. One alone is simply shown. */
export class ShapesView {
  constructor({ assembly, payload, stage, makeView }) {
    const list = withoutNoise(payload.shapes.list);
    this.name = list.length > 1 ? 'Equilibria' : 'Shape';
    this.stage = stage;
    this.tensions = tensionExtent(list);
    this.extent = new Extent();
    // Without a verdict on any, none needs to stand back.
    this.shapes = list.map((shape, index) => {
      const state = configurationState(assembly, shape);
      this.extent.add(state.vertices).add(state.ends);
      const { cell, picture } = this.makeCell(shape, index);
      const view = makeView(picture, list.length === 1 ? 'solid' : shape.stable === false ? 'faint' : 'small');
      view.structure.state = state;
      view.shape = index;
      return { ...shape, cell, view };
    });
    this.grid = h('div', { class: 'cells', role: 'list', 'aria-label': 'Equilibria' }, this.shapes.map((s) => s.cell));
    this.enlarged = list.length === 1 ? 0 : null;
    if (list.length > 1) {
      this.whole = h('div', { class: 'whole' });
      this.big = makeView(this.whole, 'solid');
      this.footer = this.makeFooter();
      const stable = list.filter((s) => s.stable).length;
      const judged = list.some((s) => s.stable !== null);
      this.summary = `${list.length} equilibria${judged ? `, ${stable} stable` : ''}`;
      this.showFooter();
    } else if (list[0].energy !== null || list[0].stable !== null) {
      this.footer = h('div', { class: 'transport' }, this.caption(list[0], 0));
    }
  }

  caption(shape, index) {
    const stability = verdict(shape.stable);
    return h('div', { class: 'caption' },
      h('b', {}, shape.label || String(index + 1)),
      shape.energy === null ? null : h('span', { class: 'energy', title: 'Potential energy' }, quantity(shape.energy, 'J', 4)),
      stability ? h('span', { class: `badge ${stability}` }, stability) : null);
  }

  makeCell(shape, index) {
    const stability = verdict(shape.stable);
    const open = h('button', { type: 'button', class: 'cell-open', 'aria-label': `Enlarge equilibrium ${shape.label}`, onclick: () => this.enlarge(index) }, this.caption(shape, index));
    const picture = h('div', { class: 'picture' });
    // Else the controls of the camera take the click for themselves.
    open.addEventListener('pointerdown', (event) => event.stopPropagation());
    return { cell: h('div', { class: `cell ${stability ?? ''}`, role: 'listitem' }, picture, open), picture };
  }

  makeFooter() {
    this.title = h('div', { class: 'caption-slot' });
    this.browse = h('div', { class: 'transport-end' },
      iconButton('previous', 'Previous equilibrium (left arrow)', () => this.move(-1)),
      iconButton('next', 'Next equilibrium (right arrow)', () => this.move(1)),
      h('button', { type: 'button', class: 'text', onclick: () => this.enlarge(null) }, 'Show all'));
    return h('div', { class: 'transport' }, this.title, this.browse);
  }

  showFooter() {
    const all = this.enlarged === null;
    this.browse.hidden = all;
    this.title.replaceChildren(all ? h('span', { class: 'note' }, `${this.summary}. Select one to enlarge it.`) : this.caption(this.shapes[this.enlarged], this.enlarged));
  }

  enlarge(index) {
    if (this.shapes.length === 1) return;
    this.enlarged = index;
    this.showFooter();
    if (index !== null) this.big.structure.show(this.shapes[index].view.structure.state);
    this.enter();
  }

  move(by) {
    const n = this.shapes.length;
    this.enlarged = (this.enlarged + by + n) % n;
    this.showFooter();
    this.big.structure.show(this.shapes[this.enlarged].view.structure.state);
    this.stage.point(null);
    this.stage.request();
  }

  enter() {
    const { stage } = this;
    const single = this.shapes.length === 1;
    const all = !single && this.enlarged === null;
    stage.layer.replaceChildren(all ? this.grid : single ? this.shapes[0].cell : this.whole);
    if (single) this.shapes[0].cell.className = 'whole bare';
    stage.onResize = all ? () => this.arrange() : null;
    stage.onTap = all ? (view) => view && this.enlarge(view.shape) : null;
    this.arrange();
    stage.setViews(all ? this.shapes.map((s) => s.view) : [single ? this.shapes[0].view : this.big], this.extent.points);
  }

  leave() {
    this.stage.onResize = null;
    this.stage.onTap = null;
  }

  arrange() {
    const { clientWidth: width, clientHeight: height } = this.stage.layer;
    const { columns: n, fits } = columns(this.shapes.length, width, height);
    this.grid.style.gridTemplateColumns = `repeat(${n}, minmax(0, 1fr))`;
    this.grid.style.gridAutoRows = fits ? `minmax(0, 1fr)` : `${Math.round((width / n) * 0.95)}px`;
    this.grid.style.height = fits ? '100%' : 'auto';
  }

  paint(theme, scale) {
    for (const view of [...this.shapes.map((s) => s.view), this.big]) {
      view?.paint(theme);
      view?.structure.paint(theme, scale);
    }
  }

  update() {}

  step() {
    return false;
  }

  key(event) {
    if (this.shapes.length === 1 || this.enlarged === null) return false;
    const actions = { ArrowLeft: () => this.move(-1), ArrowRight: () => this.move(1), Escape: () => this.enlarge(null) };
    actions[event.key]?.();
    return event.key in actions;
  }
}
