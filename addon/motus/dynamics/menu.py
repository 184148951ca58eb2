"""Operators of dynamics in the context menu of a property, which the right mouse button opens."""

import bpy

from ..core.blender import actions
from ..core.interface.view import hovered
from . import setup, targets
from .operators import MOTUS_OT_dynamics_add, MOTUS_OT_dynamics_remove


def _draw(menu, context):
    found, obj = hovered.find(context, is_drawing=True), context.object
    path = found and obj and targets.path_from(obj, *found[:2])
    if not path:
        return
    settings = obj.motus.dynamics if obj.is_property_set("motus") else None
    index = next((one for one in (found[2], -1) if settings and setup.find(settings, (path, one)) >= 0), None)
    if index is None and not _is_keyed_decimal(*found[:2]):
        return
    kind, icon = (MOTUS_OT_dynamics_add, 'FORCE_HARMONIC') if index is None else (MOTUS_OT_dynamics_remove, 'X')
    menu.layout.separator()
    menu.layout.operator_context = 'EXEC_DEFAULT'
    button = menu.layout.operator(kind.bl_idname, icon=icon)
    button.object, button.data_path, button.index = obj.name, path, found[2] if index is None else index


def _is_keyed_decimal(id_data, path):
    """Whether F-curves animate a property whose value is a float or an array of floats. path: data path from id_data."""
    curves = (curve for player in actions.players(id_data) for curve in actions.curves_of(player))
    if all(curve.data_path != path for curve in curves):
        return False
    try:
        value = id_data.path_resolve(path)
    except ValueError:
        return False
    first = value[0] if hasattr(value, "__len__") and len(value) else value
    return isinstance(first, float)


def register():
    """Add the operators to the context menu."""
    bpy.types.UI_MT_button_context_menu.append(_draw)


def unregister():
    """Remove the operators from the context menu."""
    bpy.types.UI_MT_button_context_menu.remove(_draw)
