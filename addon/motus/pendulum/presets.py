"""Presets of a pendulum's settings."""

from ..core import presets
from .properties import KEYWORDS

# What belongs to one shot is not part of a style.
OF_THE_SHOT = {"start_frame", "is_playing", "influence"}

classes = OPERATOR, PANEL = presets.classes(
    "pendulum", "Pendulum", (f"bpy.context.object.motus.pendulum.{name}" for name in KEYWORDS if name not in OF_THE_SHOT))
