import { Clock } from './clock.js';
import { Extent } from './extent.js';
import { h } from './dom.js';
import { motionSampler } from './motion-sampler.js';
import { placeVertices } from './assembly.js';
import { tensionExtent } from './tension-scale.js';
import { transport } from './transport.js';

const SAMPLES = 150;

/** Everywhere the structure goes, from frames spread over the run. */
export function motionExtent(assembly, motion, counts) {
  const extent = new Extent();
  const frames = motion.time.length;
  const step = Math.max(1, Math.ceil(frames / SAMPLES));
  const vertices = new Float32Array(assembly.vertexCount * 3);
  for (let f = 0; f < frames; f += step) {
    extent.add(placeVertices(assembly, motion.poses.subarray(f * counts.members * 7, (f + 1) * counts.members * 7), vertices));
    extent.add(motion.ends.subarray(f * counts.cables * 6, (f + 1) * counts.cables * 6));
  }
  return extent;
}

/** The run as a film. */
export class MotionView {
  constructor({ assembly, payload, counts, stage, makeView }) {
    this.name = 'Motion';
    this.stage = stage;
    this.clock = new Clock(payload.motion.time);
    this.tensions = tensionExtent([payload.motion]);
    this.extent = motionExtent(assembly, payload.motion, counts);
    this.sampler = motionSampler(assembly, payload.motion, counts);
    this.frame = h('div', { class: 'whole' });
    this.view = makeView(this.frame, 'solid');
    this.footer = transport(this.clock);
    this.view.structure.state = this.sampler.at(this.clock.time);
    this.clock.listen(() => this.update());
  }

  enter() {
    this.stage.layer.replaceChildren(this.frame);
    this.stage.setViews([this.view], this.extent.points);
    this.active = true;
    this.update();
  }

  leave() {
    this.active = false;
    this.clock.toggle(false);
  }

  paint(theme, scale) {
    this.view.paint(theme);
    this.view.structure.paint(theme, scale);
  }

  update() {
    if (!this.active) return;
    this.view.structure.show(this.sampler.at(this.clock.time));
    this.stage.refreshPointed();
    this.stage.request();
  }

  step(seconds) {
    this.clock.tick(seconds);
    return this.clock.playing;
  }

  key(event) {
    const far = event.shiftKey ? 10 : 1;
    const actions = {
      ' ': () => this.clock.toggle(),
      ArrowRight: () => this.clock.step(far),
      ArrowLeft: () => this.clock.step(-far),
      Home: () => this.clock.seek(this.clock.start),
      End: () => this.clock.seek(this.clock.end),
    };
    actions[event.key]?.();
    return event.key in actions;
  }
}
