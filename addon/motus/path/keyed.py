"""The past of a keyed setting, read from its F-curve, so that a frame alone equals playback."""

import math
from types import SimpleNamespace
from typing import Any, NamedTuple

from ..core import actions
from ..core.lazy import numpy as np

NODES = 0.5 - 0.5 * math.sqrt(0.6), 0.5, 0.5 + 0.5 * math.sqrt(0.6)
WEIGHTS = 5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0
"""Gauss-Legendre on [0, 1]: exact for polynomials up to degree 5, and never at an end, where a stepped key jumps."""

CLOSE = 1e-4  # frames; nearer bounds are one
SHORT = 2.0  # frames; between nearer keys the value bends so much in a frame that it is halved
STEP = 0.5  # frames, to either side of where a rate is measured


class Samples(NamedTuple):
    """Values of an F-curve at rising frames, and the integral from the first to the last, in frames times the value."""

    frames: Any
    values: Any
    integral: float


def find(owner, settings, name):
    """The F-curve of the active action that animates a setting, or None. `owner` may be evaluated."""
    curve = actions.find(owner, _path(settings, name))
    if curve is None or curve.is_empty or curve.mute or (curve.group and curve.group.mute):
        return None
    return curve


def is_driven(owner, settings, name):
    """Whether a driver sets the setting, so that only its present value is known."""
    animation = owner.animation_data
    driver = animation and animation.drivers.find(_path(settings, name))
    return driver is not None and not driver.mute


def is_in_strips(owner, settings, name):
    """Whether NLA strips take part in the setting's value, so that only its present one is known."""
    animation = owner.animation_data
    if animation is None or not animation.use_nla:
        return False
    replaces = animation.action_blend_type == 'REPLACE' and animation.action_influence == 1.0
    if replaces and find(owner, settings, name):
        return False
    path = _path(settings, name)
    return any(_animates(strip, path) for track in animation.nla_tracks if not track.mute for strip in track.strips)


def samples(curve, first, last):
    """Samples from frame `first` to `last`: these two, and three or more in each frame between."""
    edges = np.array(bounds(curve, first, last))
    widths = np.diff(edges)[:, None]
    nodes = (edges[:-1, None] + widths * np.array(NODES)).ravel().tolist()
    values = list(map(curve.evaluate, nodes))
    parts = np.array(values) * (widths * np.array(WEIGHTS)).ravel()
    # fsum: rounded once, so that the same samples give the same bits in every process.
    return Samples([first, *nodes, last], [curve.evaluate(first), *values, curve.evaluate(last)], math.fsum(parts.tolist()))


def bounds(curve, first, last):
    """Rising frames from `first` to `last`: whole ones and those of the keys, between which the F-curve is smooth."""
    keys = [key.co[0] for key in curve.keyframe_points]
    start, end = first, last
    if keys and curve.extrapolation == 'CONSTANT' and not curve.modifiers:
        start, end = max(first, keys[0]), min(last, keys[-1])
    inner = {*map(float, range(math.ceil(start), math.floor(end) + 1)), *keys, *_repeated(curve, keys, first, last)}
    inner.update(0.5 * (key + following) for key, following in zip(keys, keys[1:]) if following - key < SHORT)
    ordered = [first]
    for frame in sorted(inner):
        if ordered[-1] + CLOSE < frame < last - CLOSE:
            ordered.append(frame)
    return [*ordered, last]


def rate(curve, frame):
    """Change of the value per frame."""
    return (curve.evaluate(frame + STEP) - curve.evaluate(frame - STEP)) / (2.0 * STEP)


def _repeated(curve, keys, first, last):
    """Frames at which a Cycles modifier meets a key again."""
    if len(keys) < 2 or not any(modifier.type == 'CYCLES' and not modifier.mute for modifier in curve.modifiers):
        return []
    period = keys[-1] - keys[0]
    laps = range(math.floor((first - keys[-1]) / period), math.ceil((last - keys[0]) / period) + 1)
    # Those of a mirrored lap as well.
    places = {*keys, *(keys[0] + keys[-1] - key for key in keys)}
    return [place + lap * period for lap in laps for place in places]


def _animates(strip, path):
    """Whether an NLA strip, or one inside it, animates the property."""
    if strip.mute:
        return False
    if strip.type == 'META':
        return any(_animates(inner, path) for inner in strip.strips)
    # A strip names its action and slot as animation data does.
    return actions.find(SimpleNamespace(animation_data=strip), path) is not None


def _path(settings, name):
    return f"{settings.path_from_id()}.{name}"
