"""Presets of a chain's settings."""

from ..core import presets
from .properties import KEYWORDS

ENTRY = "bpy.context.object.motus.ik.entries[bpy.context.object.motus.ik.active_entry]"
# What belongs to one chain or one shot is not part of a style.
OF_THE_CHAIN = {
    "chain_length", "use_tail", "pole_angle", "hinge_angle", "position_weight", "rotation_weight", "rotation_offset",
    "target_blend", "is_muted",
}

classes = OPERATOR, PANEL = presets.classes(
    "ik", "Inverse Kinematics", (f"{ENTRY}.{name}" for name in KEYWORDS if name not in OF_THE_CHAIN))
