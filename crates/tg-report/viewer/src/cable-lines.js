import { InstancedInterleavedBuffer, InterleavedBufferAttribute } from 'three';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';

/** Line segments of a width in pixels whose number may change up to a capacity. */
export class Segments {
  constructor(capacity, material) {
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(new Float32Array(Math.max(1, capacity) * 6));
    geometry.setColors(new Float32Array(Math.max(1, capacity) * 6));
    const along = new InstancedInterleavedBuffer(new Float32Array(Math.max(1, capacity) * 2), 2, 1);
    geometry.setAttribute('instanceDistanceStart', new InterleavedBufferAttribute(along, 1, 0));
    geometry.setAttribute('instanceDistanceEnd', new InterleavedBufferAttribute(along, 1, 1));
    this.positions = geometry.attributes.instanceStart.data;
    this.colours = geometry.attributes.instanceColorStart.data;
    this.along = along;
    this.object = new LineSegments2(geometry, material);
    this.object.frustumCulled = false;
    this.count = 0;
  }

  clear() {
    this.count = 0;
  }

  /** Adds the segment that starts at `from` in `points`, six numbers long. */
  add(points, from, rgb, k) {
    const n = this.count++;
    const p = this.positions.array;
    for (let i = 0; i < 6; i++) p[6 * n + i] = points[from + i];
    if (rgb) for (let i = 0; i < 6; i++) this.colours.array[6 * n + i] = rgb[k + (i % 3)];
    this.along.array[2 * n + 1] = Math.hypot(p[6 * n + 3] - p[6 * n], p[6 * n + 4] - p[6 * n + 1], p[6 * n + 5] - p[6 * n + 2]);
  }

  finish() {
    this.object.geometry.instanceCount = this.count;
    this.object.visible = this.count > 0;
    this.positions.needsUpdate = true;
    this.colours.needsUpdate = true;
    this.along.needsUpdate = true;
  }
}

/** The cables: taut ones in the colour of their tension, slack ones dashed. */
export class CableLines {
  constructor(count, look) {
    this.count = count;
    const shared = { transparent: look.opacity < 1, opacity: look.opacity, depthWrite: look.opacity === 1 };
    this.tautMaterial = new LineMaterial({ ...shared, linewidth: look.cableWidth, vertexColors: !look.ghost });
    this.slackMaterial = new LineMaterial({ ...shared, linewidth: Math.max(1.2, look.cableWidth * 0.7), dashed: true, dashSize: look.dash, gapSize: look.dash * 0.8 });
    this.taut = new Segments(count, this.tautMaterial);
    this.slack = new Segments(count, this.slackMaterial);
    this.objects = [this.taut.object, this.slack.object];
  }

  place({ ends, tension, slack }, scale, rgb) {
    this.taut.clear();
    this.slack.clear();
    for (let c = 0; c < this.count; c++) {
      if (slack[c]) this.slack.add(ends, 6 * c);
      else this.taut.add(ends, 6 * c, rgb, 3 * scale.index(tension[c]));
    }
    this.taut.finish();
    this.slack.finish();
  }
}
