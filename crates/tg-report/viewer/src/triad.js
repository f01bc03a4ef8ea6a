import { Vector3 } from 'three';
import { h, svg } from './dom.js';

const axes = [['x', new Vector3(1, 0, 0)], ['y', new Vector3(0, 1, 0)], ['z', new Vector3(0, 0, 1)]];

/** The axes as the camera sees them. */
export class Triad {
  constructor(plane) {
    this.picture = svg('svg', { viewBox: '-36 -36 72 72', width: 72, height: 72, 'aria-hidden': 'true' });
    this.element = h('div', { class: 'triad' }, this.picture);
    this.parts = (plane ? axes.slice(0, 2) : axes).map(([name, axis]) => {
      const line = svg('line', { x1: 0, y1: 0, class: `axis-${name}` });
      const label = svg('text', { class: `axis-${name}` });
      label.textContent = name;
      return { axis, line, label, group: svg('g', {}, line, label) };
    });
  }

  update(camera) {
    const turned = this.parts.map((part) => ({ ...part, v: part.axis.clone().applyQuaternion(camera.quaternion.clone().invert()) }));
    turned.sort((a, b) => a.v.z - b.v.z);
    for (const { v, line, label } of turned) {
      line.setAttribute('x2', v.x * 22);
      line.setAttribute('y2', -v.y * 22);
      // An axis that points at the viewer keeps its letter off the origin.
      const reach = Math.max(Math.hypot(v.x, v.y), 1e-6);
      const out = Math.max(29 * reach, 12);
      label.setAttribute('x', (v.x / reach) * out);
      label.setAttribute('y', (-v.y / reach) * out);
    }
    this.picture.replaceChildren(...turned.map((t) => t.group));
  }
}
