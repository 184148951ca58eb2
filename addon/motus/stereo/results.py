"""Results of the last check of each rig, kept while the file is open: sentences, and a histogram of parallax."""

from typing import Any, NamedTuple

from ..core.lazy import numpy as np

COLUMNS = 32
NARROWEST = 0.001
"""Least range of the histogram, in parallax; equal parallax everywhere gives one column."""
MOST = 64

_found = {}
"""Results by the name of the camera and its library; the oldest ones are dropped."""


class Result(NamedTuple):
    """Result of a check. lowest, highest: parallax, fractions of the width. shares: part of the samples in each column of the histogram."""

    sentences: tuple
    lowest: float
    highest: float
    shares: Any


def keep(camera, sentences, parallax):
    """Keep the result of a check."""
    values = np.concatenate(parallax) if parallax else np.zeros(0)
    lowest, highest = (float(values.min()), float(values.max())) if len(values) else (0.0, 0.0)
    wider = 0.5 * max(NARROWEST - (highest - lowest), 0.0)
    counts, _ = np.histogram(values, COLUMNS, (lowest - wider, highest + wider))
    _found.pop(camera.name_full, None)
    _found[camera.name_full] = Result(tuple(sentences), lowest, highest, counts / max(len(values), 1))
    while len(_found) > MOST:
        del _found[next(iter(_found))]


def of(camera):
    """Result of a camera's last check, or None."""
    return _found.get(camera.name_full)


def forget(camera):
    """Drop the result of a camera."""
    _found.pop(camera.name_full, None)


def forget_all():
    """Drop all results: another file may have cameras of the same names."""
    _found.clear()
