"""Presets of a head's settings."""

from ..core import presets
from .properties import KEYWORDS

ENTRY = "bpy.context.object.motus.look_at.entries[bpy.context.object.motus.look_at.active_entry]"
# What belongs to one rig or one shot is not part of a style.
OF_THE_HEAD = {"weight", "head_forward", "eyes_forward"}

classes = OPERATOR, PANEL = presets.classes(
    "look_at", "Look At", (f"{ENTRY}.{name}" for name in KEYWORDS if name not in OF_THE_HEAD))
