"""The tables that the benchmarks have written, and their numbers as text."""

import csv
import math
import re
from dataclasses import dataclass, field
from pathlib import Path

from markupsafe import Markup


@dataclass
class Table:
    columns: list[str]
    rows: list[dict[str, str]]
    heading: list[str] = field(default_factory=list)  # what it answers, machine, compiler, versions

    def where(self, **values):
        return [row for row in self.rows if all(row[name] == value for name, value in values.items())]

    def distinct(self, column):
        return list(dict.fromkeys(row[column] for row in self.rows))


class Folder:
    """A folder of tables and charts, which knows what it was asked for and does not have."""

    def __init__(self, path):
        self.path = Path(path)
        self.missing = []

    def table(self, name):
        path = self.path / f"{name}.csv"
        if not path.exists() or path.stat().st_size == 0:  # as a benchmark leaves it that was stopped
            self.missing.append(path.name)
            return None
        with path.open(newline="") as file:
            reader = csv.DictReader(file)
            rows = list(reader)
        text = path.with_suffix(".txt")
        lines = text.read_text().splitlines() if text.exists() else []
        return Table(reader.fieldnames or [], rows, [line[2:] for line in lines if line.startswith("# ")])

    def chart(self, name):
        """A chart of gnuplot, to stand in the page, or None."""
        path = self.path / f"{name}.svg"
        if not path.exists():
            self.missing.append(path.name)
            return None
        text = path.read_text()
        box = re.search(r'viewBox="[^"]*"', text).group()
        body = text.split("</defs>", 1)[1]  # the page has the definitions of marks once
        body = re.sub(r' id="gnuplot_plot_\d+\w*"', "", body)  # every chart numbers its plots from 1
        body = re.sub(r"rgb\( *(\d+), *(\d+), *(\d+)\)", themed, body).replace('"black"', '"var(--ink)"')
        return Markup(f'<svg {box} role="img"><g>{body}')

    def marks(self):
        """The definitions of gnuplot's marks, of any chart: they are alike in all."""
        for path in self.path.glob("*.svg"):
            text = path.read_text()
            return Markup("<defs>" + text.split("<defs>", 1)[1].split("</defs>", 1)[0] + "</defs>")
        return Markup("")


# The colours of bench/charts/style.gp, as the style sheet of the page has them for light and dark.
THEME = {"0072B2": "blue", "D55E00": "orange", "009E73": "green", "CC79A7": "pink", "E69F00": "yellow", "56B4E9": "sky",
         "CC0000": "bad", "444444": "soft", "DDDDDD": "grid", "000000": "ink"}


def themed(rgb):
    name = THEME.get("".join(f"{int(part):02X}" for part in rgb.groups()))
    return f"var(--{name})" if name else rgb.group()


def number(text):
    try:
        return float(text)
    except ValueError:
        return math.nan


def scientific(text, digits=2):
    """7.6e-07 as a reader writes it."""
    value = number(text)
    if not math.isfinite(value):
        return "–" if math.isnan(value) else "not known"
    if value == 0.0:
        return "0"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    power = str(int(exponent)).replace("-", "−")
    if float(mantissa) == 1.0:
        return Markup(f"10<sup>{power}</sup>")
    return Markup(f"{mantissa.replace('-', '−')}·10<sup>{power}</sup>")


def plain(text, digits=3):
    """A number of everyday size, with so many significant digits."""
    value = number(text)
    if not math.isfinite(value):
        return "–"
    if value == 0.0:
        return "0"
    if abs(value) < 1e-3:
        return scientific(text, digits)
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    return f"{value:,.{decimals}f}".replace(",", " ").replace("-", "−")


def duration(seconds):
    value = number(seconds)
    if not math.isfinite(value):
        return "–"
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6), ("ns", 1e-9)):
        if value >= size:
            return f"{plain(value / size)} {unit}"
    return f"{plain(value / 1e-9)} ns"
