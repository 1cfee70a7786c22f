"""The sections of the report: each reads its tables and says what they show, what is wrong and what is missing."""

import json
import math
from dataclasses import dataclass

from markupsafe import Markup

from parts import Chart, Grid, Section, beyond, counted, grid_of, ratio, worst, wrong_words
from tables import duration, number, plain, scientific


def ratios(folder):
    section = Section("ratios", "Against code written by hand",
                      "How much run time does an error cost, compared with equations of motion derived by hand "
                      "and with other libraries?", checks=False)
    table = folder.table("ratios")
    if table is None:
        return section
    steppers = table.distinct("stepper")
    peers = [name for name in steppers if name.startswith("simbody")]
    section.verdict = ("Run time as a multiple of the hand-derived code's. " +
                       (f"Peers found: {', '.join(peers)}." if peers else
                        "Peers: none was found; Simbody takes part where CMake finds it."))
    rows = []
    for scene in table.distinct("scene"):
        for error in table.distinct("error"):
            own = {row["stepper"]: row for row in table.where(scene=scene, error=error)}
            if not own:
                continue
            cells = [scene, scientific(error), duration(own["hand"]["run_time_s"]) if "hand" in own else "–"]
            for name in steppers:
                if name == "hand":
                    continue
                row = own.get(name)
                if row is None:
                    cells.append("–")
                elif row["outcome"] == "ok":
                    cells.append(plain(row["ratio_to_hand"]))
                else:
                    cells.append(Markup("missed: {} at best").format(scientific(row["error_reached"]))
                                 if row["outcome"] == "missed" else row["outcome"])
            rows.append(cells)
    section.grids = [Grid(["scene", "error of position", "by hand"] + [s for s in steppers if s != "hand"], rows,
                          "Time of the integration alone to reach an error at the end of the run: by hand in seconds, "
                          "others as a multiple of that")]
    return section


def scaling(folder):
    section = Section("scaling", "Scaling", "How do time and memory grow with the number of beads of a chain, and what "
                      "does a scene cost at its start?", checks=False)
    table = folder.table("scaling")
    set_up = folder.table("set-up")
    refused = 0
    if table is not None:
        refused += sum(row["outcome"] != "ok" for row in table.rows)
        largest = max(int(row["size"]) for row in table.rows)
        section.verdict = f"Chains up to {plain(largest, 1)} beads; "
        section.charts = [Chart(folder.chart("scaling"), "Run time over the number of beads")]
        section.grids = [grid_of(table, {
            "stepper": ("stepper", str), "size": ("beads", str), "steps": ("steps", str),
            "evaluations": ("evaluations", str), "error_position": ("error of position", scientific),
            "run_time_s": ("run time", duration), "peak_memory_mib": ("peak memory so far / MiB", plain),
            "outcome": ("outcome", str)},
            "One run each. The error is not measured where the reference would take too long.")]
    if set_up is not None:
        refused += sum(row["outcome"] != "ok" for row in set_up.rows)
        section.grids.append(grid_of(set_up, {
            "scene": ("scene", str), "stepper": ("stepper", str), "size": ("number", str), "time_s": ("time", duration),
            "time_each_s": ("time of each", duration), "outcome": ("outcome", str)},
            "Scenes stated, begun and run for a millisecond"))
    if table is not None or set_up is not None:
        section.verdict += wrong_words(refused, "refused")
    return section


def extremes(folder):
    section = Section("extremes", "Extremes",
                      "Stiff, hostile and near-singular scenes, each swept over one parameter: is every row within its "
                      "derived limit, or refused with the error that is due?")
    table = folder.table("extremes")
    if table is None:
        return section
    bad = [row for row in table.rows if beyond(row)]
    cases = table.distinct("case")
    refused = sum(row["outcome"] != "ok" and not beyond(row) for row in table.rows)
    section.wrong = len(bad)
    section.verdict = (f"{counted(len(table.rows), 'run')} of {counted(len(cases), 'case')}, {refused} of them refused "
                       "as is due; " + wrong_words(len(bad), "wrong"))
    formats = {"case": ("case", str), "parameter": ("value", scientific), "stepper": ("stepper", str),
               "outcome": ("outcome", str), "error": ("error", scientific), "limit": ("limit", scientific),
               "steps": ("steps", str), "run_time_s": ("run time", duration)}
    if bad:
        section.grids.append(grid_of(table, formats, "Rows that are wrong", lambda row: True, rows=bad))
        section.grids[0].first = True
    for case in cases:
        rows = table.where(case=case)
        lost = sum(beyond(row) for row in rows)
        caption = case + (f": {counted(lost, 'row')} wrong" if lost else "")
        section.charts.append(Chart(folder.chart(f"extremes-{case}"), caption))
    section.grids.append(grid_of(table, formats, "All rows", beyond, folded=True))
    return section


