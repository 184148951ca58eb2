"""Presets of a system's settings: those that Motus contains, and the user's own ones in Blender's preset panel."""

from typing import NamedTuple

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel

from ..measures import units
from ..refusals import Refused, check_local
from ..translations import tr
from .operators import Operator
from .rows import Rows


class Preset(NamedTuple):
    """A preset that Motus contains. values: {name of a setting: value, lengths in metres}.

    Settings that only different presets of the system name are set to their defaults.
    """

    identifier: str
    label: str
    description: str
    values: dict


def classes(name, label, values, brought=(), settings_of=None):
    """Create the classes for presets of a system: (operator that adds or removes a preset of the user, preset panel).

    If `brought` is not empty, a third class follows: the operator that applies a preset of Motus.

    name: of the folder below Blender's presets/motus, and in the names of the classes. label: of the system. values: Python expressions of
    the settings that a preset of the user stores. brought: Presets that Motus contains. settings_of(context): the settings to which a
    preset of Motus is applied: a property group, a list of them if the preset is applied to the whole selection, or None.
    Blender's preset_defines, which would make the expressions shorter, do not work with Python 3.13 (Blender 4.3 on Debian).
    """
    operator, menu, folder = f"motus.{name}_preset_add", f"MOTUS_PT_{name}_presets", f"motus/{name}"
    add = type(
        f"MOTUS_OT_{name}_preset_add",
        (AddPresetBase, bpy.types.Operator),
        {
            "bl_idname": operator,
            "bl_label": f"Add {label} Preset",
            "bl_description": "Keep these settings as a preset, or remove it",
            "preset_menu": menu,
            "preset_subdir": folder,
            "preset_values": list(values),
        },
    )
    panel = type(
        menu,
        (_Panel, PresetPanel, bpy.types.Panel),
        {
            "bl_label": f"{label} Presets",
            "preset_subdir": folder,
            "preset_operator": "script.execute_preset",
            "preset_add_operator": operator,
            "brought": (f"motus.{name}_preset_use", brought),
        },
    )
    if not brought:
        return add, panel
    use = type(
        f"MOTUS_OT_{name}_preset_use",
        (_Use, bpy.types.Operator),
        {
            "bl_idname": f"motus.{name}_preset_use",
            "bl_label": f"Use {label} Preset",
            "brought": brought,
            "settings_of": staticmethod(settings_of),
            "__annotations__": {
                "preset": bpy.props.EnumProperty(
                    name="Preset", description="Preset that gives the settings their values", items=[preset[:3] for preset in brought]
                )
            },
        },
    )
    return add, panel, use


class _Use(Operator):
    bl_description = "Give the settings the values of a preset that comes with Motus"
    redo = (Rows(("preset",)),)

    def run(self, context):
        found = self.settings_of(context)
        if not found:
            raise Refused(tr("There are no settings here for this preset"))
        every = found if isinstance(found, list) else [found]
        for settings in every:
            check_local(settings.id_data)
        values = next(preset.values for preset in self.brought if preset.identifier == self.preset)
        for settings in every:
            for name in dict.fromkeys(name for preset in self.brought for name in preset.values):
                value = values.get(name, _default(settings, name))
                setattr(settings, name, units.in_scene(context.scene, settings.bl_rna.properties[name], value))


def _default(settings, name):
    prop = settings.bl_rna.properties[name]
    if getattr(prop, "is_array", False):
        return prop.default_array
    return prop.default_flag if getattr(prop, "is_enum_flag", False) else prop.default


class _Panel:
    """Mixin of a preset panel that lists the presets of Motus above those of the user."""

    def draw(self, context):
        layout = self.layout
        operator, brought = self.brought
        if brought:
            column = layout.column()
            column.emboss = 'PULLDOWN_MENU'
            column.operator_context = 'EXEC_DEFAULT'
            for preset in brought:
                column.operator(operator, text=preset.label, text_ctxt="*").preset = preset.identifier
        if bpy.utils.preset_paths(self.preset_subdir):
            if brought:
                layout.separator()
            super().draw(context)  # type: ignore[misc]
            return
        # Without a folder of presets, PresetPanel.draw() would show an error about missing paths.
        manager = context.window_manager
        row = layout.row()
        row.prop(manager, "preset_name", text="")
        row.operator(self.preset_add_operator, text="", icon='ADD').name = manager.preset_name
