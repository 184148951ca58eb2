"""Write motion drivers out as plain Blender, which needs no Motus: expressions that Blender evaluates without Python, or keys."""

import math

from ..core.animation import channel, fitted_keys
from ..core.blender import actions
from ..core.blender.frames import Kept, depsgraph_of, go_to
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.refusals import Refused
from ..core.translations import tr
from . import expressions

PARTS = 4
"""Samples per frame, between which a curve of keys may differ by more than the error."""
MOST = 20000  # most frames that are written as keys
GROUP = "Motus"


def expression(keywords, scene):
    """Expression of Blender's own terms with the value of a motion driver, at the scene's frame rate; "" if there is none.

    keywords: of the motion driver. Blender evaluates such an expression without Python.
    """
    make = _PLAIN.get(keywords["function"])
    text = make(keywords, scene) if make else ""
    if text:
        text = expressions.scaled(f"({text})", keywords)
    return text if len(text) <= expressions.LONGEST else ""


def _place(keywords, scene, ahead=0.0):
    """The number of waves up to the frame, plus `ahead`, computed as motus_sine() and the like do."""
    render = scene.render
    moved = expressions.frame_since(keywords["start"])
    text = f"({moved})" if " " in moved else moved
    text += f" * {_text(keywords['frequency'])}"
    if render.fps_base != 1.0:
        text += f" * {render.fps_base!r}"
    text += f" / {render.fps}"
    phase = keywords["phase"] + ahead
    return f"{text} + {_text(phase)}" if phase != 0.0 else text


def _text(value):
    return f"{value:.12g}"


def _sine(keywords, scene):
    return f"sin(2 * pi * ({_place(keywords, scene)}))"


def _triangle(keywords, scene):
    place = _place(keywords, scene, ahead=0.75)
    return f"4 * abs({place} - floor({place}) - 0.5) - 1"


def _saw(keywords, scene):
    place = _place(keywords, scene)
    return f"2 * ({place} - floor({place})) - 1"


def _square(keywords, scene):
    place = _place(keywords, scene)
    return f"1 if {place} - floor({place}) < {_text(keywords['share'])} else -1"


def _ease(keywords, _scene):
    """The formula of the native ease: constant speed, less what is lost while the motion speeds up and slows down."""
    start, end, ease_in, ease_out = (keywords[name] for name in ("frame_start", "frame_end", "ease_in", "ease_out"))
    if not end > start:
        return f"1 if frame >= {_text(end)} else 0"
    u = f"clamp(({expressions.frame_since(start)}) / {_text(end - start)})"
    text = f"{u} - {_text(ease_in / 2.0)}" if ease_in else u
    if ease_in:
        text += f" + pow(max({_text(ease_in)} - {u}, 0), 2) / {_text(2.0 * ease_in)}"
    if ease_out:
        text += f" - pow(max({u} - {_text(1.0 - ease_out)}, 0), 2) / {_text(2.0 * ease_out)}"
    return f"({text}) / {_text(1.0 - (ease_in + ease_out) / 2.0)}"


_PLAIN = {'SINE': _sine, 'TRIANGLE': _triangle, 'SAW': _saw, 'SQUARE': _square, 'EASE': _ease}


def write_expression(place, text):
    """Replace the expression of a driver of Motus by one of Blender's own terms. place: of the driven property."""
    place.set_expression(text)


class Keys:
    """What a motion driver does to a property, recorded frame by frame and written as keys, without the driver.

    place: of the driven property. first, last: frames of the keys' time. times: frames of the keys' time at which the value is recorded,
    rising.
    """

    def __init__(self, place, scene, first, last):
        keywords = expressions.read(place.curve.driver.expression) or {}
        self._place = place
        self._is_held = keywords.get("function") == 'STEPS' and keywords["blend"] == 0.0
        self._loops = 0 < keywords.get("loop", 0) <= MOST
        if self._is_held:
            jumps, length = _jumps(keywords, scene, first, last)
            # Recorded in the middle of each step, since rounding may put a jump on either side of its own frame.
            self._keys, self.times = [first, *jumps], [first, *(jump + length / 2.0 for jump in jumps)]
        else:
            self._keys = self.times = _samples(first, first + keywords["loop"] if self._loops else last)
        self._values = {}

    def record(self, depsgraph, time):
        """Note the value at one of the times."""
        self._values[time] = self._place.evaluated(depsgraph)

    def write(self, tolerance):
        """Replace the driver by keys; returns their number. tolerance: largest error, in units of the property."""
        place, times = self._place, np.array(self._keys)
        samples = np.array([self._values[time] for time in self.times], dtype=float)
        place.remove()
        curve = _emptied(place, self._keys[0])
        if self._loops:  # before the keys: Blender does not evaluate a modifier that comes after everything else
            curve.modifiers.new('CYCLES')
        if self._is_held or channel.number(place.holder, place.path, place.index).type != 'FLOAT':
            fitted_keys.write_steps(curve, times, samples)
        else:
            fitted_keys.write(curve, times, samples, tolerance)
        return len(curve.keyframe_points)


def _samples(first, last):
    steps = math.ceil((last - first) * PARTS)
    return [first + (last - first) * step / steps for step in range(steps + 1)]


def _jumps(keywords, scene, first, last):
    """Times after `first` up to `last` at which random steps jump, and the length of a step, both in frames."""
    length = scene_time.fps(scene) / keywords["frequency"] if keywords["frequency"] > 0.0 else math.inf
    start = keywords["start"]
    if not (last - first) / length <= MOST:
        raise Refused(tr("More than {most} steps: lower the frequency, or choose fewer frames").format(most=MOST))
    if math.isinf(length):
        return [], length
    numbers = range(math.floor((first - start) / length) + 1, math.floor((last - start) / length) + 1)
    return [start + number * length for number in numbers], length


def _emptied(place, time):
    """F-curve of a property, without keys and modifiers."""
    # keyframe_insert() makes the action, slot and F-curve as the running version of Blender needs them.
    try:
        place.struct.keyframe_insert(place.name, index=place.index, frame=time, group=GROUP)
    except RuntimeError as error:
        raise Refused(str(error)) from error
    curve = actions.find(place.holder, place.path, max(place.index, 0))
    while curve.modifiers:
        curve.modifiers.remove(curve.modifiers[0])
    for key in reversed(curve.keyframe_points):
        curve.keyframe_points.remove(key, fast=True)
    return curve


def record(context, made):
    """Record Keys of several properties in one pass, and go back to the present frame."""
    scene = context.scene
    kept = Kept(scene)
    at = {}
    for one in made:
        for time in one.times:
            at.setdefault(time, []).append(one)
    for time in sorted(at):
        go_to(scene, scene_time.time_line(scene, time))
        depsgraph = depsgraph_of(scene, context.view_layer.name)
        for one in at[time]:
            one.record(depsgraph, time)
    kept.restore()
