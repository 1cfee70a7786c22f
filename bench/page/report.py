#!/usr/bin/env python3
"""Writes index.html into a folder of tables and charts of the benchmarks: see bench/run.sh."""

import argparse
import datetime
import statistics
from dataclasses import dataclass, field
from pathlib import Path

import jinja2
from markupsafe import Markup

import sections
from parts import Chart, Grid, Section, counted, grid_of
from tables import Folder, duration, number, scientific

HERE = Path(__file__).parent
COMPARED = "1e-08"  # the tolerance of the table of all models


@dataclass
class Model:
    name: str
    notes: str
    reference: str
    t_end: str
    outcome: str  # "ok", or the error that refused its run
    page: str | None
    charts: list
    grid: Grid | None
    missing: list = field(default_factory=list)


def models(folder):
    """All of the catalogue, as far as it was run."""
    curves, listed = folder.table("work-precision"), folder.table("models")
    described = {row["model"]: row for row in (listed.rows if listed else [])}
    names = list(described) or (curves.distinct("model") if curves else [])
    return [model(folder, name, described.get(name), curves) for name in names]


def model(folder, name, row, curves):
    before = len(folder.missing)
    page = folder.path / f"{name}.html"
    if not page.exists():
        folder.missing.append(page.name)
    charts = [Chart(folder.chart(f"{name}-motion"), "Motion and force of constraint by dalembert (lines) and by hand "
                    "(circles); errors, estimated by the certificate (lines) and true (circles)"),
              Chart(folder.chart(name), "Error against run time over falling tolerances")]
    row = row or {"notes": "", "reference": "", "t_end": "", "outcome": "not run"}
    grid = numbers(curves, name) if curves else None
    return Model(name, row["notes"], row["reference"], row["t_end"], row["outcome"],
                 page.name if page.exists() else None, charts, grid, folder.missing[before:])


def numbers(curves, name):
    rows = curves.where(model=name)
    return grid_of(curves, {
        "stepper": ("stepper", str), "tolerance": ("tolerance", scientific), "steps": ("steps", str),
        "evaluations": ("evaluations", str), "factorisations": ("factorisations", str),
        "error_position": ("position", scientific), "error_force": ("force", scientific),
        "energy_drift": ("energy", scientific), "run_time_s": ("run time", duration), "outcome": ("outcome", str)},
        "Largest errors at any sample, relative to the length, weight and energy of the system", folded=True, rows=rows)


def comparison(folder):
    """One row for each model: both steppers at one tolerance."""
    curves = folder.table("work-precision")
    if curves is None:
        return None
    steppers = [name for name in ("ida", "erk") if name in curves.distinct("stepper")]
    columns = ["system"] + [f"{what}, {name}" for name in steppers for what in ("position", "force", "steps", "time")]
    rows = []
    for name in curves.distinct("model"):
        cells = [Markup('<a href="#model-{0}">{0}</a>').format(name)]
        for stepper in steppers:
            own = curves.where(model=name, stepper=stepper, tolerance=COMPARED)
            if not own or own[0]["outcome"] != "ok":
                cells += [own[0]["outcome"] if own else "–", "–", "–", "–"]
                continue
            cells += [scientific(own[0]["error_position"]), scientific(own[0]["error_force"]), own[0]["steps"],
                      duration(own[0]["run_time_s"])]
        rows.append(cells)
    return Grid(columns, rows, Markup("Largest errors against the hand derivation at tolerance 10<sup>−8</sup>: position "
                                      "relative to the length of the system, force of constraint relative to its "
                                      "weight; median run time"))


def catalogue(folder, all_models):
    """The section of the models: what they show, and what of it is missing."""
    section = Section("models", "Systems against hand derivations", "How close are motion and forces of "
                               "constraint to a hand derivation that shares no code with the solver?")
    curves = folder.table("work-precision")
    listed = folder.table("models")
    if curves is None or not curves.rows:
        return section
    section.wrong = sum(row["outcome"] != "ok" for row in (listed.rows if listed else []))
    refused = sum(row["outcome"] != "ok" for row in curves.rows)
    at = [row for row in curves.rows if row["tolerance"] == COMPARED and row["outcome"] == "ok" and
          row["stepper"] in ("ida", "erk")]
    worst = max(at, key=lambda row: number(row["error_force"]))
    middle = statistics.median(number(row["error_force"]) for row in at)
    section.verdict = Markup(f"{len(all_models)} systems. At tolerance 10<sup>−8</sup> the error of force is "
                             f"{scientific(middle)} of the weight in the median and at most "
                             f"{scientific(worst['error_force'])} ({worst['model']}). "
                             f"{counted(len(curves.rows), 'run')}, {refused} refused.")
    return section


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder")
    parser.add_argument("--commit", default="unknown")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    folder = Folder(options.folder)

    def part(make, *arguments):
        """What `make` gives, with the files that it looked for and did not find."""
        before = len(folder.missing)
        section = make(folder, *arguments)
        section.missing = list(dict.fromkeys(folder.missing[before:]))
        return section

    all_models = models(folder)
    first = part(catalogue, all_models)
    first.missing += [name for one in all_models for name in one.missing]
    parts = [first] + [part(make) for make in sections.ALL]
    curves = folder.table("work-precision")
    failures = folder.path / "failures.txt"
    heroes = [one for one in all_models if one.page]
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    text = environment.get_template("index.html.j2").render(
        models=all_models, sections=parts, comparison=comparison(folder), marks=folder.marks(),
        hero=next((one for one in heroes if one.name == "governor"), heroes[0] if heroes else None),
        machine=(curves.heading[1:] if curves else []), commit=options.commit, quick=options.quick,
        date=datetime.date.today().isoformat(),
        failures=failures.read_text().splitlines() if failures.exists() else [],
        style=(HERE / "style.css").read_text())
    path = folder.path / "index.html"
    path.write_text(text)
    print(f"Report: {path}")


if __name__ == "__main__":
    main()
