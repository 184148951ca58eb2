"""Numbers of benchmarks: the rows that benchmarks append to a file, and ratios between the rows of two commits.

A line of such a file is JSON: {"table", "row", "measures": [{"name", "unit", "value", ...}]}, or {"table", "row", "broken"} with what was
raised, or {"facts"} of the process. native/bench/table.hpp and blend_tests/bench/table.py write them.
"""

import json
import statistics
from typing import NamedTuple

TIMES = ("ns", "us", "ms", "s")
"""Units of what is compared."""
SLOWER = 1.1
"""A measure is marked if all of its ratios are greater."""


class Output(NamedTuple):
    """What a benchmark has appended to its file."""

    rows: list
    broken: list  # rows whose measuring raised
    facts: dict


def read(path):
    """The Output in a file; an empty one if there is no file. Raises ValueError if two rows cannot be told apart."""
    lines = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()] if path.exists() else []
    output = Output([], [], {})
    for line in lines:
        if "facts" in line:
            output.facts.update(line["facts"])
        else:
            (output.broken if "broken" in line else output.rows).append(line)
    keys = [key(row) for row in output.rows]
    if twice := sorted({one for one in keys if keys.count(one) > 1}):
        raise ValueError(f"rows of one name: {', '.join(map(' / '.join, twice))}")
    return output


def key(row):
    """What a row is known by within its benchmark."""
    return row["table"], row["row"]


class Ratio(NamedTuple):
    """How long ours takes of theirs: each number of a turn is a median of its rounds."""

    row: str
    measure: str
    unit: str
    ours: float  # median of the turns
    theirs: float
    ratio: float  # median of the turns' ratios
    least: float
    largest: float

    @property
    def is_slower(self):
        """Whether no turn leaves a doubt."""
        return self.least > SLOWER


def _times(rows):
    """{(table, row, measure, unit): value} of the measures that are times."""
    return {(*key(row), one["name"], one["unit"]): one["value"] for row in rows for one in row["measures"] if one["unit"] in TIMES}


def ratios(ours, theirs):
    """(Ratios, names of rows that only one side has); ours, theirs: for each turn its rows.

    A measure that is not above zero in each turn has no ratio: what an owner adds to a frame may be lost in the noise.
    """
    ours, theirs = ([_times(rows) for rows in turns] for turns in (ours, theirs))
    everywhere = set(ours[0]).intersection(*ours, *theirs)
    found = []
    for which in ours[0]:
        pairs = [(one[which], other[which]) for one, other in zip(ours, theirs)] if which in everywhere else []
        if pairs and all(value is not None and value > 0.0 for pair in pairs for value in pair):
            by_turn = [one / other for one, other in pairs]
            medians = [statistics.median(side) for side in zip(*pairs)]
            found.append(Ratio(*which[1:], *medians, statistics.median(by_turn), min(by_turn), max(by_turn)))
    names = [{which[:2] for turn in turns for which in turn} for turns in (ours, theirs)]
    return found, sorted(" / ".join(name) for name in names[0] ^ names[1])
