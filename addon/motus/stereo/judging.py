"""What is wrong with a rig on one frame: numbers by kinds, and the sentences that tell them."""

from typing import Any, NamedTuple

from ..core import native
from ..core.blender.frames import spoken
from ..core.lazy import numpy as np
from ..core.translations import tr

HIDDEN_PIXELS = 1.0
"""Parallax in front of the screen at an edge that nobody sees, and vertical parallax too."""


class Seen(NamedTuple):
    """Parallax of the samples of a frame, fractions of the width; faults: {kind: how bad}."""

    parallax: Any
    faults: dict


def judge(eyes, lens, screen, pixels, x, depths):
    """The Seen of samples. eyes, screen: keywords of the native module. pixels: the image's width."""
    if len(depths) == 0:
        return Seen(np.zeros(0), {'EMPTY': 0.0})
    call = native.module
    parallax = call.parallax(depths, **eyes)
    limit = call.divergence_limit(screen["width"], screen["eye_separation"])
    near, far = call.comfortable_parallax(**screen)
    left, right = call.window_violations(x, depths, **eyes, tolerance=HIDDEN_PIXELS / pixels)
    vertical = _vertical(float(np.min(depths)), lens, eyes)
    highest, lowest = float(np.max(parallax)), float(np.min(parallax))
    found = {
        'DIVERGES': highest - limit, 'FAR': highest - far if highest <= limit else 0.0, 'NEAR': -lowest - near,
        'LEFT': left, 'RIGHT': right, 'VERTICAL': vertical - HIDDEN_PIXELS / pixels}
    return Seen(parallax, {kind: value for kind, value in found.items() if value > 0.0})


def _vertical(depth, lens, eyes):
    """Vertical parallax of a corner at a depth; the whole width of the image where one eye is turned away from it."""
    try:
        return native.module.vertical_parallax(depth, lens.aspect, **eyes)
    except ValueError:
        return 1.0


def sentence(kind, worst, frames, screen, pixels):
    """A fault in words. worst: of all frames. frames: as text."""
    words = {
        "percent": f"{100.0 * worst:.2g}", "pixels": f"{pixels * worst:.0f}", "width": f"{screen['width']:g}", "frames": spoken(frames)}
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
