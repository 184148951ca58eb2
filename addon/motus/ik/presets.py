"""Presets of inverse kinematics for the settings of one chain."""

from ..core.interface import presets
from ..core.interface.bone_entries import selected
from ..core.interface.presets import Preset
from .properties import KEYWORDS

ENTRY = "bpy.context.object.motus.ik.entries[bpy.context.object.motus.ik.active_entry]"
# Settings that belong to one chain or one shot, which presets leave out, and copying unless asked.
OF_THE_CHAIN = {
    "chain_length",
    "use_tail",
    "pole_angle",
    "hinge_angle",
    "position_weight",
    "rotation_weight",
    "rotation_offset",
    "target_blend",
    "is_muted",
}

BROUGHT = (
    Preset('LIMB', "Limb", "Slows down a little before it is straight, so that the knee does not snap", {"softness": 0.03}),
    Preset('EXACT', "Exact", "Reaches as far as its bones are long", {}),
    Preset('CARTOON', "Cartoon", "Lengthens until it reaches the target", {"softness": 0.05, "stretch": 1.0}),
    Preset('RUBBER', "Rubber", "Lengthens until it reaches the target, and gets thinner by that", {"stretch": 1.0, "volume": 1.0}),
    Preset('ELASTIC', "Elastic", "Lengthens by half of the missing distance", {"softness": 0.1, "stretch": 0.5}),
    Preset('JOINTED', "Jointed", "Keeps the limits that the bones have", {"use_limits": True}),
)

STYLE = tuple(name for name in KEYWORDS if name not in OF_THE_CHAIN)
COPIED = tuple(name for name in KEYWORDS if name not in {"chain_length", "use_tail"})
"""Settings of a chain that are copied to other chains, which keep the bones that they have."""

classes = OPERATOR, PANEL, _ = presets.classes(
    "ik", "Inverse Kinematics", (f"{ENTRY}.{name}" for name in STYLE), BROUGHT, lambda context: selected(context, "ik")
)
