/** Payloads made by hand for the test: plausible to look at, simple enough to know what must be seen. */

const encode = (Kind) => (values) => Buffer.from(Kind.from(values).buffer).toString('base64');
const f32 = encode(Float32Array);
const f64 = encode(Float64Array);
const u8 = encode(Uint8Array);

const add = (a, b) => a.map((x, i) => x + b[i]);
const sub = (a, b) => a.map((x, i) => x - b[i]);
const scale = (a, s) => a.map((x) => x * s);
const norm = (a) => Math.hypot(...a);
const range = (n) => Array.from({ length: n }, (_, i) => i);

/** The pose of a bar with its local x axis from a to b. */
function barPose(a, b) {
  const d = scale(sub(b, a), 1 / norm(sub(b, a)));
  const q = d[0] < -0.999999 ? [0, 0, 1, 0] : [0, -d[2], d[1], 1 + d[0]];
  return [...scale(add(a, b), 0.5), ...scale(q, 1 / norm(q))];
}

const bar = (name, length, radius) => ({
  name, kind: 'bar', vertices: [[-length / 2, 0, 0], [length / 2, 0, 0]], edges: [[0, 1]], faces: [], radius,
});

const aboutX = ([x, y, z], angle) => [x, y * Math.cos(angle) - z * Math.sin(angle), y * Math.sin(angle) + z * Math.cos(angle)];

const time = (values, linked = true) => ({ label: 'time', unit: 's', time: linked, values: f64(values) });

/** Frames of nodes, bars and cables as one motion of the contract; springs push only if two-way. */
function motion(times, nodesAt, bars, cables, stiffness, rest, twoWay = false) {
  const poses = [], ends = [], tension = [], slack = [];
  for (const t of times) {
    const nodes = nodesAt(t);
    for (const [a, b] of bars) poses.push(...barPose(nodes[a], nodes[b]));
    cables.forEach(([a, b], c) => {
      const stretch = norm(sub(nodes[a], nodes[b])) - rest[c];
      ends.push(...nodes[a], ...nodes[b]);
      slack.push(!twoWay && stretch <= 0 ? 1 : 0);
      tension.push(twoWay ? stiffness * stretch : Math.max(0, stiffness * stretch));
    });
  }
  return { data: { time: f64(times), poses: f32(poses), ends: f32(ends), tension: f32(tension), slack: u8(slack) }, tension, slack };
}

const base = (title, subtitle) => ({
  version: 1, title, subtitle, dimension: 3, up: [0, 0, 1], members: [], cables: [], motion: null, modes: null, shapes: null, plots: [],
});

function cablePlots(times, cables, tension, slack, names) {
  const of = (data, c) => times.map((_, f) => data[f * cables + c]);
  return [
    { title: 'Cable tensions', kind: 'lines', x: time(times), y: { label: 'tension', unit: 'N' }, series: range(cables).map((c) => ({ name: names[c], values: f64(of(tension, c)) })) },
    { title: 'Slack intervals', kind: 'strips', x: time(times), y: { label: '', unit: '' }, series: range(cables).map((c) => ({ name: names[c], values: f64(of(slack, c)) })) },
  ];
}

/** A three-strut prism that twists and sways, with cables that go slack. */
export function prism({ twoWay = false } = {}) {
  const times = range(241).map((f) => f / 80);
  const r = 0.3, length = 0.85;
  const nodesAt = (t) => {
    const twist = (5 * Math.PI) / 6 + 0.22 * Math.sin(2 * Math.PI * 0.8 * t);
    const chord = 2 * r * Math.sin(twist / 2);
    const height = Math.sqrt(length ** 2 - chord ** 2);
    const sway = 0.2 * Math.sin(2 * Math.PI * 0.5 * t);
    const ring = (z, turn) => range(3).map((i) => aboutX([r * Math.cos((2 * Math.PI * i) / 3 + turn), r * Math.sin((2 * Math.PI * i) / 3 + turn), z], z ? sway : 0));
    return [...ring(0, 0), ...ring(height, twist)];
  };
  const bars = [[0, 3], [1, 4], [2, 5]];
  const cables = [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 5], [1, 3], [2, 4]];
  const names = ['base 1', 'base 2', 'base 3', 'top 1', 'top 2', 'top 3', 'side 1', 'side 2', 'side 3'];
  const rest = cables.map(([a, b], c) => norm(sub(nodesAt(0)[a], nodesAt(0)[b])) * (c < 6 ? 0.96 : 0.995));
  const run = motion(times, nodesAt, bars, cables, 900, rest, twoWay);
  const kinetic = times.map((t) => 1.6 * Math.cos(2 * Math.PI * 0.8 * t) ** 2 + 0.9 * Math.cos(2 * Math.PI * 0.5 * t) ** 2);
  return {
    ...base('Swaying prism', 'tg run, three struts and nine cables'),
    members: bars.map((_, i) => bar(`bar ${i + 1}`, length, 0.012)),
    cables: names.map((name) => ({ name, group: name.split(' ')[0] })),
    motion: run.data,
    plots: [
      { title: 'Energies', kind: 'lines', x: time(times), y: { label: 'energy', unit: 'J' }, series: [
        { name: 'kinetic', values: f64(kinetic) },
        { name: 'elastic', values: f64(kinetic.map((e) => 2.6 - e)) },
        { name: 'total', values: f64(kinetic.map((e, i) => (i > 100 && i < 110 ? NaN : 2.6))) },
      ] },
      ...cablePlots(times, cables.length, run.tension, run.slack, names),
      { title: 'Energy error', kind: 'lines', x: time(times), y: { label: 'error', unit: 'J' }, series: [{ name: 'error', values: f64(times.map((t) => 3e-9 * Math.sin(9 * t) * t)) }] },
      { title: 'Load path', kind: 'lines', x: { label: 'height', unit: 'm', time: false, values: f64(range(120).map((i) => 0.5 + 0.1 * Math.sin(i / 14))) }, y: { label: 'load', unit: 'N' }, series: [{ name: 'path', values: f64(range(120).map((i) => i / 4)) }] },
    ],
  };
}

