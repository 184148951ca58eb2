"""Presets for the settings of a pendulum."""

import math

from ..core.interface import presets
from ..core.interface.presets import Preset
from .properties import KEYWORDS

# Settings that presets do not store, because they depend on the shot.
OF_THE_SHOT = {"start_frame", "is_playing", "influence"}

BROUGHT = (
    Preset('WILD', "Wild", "Tumbles over itself, and no two swings are alike", {}),
    Preset(
        'CLOCK',
        "Clock",
        "Beats a second to each side",
        {"length1": 0.994, "length2": 0.1, "mass2": 0.01, "angle1": math.radians(5.0), "angle2": math.radians(5.0)},
    ),
    Preset(
        'LAMP',
        "Hanging Lamp",
        "Swings out and comes to rest",
        {"length1": 1.5, "length2": 0.3, "mass2": 0.2, "angle1": math.radians(30.0), "angle2": math.radians(30.0), "damping": 0.6},
    ),
    Preset(
        'WRECKER',
        "Wrecking Ball",
        "A heavy ball on a long arm",
        {
            "length1": 1.0,
            "length2": 4.0,
            "mass1": 0.2,
            "mass2": 10.0,
            "angle1": math.radians(-50.0),
            "angle2": math.radians(-50.0),
            "damping": 0.05,
        },
    ),
    Preset(
        'CONE',
        "Conical Pendulum",
        "Goes round at one height, if its kind is Spherical",
        {"angle1": math.radians(30.0), "velocity_sideways": math.sin(math.radians(30.0)) * math.sqrt(9.81 / math.cos(math.radians(30.0)))},
    ),
    Preset(
        'ROSETTE',
        "Rosette",
        "Draws a flower that slowly turns, if its kind is Spherical",
        {"length1": 2.0, "angle1": math.radians(50.0), "velocity_sideways": 0.5},
    ),
    Preset('MOON', "On the Moon", "A sixth of the weight", {"use_scene_gravity": False, "gravity": 1.62}),
)


def _settings(context):
    settings = context.object and context.object.motus.pendulum
    return settings if settings and settings.is_active else None


classes = OPERATOR, PANEL, _ = presets.classes(
    "pendulum",
    "Pendulum",
    (f"bpy.context.object.motus.pendulum.{name}" for name in KEYWORDS if name not in OF_THE_SHOT),
    BROUGHT,
    _settings,
)
