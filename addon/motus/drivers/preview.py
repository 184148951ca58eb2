"""Graph of a driver function's motion, with frames and values on its axes, drawn in the dialog of motus.driver_add."""

import math

from ..core import native
from ..core.interface import ui
from ..core.interface.view import graph
from ..core.lazy import numpy as np
from ..core.measures import scene_time, units
from . import expressions, functions

SECONDS = 6.0
COUNT = 257
MARGIN = 0.1
"""Part of an ease's time that the graph shows before and after it."""


def sample(keywords, frames, length):
    """Values (n,) of a driver function at frames, without base and amplitude.

    keywords: the function and its arguments. frames: counted from the start; of Ease the scene's, of Follow Keys from a key that goes at
    once from 0 to 1. length: of a frame, in seconds. Raises ValueError with the name of the wrong argument.
    """
    return _NATIVE[keywords["function"]](native.module, keywords, np.asarray(frames, dtype=float), length)


def _wave(shape):
    def values(module, k, frames, length):
        return module.wave(shape, frames * length * k["frequency"] + k["phase"], k.get("share", 0.5))

    return values


def _steps(module, k, frames, length):
    return module.steps(frames * length * k["frequency"], k["seed"], k["blend"])


def _noise(module, k, frames, length):
    if k["loop"] > 0:
        return module.noise1(*functions.looped(frames, k["loop"], k["loop"] * length * k["speed"], k["seed"]))
    return module.noise1(np.float32(frames * length * k["speed"]), k["seed"])


def _ease(module, k, frames, _length):
    duration = k["frame_end"] - k["frame_start"]
    if duration <= 0.0:
        return np.where(frames >= k["frame_end"], 1.0, 0.0)
    return module.ease((frames - k["frame_start"]) / duration, k["ease_in"], k["ease_out"])


def _pendulum(module, k, frames, length):
    times = frames * length * k["speed"]
    return module.single_pendulum(times, k["theta"], k["omega"], k["length"], k["gravity"], k["damping"])[:, 0]


def _double_pendulum(module, k, frames, length):
    states = module.double_pendulum(
        frames * length * k["speed"],
        k["theta1"],
        k["theta2"],
        k["omega1"],
        k["omega2"],
        k["mass1"],
        k["mass2"],
        k["length1"],
        k["length2"],
        k["gravity"],
        k["damping"],
    )
    return states[:, ('THETA1', 'THETA2', 'OMEGA1', 'OMEGA2').index(k["which"])]


def _second_order(module, k, frames, length):
    return module.step_response(frames * length, k["frequency"], k["damping_ratio"], k["response"])


_NATIVE = {
    'SINE': _wave("sine"),
    'TRIANGLE': _wave("triangle"),
    'SAW': _wave("saw"),
    'SQUARE': _wave("square"),
    'STEPS': _steps,
    'NOISE': _noise,
    'EASE': _ease,
    'PENDULUM': _pendulum,
    'DOUBLE_PENDULUM': _double_pendulum,
    'SECOND_ORDER': _second_order,
}


def draw(layout, keywords, scene, unit):
    """Draw the graph of a motion, or the reason why there is none.

    keywords: of the operator, with the base that counts. unit: of the property, as Blender's properties name it.
    """
    if not ui.draw_native_status(layout):
        return
    function = expressions.BY_IDENTIFIER[keywords["function"]]
    length = scene_time.seconds(scene, 1.0)
    first, last = _range(function, keywords, length)
    frames = np.linspace(first, last, COUNT)
    try:
        values = sample(keywords, frames - keywords["start"] if function.has_start else frames, length)
    except ValueError as error:
        ui.draw_message(layout, str(error), 'ERROR')
        return
    if function.follows:
        unit = 'NONE'
    else:
        values = keywords["base"] + keywords["amplitude"] * values
    shown = units.shown(scene, unit)
    heights = {
        height / shown.factor: shown.text(height) for height in graph.ticks(values.min() * shown.factor, values.max() * shown.factor)
    }
    graph.draw(layout, "drivers", values, heights, [f"{frame:.5g}" for frame in (first, (first + last) / 2.0, last)])


def _range(function, keywords, length):
    """First and last frame that the graph shows. length: of a frame, in seconds."""
    if "frame_end" in function.arguments:
        duration = max(keywords["frame_end"] - keywords["frame_start"], 1.0)
        return keywords["frame_start"] - MARGIN * duration, keywords["frame_start"] + (1.0 + MARGIN) * duration
    first = keywords["start"] if function.has_start else 0.0
    return first, first + math.ceil(SECONDS / length)
