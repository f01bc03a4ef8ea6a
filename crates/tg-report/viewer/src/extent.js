/** A growing bounding box and the points in it; what is not finite is left out, so that a failed run still opens. */
export class Extent {
  constructor() {
    this.min = [Infinity, Infinity, Infinity];
    this.max = [-Infinity, -Infinity, -Infinity];
    this.points = [];
  }

  add(coordinates) {
    for (let i = 0; i + 2 < coordinates.length; i += 3) {
      const [x, y, z] = [coordinates[i], coordinates[i + 1], coordinates[i + 2]];
      if (!Number.isFinite(x + y + z)) continue;
      this.points.push(x, y, z);
      this.min = [Math.min(this.min[0], x), Math.min(this.min[1], y), Math.min(this.min[2], z)];
      this.max = [Math.max(this.max[0], x), Math.max(this.max[1], y), Math.max(this.max[2], z)];
    }
    return this;
  }

  get empty() {
    return this.points.length === 0;
  }

  get diagonal() {
    return this.empty ? 0 : Math.hypot(...this.max.map((m, i) => m - this.min[i]));
  }

  get centre() {
    return this.max.map((m, i) => (m + this.min[i]) / 2);
  }
}
