import { BufferAttribute, BufferGeometry, Color, DoubleSide, Group, Mesh, MeshLambertMaterial, SRGBColorSpace } from 'three';
import { Balls, Tubes } from './tubes.js';
import { CableLines } from './cable-lines.js';

/** How strongly a structure is drawn: the thing itself, a lesser one beside it, or a ghost beneath it. */
export const looks = {
  solid: { opacity: 1, cableWidth: 2.4, ghost: false },
  small: { opacity: 1, cableWidth: 2, ghost: false },
  faint: { opacity: 0.5, cableWidth: 1.3, ghost: false },
  ghost: { opacity: 0.2, cableWidth: 1.2, ghost: true },
};

/** The typical length of the bars, or of any edges where there are no bars. */
function typicalLength({ members, edges, local }) {
  const length = ({ a, b }) => Math.hypot(...[0, 1, 2].map((i) => local[3 * b + i] - local[3 * a + i]));
  const bars = edges.filter((e) => members[e.member].kind === 'bar');
  const lengths = (bars.length ? bars : edges).map(length).sort((x, y) => x - y);
  return lengths.length ? lengths[lengths.length >> 1] : Infinity;
}

/**
 * Radii as drawn: the true one, but never so thin that it could be taken for a cable; in a tall mast of short bars the
 * bars still stay apart.
 */
export function drawnRadii(assembly, size) {
  const unit = Math.min(size, 8 * typicalLength(assembly));
  return assembly.members.map(({ kind, radius }) => {
    const least = unit * { bar: 0.0065, body: 0.0035, particle: 0.012 }[kind];
    return Math.max(radius, least);
  });
}

function tableInLinear(scale) {
  const out = new Float32Array(scale.rgb.length);
  const colour = new Color();
  for (let i = 0; i < out.length; i += 3) {
    colour.setRGB(scale.rgb[i], scale.rgb[i + 1], scale.rgb[i + 2], SRGBColorSpace).toArray(out, i);
  }
  return out;
}

/** Three.js objects for one structure in one configuration at a time. */
export class Structure {
  constructor(assembly, cableCount, radii, size, look) {
    this.assembly = assembly;
    this.look = look;
    this.group = new Group();
    const edges = assembly.edges.map((e) => ({ ...e, radius: radii[e.member] }));
    this.tubes = new Tubes(edges, look);
    const ends = new Set(edges.flatMap((e) => [e.a, e.b]));
    const balls = [];
    for (let v = 0; v < assembly.vertexCount; v++) {
      const m = assembly.owner[v];
      if (ends.has(v) || assembly.members[m].kind === 'particle') balls.push({ vertex: v, radius: radii[m] });
    }
    this.balls = new Balls(balls, look);
    // Many cables need thin lines to be told apart.
    const cableWidth = look.cableWidth * (cableCount > 100 ? 0.7 : 1);
    this.cables = new CableLines(cableCount, { ...look, cableWidth, dash: size * 0.014 });
    this.group.add(this.tubes.mesh, this.balls.mesh, ...this.cables.objects);
    if (assembly.faces.length) this.group.add(this.makeFaces());
    // A ghost goes first, so that what stands before it covers it.
    if (look.opacity < 1) this.group.traverse((object) => (object.renderOrder = -1));
  }

  makeFaces() {
    const geometry = new BufferGeometry();
    this.facePoints = new BufferAttribute(new Float32Array(this.assembly.vertexCount * 3), 3);
    geometry.setAttribute('position', this.facePoints);
    geometry.setIndex(this.assembly.faces.flatMap((f) => f.corners));
    this.faceMaterial = new MeshLambertMaterial({
      side: DoubleSide, flatShading: true, transparent: true, depthWrite: false, opacity: 0.3 * this.look.opacity,
    });
    const mesh = new Mesh(geometry, this.faceMaterial);
    mesh.frustumCulled = false;
    mesh.renderOrder = 1;
    return mesh;
  }

  paint(theme, scale) {
    const { assembly, look } = this;
    this.scale = scale;
    this.rgb = tableInLinear(scale);
    const of = (kind) => new Color(theme.colour(look.ghost ? 'ghost' : kind));
    const colours = { bar: of('bar'), body: of('body'), particle: of('particle') };
    this.tubes.edges.forEach((e, i) => this.tubes.mesh.setColorAt(i, colours[assembly.members[e.member].kind]));
    this.balls.balls.forEach((b, i) => this.balls.mesh.setColorAt(i, colours[assembly.members[assembly.owner[b.vertex]].kind]));
    for (const mesh of [this.tubes.mesh, this.balls.mesh]) if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    this.faceMaterial?.color.set(theme.colour(look.ghost ? 'ghost' : 'face'));
    this.cables.slackMaterial.color.set(theme.colour('slack'));
    if (look.ghost) this.cables.tautMaterial.color.set(theme.colour('ghost'));
    if (this.state) this.show(this.state);
  }

  show(state) {
    this.state = state;
    this.tubes.place(state.vertices);
    this.balls.place(state.vertices);
    this.cables.place(state, this.scale, this.look.ghost ? null : this.rgb);
    if (this.facePoints) {
      this.facePoints.array.set(state.vertices);
      this.facePoints.needsUpdate = true;
    }
  }
}
