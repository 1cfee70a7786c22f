// Time: where the page stands in it, and how it goes on.

export class Player {
  constructor(run) {
    this.run = run;
    this.t = run.start;
    this.row = 0; // set where the page stands exactly at a row
    this.playing = false;
    this.listeners = [];
    const lasts = run.end - run.start;
    // At its own pace if that can be watched, otherwise so that it lasts 15 seconds.
    this.speed = lasts >= 4 && lasts <= 60 ? 1 : lasts / 15 || 1;
    this.last = null;
    this.repeats = false;
    this.rest = 0; // how long it has stood at the end [s]
  }
  onChange(f) {
    this.listeners.push(f);
  }
  tell() {
    for (const f of this.listeners) f();
  }
  seek(t) {
    this.t = Math.min(this.run.end, Math.max(this.run.start, t));
    this.row = null;
    this.tell();
  }
  seekRow(row) {
    this.row = Math.min(this.run.rows - 1, Math.max(0, row));
    this.t = this.run.times[this.row];
    this.tell();
  }
  stepSample(by) {
    this.pause();
    const row = this.row ?? this.run.rowAt(this.t);
    this.seekRow(this.row === null && by < 0 && this.run.times[row] < this.t ? row + by + 1 : row + by);
  }
  stepEvent(by) {
    this.pause();
    const events = this.run.events.filter((e) => e.row !== undefined);
    const here = this.row ?? this.run.rowAt(this.t);
    const next = by > 0 ? events.find((e) => e.row > here || e.time > this.t)
                        : events.findLast((e) => e.row < here || e.time < this.t);
    if (next) this.seekRow(next.row);
    else this.seekRow(by > 0 ? this.run.rows - 1 : 0);
    return next;
  }
  play() {
    if (this.run.end === this.run.start) return;
    if (this.t >= this.run.end) this.seek(this.run.start);
    this.playing = true;
    this.last = null;
    this.tell();
  }
  pause() {
    this.playing = false;
    this.tell();
  }
  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }
  faster(factor) {
    this.speed *= factor;
    this.tell();
  }
  // A frame of the screen.
  advance(now) {
    if (!this.playing) return;
    const passed = this.last === null ? 0 : Math.min(0.25, (now - this.last) / 1000);
    this.last = now;
    if (this.t < this.run.end) {
      this.rest = 0;
      this.seek(this.t + passed * this.speed);
    } else if (this.repeats) {
      this.rest += passed;
      if (this.rest > 1) this.seek(this.run.start); // the end can be seen
      return;
    }
    if (this.t >= this.run.end && !this.repeats) this.pause();
  }
}
