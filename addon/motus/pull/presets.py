"""Presets of the brush, by Blender's own preset panel."""

from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel
import bpy

from .properties import KEYWORDS

FOLDER = "motus/pull"
OF_THE_OBJECT = {"vertex_group"}
NAMES = (*(name for name in KEYWORDS if name not in OF_THE_OBJECT), "use_pressure_strength", "use_pressure_size")


class MOTUS_OT_pull_preset_add(AddPresetBase, bpy.types.Operator):
    bl_idname = "motus.pull_preset_add"
    bl_label = "Add Pull Brush Preset"
    bl_description = "Keep these settings as a preset, or remove it"
    preset_menu = "MOTUS_PT_pull_presets"
    preset_subdir = FOLDER
    preset_values = [f"bpy.context.scene.motus.pull.{name}" for name in NAMES]


class MOTUS_PT_pull_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Pull Brush Presets"
    preset_subdir = FOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = "motus.pull_preset_add"


classes = (MOTUS_OT_pull_preset_add, MOTUS_PT_pull_presets)
