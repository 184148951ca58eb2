"""Motus: procedural animation for Blender, on a native C++ core."""

from .core import registration
from .core.keeping import forget_all

__all__ = ("forget_all", "register", "unregister")


def register():
    """Called by Blender when the add-on is enabled."""
    from . import demo, translations
    from .systems import SYSTEMS

    registration.register(SYSTEMS, translations.LANGUAGES, extra_classes=demo.classes, extra_add_menu=demo.ADD_MENU)


def unregister():
    """Called by Blender when the add-on is disabled."""
    registration.unregister()
