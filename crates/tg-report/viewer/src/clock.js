/** The time shown: runs at a speed, loops or stops at the end, and tells its listeners. */
export class Clock {
  constructor(time) {
    this.frames = time;
    this.start = time[0];
    this.end = time[time.length - 1];
    this.time = this.start;
    this.speed = 1;
    this.loop = true;
    this.playing = false;
    this.listeners = [];
  }

  listen(listener) {
    this.listeners.push(listener);
    listener(this);
  }

  changed() {
    for (const listener of this.listeners) listener(this);
  }

  seek(time) {
    this.time = Math.min(this.end, Math.max(this.start, time));
    this.changed();
  }

  /** Moves by whole frames, so that the arrow keys land on computed states. */
  step(count) {
    this.playing = false;
    const direction = Math.sign(count);
    for (let left = Math.abs(count); left > 0; left--) {
      // Frames at one instant, as an impact makes, count as one.
      const beyond = (t) => direction * (t - this.time) > 1e-12;
      const next = direction > 0 ? this.frames.find(beyond) : this.frames.findLast(beyond);
      if (next === undefined) break;
      this.time = next;
    }
    this.changed();
  }

  toggle(playing = !this.playing) {
    this.playing = playing && this.end > this.start;
    if (this.playing && this.time >= this.end) this.time = this.start;
    this.changed();
  }

  tick(seconds) {
    if (!this.playing) return;
    let next = this.time + seconds * this.speed;
    if (next >= this.end) {
      if (this.loop) next = this.start + ((next - this.start) % (this.end - this.start));
      else {
        next = this.end;
        this.playing = false;
      }
    }
    this.seek(next);
  }
}
