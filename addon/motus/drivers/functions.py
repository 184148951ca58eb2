"""Functions for driver expressions, also of files whose scripts may not run by themselves.

A driver whose function raises is not called again, so none does: what it cannot compute is its value at rest, and the console
says why once. `problem` tells the panel.
"""

import logging
import math

import bpy
from bpy.app.handlers import persistent

from ..core import native
from ..core.blender import handlers
from ..core.evaluated.per_thread import keep_state
from ..core.measures import scene_time
from ..core.refusals import INFINITE
from . import history

MOST_SAID = 100  # sentences in the console, of a file

log = logging.getLogger(__name__)

_said = set()


def seconds(frame):
    """The time of a frame of the scene that is being evaluated."""
    # Blender puts the depsgraph there for each driver; the expressions of users do not hand it on.
    return scene_time.seconds(bpy.app.driver_namespace["depsgraph"].scene, frame)


def motus_pendulum(frame, theta, length, omega=0.0, gravity=9.81, damping=0.0, speed=1.0):
    """Angle of a pendulum, radians from hanging down, which at frame 0 stood at theta with the angular velocity omega.

    length: metres. gravity: m/s^2. damping: 1/s. speed: of time.
    """
    try:
        keep_state()
        return _held(native.module.pendulum_angle(seconds(frame) * speed, theta, omega, length, gravity, damping))
    except Exception as error:
        return _at_rest("motus_pendulum", error, theta)


def motus_double_pendulum(frame, which, theta1, theta2, omega1=0.0, omega2=0.0, mass1=1.0, mass2=1.0, length1=1.0,
                          length2=1.0, gravity=9.81, damping=0.0, speed=1.0):
    """Of a double pendulum, `which` is 0: the upper rod's angle; 1: the lower's; 2 and 3: their angular velocities.

    Both angles are radians from hanging down; at frame 0 they were theta1 and theta2. Units as motus_pendulum.
    """
    try:
        keep_state()
        return _held(native.module.double_pendulum_value(
            seconds(frame) * speed, which, theta1, theta2, omega1, omega2, mass1, mass2, length1, length2, gravity, damping))
    except Exception as error:
        rest = theta1 if which == 0 else theta2 if which == 1 else 0.0
        return _at_rest("motus_double_pendulum", error, rest)


def motus_ease(frame, start, end, ease_in=0.3, ease_out=0.3):
    """From 0 at the frame `start` to 1 at the frame `end`, sped up over the fraction ease_in, slowed down over ease_out."""
    try:
        keep_state()
        if not end > start:
            return float(frame >= end)
        return native.module.ease((frame - start) / (end - start), float(ease_in), float(ease_out))
    except Exception as error:
        return _at_rest("motus_ease", error, 0.0)


def motus_noise(frame, speed=1.0, seed=0):
    """Smooth noise in [-1, 1]. speed: about how many times it goes up and down in a second."""
    try:
        keep_state()
        return native.module.noise1(seconds(frame) * speed, seed)
    except Exception as error:
        return _at_rest("motus_noise", error, 0.0)


def motus_second_order(self, data_path, index, frame, f=1.0, zeta=0.5, r=0.0):
    """What follows the keys of a property of the same datablock by second-order dynamics.

    f: the frequency, Hz. zeta: the damping. r: the response. index: in an array.

    Also on that property itself: its keys are followed then. At rest up to the scene's first frame.
    """
    try:
        keep_state()
        return _held(history.followed(
            self, data_path, index, frame, bpy.app.driver_namespace["depsgraph"].scene, (float(f), float(zeta), float(r))))
    except Exception as error:
        return _at_rest("motus_second_order", error, history.present(self, data_path, index))


def _held(value):
    """The value, which a property of Blender's has to hold."""
    if not abs(value) < INFINITE:
        raise ValueError("the value is too large for a property")
    return value


def _at_rest(name, error, value):
    # What the native module says of other types is written for C++.
    sentence = f"{name}: {'an argument is no number' if isinstance(error, TypeError) else error}"
    if native.module is not None and sentence not in _said and len(_said) < MOST_SAID:
        _said.add(sentence)
        log.warning("Motus: %s", sentence)
    return float(value) if isinstance(value, (int, float)) and math.isfinite(value) else 0.0


FUNCTIONS = {one.__name__: one for one in (
    motus_pendulum, motus_double_pendulum, motus_ease, motus_noise, motus_second_order)}


@persistent
def _fill_namespace(*_):
    _said.clear()
    bpy.app.driver_namespace.update(FUNCTIONS)


def _watched():
    return ((bpy.app.handlers.load_post, _fill_namespace),)


def register():
    """Make the functions known, now and after every file load, which clears the namespace."""
    _fill_namespace()
    handlers.add(_watched())


def unregister():
    """Take them back."""
    handlers.remove(_watched())
    for name in FUNCTIONS:
        bpy.app.driver_namespace.pop(name, None)
