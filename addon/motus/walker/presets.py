"""Presets of walks: those that Motus brings, and those that users save."""

import math

from ..core.declare import is_owner, registered
from ..core.interface import presets
from ..core.interface.presets import Preset
from .properties import KEYWORDS

OF_THE_SHOT = {
    "use_plane",
    "plane_height",
    "stride",
    "clearance",
    "minimum_step",
    "reach_up",
    "reach_down",
    "ankle",
    "use_soles",
    "heel",
    "toe",
    "jump",
    "transition",
    "use_natural",
    "hip_height",
    "forward_axis",
    "up_axis",
    "influence",
}
"""Settings that presets leave unchanged, as they belong to one body or one shot and not to a style of walking."""

BROUGHT = (
    Preset('SPIDER', "Spider", "Eight legs in two groups, a body that hangs calmly between them", {}),
    Preset(
        'HUNTER',
        "Hunter",
        "Quick steps, and a body that goes along with them",
        {"cadence": 1.8, "use_duty": True, "duty": 0.5, "frequency": 3.0, "damping": 0.7, "body_tilt": 1.0},
    ),
    Preset('INSECT', "Insect", "Two halves that take turns without a pause", {"gait": 'TRIPOD', "cadence": 1.5, "frequency": 2.5}),
    Preset('CRAWLER', "Crawler", "Waves of steps from the back to the front", {"gait": 'RIPPLE', "use_duty": True, "duty": 0.75}),
    Preset(
        'CAUTIOUS',
        "Cautious",
        "A single leg at a time, under a body that hardly moves",
        {"gait": 'WAVE', "cadence": 0.5, "frequency": 0.8, "body_tilt": 0.5},
    ),
    Preset(
        'HORSE',
        "Horse",
        "Diagonal halves take turns, and the body swings a little",
        {"gait": 'TROT', "frequency": 2.0, "damping": 0.6, "body_tilt": 0.5},
    ),
    Preset(
        'CAMEL',
        "Camel",
        "The legs of a side go together, and the body rolls",
        {"gait": 'PACE', "frequency": 1.5, "damping": 0.5, "body_tilt": 1.0},
    ),
    Preset(
        'WALK',
        "Walk",
        "Somebody on two legs, or a horse at its ease",
        {"gait": 'WALK', "frequency": 3.0, "body_tilt": 0.0},
    ),
    Preset(
        'RUN',
        "Run",
        "All feet are in the air between steps, and the heels hardly strike",
        {"gait": 'RUN', "cadence": 1.3, "frequency": 3.0, "body_tilt": 0.0, "strike": math.radians(8.0), "push": math.radians(65.0)},
    ),
    Preset(
        'CANTER',
        "Canter",
        "Three beats and a moment in the air, and the body rocks",
        {"gait": 'CANTER', "cadence": 1.6, "frequency": 2.0, "damping": 0.6, "body_tilt": 0.6},
    ),
    Preset(
        'GALLOP',
        "Gallop",
        "Four quick beats, and long in the air",
        {"gait": 'GALLOP', "cadence": 2.2, "frequency": 2.5, "damping": 0.6, "body_tilt": 0.5},
    ),
    Preset(
        'HOP',
        "Hop",
        "All feet together, as kangaroos and birds go",
        {"gait": 'HOP', "cadence": 1.8, "frequency": 2.5, "damping": 0.7, "body_tilt": 0.5},
    ),
    Preset(
        'MACHINE',
        "Machine",
        "A stiff body, exactly where its feet have it",
        {"gait": 'TRIPOD', "use_duty": True, "duty": 0.55, "frequency": 6.0, "body_tilt": 1.0},
    ),
)


def _settings_of(context):
    obj = context.object
    return obj.motus.walker if obj and is_owner(registered["walker"], obj) else None


SETTINGS = "bpy.context.object.motus.walker"
classes = OPERATOR, PANEL, _ = presets.classes(
    "walker", "Walker", (f"{SETTINGS}.{name}" for name in KEYWORDS if name not in OF_THE_SHOT), BROUGHT, _settings_of
)
