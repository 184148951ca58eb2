"""The past of a keyed setting: samples of its F-curve, so that a frame alone equals playback."""

import math

import numpy as np

from ..core import actions

STEP = 0.5  # frames between samples
BEFORE_STEP = 1e-3  # frames; a stepped key gets a sample this much earlier


def find(owner, settings, name):
    """The F-curve that animates a setting, or None. `owner` may be evaluated."""
    curve = actions.find(owner, _path(settings, name))
    return None if curve is None or curve.mute else curve


def is_driven(owner, settings, name):
    """Whether a driver sets the setting, so that only its present value is known."""
    animation = owner.animation_data
    return animation is not None and animation.drivers.find(_path(settings, name)) is not None


def samples(curve, first, last):
    """(frames, values) from frame `first` to `last` or a little beyond; outside, the end values hold.

    The frames depend on the F-curve and `first`; `last` only says where they end.
    """
    keys = [key.co[0] for key in curve.keyframe_points]
    if keys and curve.extrapolation == 'CONSTANT' and not curve.modifiers:
        first = min(max(first, keys[0]), keys[-1])
        last = max(first, min(last, keys[-1]))
    count = max(0, math.ceil((last - first) / STEP)) + 1
    frames = {first + STEP * index for index in range(count)}
    end = first + STEP * (count - 1)
    stepped = [following - BEFORE_STEP for key, following in zip(curve.keyframe_points, keys[1:])
               if key.interpolation == 'CONSTANT']
    frames.update(frame for frame in keys + stepped if first < frame < end)
    ordered = sorted(frames)
    return np.array(ordered), np.array([curve.evaluate(frame) for frame in ordered])


def rate(curve, frame):
    """Change of the value per frame."""
    return (curve.evaluate(frame + STEP) - curve.evaluate(frame - STEP)) / (2.0 * STEP)


def _path(settings, name):
    return f"{settings.path_from_id()}.{name}"
