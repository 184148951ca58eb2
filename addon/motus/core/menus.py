"""The Motus entries of the Add, Object and Pose menus; F3 search finds what stands in a menu."""

import bpy

_entries = {"add": (), "object": (), "pose": ()}


class MOTUS_MT_add(bpy.types.Menu):
    bl_label = "Motus"

    def draw(self, context):
        _draw(self.layout, _entries["add"])


class MOTUS_MT_object(bpy.types.Menu):
    bl_label = "Motus"

    def draw(self, context):
        _draw(self.layout, _entries["object"])


class MOTUS_MT_pose(bpy.types.Menu):
    bl_label = "Motus"

    def draw(self, context):
        _draw(self.layout, _entries["pose"])


def _draw(layout, operators):
    layout.operator_context = 'INVOKE_DEFAULT'
    for identifier in operators:
        if identifier is None:
            layout.separator()
        else:
            layout.operator(identifier)


def _draw_add(menu, _context):
    menu.layout.separator()
    menu.layout.menu(MOTUS_MT_add.__name__, icon='CON_FOLLOWPATH')


def _draw_object(menu, _context):
    menu.layout.separator()
    menu.layout.menu(MOTUS_MT_object.__name__, icon='CON_FOLLOWPATH')


def _draw_pose(menu, _context):
    menu.layout.separator()
    menu.layout.menu(MOTUS_MT_pose.__name__, icon='CON_FOLLOWPATH')


classes = (MOTUS_MT_add, MOTUS_MT_object, MOTUS_MT_pose)


def register(systems, extra_add=()):
    """Show the systems' operators (identifiers; None draws a separator) in the menus."""
    _entries["add"] = tuple(name for one in systems for name in one.add_menu) + tuple(extra_add)
    for menu in ("object", "pose"):
        _entries[menu] = tuple(name for one in systems for name in getattr(one, f"{menu}_menu")) + (
            None, "motus.bake", "motus.unbake")
    bpy.types.VIEW3D_MT_add.append(_draw_add)
    bpy.types.VIEW3D_MT_object.append(_draw_object)
    bpy.types.VIEW3D_MT_pose.append(_draw_pose)


def unregister():
    """Take the entries back."""
    bpy.types.VIEW3D_MT_pose.remove(_draw_pose)
    bpy.types.VIEW3D_MT_object.remove(_draw_object)
    bpy.types.VIEW3D_MT_add.remove(_draw_add)