/** A plane truss of bars and two-way springs, with modes. */
export function truss() {
  const n = 6;
  const nodes = [...range(n + 1).map((i) => [i, 0, 0]), ...range(n).map((i) => [i + 0.5, 0.9, 0])];
  const top = n + 1;
  const bars = [...range(n).map((i) => [i, i + 1]), ...range(n - 1).map((i) => [top + i, top + i + 1])];
  const cables = range(n).flatMap((i) => [[i, top + i], [top + i, i + 1]]);
  const shape = (mode) => (p) => {
    const phase = ((mode + 1) * Math.PI * p[0]) / n;
    return [-0.25 * p[1] * Math.cos(phase), Math.sin(phase), 0];
  };
  const members = [
    ...bars.map(([a, b], i) => bar(`bar ${i + 1}`, norm(sub(nodes[a], nodes[b])), 0.02)),
    { name: 'load', kind: 'particle', vertices: [[0, 0, 0]], edges: [], faces: [], radius: 0.07 },
  ];
  const load = nodes[3];
  return {
    ...base('Plane truss', 'tg modes, two-way springs as diagonals'),
    dimension: 2, up: [0, 1, 0], members,
    cables: cables.map((_, i) => ({ name: `spring ${i + 1}`, group: 'diagonals' })),
    modes: {
      reference: {
        poses: f32([...bars.flatMap(([a, b]) => barPose(nodes[a], nodes[b])), ...load, 0, 0, 0, 1]),
        ends: f32(cables.flatMap(([a, b]) => [...nodes[a], ...nodes[b]])),
        tension: f32(cables.map((_, i) => 40 * Math.cos((i * Math.PI) / 11) + 8)),
        slack: u8(cables.map(() => 0)),
      },
      list: range(8).map((m) => ({
        label: `mode ${m + 1}`,
        frequency: m === 7 ? null : 1.85 * (m + 1) ** 1.6,
        damping: m === 7 ? null : 0.004 * (m + 1),
        vertices: f32([...bars.flatMap(([a, b]) => [...shape(m)(nodes[a]), ...shape(m)(nodes[b])]), ...shape(m)(load)]),
        ends: f32(cables.flatMap(([a, b]) => [...shape(m)(nodes[a]), ...shape(m)(nodes[b])])),
      })),
    },
    plots: [{
      title: 'Frequencies', kind: 'points', x: { label: 'mode', unit: '', time: false, values: f64(range(7).map((i) => i + 1)) },
      y: { label: 'frequency', unit: 'Hz' }, series: [{ name: 'undamped', values: f64(range(7).map((m) => 1.85 * (m + 1) ** 1.6)) }, { name: 'damped', values: f64(range(7).map((m) => 1.8 * (m + 1) ** 1.57)) }],
    }],
  };
}

