"""Motus: procedural animation for Blender, on a native C++ core."""

from .core import registration


def register():
    """Called by Blender when the add-on is enabled."""
    from . import demo
    from .systems import SYSTEMS
    registration.register(SYSTEMS, extra_classes=demo.classes, extra_add_menu=demo.ADD_MENU)


def unregister():
    """Called by Blender when the add-on is disabled."""
    registration.unregister()
