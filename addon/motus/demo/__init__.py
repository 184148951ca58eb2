"""Demo scenes: examples that the add-on's own public operators build, each in a new scene of its own."""

from .operators import MOTUS_OT_demo_scene, classes

ADD_MENU = (MOTUS_OT_demo_scene.bl_idname,)

__all__ = ("ADD_MENU", "classes")