def events(folder):
    section = Section("events", "Events", "At which times do contacts open, close and come to rest, and friction "
                      "sticks or slides, compared with closed forms?")
    table = folder.table("events")
    if table is None:
        return section
    bad = [row for row in table.rows if beyond(row)]
    section.wrong = len(bad)
    section.verdict = (f"{counted(len(table.rows), 'time')} of {counted(len(table.distinct('model')), 'system')}; " +
                       wrong_words(len(bad), "beyond its limit"))
    tolerances = table.distinct("tolerance")
    steppers = table.distinct("stepper")
    rows, wrong = [], set()
    for model in table.distinct("model"):
        plays = (folder.path / f"{model}.html").exists()
        cells = [Markup('<a href="{0}.html">{0}</a>').format(model) if plays else model,
                 len(table.where(model=model, stepper=steppers[0], tolerance=tolerances[0]))]
        for stepper in steppers:
            for tolerance in tolerances:
                own = table.where(model=model, stepper=stepper, tolerance=tolerance)
                cells.append(scientific(max(number(row["error"]) for row in own)) if own else "–")
        if any(beyond(row) for row in table.where(model=model)):
            wrong.add(len(rows))
        rows.append(cells)
    columns = ["system", "times"] + [f"{s}, {t}" for s in steppers for t in tolerances]
    section.grids = [Grid(columns, rows, "Largest relative error of a time, by stepper and tolerance", wrong)]
    formats = {"model": ("system", str), "event": ("event", str), "stepper": ("stepper", str),
               "tolerance": ("tolerance", scientific), "time": ("time", lambda x: plain(x, 10)),
               "reference_time": ("closed form", lambda x: plain(x, 10)), "error": ("error", scientific),
               "limit": ("limit", scientific)}
    section.grids.append(grid_of(table, formats, "All times", beyond, folded=True))
    return section


def modes(folder):
    section = Section("modes", "Equilibria, modes and stability",
                      "How close are equilibria, frequencies and critical parameters to closed forms, and systems "
                      "stated twice to one another?")
    table = folder.table("modes")
    for name in ("hoop", "governor", "kapitza"):
        folder.table(name)
    section.charts = [Chart(folder.chart("hoop-branches"), "Bead on a hoop that turns about its vertical diameter "
                            "(mex39): equilibria over the rate"),
                      Chart(folder.chart("governor-branches"), "Watt's governor (mex23): equilibria over the rate"),
                      Chart(folder.chart("kapitza-chart"), "Pendulum upright on a shaken pivot: growth of a "
                            "disturbance in a period, by Floquet's theory")]
    if table is None:
        return section
    bad = [row for row in table.rows if beyond(row)]
    section.wrong = len(bad)
    section.verdict = (f"{counted(len(table.rows), 'number')} of {counted(len(table.distinct('model')), 'system')}; " +
                       wrong_words(len(bad), "beyond its limit"))
    rows, wrong = [], set()
    for model in table.distinct("model"):
        own = table.where(model=model)
        most = worst(own)
        if beyond(most):
            wrong.add(len(rows))
        rows.append([model, len(own), most["quantity"], scientific(most["error"]), scientific(most["limit"])])
    section.grids = [Grid(["system", "numbers", "the one closest to its limit", "error", "limit"], rows,
                          "Of each system the number closest to its limit", wrong),
                     grid_of(table, {"model": ("system", str), "quantity": ("quantity", str),
                                     "value": ("value", lambda x: plain(x, 10)),
                                     "reference": ("closed form", lambda x: plain(x, 10)),
                                     "error": ("error", scientific), "limit": ("limit", scientific)},
                             "All numbers", beyond, folded=True)]
    return section


@dataclass
class Pairs:
    features: list[str]
    cells: dict  # (feature, feature): row


def products(folder):
    section = Section("products", "Products of features", "Do features work together? Random scenes draw from all "
                      "features at once; each must run right or be refused with a reason.")
    table = folder.table("pairs")
    if table is None:
        return section
    cells = {}
    for row in table.rows:
        cells[row["feature"], row["with"]] = cells[row["with"], row["feature"]] = row
    faults = [row for row in table.rows if int(row["faults"]) > 0]
    never = sum(int(row["scenes"]) == 0 for row in table.rows)
    section.wrong = len(faults)
    section.verdict = (f"{counted(len(table.rows), 'pair')} of features, {never} of them never drawn; " +
                       wrong_words(len(faults), "at fault in any scene"))
    section.pairs = Pairs(table.distinct("feature"), cells)
    refusing = sorted((row for row in table.rows if int(row["refused"]) > 0),
                      key=lambda row: -int(row["refused"]) / int(row["scenes"]))
    section.grids = [grid_of(table, {"feature": ("feature", str), "with": ("with", str), "scenes": ("scenes", str),
                                     "refused": ("refused", str), "most refused by": ("most refused by", str)},
                             "Pairs that are refused, most often first", folded=True, rows=refusing)]
    return section


