"""What the last check of a rig has found, as long as its file is open: sentences, and how parallax is distributed."""

from typing import Any, NamedTuple

from ..core.lazy import numpy as np

COLUMNS = 32
NARROWEST = 0.001
"""Parallax from the first column to the last one at least: what is equally far is one bar."""
MOST = 64

_found = {}
"""Name of the camera with its library -> Result; the oldest ones are dropped."""


class Result(NamedTuple):
    """lowest, highest: parallax, fractions of the width. shares: a histogram, what part of all samples lies in each column between them."""

    sentences: tuple
    lowest: float
    highest: float
    shares: Any


def keep(camera, sentences, parallax):
    """Keep what a check has found."""
    values = np.concatenate(parallax) if parallax else np.zeros(0)
    lowest, highest = (float(values.min()), float(values.max())) if len(values) else (0.0, 0.0)
    wider = 0.5 * max(NARROWEST - (highest - lowest), 0.0)
    counts, _ = np.histogram(values, COLUMNS, (lowest - wider, highest + wider))
    _found.pop(camera.name_full, None)
    _found[camera.name_full] = Result(tuple(sentences), lowest, highest, counts / max(len(values), 1))
    while len(_found) > MOST:
        del _found[next(iter(_found))]


def of(camera):
    """The Result of the last check, or None."""
    return _found.get(camera.name_full)


def forget(camera):
    """There is no check any more."""
    _found.pop(camera.name_full, None)


def forget_all():
    """There is no check of any camera: another file may have some of the same names."""
    _found.clear()
