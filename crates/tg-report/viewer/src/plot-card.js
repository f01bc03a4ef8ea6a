import uPlot from 'uplot';
import { h } from './dom.js';
import { axisLabel, number, quantity } from './format.js';
import { lineContent, stripContent } from './plot-content.js';
import { rowAxis, xAxis, yAxis } from './plot-axes.js';
import { SeriesList } from './series-list.js';
import { seriesStyle, seriesSwatch, theme } from './theme.js';

const FIRST = { lines: 8, points: 8, strips: 20 };
const HEIGHT = 190;
const ALONE = 320;
const GRAB = 8;

/** Which series are on at first: all of a few, the first of many; of strips, those where something happens. */
function firstVisible(plot) {
  const all = plot.series.map((_, i) => i);
  const eventful = all.filter((i) => plot.kind !== 'strips' || plot.series[i].values.some((v) => v > 0.5));
  const pool = eventful.length ? eventful : all;
  const few = plot.kind === 'strips' ? FIRST.strips : 12;
  return new Set(pool.length <= few ? pool : pool.slice(0, FIRST[plot.kind]));
}

/** One plot with its title, legend and links; drawn only while it is open. */
export class PlotCard {
  constructor(plot, link, open) {
    this.plot = plot;
    this.link = plot.x.time ? link : null;
    this.strips = plot.kind === 'strips';
    this.visible = firstVisible(plot);
    this.range = null;
    this.time = null;
    this.make(open);
    this.link?.add(this);
  }

  make(open) {
    const { plot } = this;
    this.readout = h('span', { class: 'readout' });
    this.undo = h('button', { type: 'button', class: 'text', hidden: true, onclick: () => this.zoomAll(null) }, 'Reset zoom');
    this.holder = h('div', { class: 'plot' });
    const list = new SeriesList(
      plot.series.map((s, i) => ({ name: s.name, swatch: this.strips ? 'var(--strip)' : this.swatch(i) })),
      this.visible, () => this.showVisible());
    this.list = list;
    const single = plot.series.length === 1 && !this.strips;
    this.body = h('div', { class: 'card-body', hidden: !open },
      h('div', { class: 'plot-head' }, h('span', { class: 'unit' }, this.strips ? '' : axisLabel(plot.y)), this.readout, this.undo),
      this.holder, single ? null : list.element);
    this.heading = h('button', { type: 'button', class: 'fold', 'aria-expanded': open, onclick: () => this.fold() }, h('i', { class: 'arrow' }), plot.title);
    this.element = h('section', { class: 'card' }, h('h2', {}, this.heading), this.body);
    new ResizeObserver(() => this.resize()).observe(this.holder);
  }

  fold() {
    this.body.hidden = !this.body.hidden;
    this.heading.setAttribute('aria-expanded', !this.body.hidden);
  }

  swatch(i) {
    return this.plot.kind === 'points' ? seriesStyle(i).colour : seriesSwatch(i);
  }

  rows() {
    return [...this.visible].sort((a, b) => a - b);
  }

  height() {
    // Without a stage beside them the plots have the page to themselves.
    if (!this.strips) return this.element.closest('.with-stage') ? HEIGHT : ALONE;
    const rows = Math.max(1, this.visible.size);
    return 52 + rows * (rows <= 24 ? 17 : 12);
  }

  resize() {
    const width = this.holder.clientWidth;
    if (!width) return;
    if (!this.chart) this.draw();
    else if (this.chart.width !== width) this.chart.setSize({ width, height: this.height() });
    this.placeCursor();
  }

  /** Makes the chart, again when the theme changes. */
  draw() {
    this.chart?.destroy();
    this.chart = null;
    const width = this.holder.clientWidth;
    if (!width) return;
    const now = theme();
    const { plot } = this;
    const names = () => this.rows().map((i) => plot.series[i].name);
    const content = this.strips
      ? stripContent(plot, () => this.rows(), { strip: now.colour('strip'), track: now.colour('track') })
      : lineContent(plot, this.visible);
    this.data = content.data;
    const xs = content.data[0];
    this.full = xs.length ? [xs[0], xs[xs.length - 1]] : [0, 1];
    if (this.full[0] === this.full[1]) this.full = [this.full[0] - 0.5, this.full[1] + 0.5];
    else if (plot.kind === 'points' || !plot.x.time) {
      const air = 0.02 * (this.full[1] - this.full[0]);
      this.full = [this.full[0] - air, this.full[1] + air];
    }
    const options = {
      width,
      height: this.height(),
      padding: [8, 12, 0, 0],
      legend: { show: false },
      scales: {
        x: { time: false, range: () => this.range ?? this.full },
        y: this.strips ? { range: () => [0, Math.max(1, this.visible.size)], dir: -1 } : {},
      },
      axes: [xAxis(now, plot.x), this.strips ? rowAxis(now, names) : yAxis(now)],
      series: [{}, ...content.series],
      cursor: {
        y: false,
        points: { show: !this.strips && plot.series.length <= 12, size: 6 },
        drag: { x: true, y: false, setScale: false, dist: 4 },
        bind: {
          // Pulling at the time line seeks; pulling elsewhere zooms.
          mousedown: (u, target, handle) => (event) => (this.seeking ? null : handle(event)),
          dblclick: () => () => this.zoomAll(null),
        },
      },
      hooks: {
        draw: content.paint ? [content.paint] : [],
        setSelect: [(u) => this.selected(u)],
        setCursor: [(u) => this.read(u)],
      },
    };
    this.chart = new uPlot(options, content.data, this.holder);
    this.line = h('div', { class: 'time-line', hidden: true });
    this.chart.over.append(this.line);
    if (this.link?.clock) this.bindSeeking(this.chart.over);
    this.placeCursor();
  }