def audit(folder):
    section = Section("audit", "Audit", "Every run is held against the laws of mechanics by code that shares nothing "
                      "with the steppers. How close does it come to a limit?")
    table = folder.table("audit")
    if table is None:
        return section
    bad = [row for row in table.rows if beyond(row, "worst")]
    section.wrong = len(bad)
    section.verdict = (f"{counted(len(table.rows), 'finding')} in {counted(len(table.distinct('scene')), 'scene')}; " +
                       wrong_words(len(bad), "beyond its limit"))
    rows, wrong = [], set()
    for law in table.distinct("law"):
        own = table.where(law=law)
        most = worst(own, "worst")
        if any(beyond(row, "worst") for row in own):
            wrong.add(len(rows))
        rows.append([law, len(own), scientific(most["worst"]), scientific(most["limit"]),
                     plain(ratio(most, "worst")),
                     f"{most['scene']}, {most['stepper']}" + (f" at {most['tolerance']}" if most["tolerance"] else "")])
    section.grids = [Grid(["law", "runs", "worst violation", "its limit", "part of the limit", "in"], rows,
                          "Of each law the run closest to its limit", wrong)]
    return section


def certificates(folder):
    section = Section("certificates", "Certificates", "How close are the errors that certify estimates to the true "
                      "ones?")
    table = folder.table("certificates")
    section.charts = [Chart(folder.chart("certificates"), "Estimated over true error, of runs and of single events; errors "
                            "that may be round-off are left out")]
    if table is None:
        return section
    known = [row for row in table.rows if math.isfinite(number(row["estimated_error"])) and
             number(row["estimated_error"]) > number(row["round_off"])]
    rows = []
    for name, kept in (("position", lambda q: q == "position"), ("force", lambda q: q == "force"),
                       ("largest error of an event's time in a run", lambda q: q == "time of events"),
                       ("largest error of an impulse in a run", lambda q: q == "impulse")):
        own = [number(row["estimated_error"]) / number(row["true_error"]) for row in known
               if kept(row["quantity"]) and number(row["true_error"]) > 0]
        if own:
            rows.append((name, own))
    every = [part for _, own in rows for part in own]
    share = lambda own, low, high: 100.0 * sum(low <= part <= high for part in own) / len(own)
    claims = every and share(every, 0.8, 1.25) >= 95.0 and share(every, 0.2, 5.0) >= 99.5
    section.wrong = 0 if claims else 1
    section.verdict = (f"{counted(len(every), 'largest error')} of a run: {plain(share(every, 0.8, 1.25))} % are estimated "
                       f"within 0.8 to 1.25 times the true error (claimed: 95 %), {plain(share(every, 0.2, 5.0))} % within "
                       "0.2 to 5 times (claimed: 99.5 %)." if every else "No estimate is above round-off.")
    section.grids = [Grid(["largest error of a run", "runs", "within 0.8 to 1.25", "within 0.2 to 5", "least", "most"],
                          [[name, len(own), f"{plain(share(own, 0.8, 1.25))} %", f"{plain(share(own, 0.2, 5.0))} %",
                            plain(min(own)), plain(max(own))] for name, own in rows],
                          "Estimated over true error")]
    return section


def requests(folder):
    section = Section("requests", "Requests", "What does simulate_to give for an error of force that is asked for, and "
                      "at what cost?")
    table = folder.table("requests")
    if table is None:
        return section
    wrong = lambda row: row["met"] == "yes" and number(row["true_error"]) > 1.25 * number(row["request"])
    section.wrong = sum(map(wrong, table.rows))
    met = sum(row["met"] == "yes" for row in table.rows)
    section.verdict = f"{met} of {counted(len(table.rows), 'request')} met; " + wrong_words(section.wrong, "wrong")
    section.grids = [grid_of(table, {
        "model": ("system", str), "request": ("requested", scientific), "stepper": ("stepper", str),
        "tolerance": ("tolerance chosen", scientific), "runs": ("runs", str), "met": ("met", str),
        "true_error": ("true error", scientific), "estimated_error": ("estimated", scientific),
        "time_s": ("time", duration), "cost": ("cost", plain)},
        "Errors relative to the model's force; cost: processor time over that of the cheapest single run that meets it",
        lambda row: wrong(row) or row["met"] != "yes", folded=len(table.rows) > 30)]
    return section


