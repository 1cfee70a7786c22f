// The page of a run.
import { number, roundDown, short, withError } from "./numbers.js";
import { auditTable, element, eventsTable, Forces, ledgerTable, most, reading, runTable } from "./panel.js";
import { Player } from "./player.js";
import { Plot, quantities } from "./plots.js";
import { Run } from "./run.js";
import { palettes, Stage } from "./stage.js";

const $ = (id) => document.getElementById(id);

class Page {
  constructor(run) {
    this.run = run;
    this.player = new Player(run);
    this.span = [run.start, run.end > run.start ? run.end : run.start + 1];
    this.selected = null;
    this.labelsOn = null;
    this.stage = new Stage(run, $("stage"));
    this.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
    this.palette = palettes[this.theme];
    this.heading();
    this.panels();
    this.plots();
    this.labels();
    this.buttons();
    this.keys();
    this.pointer();
    this.setTheme(this.theme);
    this.layout();
    new ResizeObserver(() => this.layout()).observe($("view"));
    this.stage.onView = () => (this.dirty = true);
    this.player.onChange(() => (this.dirty = true));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (e) => this.setTheme(e.matches ? "dark" : "light"));
    this.frames = [];
    this.update();
    const loop = (now) => {
      this.player.advance(now);
      this.stage.controls.update();
      if (this.dirty || this.player.playing) this.update(now);
      requestAnimationFrame(loop);
    };
    requestAnimationFrame(loop);
    // Who opens it wants to see it move; a system that asks for less motion gets a still picture.
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) this.player.play();
  }

  heading() {
    const { run } = this;
    document.title = run.title;
    $("title").textContent = run.title;
    const said = [`${run.samples.toLocaleString("en")} samples`, `stepper ${run.stepper}`, `tolerance ${number(run.tolerance, 2)}`];
    if (run.every > 1) said.push(`every ${run.every}th sample is on this page`);
    if (run.digits < 16) said.push(`numbers with ${run.digits} digits`);
    $("about").textContent = said.join(" \u00b7 ");
  }

  panels() {
    const { run } = this;
    this.forces = new Forces(this, $("forces"));
    eventsTable(this, $("events"));
    runTable(this, $("run-table"));
    if (run.ledger.length > 0) ledgerTable(this, $("ledger"));
    if (run.audit.length > 0) auditTable(this, $("audit"));
    const tabs = [...document.querySelectorAll("[role=tab]")];
    const show = (tab) => {
      for (const other of tabs) {
        const on = other === tab;
        other.setAttribute("aria-selected", String(on));
        other.tabIndex = on ? 0 : -1;
        $(other.getAttribute("aria-controls")).hidden = !on;
      }
    };
    $("tab-ledger").hidden = run.ledger.length === 0;
    $("tab-audit").hidden = run.audit.length === 0;
    $("tab-events").textContent = `Events (${run.events.length})`;
    if (run.audit.length > 0) {
      const broken = run.audit.some((f) => f.size > f.limit);
      $("tab-audit").textContent = broken ? "Audit \u2717" : "Audit \u2713";
    }
    for (const tab of tabs) {
      tab.addEventListener("click", () => show(tab));
      tab.addEventListener("keydown", (event) => {
        if (event.key !== "ArrowRight" && event.key !== "ArrowLeft") return;
        event.stopPropagation();
        const open = tabs.filter((t) => !t.hidden), at = open.indexOf(tab);
        const next = open[(at + (event.key === "ArrowRight" ? 1 : open.length - 1)) % open.length];
        show(next);
        next.focus();
      });
    }
    show(tabs[0]);
  }

  plots() {
    const all = quantities(this.run);
    this.quantities = all;
    // At first the largest force, and the energy; without forces how the first particle moves.
    const rows = [0, 0.2, 0.4, 0.6, 0.8, 1].map((s) => Math.round(s * (this.run.rows - 1)));
    const sizeOf = (q) => Math.max(...rows.map((row) => Math.abs(q.read(row))).filter(Number.isFinite), 0);
    const forces = all.filter((q) => q.group === "Multipliers").slice(0, 60);
    const largest = forces.reduce((best, q) => (best === null || sizeOf(q) > sizeOf(best) * (1 + 1e-9) ? q : best), null);
    // What moves most: a place of a particle, else of a body or a rotor.
    const some = Array.from({ length: 40 }, (_, k) => Math.round((k / 39) * (this.run.rows - 1)));
    const rangeOf = (q) => {
      const values = some.map(q.read);
      return Math.max(...values) - Math.min(...values);
    };
    const inGroup = (group) => all.filter((q) => q.group === group && q.unit !== "rad").slice(0, 60);
    const angle = all.find((q) => q.group === "Bodies" && q.unit === "rad");
    const position = [...inGroup("Positions"), ...(angle ? [angle] : inGroup("Bodies"))]
      .reduce((best, q) => (best === null || rangeOf(q) > rangeOf(best) * (1 + 1e-6) ? q : best), null) ??
      all.find((q) => q.group === "Rotors");
    this.shown = [];
    for (const q of [largest, position, largest ? null : all.find((x) => x.group === "Energy")]) if (q) this.addPlot(q);
    $("add-plot").addEventListener("click", () => this.addPlot(all.find((q) => q.group === "Energy")));
  }
  addPlot(quantity) {
    const select = element("select", { "aria-label": "quantity of this plot" });
    const groups = new Map();
    for (const q of this.quantities) {
      if (!groups.has(q.group)) {
        groups.set(q.group, element("optgroup", { label: q.group }));
        select.append(groups.get(q.group));
      }
      groups.get(q.group).append(element("option", { value: q.id, text: q.label + (q.unit ? ` [${q.unit}]` : "") }));
    }
    select.value = quantity.id;
    const value = element("output", { class: "value" });
    const host = element("div", { class: "plot", role: "img", "aria-label": "plot over time" });
    const close = element("button", { class: "close", text: "\u00d7", title: "remove this plot", "aria-label": "remove this plot" });
    const box = element("section", { class: "plot-box" }, element("div", { class: "plot-head" }, select, value, close), host);
    $("plots").insertBefore(box, $("add-plot"));
    const plot = new Plot(this, host, quantity);
    plot.value = value;
    select.addEventListener("change", () => {
      plot.set(this.quantities[Number(select.value)]);
      this.dirty = true;
    });
    close.addEventListener("click", () => {
      box.remove();
      this.shown = this.shown.filter((p) => p !== plot);
    });
    this.shown.push(plot);
    this.dirty = true;
  }
  zoomTime(t, factor) {
    const { start, end } = this.run;
    if (t === null) this.span = [start, end > start ? end : start + 1];
    else {
      const [a, b] = this.span;
      this.span = [Math.max(start, t - (t - a) * factor), Math.min(end, t + (b - t) * factor)];
    }
    for (const { plot } of this.shown) plot.redraw(false, true), plot.setScale("x", { min: this.span[0], max: this.span[1] });
    this.dirty = true;
  }

  labels() {
    const { run } = this, inBody = new Set(run.bodies.flatMap((b) => b.particles));
    const points = run.bodies.map((b) => ({ name: b.name, point: b.places[0] }));
    run.particles.forEach((p, k) => {
      if (!inBody.has(k)) points.push({ name: p.name, point: { coordinates: p.position.map((_, i) => p.coordinate + i) } });
    });
    this.labelled = points.slice(0, 40).map(({ name, point }) => {
      const label = element("span", { class: "label", text: name });
      $("labels").append(label);
      return { point, label };
    });
    this.unknown = this.stage.arrows.all.map((one) => {
      const label = element("span", { class: "label unknown", text: "?", title: `${one.constraint.name}: not determined by the motion`, hidden: true });
      $("labels").append(label);
      return { one, label };
    });
    this.setLabels(points.length <= 6 && points.every(({ name }) => !/^(particle|rotor)\d+$/.test(name)));
  }
  setLabels(on) {
    this.labelsOn = on;
    $("labels-button").setAttribute("aria-pressed", String(on));
    this.dirty = true;
  }

  buttons() {
    const { player, stage } = this;
    const on = (id, f) => $(id).addEventListener("click", f);
    on("play", () => player.toggle());
    on("first", () => this.go(() => player.seekRow(0)));
    on("previous-event", () => this.stepEvent(-1));
    on("next-event", () => this.stepEvent(1));
    on("slower", () => player.faster(0.5));
    on("faster", () => player.faster(2));
    on("trails-button", () => this.setTrails(!stage.trailsOn));
    on("labels-button", () => this.setLabels(!this.labelsOn));
    on("arrows-button", () => this.setArrows(!stage.arrows.visible));
    on("fit", () => this.fit());
    on("theme", () => this.setTheme(this.theme === "dark" ? "light" : "dark"));
    on("help-button", () => $("help").showModal());
    on("close-help", () => $("help").close());
    on("longer", () => this.scaleArrows(1.25));
    on("shorter", () => this.scaleArrows(0.8));
    $("previous-event").hidden = $("next-event").hidden = this.run.events.length === 0;
    const slider = $("time");
    slider.addEventListener("input", () => {
      player.pause();
      player.seek(this.run.start + (slider.value / 10000) * (this.run.end - this.run.start));
    });
    for (const event of this.run.events.slice(0, 400)) {
      const mark = element("i");
      mark.style.left = `${(100 * (event.time - this.run.start)) / (this.run.end - this.run.start || 1)}%`;
      $("marks").append(mark);
    }
    on("repeat", () => this.setRepeat(!player.repeats));
    this.setRepeat(true);
    this.setTrails(stage.trailsOn);
    this.setArrows(true);
  }
  go(f) {
    this.player.pause();
    f();
  }
  stepEvent(by) {
    const event = this.player.stepEvent(by);
    $("live").textContent = event ? `${event.name} ${event.what}, t = ${number(event.time, 6)}` : "no event further on";
  }
  setRepeat(on) {
    this.player.repeats = on;
    $("repeat").setAttribute("aria-pressed", String(on));
  }
  setTrails(on) {
    this.stage.trailsOn = on;
    $("trails-button").setAttribute("aria-pressed", String(on));
    this.dirty = true;
  }
  setArrows(on) {
    this.stage.arrows.visible = on;
    $("arrows-button").setAttribute("aria-pressed", String(on));
    this.dirty = true;
  }
  scaleArrows(factor) {
    this.stage.arrows.forceScale *= factor;
    this.stage.arrows.torqueScale *= factor;
    this.dirty = true;
  }
  fit() {
    this.stage.fit();
    this.dirty = true;
  }

  keys() {
    const { player } = this;
    const actions = {
      " ": () => player.toggle(),
      ArrowRight: (e) => player.stepSample(e.shiftKey ? 10 : 1),
      ArrowLeft: (e) => player.stepSample(e.shiftKey ? -10 : -1),
      Home: () => this.go(() => player.seekRow(0)),
      End: () => this.go(() => player.seekRow(this.run.rows - 1)),
      n: () => this.stepEvent(1), p: () => this.stepEvent(-1),
      "+": () => player.faster(2), "=": () => player.faster(2), "-": () => player.faster(0.5),
      t: () => this.setTrails(!this.stage.trailsOn), l: () => this.setLabels(!this.labelsOn),
      r: () => this.setRepeat(!player.repeats), a: () => this.setArrows(!this.stage.arrows.visible), f: () => this.fit(),
      d: () => this.setTheme(this.theme === "dark" ? "light" : "dark"),
      "]": () => this.scaleArrows(1.25), "[": () => this.scaleArrows(0.8),
      "?": () => $("help").showModal(), Escape: () => this.select(null),
    };
    document.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || $("help").open) return;
      const target = event.target;
      if (target.matches("select, input[type=checkbox]")) return;
      if (target.matches("button, a") && (event.key === " " || event.key === "Enter")) return;
      const action = actions[event.key];
      if (!action) return;
      event.preventDefault();
      action(event);
    });
  }

  // A click on an arrow picks it, a drag moves the view.
  pointer() {
    const canvas = $("stage"), tip = $("tip");
    let down = null;
    const at = (event) => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    canvas.addEventListener("pointerdown", (event) => (down = at(event)));
    canvas.addEventListener("pointerup", (event) => {
      const [x, y] = at(event);
      if (!down || Math.hypot(x - down[0], y - down[1]) > 4) return;
      const one = this.stage.arrowAt(x, y, event.pointerType === "touch" ? 24 : 10);
      this.select(one?.constraint ?? null);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons) return;
      const [x, y] = at(event), one = this.stage.arrowAt(x, y, 10);
      canvas.style.cursor = one ? "pointer" : "grab";
      tip.hidden = !one;
      if (!one) return;
      tip.textContent = this.describe(one.constraint, true);
      tip.style.transform = `translate(${Math.min(x + 14, canvas.clientWidth - 240)}px, ${y + 16}px)`;
    });
    canvas.addEventListener("pointerleave", () => (tip.hidden = true));
  }
  select(constraint) {
    this.selected = this.stage.arrows.selected = constraint;
    $("picked").hidden = !constraint;
    if (constraint && this.shown.length > 0 && this.shown[0].quantity.constraint !== constraint) {
      const q = this.quantities.find((one) => one.constraint === constraint);
      if (q) {
        this.shown[0].set(q);
        $("plots").querySelector("select").value = q.id;
      }
    }
    this.dirty = true;
  }
  hide(constraint, hidden) {
    if (hidden) this.stage.arrows.hidden.add(constraint.index);
    else this.stage.arrows.hidden.delete(constraint.index);
    this.dirty = true;
  }
  // Name, value with its error, and whether the motion determines it.
  describe(constraint, short = false) {
    const { run, player } = this, row = player.row ?? run.nearest(player.t);
    const { lambda, error, unique, determined, unit } = reading(run, constraint, row);
    if (!determined) return `${constraint.name}: not determined by the motion at this instant`;
    const value = lambda.length === 1 ? `\u03bb = ${withError(lambda[0], error, unit, most(run))}`
      : `|\u03bb| = ${withError(Math.hypot(...lambda), error, unit, most(run))}`;
    const sure = unique ? "unique" : "not unique: only together with others is it determined";
    return short ? `${constraint.name}: ${value}` : `${value}; ${sure}. ${constraint.meaning}.`;
  }

  setTheme(name) {
    this.theme = name;
    this.palette = palettes[name];
    document.documentElement.dataset.theme = name;
    this.stage.setTheme(name);
    this.forces.recolour(this.palette);
    for (const plot of this.shown) plot.make();
    this.dirty = true;
  }
  layout() {
    this.stage.resize();
    if (!this.fitted) {
      this.stage.fit();
      this.fitted = true;
    }
    this.dirty = true;
  }

  update(now = performance.now()) {
    this.dirty = false;
    const { run, player, stage } = this;
    stage.set(player.t, player.row);
    stage.draw(2 * player.speed);
    this.frames.push(now);
    if (this.frames.length > 240) this.frames.shift();
    for (const plot of this.shown) plot.move();
    this.placeLabels();
    // Text is not read faster than this.
    if (player.playing && now - (this.lastText ?? 0) < 80) return;
    this.lastText = now;
    this.updateText();
  }
  updateText() {
    const { run, player } = this;
    $("play").textContent = player.playing ? "\u275a\u275a" : "\u25b6";
    $("play").setAttribute("aria-label", player.playing ? "pause" : "play");
    const part = run.end > run.start ? (player.t - run.start) / (run.end - run.start) : 0;
    const unit = run.units.time ? " " + run.units.time : "", t = player.t.toFixed(this.decimals());
    $("time").value = Math.round(10000 * part);
    $("time").setAttribute("aria-valuetext", `time ${t}${unit}`);
    $("clock").textContent = `t = ${t}${unit}`;
    $("speed").textContent = `\u00d7${short(Number(player.speed.toPrecision(2)))}`;
    $("stage").setAttribute("aria-label", `${run.title} at time ${t}${unit}`);
    if (this.selected) {
      $("picked-name").textContent = this.selected.name;
      $("picked-kind").textContent = this.selected.kind;
      $("picked-value").textContent = this.describe(this.selected);
    }
    this.forces.update();
    const row = player.row ?? run.nearest(player.t);
    for (const plot of this.shown) {
      const q = plot.quantity, error = q.error === undefined ? undefined : run.at(q.error, row);
      plot.value.textContent = withError(plot.values[row], error, q.unit, most(run));
    }
    this.legend();
  }
  decimals() {
    const span = this.run.end - this.run.start;
    return span > 0 ? Math.min(9, Math.max(0, 3 - Math.floor(Math.log10(span)))) : 3;
  }
  legend() {
    const { stage, run } = this, { forceScale, torqueScale } = stage.arrows;
    const show = (id, scale, unit) => {
      $(id).hidden = !(scale > 0);
      if (!(scale > 0)) return;
      const force = roundDown(110 / stage.pixels(scale)), width = stage.pixels(force * scale);
      $(id).querySelector("svg").setAttribute("width", width + 2);
      $(id).querySelector("line").setAttribute("x2", Math.max(0, width - 7));
      $(id).querySelector("path").setAttribute("d", `M${width} 6l-9-4.5v9z`);
      $(id).querySelector("span").textContent = short(force) + (unit ? " " + unit : "");
    };
    show("force-scale", forceScale, run.units.force);
    show("torque-scale", torqueScale, run.units.force && run.units.length ? `${run.units.force} ${run.units.length}` : "");
    const length = roundDown(140 / stage.pixels(1)), width = stage.pixels(length);
    $("length-scale").querySelector("i").style.width = `${width}px`;
    $("length-scale").querySelector("span").textContent = short(length) + (run.units.length ? " " + run.units.length : "");
  }
  placeLabels() {
    const { stage } = this;
    const put = (label, place) => {
      const [x, y] = stage.project(place);
      label.style.transform = `translate(${x + 14}px, ${y - 28}px)`;
    };
    for (const { point, label } of this.labelled) {
      label.hidden = !this.labelsOn;
      if (this.labelsOn) put(label, stage.camera.position.clone().fromArray(stage.frame.place(point)));
    }
    const unknown = new Set(stage.arrows.undetermined());
    for (const { one, label } of this.unknown) {
      label.hidden = !unknown.has(one);
      if (!label.hidden) put(label, one.tail);
    }
  }
}

function start() {
  const began = performance.now();
  try {
    const run = new Run(JSON.parse($("data").textContent));
    $("data").remove();
    const page = new Page(run);
    page.decoded = performance.now() - began;
    window.dalembert = page;
    document.documentElement.dataset.ready = "yes";
  } catch (error) {
    $("failure").hidden = false;
    $("failure").textContent = `This page could not be shown: ${error.message}. It needs WebGL; is it turned off?`;
    throw error;
  }
}
start();
