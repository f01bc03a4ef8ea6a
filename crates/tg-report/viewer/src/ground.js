import { BufferAttribute, BufferGeometry, Color, LineBasicMaterial, LineSegments, Vector3 } from 'three';
import { roundDown } from './format.js';

/** A grid under (or, for a plane structure, behind) everything, which fades outwards. */
export class Ground {
  constructor(extent, space, plane) {
    const [e1, e2] = space.level;
    const normal = space.gridNormal;
    const along = (axis) => {
      let low = Infinity, high = -Infinity;
      for (let i = 0; i < extent.points.length; i += 3) {
        const d = extent.points[i] * axis.x + extent.points[i + 1] * axis.y + extent.points[i + 2] * axis.z;
        low = Math.min(low, d);
        high = Math.max(high, d);
      }
      return [low, high];
    };
    const [u0, u1] = along(e1);
    const [v0, v1] = along(e2);
    const reach = Math.max(extent.diagonal, 1e-9);
    this.spacing = roundDown(reach / 7);
    const height = plane ? -0.02 * reach : along(normal)[0] - 0.004 * reach;
    const centre = [(u0 + u1) / 2, (v0 + v1) / 2];
    const radius = Math.max(u1 - u0, v1 - v0) / 2 + reach * (plane ? 0.9 : 0.55);
    const positions = [];
    const alphas = [];
    const point = (u, v) => {
      const p = new Vector3().addScaledVector(e1, u).addScaledVector(e2, v).addScaledVector(normal, height);
      positions.push(p.x, p.y, p.z);
      const r = Math.hypot(u - centre[0], v - centre[1]) / radius;
      // Behind a plane structure it is seen from the front, all of it at once: there it must be quieter.
      alphas.push(Math.max(0, 1 - r * r) * (plane ? 0.55 : 1));
    };
    const range = (c) => [Math.floor((c - radius) / this.spacing), Math.ceil((c + radius) / this.spacing)];
    const [i0, i1] = range(centre[0]);
    const [j0, j1] = range(centre[1]);
    // Segment by segment, for the fading works by vertex.
    for (let i = i0; i <= i1; i++) {
      for (let j = j0; j <= j1; j++) {
        const [u, v] = [i * this.spacing, j * this.spacing];
        if (Math.hypot(u - centre[0], v - centre[1]) > radius + this.spacing) continue;
        point(u, v); point(u + this.spacing, v);
        point(u, v); point(u, v + this.spacing);
      }
    }
    this.alphas = alphas;
    this.geometry = new BufferGeometry();
    this.geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
    this.geometry.setAttribute('color', new BufferAttribute(new Float32Array(alphas.length * 4), 4));
    this.material = new LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false });
  }

  /** Each scene needs an object of its own; the lines are shared. */
  object() {
    const lines = new LineSegments(this.geometry, this.material);
    lines.frustumCulled = false;
    lines.renderOrder = -2;
    return lines;
  }

  paint(theme) {
    const c = new Color(theme.colour('grid'));
    const array = this.geometry.attributes.color.array;
    this.alphas.forEach((alpha, i) => array.set([c.r, c.g, c.b, alpha], 4 * i));
    this.geometry.attributes.color.needsUpdate = true;
  }
}
