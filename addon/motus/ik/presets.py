"""Presets of a chain's settings, by Blender's own preset panel."""

from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel
import bpy

from .properties import KEYWORDS

FOLDER = "motus/ik"
# Blender's preset_defines, which would make this shorter, do not work with Python 3.13 (Blender 4.3 on Debian).
ENTRY = "bpy.context.object.motus.ik.entries[bpy.context.object.motus.ik.active_entry]"
# What belongs to one chain or one shot is not part of a style.
OF_THE_CHAIN = {
    "chain_length", "use_tail", "pole_angle", "hinge_angle", "position_weight", "rotation_weight", "rotation_offset",
    "target_blend", "is_muted",
}


class MOTUS_OT_ik_preset_add(AddPresetBase, bpy.types.Operator):
    bl_idname = "motus.ik_preset_add"
    bl_label = "Add Inverse Kinematics Preset"
    bl_description = "Keep these settings as a preset, or remove it"
    preset_menu = "MOTUS_PT_ik_presets"
    preset_subdir = FOLDER
    preset_values = [f"{ENTRY}.{name}" for name in KEYWORDS if name not in OF_THE_CHAIN]


class MOTUS_PT_ik_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Inverse Kinematics Presets"
    preset_subdir = FOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = "motus.ik_preset_add"


classes = (MOTUS_OT_ik_preset_add, MOTUS_PT_ik_presets)
