"""Results of the last check of each rig, kept while the file is open: sentences, and a histogram of parallax."""

from typing import Any, NamedTuple

from ..core import keeping
from ..core.lazy import numpy as np

COLUMNS = 32
NARROWEST = 0.001
"""Least range of the histogram, in parallax; equal parallax everywhere gives one column."""

_found = keeping.OfFile("what the last check of a stereo rig has found (Result)", "name of the camera with its library", most=64)


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
    _found.add(camera.name_full, Result(tuple(sentences), lowest, highest, counts / max(len(values), 1)))


def of(camera):
    """Result of the last check of a camera's stereo rig in this session; None if it was not checked."""
    return _found.get(camera.name_full)


def forget(camera):
    """Drop the result of a camera."""
    _found.drop(camera.name_full)
