"""The asset shelf with the user's presets, and entries in the menus of the asset browser and the 3D viewport.

The shelf is there if Blender has asset shelves and the user has switched it on.
"""

from functools import partial

import bpy

from ...blender import capabilities, handlers
from ..view import offering, preferences
from . import held
from .dragging import MOTUS_OT_asset_drag
from .giving import MOTUS_OT_asset_give

_KEYS = (MOTUS_OT_asset_give, 'CLICK'), (MOTUS_OT_asset_drag, 'CLICK_DRAG')
"""(operator, value of the left mouse button) of the shelf in versions of Blender whose shelves call no operator by themselves."""
_undo = []


def _draw_in_browser(menu, context):
    asset = held.shown(context)
    if asset is not None and held.is_held(asset):
        layout = offering.offer(menu.layout)
        layout.operator_context = 'INVOKE_DEFAULT'
        layout.operator(MOTUS_OT_asset_give.bl_idname, icon='ASSET_MANAGER')


def _draw_in_view(menu, context):
    own = preferences.own(context)
    if own is not None:
        menu.layout.prop(own, "show_preset_shelf")


def _shelf():
    """Make the class of the shelf, whose base is not there in older versions of Blender."""

    class MOTUS_AST_presets(bpy.types.AssetShelf):
        bl_idname = "MOTUS_AST_presets"
        bl_space_type = 'VIEW_3D'
        bl_options = {'NO_ASSET_DRAG'}
        bl_default_preview_size = 64
        filter_object = True

        @classmethod
        def poll(cls, context):
            own = preferences.own(context)
            return own is not None and own.show_preset_shelf and context.mode in {'OBJECT', 'POSE'}

        @classmethod
        def asset_poll(cls, asset):
            return held.is_held(asset)

        @classmethod
        def draw_context_menu(cls, _context, _asset, layout):
            layout.operator(MOTUS_OT_asset_give.bl_idname)
            layout.separator()
            layout.operator("asset.open_containing_blend_file")

    if capabilities.has_drags_from_shelves():
        MOTUS_AST_presets.bl_activate_operator = MOTUS_OT_asset_give.bl_idname
        MOTUS_AST_presets.bl_drag_operator = MOTUS_OT_asset_drag.bl_idname
    return MOTUS_AST_presets


def register():
    """Add the entries of menus, and the shelf if Blender has asset shelves."""
    menus = [bpy.types.ASSETBROWSER_MT_context_menu, bpy.types.ASSETBROWSER_MT_editor_menus]
    for menu in menus:
        _add(menu.append, menu.remove, _draw_in_browser)
    if not capabilities.has_asset_shelves():
        return
    _add(bpy.utils.register_class, bpy.utils.unregister_class, _shelf())
    _add(bpy.types.VIEW3D_MT_view.append, bpy.types.VIEW3D_MT_view.remove, _draw_in_view)
    keys = bpy.context.window_manager.keyconfigs.addon
    if keys is None or capabilities.has_drags_from_shelves():  # Blender without a window has no keymaps
        return
    keymap = keys.keymaps.new(name="Asset Shelf")
    for operator, value in _KEYS:
        _undo.append(partial(keymap.keymap_items.remove, keymap.keymap_items.new(operator.bl_idname, 'LEFTMOUSE', value)))


def _add(do, undo, thing):
    do(thing)
    _undo.append(partial(undo, thing))


def unregister():
    """Remove everything that register() has added."""
    while _undo:
        handlers.take_back(_undo.pop())
