import { CylinderGeometry, InstancedMesh, MeshLambertMaterial, SphereGeometry, DynamicDrawUsage } from 'three';

function instances(geometry, count, look) {
  const material = new MeshLambertMaterial({ transparent: look.opacity < 1, opacity: look.opacity, depthWrite: look.opacity === 1 });
  const mesh = new InstancedMesh(geometry, material, count);
  mesh.instanceMatrix.setUsage(DynamicDrawUsage);
  mesh.frustumCulled = false;
  return mesh;
}

/** Straight tubes between pairs of vertices. */
export class Tubes {
  /** @param {{a:number,b:number,radius:number}[]} edges */
  constructor(edges, look) {
    this.edges = edges;
    this.mesh = instances(new CylinderGeometry(1, 1, 1, 16, 1), edges.length, look);
  }

  place(vertices) {
    const out = this.mesh.instanceMatrix.array;
    this.edges.forEach(({ a, b, radius }, i) => {
      const ax = vertices[3 * a], ay = vertices[3 * a + 1], az = vertices[3 * a + 2];
      const dx = vertices[3 * b] - ax, dy = vertices[3 * b + 1] - ay, dz = vertices[3 * b + 2] - az;
      const length = Math.hypot(dx, dy, dz) || 1e-12;
      // Any unit vector across the tube: take the axis it leans on least.
      const ux = dx / length, uy = dy / length, uz = dz / length;
      let px, py, pz;
      if (Math.abs(ux) <= Math.abs(uy) && Math.abs(ux) <= Math.abs(uz)) [px, py, pz] = [0, uz, -uy];
      else if (Math.abs(uy) <= Math.abs(uz)) [px, py, pz] = [-uz, 0, ux];
      else [px, py, pz] = [uy, -ux, 0];
      const scale = radius / (Math.hypot(px, py, pz) || 1);
      px *= scale; py *= scale; pz *= scale;
      const qx = py * uz - pz * uy, qy = pz * ux - px * uz, qz = px * uy - py * ux;
      out.set([px, py, pz, 0, dx, dy, dz, 0, qx, qy, qz, 0, ax + dx / 2, ay + dy / 2, az + dz / 2, 1], i * 16);
    });
    this.mesh.instanceMatrix.needsUpdate = true;
  }
}

/** Balls at vertices: particles, and the rounded ends of tubes. */
export class Balls {
  /** @param {{vertex:number,radius:number}[]} balls */
  constructor(balls, look) {
    this.balls = balls;
    this.mesh = instances(new SphereGeometry(1, 20, 14), balls.length, look);
  }

  place(vertices) {
    const out = this.mesh.instanceMatrix.array;
    this.balls.forEach(({ vertex: v, radius: r }, i) => {
      out.set([r, 0, 0, 0, 0, r, 0, 0, 0, 0, r, 0, vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2], 1], i * 16);
    });
    this.mesh.instanceMatrix.needsUpdate = true;
  }
}
