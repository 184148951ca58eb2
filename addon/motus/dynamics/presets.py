"""Presets of an entry's settings."""

from ..core import presets

ENTRY = "bpy.context.object.motus.dynamics.entries[bpy.context.object.motus.dynamics.active_entry]"
OF_A_STYLE = "frequency", "damping", "response", "mass", "shape"
"""What belongs to one thing or one shot is not part of a style."""

classes = OPERATOR, PANEL = presets.classes("dynamics", "Dynamics", (f"{ENTRY}.{name}" for name in OF_A_STYLE))
