"""What a section of the report consists of, and how rows are judged."""

import math
import re
from dataclasses import dataclass, field

from tables import number


@dataclass
class Grid:
    """A table for a reader: names of columns, and rows of cells; the number of a wrong row is in `wrong`."""

    columns: list[str]
    rows: list[list]
    caption: str = ""
    wrong: set = field(default_factory=set)
    folded: bool = False
    first: bool = False  # before the charts

    @property
    def words(self):
        """The columns of words, which stand to the left."""
        return {k for k in range(len(self.columns)) if any(re.search("[A-Za-z]{3}", str(row[k])) for row in self.rows)}


@dataclass
class Chart:
    picture: object
    caption: str
    wide: bool = False


@dataclass
class Section:
    name: str
    title: str
    question: str
    verdict: str = ""
    checks: bool = True  # whether it has rows that can be wrong
    wrong: int = 0
    charts: list = field(default_factory=list)
    grids: list = field(default_factory=list)
    pairs: object = None
    missing: list = field(default_factory=list)

    @property
    def state(self):
        if self.wrong:
            return "wrong"
        return "missing" if self.missing else "right" if self.checks else "measured"


def beyond(row, value="error", limit="limit"):
    """Not within the limit; what is no number is not, either."""
    return not number(row[value]) <= number(row[limit])


def ratio(row, value="error", limit="limit"):
    bound = number(row[limit])
    part = number(row[value]) / bound if bound > 0 else 0.0 if number(row[value]) == 0 else math.inf
    return math.inf if math.isnan(part) else part


def worst(rows, value="error", limit="limit"):
    return max(rows, key=lambda row: ratio(row, value, limit))


def grid_of(table, formats, caption="", wrong=lambda row: False, folded=False, rows=None):
    """A table as it stands; `formats` gives the columns shown, their titles and how numbers are written."""
    rows = table.rows if rows is None else rows
    return Grid(
        columns=[title for title, _ in formats.values()],
        rows=[[write(row[name]) for name, (_, write) in formats.items()] for row in rows],
        caption=caption,
        wrong={i for i, row in enumerate(rows) if wrong(row)},
        folded=folded,
    )


def counted(count, what):
    return f"{count:,}".replace(",", " ") + f" {what}" + ("" if count == 1 else "s")


def wrong_words(count, what):
    return f"none is {what}." if count == 0 else f"{count} {'is' if count == 1 else 'are'} {what}."
