/**
 * The members flattened: every vertex has one index in the whole structure, so that motion, modes and shapes all come
 * down to "here are the vertices now".
 */
export function assemble(members) {
  const local = [];
  const owner = [];
  const start = [];
  const edges = [];
  const faces = [];
  members.forEach((member, m) => {
    const first = owner.length;
    start.push(first);
    // A member without vertices is a point at its own origin.
    const vertices = member.vertices.length ? member.vertices : [[0, 0, 0]];
    for (const v of vertices) {
      local.push(...v);
      owner.push(m);
    }
    const own = member.kind === 'bar' && !member.edges.length && vertices.length === 2 ? [[0, 1]] : member.edges;
    for (const [a, b] of own) edges.push({ member: m, a: first + a, b: first + b });
    for (const face of member.faces) faces.push({ member: m, corners: face.map((i) => first + i) });
  });
  return { members, local: Float32Array.from(local), owner, start, edges, faces, vertexCount: owner.length };
}

/** Places all vertices by the members' poses (position, then quaternion x y z w). */
export function placeVertices(assembly, poses, out) {
  const { local, owner, vertexCount } = assembly;
  for (let v = 0; v < vertexCount; v++) {
    const p = owner[v] * 7;
    const qx = poses[p + 3], qy = poses[p + 4], qz = poses[p + 5], qw = poses[p + 6];
    const x = local[3 * v], y = local[3 * v + 1], z = local[3 * v + 2];
    const tx = 2 * (qy * z - qz * y), ty = 2 * (qz * x - qx * z), tz = 2 * (qx * y - qy * x);
    out[3 * v] = poses[p] + x + qw * tx + qy * tz - qz * ty;
    out[3 * v + 1] = poses[p + 1] + y + qw * ty + qz * tx - qx * tz;
    out[3 * v + 2] = poses[p + 2] + z + qw * tz + qx * ty - qy * tx;
  }
  return out;
}

/** Spreads a mode's displacements, which skip members without vertices, over the flattened vertices. */
export function spreadDisplacements(assembly, displacement) {
  const out = new Float32Array(assembly.vertexCount * 3);
  let from = 0;
  assembly.members.forEach((member, m) => {
    const count = member.vertices.length * 3;
    out.set(displacement.subarray(from, from + count), assembly.start[m] * 3);
    from += count;
  });
  return out;
}

/** What is drawn: places of vertices and cable ends, and the cables' state. */
export function configurationState(assembly, { poses, ends, tension, slack }) {
  return { vertices: placeVertices(assembly, poses, new Float32Array(assembly.vertexCount * 3)), ends, tension, slack };
}
