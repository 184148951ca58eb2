"""Presets of the brush."""

from ..core import presets
from .properties import KEYWORDS

OF_THE_OBJECT = {"vertex_group"}
NAMES = (*(name for name in KEYWORDS if name not in OF_THE_OBJECT), "use_pressure_strength", "use_pressure_size")

classes = OPERATOR, PANEL = presets.classes("pull", "Pull Brush", (f"bpy.context.scene.motus.pull.{name}" for name in NAMES))
