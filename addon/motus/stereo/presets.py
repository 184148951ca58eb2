"""Presets of a stereo rig's settings."""

from ..core.interface import presets
from .properties import KEYWORDS

classes = OPERATOR, PANEL = presets.classes("stereo", "Stereo", (f"bpy.context.object.motus.stereo.{name}" for name in KEYWORDS))
