"""Presets of a follower's settings."""

from ..core import presets
from .properties import KEYWORDS

# What belongs to one shot is not part of a style.
OF_THE_SHOT = {"spline", "start_frame", "offset", "distance_factor", "influence"}

classes = OPERATOR, PANEL = presets.classes(
    "path", "Follow Path", (f"bpy.context.object.motus.path.{name}" for name in KEYWORDS if name not in OF_THE_SHOT))
