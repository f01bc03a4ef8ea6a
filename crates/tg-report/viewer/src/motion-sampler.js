import { placeVertices } from './assembly.js';

/** The last frame not later than t. */
function frameBefore(time, t) {
  let low = 0;
  let high = time.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (time[middle] <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

function lerpInto(out, data, from, to, w) {
  const n = out.length;
  for (let i = 0; i < n; i++) out[i] = data[from * n + i] * (1 - w) + data[to * n + i] * w;
}

function slerpInto(out, o, data, a, b, w) {
  let cosine = 0;
  for (let k = 0; k < 4; k++) cosine += data[a + k] * data[b + k];
  // q and -q are one rotation: take the shorter way round.
  const sign = cosine < 0 ? -1 : 1;
  const angle = Math.acos(Math.min(1, Math.abs(cosine)));
  const sine = Math.sin(angle);
  const u = sine < 1e-4 ? 1 - w : Math.sin((1 - w) * angle) / sine;
  const v = sign * (sine < 1e-4 ? w : Math.sin(w * angle) / sine);
  let norm = 0;
  for (let k = 0; k < 4; k++) {
    out[o + k] = u * data[a + k] + v * data[b + k];
    norm += out[o + k] ** 2;
  }
  norm = Math.sqrt(norm) || 1;
  for (let k = 0; k < 4; k++) out[o + k] /= norm;
}

/** Gives the state at any time, between frames too. The arrays it returns are reused. */
export function motionSampler(assembly, motion, counts) {
  const { time } = motion;
  const stride = counts.members * 7;
  const poses = new Float32Array(stride);
  const state = {
    vertices: new Float32Array(assembly.vertexCount * 3),
    ends: new Float32Array(counts.cables * 6),
    tension: new Float32Array(counts.cables),
    slack: new Uint8Array(counts.cables),
  };
  return {
    frameBefore: (t) => frameBefore(time, t),
    at(t) {
      const i = frameBefore(time, t);
      const j = Math.min(i + 1, time.length - 1);
      const gap = time[j] - time[i];
      const w = gap > 0 ? Math.min(1, Math.max(0, (t - time[i]) / gap)) : 0;
      lerpInto(poses, motion.poses, i, j, w);
      for (let p = 3; p < stride; p += 7) slerpInto(poses, p, motion.poses, i * stride + p, j * stride + p, w);
      placeVertices(assembly, poses, state.vertices);
      lerpInto(state.ends, motion.ends, i, j, w);
      lerpInto(state.tension, motion.tension, i, j, w);
      state.slack.set(motion.slack.subarray(i * counts.cables, (i + 1) * counts.cables));
      return state;
    },
  };
}
