"""Results of the last check of each stereo rig, kept while the file is open: sentences, and the parallax as a histogram and over frames."""

from typing import Any, NamedTuple

from ..core import keeping
from ..core.lazy import numpy as np

COLUMNS = 32
NARROWEST = 0.001
"""Least range of the histogram, in fractions of the image width; if all parallax is equal, one column contains all samples."""

_found = keeping.OfFile("results of the last check of each stereo rig (Result)", "name and library of the camera", most=64)


class OnFrame(NamedTuple):
    """What a check has found on one frame.

    parallax: array of the samples' parallax, in fractions of the image width. convergence: distance, infinite for parallel eyes. is_faulty:
    whether there is a fault.
    """

    frame: float
    parallax: Any
    convergence: float
    is_faulty: bool


class Result(NamedTuple):
    """Result of a check.

    sentences: one for each fault. verdict: the sentence that there is none, or empty. lowest, highest: parallax in fractions of the image
    width. shares: share of the samples in each column of the histogram. frames: (m,) frames on which the camera sees something; nearest,
    farthest, convergence, is_faulty: (m,), of each of them, nearest and farthest as parallax.
    """

    sentences: tuple
    verdict: str
    lowest: float
    highest: float
    shares: Any
    frames: Any
    nearest: Any
    farthest: Any
    convergence: Any
    is_faulty: Any


def keep(camera, sentences, verdict, on_frames):
    """Store the result of a check of a camera's stereo rig.

    sentences, verdict: as Result has them. on_frames: list of OnFrame.
    """
    seen = [one for one in on_frames if len(one.parallax)]
    values = np.concatenate([one.parallax for one in seen]) if seen else np.zeros(0)
    lowest, highest = (float(values.min()), float(values.max())) if len(values) else (0.0, 0.0)
    wider = 0.5 * max(NARROWEST - (highest - lowest), 0.0)
    counts, _ = np.histogram(values, COLUMNS, (lowest - wider, highest + wider))
    over_frames = (
        [one.frame for one in seen],
        [one.parallax.min() for one in seen],
        [one.parallax.max() for one in seen],
        [one.convergence for one in seen],
        [one.is_faulty for one in seen],
    )
    shares = counts / max(len(values), 1)
    _found.add(camera.name_full, Result(tuple(sentences), verdict, lowest, highest, shares, *map(np.array, over_frames)))


def of(camera):
    """Result of the last check of a camera's stereo rig in this session; None if it was not checked."""
    return _found.get(camera.name_full)


def forget(camera):
    """Delete the stored result of a camera's check."""
    _found.drop(camera.name_full)
