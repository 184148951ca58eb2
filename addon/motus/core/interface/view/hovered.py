"""Find the property under the mouse, or the property whose context menu is open."""

import re

import bpy

_INDEX = re.compile(r"\[(\d{1,9})\]$")


def find(context, is_drawing=False):
    """(datablock, data path, index) of the property under the mouse; None if there is none. The index is -1 if it is unknown.

    is_drawing: whether a menu is being drawn at the moment, while Blender 3.4 does not tell the index.
    """
    if hasattr(context, "property"):  # from 4.0 on
        return context.property
    struct, prop = getattr(context, "button_pointer", None), getattr(context, "button_prop", None)
    if struct is None or prop is None or struct.id_data is None:
        return None
    try:
        path = prop.identifier if struct == struct.id_data else struct.path_from_id(prop.identifier)
    except ValueError:
        return None
    return struct.id_data, path, _hovered_index(context) if getattr(prop, "is_array", False) and not is_drawing else -1


def _hovered_index(context):
    """Index of the array component under the mouse; -1 if unknown. Only the data path that Blender's operator copies has it."""
    manager = context.window_manager
    before = manager.clipboard
    try:
        if not bpy.ops.ui.copy_data_path_button.poll():  # type: ignore[call-arg]
            return -1
        bpy.ops.ui.copy_data_path_button(full_path=True)
        found = _INDEX.search(manager.clipboard)
    finally:
        manager.clipboard = before
    return int(found[1]) if found else -1
