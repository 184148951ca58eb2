"""Presets of a system's settings, by Blender's own preset panel."""

from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel
import bpy


def classes(name, label, values):
    """(operator that keeps the settings or removes a preset, panel) of a system.

    name: the folder below Blender's presets/motus, and in the classes' names. values: Python expressions of the settings.
    Blender's preset_defines, which would make these shorter, do not work with Python 3.13 (Blender 4.3 on Debian).
    """
    operator, menu, folder = f"motus.{name}_preset_add", f"MOTUS_PT_{name}_presets", f"motus/{name}"
    add = type(f"MOTUS_OT_{name}_preset_add", (AddPresetBase, bpy.types.Operator), {
        "bl_idname": operator, "bl_label": f"Add {label} Preset",
        "bl_description": "Keep these settings as a preset, or remove it",
        "preset_menu": menu, "preset_subdir": folder, "preset_values": list(values)})
    panel = type(menu, (PresetPanel, bpy.types.Panel), {
        "bl_label": f"{label} Presets", "preset_subdir": folder, "preset_operator": "script.execute_preset",
        "preset_add_operator": operator})
    return add, panel
