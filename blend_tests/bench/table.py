"""Tables of benchmarks inside Blender: a line for readers, and for .ci/bench.py a line of JSON, for each row.

The environment variable MOTUS_BENCH_ROWS names the file that the lines of JSON are appended to. The rows of native/bench/table.hpp
have the same form.
"""

import contextlib
import json
import math
import os
import traceback
from typing import NamedTuple

import bpy
import numpy as np

import support


class Column(NamedTuple):
    """A measure: its name, its unit ("ns", "us", "ms" and "s" are compared between commits), and how a number is shown.

    With rounds a cell holds one number for each round: the median, the least and the upper quartile are shown.
    """

    name: str
    unit: str = ""
    form: str = "9.3f"
    has_rounds: bool = False


class Table:
    """Prints its title and the names of its columns, then a row at a time."""

    def __init__(self, title, *columns, rows="", width=40):
        self.title, self.columns, self.width = title, columns, width
        _write_facts()
        note(f"{title}, Blender {bpy.app.version_string}")
        heads = []
        for column in columns:
            heads.append(f"{column.name}, {column.unit}" if column.unit not in ("", "x", "%") else column.name)
            heads += ["least", "upper"] if column.has_rounds else []
        self.widths = [max(len(head), 9) for head in heads]
        note(f"{rows:{width}} " + " ".join(f"{head:>{size}}" for head, size in zip(heads, self.widths)))

    def row(self, name, *cells):
        """A number for each column, or all rounds of one; None leaves a cell empty."""
        measures = [_measure(column, cell) for column, cell in zip(self.columns, cells, strict=True) if cell is not None]
        _append({"table": self.title, "row": name, "measures": measures})
        found = {measure["name"]: measure for measure in measures}
        shown = []
        for column in self.columns:
            measure = found.get(column.name, {})
            for key in ("value", "least", "upper") if column.has_rounds else ("value",):
                shown.append(_shown(column, measure.get(key)))
        note(f"{name:{self.width}} " + " ".join(f"{text:>{size}}" for text, size in zip(shown, self.widths)))

    @contextlib.contextmanager
    def guarded(self, name):
        """What raises while a row is measured is told as that row's fault, and the benchmark goes on."""
        try:
            yield
        except Exception as error:
            traceback.print_exc()
            _append({"table": self.title, "row": name, "broken": f"{type(error).__name__}: {error}".strip().splitlines()[0]})
            note(f"{name:{self.width}} broke: {type(error).__name__}")


def note(text):
    """A line for readers. Those that begin with a bar are the benchmark's, all others are Blender's."""
    print(f"| {text}", flush=True)


def _measure(column, cell):
    rounds = np.asarray(cell, float).ravel()
    measure = {"name": column.name, "unit": column.unit, "value": _number(np.median(rounds))}
    if column.has_rounds:
        least, lower, upper = np.percentile(rounds, (0, 25, 75))
        measure.update(least=_number(least), lower=_number(lower), upper=_number(upper), rounds=len(rounds))
    return measure


def _number(value):
    """JSON has no NaN and no infinity."""
    return float(value) if math.isfinite(value) else None


def _shown(column, value):
    if value is None:
        return "-"
    return f"{value:{column.form}}".strip() + (column.unit if column.unit in ("x", "%") else "")


def _append(line):
    path = os.environ.get("MOTUS_BENCH_ROWS")
    if path:
        with open(path, "a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")


def _write_facts():
    """What runs: Blender, and the instruction set of the add-on's library, where the add-on is of a version that tells."""
    facts = {"blender": bpy.app.version_string}
    tell = getattr(support.addon("core.native").module, "instruction_set", None)
    if tell:
        facts["instruction_set"] = tell()
    _append({"facts": facts})
