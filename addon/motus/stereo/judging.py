"""Judge a stereo rig on one frame: a number for each kind of fault, and the sentences that report faults."""

from typing import Any, NamedTuple

from ..core import native
from ..core.blender.frames import spoken
from ..core.lazy import numpy as np
from ..core.translations import tr

HIDDEN_PIXELS = 1.0
"""Parallax in pixels that viewers do not notice: in front of the screen at an edge of the image, and vertical parallax."""


class Seen(NamedTuple):
    """Judgement of one frame.

    parallax: array of the samples' parallax, in fractions of the image width. faults: {kind: value of the worst sample}, a key of SENTENCES
    for each fault found.
    """

    parallax: Any
    faults: dict


def judge(eyes, lens, screen, window, pixels, x, depths):
    """Judge the sampled depths of a frame; returns a Seen.

    eyes, screen: keyword arguments of the native functions. window: parallax of the left and right edge of the floating
    window, fractions of the image's width. pixels: width of the image. x, depths: samples from samples.take().
    """
    if len(depths) == 0:
        return Seen(np.zeros(0), {'EMPTY': 0.0})
    call = native.module
    parallax = call.parallax(depths, **eyes)
    limit = call.divergence_limit(screen["width"], screen["eye_separation"])
    near, far = call.comfortable_parallax(**screen)
    hidden = HIDDEN_PIXELS / pixels
    edges = call.window_violations(x, depths, **eyes, tolerance=hidden)
    left, right = (found if found > edge + hidden else 0.0 for found, edge in zip(edges, window))
    vertical = _vertical(float(np.min(depths)), lens, eyes)
    highest, lowest = float(np.max(parallax)), float(np.min(parallax))
    found = {
        'DIVERGES': highest - limit,
        'FAR': highest - far if highest <= limit else 0.0,
        'NEAR': -lowest - near,
        'LEFT': left,
        'RIGHT': right,
        'VERTICAL': vertical - hidden,
    }
    return Seen(parallax, {kind: value for kind, value in found.items() if value > 0.0})


def _vertical(depth, lens, eyes):
    """Vertical parallax of the image corner at a depth, in fractions of the image width; 1.0 if the corner is behind an eye."""
    try:
        return native.module.vertical_parallax(depth, lens.aspect, **eyes)
    except ValueError:
        return 1.0


def sentence(kind, worst, frames, screen, pixels):
    """Sentence in the user's language that reports a fault of a stereo rig.

    kind: key of SENTENCES. worst: largest value of the fault, a fraction of the image width. frames: the frames with the fault, as text.
    screen: keywords of the native library. pixels: width of the image.
    """
    words = {
        "percent": f"{100.0 * worst:.2g}",
        "pixels": f"{pixels * worst:.0f}",
        "width": f"{screen['width']:g}",
        "frames": spoken(frames),
    }
    return SENTENCES[kind]().format(**words)


SENTENCES = {
    'EMPTY': lambda: tr("The camera sees nothing that has a depth in {frames}"),
    'DIVERGES': lambda: tr("Diverges on a {width} m screen by {percent} % in {frames}"),
    'FAR': lambda: tr("Is too far behind a {width} m screen by {percent} % in {frames}"),
    'NEAR': lambda: tr("Is too far in front of a {width} m screen by {percent} % in {frames}"),
    'LEFT': lambda: tr("The window is violated on the left edge by {percent} % in {frames}"),
    'RIGHT': lambda: tr("The window is violated on the right edge by {percent} % in {frames}"),
    'VERTICAL': lambda: tr("Corners are higher in one eye than in the other by more than a pixel, {pixels} pixels, in {frames}"),
}
