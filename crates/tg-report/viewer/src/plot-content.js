import { seriesStyle } from './theme.js';

/** Not-a-number is a gap, which uPlot knows as null. */
const gaps = (values, order) => Array.from(order, (i) => (Number.isFinite(values[i]) ? values[i] : null));

/** A line in the order of the data: a load path may turn back in x, where uPlot draws from left to right. */
function pathInOrder(xs, ys) {
  return (u) => {
    const stroke = new Path2D();
    let down = false;
    for (let i = 0; i < xs.length; i++) {
      if (!Number.isFinite(xs[i]) || !Number.isFinite(ys[i])) {
        down = false;
        continue;
      }
      const [x, y] = [u.valToPos(xs[i], 'x', true), u.valToPos(ys[i], 'y', true)];
      if (down) stroke.lineTo(x, y);
      else stroke.moveTo(x, y);
      down = true;
    }
    return { stroke, fill: null, clip: null, band: null, gaps: null, flags: 1 };
  };
}

/** Lines and points for uPlot: aligned data, and a description of each series. */
export function lineContent(plot, visible) {
  const xs = plot.x.values;
  const order = Array.from(xs.keys()).filter((i) => Number.isFinite(xs[i]));
  const ascending = order.every((i, k) => k === 0 || xs[order[k - 1]] <= xs[i]);
  if (!ascending) order.sort((a, b) => xs[a] - xs[b]);
  const points = plot.kind === 'points';
  const series = plot.series.map(({ name, values }, i) => {
    const { colour, dash } = seriesStyle(i);
    return {
      label: name,
      show: visible.has(i),
      stroke: colour,
      width: points ? 0 : 1.5,
      dash: points ? undefined : (dash ?? undefined),
      paths: points ? () => null : ascending ? undefined : pathInOrder(xs, values),
      points: points ? { show: true, size: 6, fill: colour, stroke: colour, width: 0 } : { show: order.length === 1, size: 6, fill: colour },
    };
  });
  return { data: [Array.from(order, (i) => xs[i]), ...plot.series.map((s) => gaps(s.values, order))], series };
}

/** The spans over which a 0/1 series is 1: a value holds until the next sample. */
export function spans(xs, values) {
  const out = [];
  let from = null;
  for (let i = 0; i < xs.length; i++) {
    const on = values[i] > 0.5;
    if (on && from === null) from = xs[i];
    if (!on && from !== null) {
      out.push([from, xs[i]]);
      from = null;
    }
  }
  if (from !== null && xs.length) out.push([from, xs[xs.length - 1]]);
  return out;
}

/** Strips for uPlot: an invisible series gives the x range, a hook paints the rows. */
export function stripContent(plot, rows, colours) {
  const xs = Array.from(plot.x.values);
  const all = plot.series.map((s) => spans(xs, s.values));
  const paint = (u) => {
    const { ctx, bbox } = u;
    const shown = rows();
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    const height = bbox.height / Math.max(1, shown.length);
    const inset = Math.min(height * 0.2, 4 * devicePixelRatio);
    shown.forEach((s, row) => {
      const top = bbox.top + row * height;
      ctx.fillStyle = colours.track;
      ctx.fillRect(bbox.left, top + inset, bbox.width, height - 2 * inset);
      ctx.fillStyle = colours.strip;
      for (const [from, to] of all[s]) {
        const [x0, x1] = [u.valToPos(from, 'x', true), u.valToPos(to, 'x', true)];
        // A span shorter than a pixel still happened.
        ctx.fillRect(x0, top + inset, Math.max(devicePixelRatio, x1 - x0), height - 2 * inset);
      }
    });
    ctx.restore();
  };
  return {
    data: [xs, xs.map(() => 0)],
    series: [{ paths: () => null, points: { show: false } }],
    paint,
    active: all.map((s) => s.length > 0),
  };
}
