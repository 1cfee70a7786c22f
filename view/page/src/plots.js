// Plots of quantities over time, with their errors, events, and a line at the present.
import uPlot from "uplot";

import { number, roundDown, short } from "./numbers.js";

const axesNames = ["x", "y", "z"];

// All that can be plotted: label, group, its number at a row, error column if there is one.
export function quantities(run) {
  const all = [], { units } = run;
  const per = (power) => (units.length && units.time ? `${units.length}/${units.time}${power}` : "");
  const moment = units.force && units.length ? `${units.force} ${units.length}` : "";
  const add = (group, label, unit, read, error, more = {}) =>
    all.push({ id: all.length, group, label, unit, read, error, ...more });
  const one = (column) => (row) => run.at(column, row);
  const size = (columns) => (columns.length === 1 ? one(columns[0]) : (row) => run.norm(columns, row));
  for (const c of run.constraints) {
    c.lambda.forEach((column, k) => {
      const which = c.lambda.length > 1 ? ` ${k + 1}` : "";
      add("Multipliers", `${c.name}: \u03bb${which}`, units.force, one(column), c.error, { constraint: c });
    });
  }
  for (const c of run.constraints) {
    for (const arrow of c.arrows) {
      const on = c.arrows.filter((a) => !a.torque).length > 1 ? ` (point ${arrow.point + 1})` : "";
      const what = arrow.torque ? "torque" : "force", unit = arrow.torque ? moment : units.force;
      const more = { constraint: c }, { force, error } = arrow;
      add("Forces of constraint", `${c.name}: ${force.length > 1 ? `|${what}|` : what}${on}`, unit, size(force), error, more);
      if (force.length === 1) continue;
      force.forEach((column, k) => add("Forces of constraint", `${c.name}: ${what} ${axesNames[k]}${on}`, unit, one(column), error, more));
    }
  }
  for (const body of run.bodies) addBody(run, body, (label, unit, read) => add("Bodies", `${body.name}: ${label}`, unit, read));
  const inBody = new Set(run.bodies.flatMap((body) => body.particles));
  const free = run.particles.filter((_, k) => !inBody.has(k));
  for (const p of free) {
    p.position.forEach((column, k) => add("Positions", `${p.name}: ${axesNames[k]}`, units.length, one(column), p.positionError));
  }
  for (const p of free) {
    add("Velocities", `${p.name}: speed`, per(""), size(p.velocity), p.velocityError);
    p.velocity.forEach((column, k) => add("Velocities", `${p.name}: v${axesNames[k]}`, per(""), one(column), p.velocityError));
  }
  for (const p of free) {
    p.acceleration.forEach((column, k) => add("Accelerations", `${p.name}: a${axesNames[k]}`, per("\u00b2"), one(column)));
  }
  for (const r of run.rotors) {
    add("Rotors", `${r.name}: angle`, "rad", one(r.position[0]), r.positionError);
    add("Rotors", `${r.name}: rate`, units.time ? "rad/" + units.time : "", one(r.velocity[0]), r.velocityError);
  }
  add("Energy", "energy", moment, one(run.energy), run.energyError);
  for (const account of run.ledger) add("Ledger", account.name, "", one(account.column), undefined, { gaps: true });
  return all;
}
// Its centre, and in the plane how far it has turned.
function addBody(run, body, add) {
  const { coordinates, map } = body.places[0], n = coordinates.length;
  for (let k = 0; k < run.dimension; ++k) {
    const parts = coordinates.map((c, i) => [run.q[c], map[k * n + i]]).filter(([, weight]) => weight !== 0);
    add(axesNames[k], run.units.length, (row) => parts.reduce((sum, [column, weight]) => sum + weight * run.at(column, row), 0));
  }
  if (run.dimension !== 2) return;
  const [a, b] = [body.particles[0], body.particles[1]].map((k) => run.particles[k].position);
  const turn = (row) => Math.atan2(run.at(b[1], row) - run.at(a[1], row), run.at(b[0], row) - run.at(a[0], row));
  let turned = null; // without jumps of a full turn; worked out if it is asked for
  add("angle", "rad", (row) => {
    if (!turned) {
      turned = new Float64Array(run.rows);
      for (let i = 0, before = 0; i < run.rows; ++i) {
        const now = turn(i);
        turned[i] = before = now - 2 * Math.PI * Math.round((now - before) / (2 * Math.PI));
      }
    }
    return turned[row];
  });
}

