"""Settings that belong to the scene: what the viewport shows. Systems add theirs (overlay.py) and those of their tools."""

import bpy


class MOTUS_PG_scene(bpy.types.PropertyGroup):
    show_overlay: bpy.props.BoolProperty(
        name="Overlay", description="Show what the systems compute in the viewport", default=True, options=set())


classes = (MOTUS_PG_scene,)
