"""Presets for the settings of an entry of dynamics."""

from ..core.interface import presets
from ..core.interface.bone_entries import selected
from ..core.interface.presets import Preset
from . import filters, styles

ENTRY = "bpy.context.object.motus.dynamics.entries[bpy.context.object.motus.dynamics.active_entry]"
OF_A_STYLE = "frequency", "damping", "response", "mass", "shape"
"""Settings of an entry that a preset stores: those that do not depend on the object, bone or shot."""

BROUGHT = [Preset(identifier, label, told, dict(zip(filters.NUMBERS, numbers))) for identifier, label, told, numbers in styles.STYLES]

classes = OPERATOR, PANEL, USE = presets.classes(
    "dynamics", "Dynamics", (f"{ENTRY}.{name}" for name in OF_A_STYLE), BROUGHT, lambda context: selected(context, "dynamics")
)
