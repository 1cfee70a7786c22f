// A run as the page reads it: columns of numbers, a row for each instant.

function decode(text, bytes) {
  const raw = Uint8Array.fromBase64?.(text) ?? Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return bytes === 8 ? new Float64Array(raw.buffer) : new Float32Array(raw.buffer);
}

export class Run {
  constructor(data) {
    Object.assign(this, data);
    this.columns = data.columns.map((column) => decode(column.data, data.bytes));
    this.times = this.full(this.time);
    this.start = this.times[0];
    this.end = this.times[this.rows - 1];
    this.spatial = this.dimension === 3;
    // Rows of q, v: the columns of each coordinate.
    this.q = [];
    this.v = [];
    for (const one of [...this.particles, ...this.rotors]) {
      one.position.forEach((column, k) => {
        this.q[one.coordinate + k] = column;
        this.v[one.coordinate + k] = one.velocity[k];
      });
    }
    this.byIndex = new Map(this.constraints.map((c) => [c.index, c]));
  }

  // A number at a row; a column that does not change is one number.
  at(column, row) {
    const numbers = this.columns[column];
    return numbers.length === 1 ? numbers[0] : numbers[row];
  }
  full(column) {
    const numbers = this.columns[column];
    return numbers.length === this.rows ? numbers : new Float64Array(this.rows).fill(numbers[0]);
  }
  norm(columns, row) {
    return Math.hypot(...columns.map((c) => this.at(c, row)));
  }
  // The last row that is not after t.
  rowAt(t) {
    let low = 0, high = this.rows - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= t) low = middle;
      else high = middle - 1;
    }
    return low;
  }
  // The sample nearest in time, whose numbers are shown.
  nearest(t) {
    const row = this.rowAt(t);
    if (row + 1 < this.rows && this.times[row + 1] - t < t - this.times[row]) return row + 1;
    return row;
  }
}

// An instant of the picture: exact at a row; between two of them positions follow Hermite's cubic of positions and
// velocities, all else is linear.
export class Frame {
  constructor(run) {
    this.run = run;
    this.positions = new Float64Array(run.q.length);
    this.set(run.start);
  }
  set(t, row = null) {
    const run = this.run;
    this.t = t;
    this.row = row ?? run.rowAt(t);
    const next = Math.min(this.row + 1, run.rows - 1);
    const h = run.times[next] - run.times[this.row];
    this.part = row === null && h > 0 ? (t - run.times[this.row]) / h : 0;
    this.next = this.part > 0 ? next : this.row;
    for (let k = 0; k < run.q.length; ++k) this.positions[k] = this.coordinate(k, h);
  }
  coordinate(k, h) {
    const run = this.run, s = this.part;
    const q0 = run.at(run.q[k], this.row);
    if (s === 0) return q0;
    const q1 = run.at(run.q[k], this.next), v0 = run.at(run.v[k], this.row), v1 = run.at(run.v[k], this.next);
    const s2 = s * s, s3 = s2 * s;
    return (2 * s3 - 3 * s2 + 1) * q0 + (s3 - 2 * s2 + s) * h * v0 + (3 * s2 - 2 * s3) * q1 + (s3 - s2) * h * v1;
  }
  value(column) {
    const a = this.run.at(column, this.row);
    return this.part === 0 ? a : a + this.part * (this.run.at(column, this.next) - a);
  }
  // Of a point of a picture, or a direction, in space.
  place(point, out = [0, 0, 0]) {
    const D = this.run.dimension;
    out[0] = out[1] = out[2] = 0;
    for (let row = 0; row < D; ++row) {
      if (point.at) out[row] = point.at[row];
      else if (point.path) out[row] = this.value(point.path[row]);
      else if (!point.map) out[row] = this.positions[point.coordinates[row]];
      else {
        const n = point.coordinates.length;
        for (let k = 0; k < n; ++k) out[row] += point.map[row * n + k] * this.positions[point.coordinates[k]];
      }
    }
    return out;
  }
  angle(point) {
    return this.positions[point.rotor];
  }
}