def leave_out(folder):
    section = Section("leave-out", "What leaving out saves", "What a scene does not need is left out. What does that "
                      "save, and is it the same motion?")
    table = folder.table("leave-out")
    own = folder.table("own-constraint")
    if table is not None:
        section.wrong = sum(row["outcome"] != "ok" for row in table.rows)
        section.verdict = f"{counted(len(table.rows), 'comparison')}; " + wrong_words(section.wrong, "wrong")
        rows = [[row["scene"], row["left_out"], row["stepper"], f"{row['unknowns_full']} → {row['unknowns']}",
                 duration(row["run_time_full_s"]), duration(row["run_time_s"]),
                 plain(number(row["run_time_full_s"]) / number(row["run_time_s"])),
                 scientific(row["difference_position"]), row["outcome"]] for row in table.rows]
        section.grids = [Grid(["scene", "left out", "stepper", "unknowns", "in full", "without", "ratio",
                               "difference of position", "outcome"], rows, "One motion stated in full and without",
                              {i for i, row in enumerate(table.rows) if row["outcome"] != "ok"})]
    if own is not None:
        section.grids.append(grid_of(own, {
            "stepper": ("stepper", str), "beads": ("beads", str), "run_time_distance_s": ("Distance", duration),
            "run_time_own_s": ("a user's lambda", duration), "ratio": ("ratio", plain),
            "difference_position": ("difference of position", scientific), "outcome": ("outcome", str)},
            "A constraint written as a lambda against the library's Distance"))
    return section


def sensitivity(folder):
    section = Section("sensitivity", "Sensitivity", "The solvers' empirical constants halved and doubled: what changes?",
                      checks=False)
    table = folder.table("sensitivity")
    if table is None:
        return section
    section.verdict = f"{counted(len(table.distinct('constant')), 'constant')}, each halved and doubled."
    section.grids = [grid_of(table, {
        "constant": ("constant", str), "factor": ("times", str), "scenes": ("runs that change", str),
        "worse_error": ("error grows at most", plain), "more_time": ("work (geometric mean)", plain),
        "refused": ("newly refused", str), "worst": ("where the error grows most", str)},
        table.heading[0] if table.heading else "")]
    return section


def sweeps(folder):
    section = Section("sweeps", "Sweeps", "Many scenes over threads and ranks, killed and gone on with: at which rate, "
                      "and with the same bytes?")
    table = folder.table("sweep")
    section.charts = [Chart(folder.chart("sweep-flips"), "First flip of a double pendulum from rest, over the start "
                            "angles"),
                      Chart(folder.chart("sweep-kapitza"), "Pendulum upright on a shaken pivot: when it leaves"),
                      Chart(folder.chart("sweep-governors"), "Bearing force of governors made within their tolerances")]
    if table is None:
        return section
    section.wrong = sum(row["identical"] != "yes" for row in table.rows)
    section.verdict = (f"{counted(len(table.rows), 'sweep')}; " +
                       wrong_words(section.wrong, "other than the same, byte by byte"))
    section.grids = [grid_of(table, {
        "case": ("sweep", str), "runs": ("runs", str), "threads": ("threads", str), "ranks": ("ranks", str),
        "run_time_s": ("time", duration), "runs_per_s": ("runs per second", plain), "efficiency": ("efficiency", plain),
        "failed": ("failed rows", str), "identical": ("same bytes", str)},
        "Efficiency: rate per thread over that of a bare loop", lambda row: row["identical"] != "yes")]
    return section


def kernels(folder):
    section = Section("kernels", "Kernels", "How long does each kernel take?", checks=False)
    path = folder.path / "kernels.json"
    try:
        measured = json.loads(path.read_text())["benchmarks"]
    except (FileNotFoundError, json.JSONDecodeError):  # not run, or stopped before its end
        folder.missing.append(path.name)
        return section
    timed = [one for one in measured if one.get("run_type", "iteration") == "iteration"]
    section.verdict = f"{counted(len(timed), 'kernel')}: time per call."
    unit = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
    rows = [[one["name"], duration(one["real_time"] * unit[one["time_unit"]])] for one in timed]
    section.grids = [Grid(["kernel / size", "time"], rows, "Time of one call")]
    return section


ALL = [ratios, scaling, extremes, events, modes, products, audit, certificates, requests, leave_out, sensitivity, sweeps,
       kernels]
