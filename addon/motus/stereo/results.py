"""Results of the last check of each stereo rig, kept while the file is open: sentences on faults, and a histogram of parallax."""

from typing import Any, NamedTuple

from ..core import keeping
from ..core.lazy import numpy as np

COLUMNS = 32
NARROWEST = 0.001
"""Least range of the histogram, in fractions of the image width; if all parallax is equal, one column contains all samples."""

_found = keeping.OfFile("results of the last check of each stereo rig (Result)", "name and library of the camera", most=64)


class Result(NamedTuple):
    """Result of a check.

    sentences: one for each fault. lowest, highest: parallax in fractions of the image width. shares: share of the samples in each column of
    the histogram.
    """

    sentences: tuple
    lowest: float
    highest: float
    shares: Any


def keep(camera, sentences, parallax):
    """Store the result of a check of a camera's stereo rig.

    sentences: one for each fault. parallax: list of arrays, one for each frame.
    """
    values = np.concatenate(parallax) if parallax else np.zeros(0)
    lowest, highest = (float(values.min()), float(values.max())) if len(values) else (0.0, 0.0)
    wider = 0.5 * max(NARROWEST - (highest - lowest), 0.0)
    counts, _ = np.histogram(values, COLUMNS, (lowest - wider, highest + wider))
    _found.add(camera.name_full, Result(tuple(sentences), lowest, highest, counts / max(len(values), 1)))


def of(camera):
    """Result of the last check of a camera's stereo rig in this session; None if it was not checked."""
    return _found.get(camera.name_full)


def forget(camera):
    """Delete the stored result of a camera's check."""
    _found.drop(camera.name_full)
