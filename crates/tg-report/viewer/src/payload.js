import { decode } from './base64.js';

/** A fault of the data, worded for the person who opens the page. */
export class PayloadError extends Error {}

const VERSION = 1;

function need(condition, message) {
  if (!condition) throw new PayloadError(message);
}

/** Decodes one array and checks its length; a null length accepts any. */
function numbers(owner, key, kind, length, where) {
  const text = owner[key];
  need(typeof text === 'string', `${where}.${key} is missing.`);
  let out;
  try {
    out = decode(text, kind);
  } catch {
    throw new PayloadError(`${where}.${key} is not valid base64 of ${kind} numbers.`);
  }
  need(length === null || out.length === length, `${where}.${key} holds ${out.length} numbers; ${length} expected.`);
  return out;
}

function list(owner, key, where) {
  const value = owner[key];
  need(Array.isArray(value), `${where}${key} is missing or not a list.`);
  return value;
}

function member(raw, index) {
  const where = `members[${index}]`;
  need(raw && typeof raw === 'object', `${where} is not an object.`);
  need(['bar', 'body', 'particle'].includes(raw.kind), `${where}.kind is neither bar, body nor particle.`);
  const vertices = list(raw, 'vertices', `${where}.`);
  need(vertices.every((v) => Array.isArray(v) && v.length === 3), `${where}.vertices are not points of three numbers.`);
  const within = (width) => (t) =>
    Array.isArray(t) && t.length === width && t.every((i) => Number.isInteger(i) && i >= 0 && i < vertices.length);
  const edges = raw.edges ?? [];
  const faces = raw.faces ?? [];
  need(Array.isArray(edges) && edges.every(within(2)), `${where}.edges name a vertex that does not exist.`);
  need(Array.isArray(faces) && faces.every(within(3)), `${where}.faces name a vertex that does not exist.`);
  return { name: String(raw.name ?? `member ${index + 1}`), kind: raw.kind, vertices, edges, faces, radius: Number(raw.radius) || 0 };
}

/** One configuration: where the members and the cable ends are, and what the cables carry. */
function configuration(raw, counts, where) {
  need(raw && typeof raw === 'object', `${where} is missing.`);
  return {
    poses: numbers(raw, 'poses', 'f32', counts.members * 7, where),
    ends: numbers(raw, 'ends', 'f32', counts.cables * 6, where),
    tension: numbers(raw, 'tension', 'f32', counts.cables, where),
    slack: numbers(raw, 'slack', 'u8', counts.cables, where),
  };
}

function motion(raw, { members, cables }) {
  if (!raw) return null;
  const time = numbers(raw, 'time', 'f64', null, 'motion');
  need(time.length > 0, 'motion has no frames.');
  for (let i = 0; i < time.length; i++) {
    need(Number.isFinite(time[i]) && (i === 0 || time[i] >= time[i - 1]), 'motion.time does not increase.');
  }
  const frames = time.length;
  return {
    time,
    poses: numbers(raw, 'poses', 'f32', frames * members * 7, 'motion'),
    ends: numbers(raw, 'ends', 'f32', frames * cables * 6, 'motion'),
    tension: numbers(raw, 'tension', 'f32', frames * cables, 'motion'),
    slack: numbers(raw, 'slack', 'u8', frames * cables, 'motion'),
  };
}

function modes(raw, counts) {
  if (!raw) return null;
  const entries = list(raw, 'list', 'modes.').map((mode, i) => ({
    label: String(mode.label ?? `mode ${i + 1}`),
    frequency: mode.frequency ?? null,
    damping: mode.damping ?? null,
    vertices: numbers(mode, 'vertices', 'f32', counts.vertices * 3, `modes.list[${i}]`),
    ends: numbers(mode, 'ends', 'f32', counts.cables * 6, `modes.list[${i}]`),
  }));
  return entries.length ? { reference: configuration(raw.reference, counts, 'modes.reference'), list: entries } : null;
}

function shapes(raw, counts) {
  if (!raw) return null;
  const entries = list(raw, 'list', 'shapes.').map((shape, i) => ({
    label: String(shape.label ?? i + 1),
    stable: shape.stable ?? null,
    energy: shape.energy ?? null,
    ...configuration(shape, counts, `shapes.list[${i}]`),
  }));
  return entries.length ? { list: entries } : null;
}

function plot(raw, index) {
  const where = `plots[${index}]`;
  need(raw && typeof raw === 'object' && raw.x && raw.y, `${where} lacks an axis.`);
  need(['lines', 'points', 'strips'].includes(raw.kind), `${where}.kind is neither lines, points nor strips.`);
  const x = numbers(raw.x, 'values', 'f64', null, `${where}.x`);
  return {
    title: String(raw.title ?? ''),
    kind: raw.kind,
    x: { label: String(raw.x.label ?? ''), unit: String(raw.x.unit ?? ''), time: Boolean(raw.x.time), values: x },
    y: { label: String(raw.y.label ?? ''), unit: String(raw.y.unit ?? '') },
    series: list(raw, 'series', `${where}.`).map((s, i) => ({
      name: String(s.name ?? `series ${i + 1}`),
      values: numbers(s, 'values', 'f64', x.length, `${where}.series[${i}]`),
    })),
  };
}

/** Reads the text of the data element into typed arrays, or throws a PayloadError that names the part. */
export function readPayload(text) {
  need(text && text.trim() && !text.startsWith('__TG_'), 'The page holds no data: it is the empty template.');
  let raw;
  try {
    raw = JSON.parse(text);
  } catch (error) {
    throw new PayloadError(`The data is not valid JSON: ${error.message}`);
  }
  need(raw && typeof raw === 'object', 'The data is not an object.');
  need(raw.version === VERSION, `The data has version ${raw.version}; this page reads version ${VERSION}.`);
  const members = list(raw, 'members', '').map(member);
  const cables = list(raw, 'cables', '').map((c, i) => ({ name: String(c?.name ?? `cable ${i + 1}`), group: c?.group ?? null }));
  const counts = {
    members: members.length,
    cables: cables.length,
    vertices: members.reduce((sum, m) => sum + m.vertices.length, 0),
  };
  const up = Array.isArray(raw.up) && raw.up.length === 3 && Math.hypot(...raw.up) > 0 ? raw.up : [0, 0, 1];
  return {
    title: String(raw.title ?? ''),
    subtitle: String(raw.subtitle ?? ''),
    plane: raw.dimension === 2,
    up,
    members,
    cables,
    motion: motion(raw.motion, counts),
    modes: modes(raw.modes, counts),
    shapes: shapes(raw.shapes, counts),
    plots: (raw.plots ?? []).map(plot),
  };
}
