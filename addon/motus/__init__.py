"""Motus: procedural animation for Blender, on a native C++ core."""

from .core import registration


def register():
    from . import demo
    from .systems import SYSTEMS
    registration.register(SYSTEMS, extra_classes=demo.classes, extra_add_menu=demo.ADD_MENU)


def unregister():
    registration.unregister()
