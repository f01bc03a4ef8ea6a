import { configurationState, spreadDisplacements } from './assembly.js';
import { Extent } from './extent.js';
import { h } from './dom.js';
import { number, quantity } from './format.js';
import { playButton } from './transport.js';
import { tensionExtent } from './tension-scale.js';

/** Every mode is shown at this pace: true frequencies are often too fast or too slow to see. */
const SHOWN_HERTZ = 0.6;
const SLIDER = 100;

const percent = (ratio) => (ratio === null ? '–' : `${number(ratio * 100, 3)}\u202f%`);

/** The modes: a list, and the chosen one swinging about the undeformed structure. */
export class ModesView {
  constructor({ assembly, payload, stage, size, makeView, makeStructure }) {
    this.name = 'Modes';
    this.stage = stage;
    this.reference = configurationState(assembly, payload.modes.reference);
    this.tensions = tensionExtent([payload.modes.reference]);
    this.modes = payload.modes.list.map((mode) => ({ ...mode, vertices: spreadDisplacements(assembly, mode.vertices) }));
    this.largest = 0.3 * size;
    this.amplitude = 0.1 * size;
    this.phase = Math.PI / 2;
    this.playing = false;
    this.chosen = 0;
    this.state = { ...this.reference, vertices: this.reference.vertices.slice(), ends: this.reference.ends.slice() };
    this.frame = h('div', { class: 'whole' });
    this.view = makeView(this.frame, 'solid');
    this.ghost = makeStructure('ghost');
    this.view.scene.add(this.ghost.group);
    this.ghost.state = this.reference;
    this.view.structure.state = this.state;
    this.extent = this.reach();
    this.panel = this.makePanel();
    this.footer = this.makeFooter();
  }

  reach() {
    const extent = new Extent().add(this.reference.vertices).add(this.reference.ends);
    for (const mode of this.modes.slice(0, 12)) {
      for (const sign of [-1, 1]) {
        extent.add(this.reference.vertices.map((x, i) => x + sign * this.amplitude * mode.vertices[i]));
      }
    }
    return extent;
  }

  makePanel() {
    const rows = this.modes.map((mode, i) => {
      const input = h('input', { type: 'radio', name: 'mode', value: i, checked: i === this.chosen, onchange: () => this.choose(i) });
      return h('label', { class: 'mode' }, input,
        h('span', { class: 'mode-name' }, mode.label),
        h('span', { class: 'value' }, mode.frequency === null ? '–' : quantity(mode.frequency, 'Hz', 4)),
        h('span', { class: 'value' }, percent(mode.damping)));
    });
    return h('section', { class: 'card modes' },
      h('h2', { id: 'modes-title' }, 'Modes'),
      h('div', { class: 'mode mode-head', 'aria-hidden': 'true' }, h('span', { class: 'mode-name' }, ''), h('span', { class: 'value' }, 'frequency'), h('span', { class: 'value' }, 'damping')),
      h('div', { class: 'mode-list', role: 'radiogroup', 'aria-labelledby': 'modes-title' }, rows));
  }

  makeFooter() {
    this.button = playButton(() => this.toggle());
    const slider = h('input', { type: 'range', class: 'scrub', min: 0, max: SLIDER, value: Math.round((this.amplitude / this.largest) * SLIDER), 'aria-label': 'Amplitude' });
    const value = h('output', { class: 'time', title: 'Largest displacement shown' });
    const read = () => {
      this.amplitude = (this.largest * slider.value) / SLIDER;
      value.textContent = quantity(this.amplitude, 'm', 3);
      slider.style.setProperty('--at', `${(100 * slider.value) / SLIDER}%`);
      this.update();
    };
    slider.addEventListener('input', read);
    read();
    return h('div', { class: 'transport' }, this.button.button, h('label', { class: 'slider' }, h('span', {}, 'Amplitude'), slider),
      h('div', { class: 'transport-end' }, value, h('span', { class: 'note' }, `shown at ${SHOWN_HERTZ}\u202fHz`)));
  }

  choose(index) {
    this.chosen = index;
    this.update();
  }

  toggle(playing = !this.playing) {
    this.playing = playing;
    this.button.update(playing);
    this.stage.loop.request();
  }

  enter() {
    this.stage.layer.replaceChildren(this.frame);
    this.stage.setViews([this.view], this.extent.points);
    this.active = true;
    this.update();
    this.toggle(!window.matchMedia('(prefers-reduced-motion: reduce)').matches);
  }

  leave() {
    this.active = false;
    this.toggle(false);
  }

  paint(theme, scale) {
    this.view.paint(theme);
    this.view.structure.paint(theme, scale);
    this.ghost.paint(theme, scale);
  }

  update() {
    if (!this.active) return;
    const mode = this.modes[this.chosen];
    const factor = this.amplitude * Math.sin(this.phase);
    for (const part of ['vertices', 'ends']) {
      const [rest, moved, by] = [this.reference[part], this.state[part], mode[part]];
      for (let i = 0; i < rest.length; i++) moved[i] = rest[i] + factor * by[i];
    }
    this.view.structure.show(this.state);
    this.stage.refreshPointed();
    this.stage.request();
  }

  step(seconds) {
    if (!this.playing) return false;
    this.phase = (this.phase + seconds * 2 * Math.PI * SHOWN_HERTZ) % (2 * Math.PI);
    this.update();
    return true;
  }

  key(event) {
    if (event.key !== ' ') return false;
    this.toggle();
    return true;
  }
}
