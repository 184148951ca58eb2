"""Functions for driver expressions; they also work in files whose Python scripts Blender does not run automatically.

Blender disables a driver whose function has raised an exception. So the functions never raise: if there is no valid result, they return the
value at rest, and print the reason to the console once. The panel shows the reason too.
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

MOST_SAID = 100  # most sentences that are printed to the console for a file

log = logging.getLogger(__name__)

_said = set()


def seconds(frame):
    """Time of a frame in seconds, by the frame rate of the scene that the depsgraph is evaluating."""
    # Blender passes the depsgraph to each driver; users' expressions do not pass it on to the functions.
    return scene_time.seconds(bpy.app.driver_namespace["depsgraph"].scene, frame)


def waves(frame, frequency):
    """Number of waves or steps up to a frame, at so many per second: exact at frames where it is a whole number."""
    render = bpy.app.driver_namespace["depsgraph"].scene.render
    return frame * frequency * render.fps_base / render.fps


def motus_pendulum(frame, theta, length, omega=0.0, gravity=9.81, damping=0.0, speed=1.0):
    """Angle of a pendulum, in radians from hanging down, that starts at frame 0 with angle theta and angular velocity omega.

    length: metres. gravity: m/s^2. damping: 1/s. speed: factor on time.
    """
    try:
        keep_state()
        return _held(native.module.pendulum_angle(seconds(frame) * speed, theta, omega, length, gravity, damping))
    except Exception as error:
        return _at_rest("motus_pendulum", error, theta)


def motus_double_pendulum(
    frame,
    which,
    theta1,
    theta2,
    omega1=0.0,
    omega2=0.0,
    mass1=1.0,
    mass2=1.0,
    length1=1.0,
    length2=1.0,
    gravity=9.81,
    damping=0.0,
    speed=1.0,
):
    """One value of a double pendulum. which: 0 upper angle, 1 lower angle, 2 upper and 3 lower angular velocity.

    Angles are radians from hanging down, angular velocities radians per second. theta1, theta2, omega1 and omega2 are the state at
    frame 0. mass1, mass2: kilograms. length1, length2: metres. gravity: m/s^2. damping: 1/s. speed: factor on time.
    """
    try:
        keep_state()
        return _held(
            native.module.double_pendulum_value(
                seconds(frame) * speed, which, theta1, theta2, omega1, omega2, mass1, mass2, length1, length2, gravity, damping
            )
        )
    except Exception as error:
        rest = theta1 if which == 0 else theta2 if which == 1 else 0.0
        return _at_rest("motus_double_pendulum", error, rest)


def motus_ease(frame, start, end, ease_in=0.3, ease_out=0.3):
    """Ease from 0 at frame `start` to 1 at frame `end`.

    ease_in, ease_out: fractions of the duration in which the value accelerates and slows down.
    """
    try:
        keep_state()
        if not end > start:
            return float(frame >= end)
        return native.module.ease((frame - start) / (end - start), float(ease_in), float(ease_out))
    except Exception as error:
        return _at_rest("motus_ease", error, 0.0)


def motus_noise(frame, speed=1.0, seed=0, loop=0.0):
    """Smooth noise in [-1, 1] at a frame.

    speed: approximate number of ups and downs per second. seed: chooses the noise. loop: frames after which the noise repeats; 0 never.
    """
    try:
        keep_state()
        if loop > 0.0:
            return native.module.noise1(*looped(frame, loop, seconds(loop) * speed, seed))
        return native.module.noise1(seconds(frame) * speed, seed)
    except Exception as error:
        return _at_rest("motus_noise", error, 0.0)


def looped(frame, loop, units, seed):
    """Arguments with which the native noise1 repeats after `loop` frames. units: of noise in a loop, which are rounded to whole ones."""
    whole = max(1, round(abs(units)))
    return frame % loop / loop * whole, seed, whole


def motus_sine(frame, frequency=1.0, phase=0.0):
    """Sine in [-1, 1], which rises from 0 at frame 0. frequency: waves per second. phase: fraction of a wave that it is ahead."""
    return _wave("sine", frame, frequency, phase)


def motus_triangle(frame, frequency=1.0, phase=0.0):
    """Straight ups and downs in [-1, 1], which rise from 0 at frame 0. Arguments as motus_sine()."""
    return _wave("triangle", frame, frequency, phase)


def motus_saw(frame, frequency=1.0, phase=0.0):
    """Straight rise from -1 to 1 in each wave, and a jump back. Arguments as motus_sine()."""
    return _wave("saw", frame, frequency, phase)


def motus_square(frame, frequency=1.0, phase=0.0, share=0.5):
    """1 in the first part of each wave, and then -1. share: fraction of a wave that the part is; further arguments as motus_sine()."""
    return _wave("square", frame, frequency, phase, share)


def _wave(shape, frame, frequency, phase, share=0.5):
    try:
        keep_state()
        return native.module.wave(shape, waves(frame, frequency) + phase, share)
    except Exception as error:
        return _at_rest(f"motus_{shape}", error, 0.0)


def motus_steps(frame, frequency=1.0, seed=0, blend=0.0):
    """Random number in [-1, 1], and another one `frequency` times per second. seed: chooses the numbers.

    blend: fraction of a step in which the value goes over smoothly from the number before; 0 jumps.
    """
    try:
        keep_state()
        return native.module.steps(waves(frame, frequency), seed, blend)
    except Exception as error:
        return _at_rest("motus_steps", error, 0.0)


def motus_second_order(self, data_path, index, frame, f=1.0, zeta=0.5, r=0.0):
    """Value of a property of the driven datablock, followed by second-order dynamics (like a mass on a spring).

    self, data_path, index: the driven struct, and the property with its array index. f: frequency, Hz. zeta: damping ratio. r: initial
    response. If the property is the driven property, its keys are followed. Until the scene's first frame the result is at rest.
    """
    try:
        keep_state()
        return _held(
            history.followed(self, data_path, index, frame, bpy.app.driver_namespace["depsgraph"].scene, (float(f), float(zeta), float(r)))
        )
    except Exception as error:
        return _at_rest("motus_second_order", error, history.present(self, data_path, index))


def _held(value):
    """Return the value if it is finite and fits into a float property of Blender; raise ValueError otherwise."""
    if not abs(value) < INFINITE:
        raise ValueError("the value is too large for a property")
    return value


def _at_rest(name, error, value):
    # A TypeError of the native module names C++ types, so that a plain sentence replaces its message.
    sentence = f"{name}: {'an argument is no number' if isinstance(error, TypeError) else error}"
    if native.module is not None and sentence not in _said and len(_said) < MOST_SAID:
        _said.add(sentence)
        log.warning("Motus: %s", sentence)
    return float(value) if isinstance(value, (int, float)) and math.isfinite(value) else 0.0


FUNCTIONS = {
    one.__name__: one
    for one in (
        motus_sine,
        motus_triangle,
        motus_saw,
        motus_square,
        motus_steps,
        motus_noise,
        motus_ease,
        motus_pendulum,
        motus_double_pendulum,
        motus_second_order,
    )
}


@persistent
def _fill_namespace(*_):
    _said.clear()
    bpy.app.driver_namespace.update(FUNCTIONS)


def _watched():
    return ((bpy.app.handlers.load_post, _fill_namespace),)


def register():
    """Add the functions to Blender's driver namespace now and after every file load, which clears the namespace."""
    _fill_namespace()
    handlers.add(_watched())


def unregister():
    """Remove the functions from Blender's driver namespace."""
    handlers.remove(_watched())
    for name in FUNCTIONS:
        bpy.app.driver_namespace.pop(name, None)