/** Two rigid tetrahedra held by cables, in so many equilibria. */
export function equilibria(count = 5) {
  const corner = [[0.35, 0, -0.1], [-0.18, 0.3, -0.1], [-0.18, -0.3, -0.1], [0, 0, 0.4]];
  const body = (name) => ({
    name, kind: 'body', vertices: corner, edges: [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]], faces: [[0, 1, 2], [0, 1, 3], [1, 2, 3], [2, 0, 3]], radius: 0.008,
  });
  const turn = (p, yaw, tilt) => {
    const [x, y, z] = aboutX(p, tilt);
    return [x * Math.cos(yaw) - y * Math.sin(yaw), x * Math.sin(yaw) + y * Math.cos(yaw), z];
  };
  const shape = (i) => {
    const [yaw, tilt] = [0.5 * i, i === 0 ? 0 : 0.55 * i];
    const at = [0.04 * i, -0.03 * i, 0.5 - 0.03 * (i % 4)];
    const q = [Math.sin(tilt / 2) * Math.cos(yaw / 2), Math.sin(tilt / 2) * Math.sin(yaw / 2), Math.cos(tilt / 2) * Math.sin(yaw / 2), Math.cos(tilt / 2) * Math.cos(yaw / 2)];
    const upper = corner.map((p) => add(turn(p, yaw, tilt), at));
    const pairs = [[0, 0], [1, 1], [2, 2], [3, 0], [3, 1], [3, 2]];
    return {
      label: String(i + 1), stable: i === 0 || i === 3, energy: -2.31 + 0.83 * i,
      poses: f32([0, 0, 0, 0, 0, 0, 1, ...at, ...q]),
      ends: f32(pairs.flatMap(([a, b]) => [...corner[a], ...upper[b]])),
      tension: f32(pairs.map((_, c) => 12 + 6 * Math.sin(2 * c + i))),
      slack: u8(pairs.map((_, c) => (i === 2 && c < 2 ? 1 : 0))),
    };
  };
  return {
    ...base('Two-body spire', `tg equilibria, ${count} found`),
    members: [body('base'), body('upper')],
    cables: range(6).map((i) => ({ name: `cable ${i + 1}`, group: i < 3 ? 'outer' : 'inner' })),
    shapes: { list: range(count).map(shape) },
  };
}

/** A tower of 60 bars and 200 cables over 400 frames. */
export function tower() {
  const levels = 20, sides = 3;
  const times = range(400).map((f) => f / 50);
  const nodesAt = (t) => range(levels + 1).flatMap((k) => range(sides * (k === 0 || k === levels ? 1 : 2)).map((i) => {
    const inner = i % 2 && k > 0 && k < levels;
    const turn = (2 * Math.PI * i) / (sides * (k === 0 || k === levels ? 1 : 2)) + 0.5 * k;
    const r = inner ? 0.42 : 0.5;
    const lean = 0.0022 * k ** 2 * Math.sin(2 * Math.PI * 0.35 * t - 0.04 * k);
    return [r * Math.cos(turn) + lean, r * Math.sin(turn) + 0.5 * lean, 0.5 * k + (inner ? 0.08 : 0)];
  }));
  const start = (k) => (k === 0 ? 0 : sides + (k - 1) * 2 * sides);
  const width = (k) => (k === 0 || k === levels ? sides : 2 * sides);
  const node = (k, i) => start(k) + (((i % width(k)) + width(k)) % width(k));
  const bars = range(levels).flatMap((k) => range(sides).map((i) => [node(k, k ? 2 * i : i), node(k + 1, k + 1 < levels ? 2 * i + 1 : i)]));
  const candidates = range(levels).flatMap((k) => range(width(k)).flatMap((i) => [[node(k, i), node(k, i + 1)], [node(k, i), node(k + 1, i)]]));
  const cables = candidates.slice(0, 200);
  const rest = cables.map(([a, b], c) => norm(sub(nodesAt(0)[a], nodesAt(0)[b])) * (0.985 + 0.001 * (c % 12)));
  const run = motion(times, nodesAt, bars, cables, 2500, rest);
  const names = cables.map((_, c) => `cable ${c + 1}`);
  return {
    ...base('Deployable tower', 'tg run, 60 bars and 200 cables, 400 frames'),
    members: bars.map(([a, b], i) => bar(`bar ${i + 1}`, norm(sub(nodesAt(0)[a], nodesAt(0)[b])), 0.02)),
    cables: names.map((name, c) => ({ name, group: c % 2 ? 'vertical' : 'ring' })),
    motion: run.data,
    plots: cablePlots(times, cables.length, run.tension, run.slack, names),
  };
}

/** Data with faults, and a word of the message each must give. */
export const malformed = [
  { name: 'cut off', text: '{"version":1,"title":', word: 'JSON' },
  { name: 'empty template', text: '__TG_VIEW_DATA__', word: 'no data' },
  { name: 'other version', text: '{"version":99}', word: 'version' },
  { name: 'short array', text: JSON.stringify({ ...prism(), motion: { ...prism().motion, tension: f32([1, 2, 3]) } }), word: 'tension' },
  { name: 'vertex out of range', text: JSON.stringify({ ...prism(), members: [{ name: 'x', kind: 'bar', vertices: [], edges: [[0, 1]], faces: [], radius: 1 }] }), word: 'edges' },
];

/** The page as the Rust side writes it. */
export function fill(template, text, title) {
  const escape = { '&': '&amp;', '<': '&lt;', '>': '&gt;' };
  return template
    .replace('__TG_TITLE__', () => title.replace(/[&<>]/g, (c) => escape[c]))
    .replace('__TG_VIEW_DATA__', () => text.replaceAll('<', '\\u003c'));
}
