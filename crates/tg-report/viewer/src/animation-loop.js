/** One animation-frame loop for the page, which sleeps when nothing moves. */
export class AnimationLoop {
  constructor() {
    this.steps = [];
    this.pending = false;
    this.last = null;
  }

  /** A step gets the seconds since the last frame and returns true while it wants more. */
  add(step) {
    this.steps.push(step);
  }

  request() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame((now) => this.frame(now));
  }

  frame(now) {
    this.pending = false;
    // A page that comes back from the background must not jump.
    const seconds = this.last === null ? 0 : Math.min(0.25, (now - this.last) / 1000);
    let more = false;
    for (const step of this.steps) more = step(seconds) || more;
    this.last = more ? now : null;
    if (more) this.request();
  }
}