export class Plot {
  constructor(page, host, quantity) {
    this.page = page;
    this.run = page.run;
    this.host = host;
    this.now = document.createElement("div");
    this.now.className = "now";
    this.note = document.createElement("p");
    this.note.className = "note";
    this.set(quantity);
    host.after(this.note);
    new ResizeObserver(() => this.resize()).observe(host);
  }
  set(quantity) {
    this.quantity = quantity;
    const { run } = this;
    const values = new Float64Array(run.rows);
    for (let i = 0; i < run.rows; ++i) values[i] = quantity.read(i);
    this.values = values;
    this.findRange();
    this.findBand();
    this.make();
  }
  findRange() {
    let low = Infinity, high = -Infinity;
    for (const x of this.values) {
      if (x < low) low = x;
      if (x > high) high = x;
    }
    if (!(high >= low)) [low, high] = [-1, 1];
    const size = Math.max(Math.abs(low), Math.abs(high)), span = high - low;
    // What differs in its last digits only is shown as constant.
    const pad = span > 1e-6 * size ? 0.06 * span : size > 0 ? 0.1 * size : 1;
    this.range = [low - pad, high + pad];
  }
  // An error that could not be seen is drawn enlarged, by a round number that the note says.
  findBand() {
    const { run, quantity } = this;
    this.magnified = 1;
    this.errors = null;
    if (quantity.error === undefined) return;
    const errors = run.full(quantity.error);
    let largest = 0;
    for (const e of errors) if (Number.isFinite(e) && e > largest) largest = e;
    this.errors = errors;
    const visible = 0.12 * (this.range[1] - this.range[0]);
    if (largest > 0 && largest < 0.02 * (this.range[1] - this.range[0])) {
      this.magnified = roundDown(visible / largest);
    }
    this.largest = largest;
  }
  make() {
    this.plot?.destroy();
    const { run, page, quantity } = this, theme = page.palette;
    const plain = (array) => (this.hasGaps(array) ? Array.from(array, (x) => (Number.isFinite(x) ? x : null)) : array);
    const data = [run.times, plain(this.values)];
    const colour = quantity.constraint ? theme.colours[quantity.constraint.colour % theme.colours.length] : theme.ink;
    const series = [{}, { label: quantity.label, stroke: colour, width: 1.8, points: { show: run.rows < 60, size: 4 },
                          spanGaps: Boolean(quantity.gaps) }];
    const bands = [];
    if (this.errors) {
      const edge = (sign) => Array.from(this.values, (x, i) => {
        const y = x + sign * this.magnified * this.errors[i];
        return Number.isFinite(y) ? y : null;
      });
      data.push(edge(1), edge(-1));
      series.push({ stroke: "transparent", points: { show: false } }, { stroke: "transparent", points: { show: false } });
      bands.push({ series: [2, 3], fill: colour + (page.theme === "dark" ? "66" : "38") });
    }
    const grid = { stroke: theme.grid, width: 0.5 }, axis = { stroke: theme.ink, grid, ticks: grid, font: "11px system-ui, sans-serif" };
    const u = new uPlot({
      width: Math.max(160, this.host.clientWidth), height: this.height(),
      legend: { show: false },
      cursor: { drag: { x: false, y: false }, x: false, y: false, points: { show: false } },
      scales: { x: { time: false, range: () => page.span }, y: { range: () => this.range } },
      axes: [{ ...axis, size: 26 }, { ...axis, size: 58, values: (_, ticks) => ticks.map(short) }],
      series, bands,
      hooks: { draw: [(plot) => this.drawEvents(plot)] },
    }, data, this.host);
    u.over.append(this.now);
    this.listen(u.over);
    this.plot = u;
    this.writeNote();
    this.move();
  }
  hasGaps(array) {
    for (const x of array) if (!Number.isFinite(x)) return true;
    return false;
  }
  height() {
    return Math.round(Math.min(210, Math.max(120, window.innerHeight * 0.22)));
  }
  resize() {
    const width = this.host.clientWidth;
    if (width > 0 && this.plot && Math.abs(width - this.plot.width) > 1) this.plot.setSize({ width, height: this.height() });
    this.move();
  }
  drawEvents(u) {
    const { ctx } = u, { top, height, left, width } = u.bbox, theme = this.page.palette;
    ctx.save();
    ctx.strokeStyle = theme.mark;
    ctx.globalAlpha = this.run.events.length > 60 ? 0.25 : 0.7;
    ctx.setLineDash([4, 4]);
    for (const event of this.run.events) {
      const x = u.valToPos(event.time, "x", true);
      if (x < left || x > left + width) continue;
      ctx.beginPath();
      ctx.moveTo(x, top);
      ctx.lineTo(x, top + height);
      ctx.stroke();
    }
    ctx.restore();
  }
  writeNote() {
    const { errors, magnified } = this;
    let text = "";
    if (errors) {
      const unknown = errors.some((e) => !Number.isFinite(e));
      if (this.largest > 0) {
        text = `Band: error${magnified > 1 ? ", drawn " + short(magnified) + " times enlarged" : ""}; largest ${number(this.largest, 2)}${this.quantity.unit ? " " + this.quantity.unit : ""}.`;
      }
      if (unknown) text += " Without band the error is not known.";
    }
    if (this.values.some(Number.isNaN) && !this.quantity.gaps) text += " Gaps: not determined by the motion.";
    this.note.textContent = text;
    this.note.hidden = text === "";
  }
  move() {
    if (!this.plot) return;
    const x = this.plot.valToPos(this.page.player.t, "x");
    this.now.style.transform = `translateX(${x}px)`;
    this.now.hidden = !(x >= 0 && x <= this.plot.over.clientWidth);
  }
  listen(over) {
    const seek = (event) => {
      const box = over.getBoundingClientRect();
      this.page.player.pause();
      this.page.player.seek(this.plot.posToVal(event.clientX - box.left, "x"));
    };
    over.addEventListener("pointerdown", (event) => {
      over.setPointerCapture(event.pointerId);
      seek(event);
    });
    over.addEventListener("pointermove", (event) => event.buttons === 1 && seek(event));
    over.addEventListener("wheel", (event) => {
      event.preventDefault();
      const box = over.getBoundingClientRect();
      this.page.zoomTime(this.plot.posToVal(event.clientX - box.left, "x"), event.deltaY > 0 ? 1.25 : 0.8);
    }, { passive: false });
    over.addEventListener("dblclick", () => this.page.zoomTime(null));
  }
}
