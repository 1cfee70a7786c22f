// Tables beside the picture: forces now, events, the run, ledger and audit.
import { number, withError } from "./numbers.js";

export const element = (tag, attributes = {}, ...children) => {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "text") made.textContent = value;
    else if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== false && value !== undefined) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children);
  return made;
};

// What a constraint exerts at a row, in words.
export function reading(run, constraint, row) {
  const { units } = run;
  const unique = !constraint.unique || constraint.unique.every((c) => run.at(c, row) !== 0);
  const lambda = constraint.lambda.map((c) => run.at(c, row));
  const error = constraint.error === undefined ? undefined : run.at(constraint.error, row);
  return { lambda, error, unique, determined: !lambda.some(Number.isNaN), unit: units.force };
}
export const most = (run) => (run.digits === 16 ? 12 : 7);

export class Forces {
  constructor(page, host) {
    this.page = page;
    this.rows = [];
    if (page.run.constraints.length === 0) {
      host.append(element("p", { text: "This scene has no constraints." }));
      return;
    }
    const body = element("tbody");
    host.append(element("table", {},
      element("thead", {}, element("tr", {}, element("th", { text: "constraint", scope: "col" }),
        element("th", { text: `\u03bb now${page.run.units.force ? " [" + page.run.units.force + "]" : ""}`, scope: "col" }),
        element("th", { text: "show", scope: "col" }))), body));
    for (const constraint of page.run.constraints.slice(0, 300)) {
      const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
      const name = element("button", { class: "link", text: constraint.name, title: constraint.meaning,
                                       onclick: () => page.select(constraint) });
      const value = element("td", { class: "number" });
      const box = element("input", { type: "checkbox", checked: true, "aria-label": `arrow of ${constraint.name}`,
                                     onchange: () => page.hide(constraint, !box.checked) });
      const row = element("tr", {}, element("td", { class: "name" }, swatch, name), value, element("td", {}, box));
      body.append(row);
      this.rows.push({ constraint, swatch, value, row, text: "" });
    }
    if (page.run.constraints.length > 300) host.append(element("p", { text: `and ${page.run.constraints.length - 300} more` }));
  }
  recolour(palette) {
    for (const { constraint, swatch } of this.rows) swatch.style.background = palette.colours[constraint.colour % palette.colours.length];
  }
  update() {
    const { run, player } = this.page, row = player.row ?? run.nearest(player.t);
    for (const one of this.rows) {
      const { lambda, error, unique, determined } = reading(run, one.constraint, row);
      const size = Math.hypot(...lambda);
      let text = !determined ? "not determined"
        : lambda.length === 1 ? withError(lambda[0], error, "", most(run))
        : `|\u03bb| = ${withError(size, error, "", most(run))}`;
      if (determined && !unique) text += " (not unique)";
      if (text !== one.text) one.value.textContent = one.text = text;
      if (lambda.length > 1) one.value.title = lambda.map((x) => number(x, 5)).join(", ");
      one.row.classList.toggle("selected", this.page.selected === one.constraint);
    }
  }
}

export function eventsTable(page, host) {
  const { run } = page;
  if (run.events.length === 0) {
    host.append(element("p", { text: "Nothing happened that the run lists." }));
    return;
  }
  const body = element("tbody");
  const show = (from) => {
    for (const event of run.events.slice(from, from + 200)) {
      const go = () => {
        page.player.pause();
        if (event.row === undefined) page.player.seek(event.time);
        else page.player.seekRow(event.row);
      };
      body.append(element("tr", {},
        element("td", { class: "number" }, element("button", { class: "link", text: withError(event.time, event.error === null ? Infinity : event.error, run.units.time, most(run)), onclick: go })),
        element("td", { text: event.name }), element("td", { text: event.what })));
    }
  };
  show(0);
  host.append(element("table", {}, element("thead", {}, element("tr", {}, ...["time", "what", "happens"].map((text) => element("th", { text, scope: "col" })))), body));
  if (run.events.length > 200) {
    let next = 200;
    const more = element("button", { text: "more", onclick: () => {
      show(next);
      next += 200;
      more.hidden = next >= run.events.length;
    } });
    host.append(more);
  }
}

export function runTable(page, host) {
  const { run } = page, body = element("tbody");
  const row = (name, text) => body.append(element("tr", {}, element("th", { scope: "row", text: name }), element("td", { class: "number", text })));
  row("stepper", run.stepper);
  row("tolerance", number(run.tolerance, 2));
  row("samples", String(run.samples));
  for (const [name, value] of Object.entries(run.statistics)) {
    if (value === "" || value === null) continue;
    row(name, typeof value === "number" ? (Number.isInteger(value) ? value.toLocaleString("en") : number(value, 3)) : value);
  }
  row("dalembert", run.version);
  if (run.certificate) host.append(element("p", { class: "statement", text: run.certificate.statement }));
  host.append(element("table", {}, body));
}

export function ledgerTable(page, host) {
  const { run } = page;
  host.append(element("p", { text: "Since the start; each can be plotted." }));
  const body = element("tbody");
  for (const { name, column } of run.ledger) {
    let last = run.rows - 1;
    while (last > 0 && Number.isNaN(run.at(column, last))) --last;
    body.append(element("tr", {}, element("th", { scope: "row", text: name }),
      element("td", { class: "number", text: number(run.at(column, 0), 5) }), element("td", { class: "number", text: number(run.at(column, last), 5) })));
  }
  host.append(element("table", {}, element("thead", {}, element("tr", {}, ...["account", "at the start", "at the end"].map((text) => element("th", { text, scope: "col" })))), body));
}

export function auditTable(page, host) {
  const { run } = page, body = element("tbody");
  host.append(element("p", { text: "Each law of mechanics, where the numbers of this run are furthest from it, against what its tolerance allows." }));
  for (const finding of run.audit) {
    const ratio = finding.size > 0 ? finding.size / finding.limit : 0, holds = ratio <= 1;
    body.append(element("tr", { class: holds ? "" : "broken" }, element("td", { text: (holds ? "\u2713 " : "\u2717 ") + finding.law }),
      element("td", { text: finding.element }), element("td", { class: "number", text: number(finding.time, 4) }),
      element("td", { class: "number", text: number(finding.size, 2) }), element("td", { class: "number", text: number(finding.limit, 2) })));
  }
  host.append(element("table", {}, element("thead", {}, element("tr", {}, ...["law", "of", "at t", "off by", "limit"].map((text) => element("th", { text, scope: "col" })))), body));
}
