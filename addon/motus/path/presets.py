"""Presets of the settings, by Blender's own preset panel."""

from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel
import bpy

from .properties import KEYWORDS

FOLDER = "motus/path"
# What belongs to one shot is not part of a style.
OF_THE_SHOT = {"spline", "start_frame", "offset", "distance_factor", "influence"}


class MOTUS_OT_path_preset_add(AddPresetBase, bpy.types.Operator):
    bl_idname = "motus.path_preset_add"
    bl_label = "Add Follow Path Preset"
    bl_description = "Keep these settings as a preset, or remove it"
    preset_menu = "MOTUS_PT_path_presets"
    preset_subdir = FOLDER
    preset_values = [f"bpy.context.object.motus.path.{name}" for name in KEYWORDS if name not in OF_THE_SHOT]


class MOTUS_PT_path_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Follow Path Presets"
    preset_subdir = FOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = "motus.path_preset_add"


classes = (MOTUS_OT_path_preset_add, MOTUS_PT_path_presets)
