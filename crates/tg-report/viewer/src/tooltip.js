import { h } from './dom.js';
import { quantity } from './format.js';

const distance = (p, i, q, j) => Math.hypot(p[i] - q[j], p[i + 1] - q[j + 1], p[i + 2] - q[j + 2]);

/** Name, tension and length of what is pointed at. */
export class Tooltip {
  constructor(payload) {
    this.payload = payload;
    this.element = h('div', { class: 'tooltip', role: 'status', hidden: true });
  }

  hide() {
    this.element.hidden = true;
  }

  rows(view) {
    const { picked, structure } = view;
    const { state, assembly } = structure;
    if (picked.kind === 'cable') {
      const cable = this.payload.cables[picked.index];
      const c = picked.index;
      return {
        title: cable.name,
        note: cable.group,
        rows: [
          ['tension', structure.scale.describe(state.tension[c], state.slack[c])],
          ['length', quantity(distance(state.ends, 6 * c, state.ends, 6 * c + 3), 'm', 4)],
        ],
      };
    }
    const member = assembly.members[picked.index];
    const edge = assembly.edges.find((e) => e.member === picked.index);
    const rows = [];
    if (member.kind === 'bar' && edge) rows.push(['length', quantity(distance(state.vertices, 3 * edge.a, state.vertices, 3 * edge.b), 'm', 4)]);
    if (member.kind === 'particle') {
      const v = 3 * assembly.start[picked.index];
      ['x', 'y', 'z'].forEach((axis, i) => rows.push([axis, quantity(state.vertices[v + i], 'm', 4)]));
    }
    return { title: member.name, note: member.name.startsWith(member.kind) ? null : member.kind, rows };
  }

  /** Shows the view's picked part near a place of the pane. */
  show(view, x, y, paneWidth, paneHeight) {
    const { title, note, rows } = this.rows(view);
    this.element.replaceChildren(
      h('div', {}, h('b', {}, title), note ? h('span', {}, ` ${note}`) : null),
      h('dl', {}, rows.map(([name, value]) => [h('dt', {}, name), h('dd', {}, value)])),
    );
    this.element.hidden = false;
    const { offsetWidth: w, offsetHeight: t } = this.element;
    const left = x + 14 + w > paneWidth ? x - w - 12 : x + 14;
    const top = y + 14 + t > paneHeight ? y - t - 12 : y + 14;
    this.element.style.transform = `translate(${Math.max(4, left)}px, ${Math.max(4, top)}px)`;
  }
}
