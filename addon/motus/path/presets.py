"""Presets of a follower's settings."""

import math

from ..core.interface import presets
from ..core.interface.presets import Preset
from .properties import KEYWORDS

# A preset leaves out settings that belong to one shot, such as frames and distances.
OF_THE_SHOT = {
    "spline",
    "start_frame",
    "offset",
    "distance_factor",
    "distance",
    "rail_spline",
    "side",
    "height",
    "wheelbase",
    "influence",
}

BROUGHT = (
    Preset(
        'AIRCRAFT',
        "Aircraft",
        "Even speed, and the bank that an aircraft needs in its curves",
        {"timing": 'SPEED', "speed": 12.0, "orientation": 'BANKING', "bank_limit": math.radians(70.0), "bank_smoothing": 2.0},
    ),
    Preset(
        'BIRD',
        "Bird",
        "Leans gently, and its body trails behind the turn",
        {
            "timing": 'SPEED',
            "speed": 6.0,
            "orientation": 'BANKING',
            "bank_strength": 0.6,
            "bank_limit": math.radians(45.0),
            "bank_smoothing": 1.0,
            "lag_rate": 4.0,
            "lag_by": 'CURVATURE',
        },
    ),
    Preset('CAR', "Car", "Starts and stops gently, upright", {"ease_in": 0.15, "ease_out": 0.2}),
    Preset(
        'COASTER',
        "Roller Coaster",
        "Up points to the middle of each bend, also in loopings",
        {"timing": 'SPEED', "speed": 8.0, "orientation": 'CURVATURE', "bank_smoothing": 3.0},
    ),
    Preset(
        'RAILS',
        "Coaster on Two Rails",
        "The path is the left rail, and the curve that is chosen as Rail the right one",
        {"timing": 'SPEED', "speed": 8.0, "orientation": 'RAIL', "rail_side": 'RIGHT'},
    ),
    Preset('CAMERA', "Camera Move", "Soft at both ends, never rolling", {"ease_in": 0.3, "ease_out": 0.3}),
    Preset('BEAD', "Bead on a String", "Turned as little as possible along the path", {"orientation": 'MINIMAL'}),
)


def _settings(context):
    settings = context.object and context.object.motus.path
    return settings if settings and settings.is_active else None


classes = OPERATOR, PANEL, _ = presets.classes(
    "path", "Follow Path", (f"bpy.context.object.motus.path.{name}" for name in KEYWORDS if name not in OF_THE_SHOT), BROUGHT, _settings
)