  timeAt(event) {
    const box = this.chart.over.getBoundingClientRect();
    return this.chart.posToVal(Math.min(box.width, Math.max(0, event.clientX - box.left)), 'x');
  }

  bindSeeking(over) {
    over.style.cursor = 'pointer';
    over.style.touchAction = 'pan-y';
    const nearLine = (event) => {
      const box = over.getBoundingClientRect();
      return this.time !== null && Math.abs(event.clientX - box.left - this.chart.valToPos(this.time, 'x')) < GRAB;
    };
    over.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      this.press = event.clientX;
      // A finger has no second gesture to spare: it always seeks.
      this.seeking = event.pointerType === 'touch' || nearLine(event);
      if (this.seeking) over.setPointerCapture(event.pointerId);
    });
    over.addEventListener('pointermove', (event) => {
      if (this.seeking) this.link.seek(this.timeAt(event));
      else over.style.cursor = nearLine(event) ? 'ew-resize' : 'pointer';
    });
    over.addEventListener('pointerup', (event) => {
      if (this.press !== null && Math.abs(event.clientX - this.press) < 4) this.link.seek(this.timeAt(event));
      this.press = null;
      this.seeking = false;
    });
    over.addEventListener('pointercancel', () => {
      this.press = null;
      this.seeking = false;
    });
  }

  selected(u) {
    const { left, width } = u.select;
    if (width < 4) return;
    const range = [u.posToVal(left, 'x'), u.posToVal(left + width, 'x')];
    u.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    this.zoomAll(range);
  }

  zoomAll(range) {
    if (this.link) this.link.zoom(range);
    else this.zoom(range);
  }

  zoom(range) {
    this.range = range;
    this.undo.hidden = range === null;
    const [min, max] = range ?? this.full ?? [0, 1];
    this.chart?.setScale('x', { min, max });
    this.placeCursor();
  }

  showVisible() {
    if (!this.chart) return;
    if (this.strips) {
      this.chart.setSize({ width: this.holder.clientWidth, height: this.height() });
      this.chart.redraw(true, true);
    } else {
      this.chart.batch(() => {
        this.plot.series.forEach((_, i) => {
          const show = this.visible.has(i);
          if (this.chart.series[i + 1].show !== show) this.chart.setSeries(i + 1, { show });
        });
      });
    }
    this.placeCursor();
  }

  showTime(time) {
    this.time = time;
    this.placeCursor();
  }

  /** The line of the current time is an element of its own: moving it does not redraw the plot. */
  placeCursor() {
    if (!this.chart || this.time === null) return;
    const x = this.chart.valToPos(this.time, 'x');
    const inside = x >= -0.5 && x <= this.chart.over.clientWidth + 0.5;
    this.line.hidden = !inside;
    if (inside) this.line.style.transform = `translateX(${x}px)`;
  }

  /** Says what is under the pointer: x, and the nearest series with its value. */
  read(u) {
    const { idx, left, top } = u.cursor;
    if (idx === null || idx === undefined || left < 0) {
      this.readout.textContent = '';
      return;
    }
    const { x, y, series } = this.plot;
    const place = `${x.label} ${quantity(u.data[0][idx], x.unit, 4)}`;
    if (this.strips) {
      const rows = this.rows();
      const row = Math.floor((top / u.over.clientHeight) * rows.length);
      this.readout.textContent = rows[row] === undefined ? place : `${place}, ${series[rows[row]].name}`;
      return;
    }
    let best = null;
    for (const i of this.visible) {
      const value = u.data[i + 1][idx];
      if (value === null || value === undefined) continue;
      const far = Math.abs(u.valToPos(value, 'y') - top);
      if (!best || far < best.far) best = { i, value, far };
    }
    const name = series.length > 1 && best ? `${series[best.i].name} ` : '';
    this.readout.textContent = best ? `${place}, ${name}${y.unit ? quantity(best.value, y.unit, 4) : number(best.value, 4)}` : place;
  }

  repaint() {
    if (!this.strips) this.plot.series.forEach((_, i) => (this.list.entries[i].swatch = this.swatch(i)));
    this.list.refresh();
    if (this.chart) this.draw();
  }
}
