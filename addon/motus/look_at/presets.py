"""Presets of Look At for the settings of one head."""

import math

from ..core.interface import presets
from ..core.interface.bone_entries import selected
from ..core.interface.presets import Preset
from .properties import KEYWORDS, SIDE_LIMITS

ENTRY = "bpy.context.object.motus.look_at.entries[bpy.context.object.motus.look_at.active_entry]"
# Settings that belong to one rig or one shot, which presets leave out, and copying unless asked.
OF_THE_HEAD = {"weight", "head_forward", "eyes_forward", "eyes_seed"}


# How far people turn their heads and eyes with ease: left, right, up, down.
HUMAN_SIDES = {name: math.radians(angle) for name, angle in zip(SIDE_LIMITS, (70.0, 70.0, 50.0, 50.0, 35.0, 35.0, 25.0, 30.0))}


def _degrees(body, head, eyes):
    return {name: math.radians(angle) for name, angle in zip(("body_limit", "head_limit", "eyes_limit"), (body, head, eyes))}


BROUGHT = (
    Preset(
        'PERSON',
        "Person",
        "Eyes first, then the head, and a little of the back",
        {"body_weight": 0.25, "head_weight": 0.7, "eyes_weight": 1.0} | _degrees(50.0, 70.0, 35.0) | HUMAN_SIDES,
    ),
    Preset(
        'ALIVE',
        "Alive",
        "As Person, with eyes that jump a little and blink by themselves",
        {"body_weight": 0.25, "head_weight": 0.7, "eyes_weight": 1.0, "use_saccades": True, "use_blinks": True}
        | _degrees(50.0, 70.0, 35.0)
        | HUMAN_SIDES,
    ),
    Preset(
        'GLANCE',
        "Glance",
        "The eyes nearly alone",
        {"body_weight": 0.0, "head_weight": 0.15, "eyes_weight": 1.0} | _degrees(0.0, 25.0, 35.0),
    ),
    Preset(
        'OWL',
        "Owl",
        "The head alone, nearly all the way round",
        {"body_weight": 0.0, "head_weight": 1.0, "eyes_weight": 0.0, "clamp": 0.2} | _degrees(0.0, 150.0, 0.0),
    ),
    Preset(
        'SNAKE',
        "Snake",
        "The whole body turns along",
        {"body_weight": 0.8, "head_weight": 1.0, "eyes_weight": 0.0, "clamp": 0.3} | _degrees(150.0, 60.0, 0.0),
    ),
)

STYLE = tuple(name for name in KEYWORDS if name not in OF_THE_HEAD)

classes = OPERATOR, PANEL, _ = presets.classes(
    "look_at", "Look At", (f"{ENTRY}.{name}" for name in STYLE), BROUGHT, lambda context: selected(context, "look_at")
)
