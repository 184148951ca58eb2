"""What this Blender can do, asked by name. The one place where Blender versions are told apart.

Functions, not constants: several answers come from RNA, which is read only when somebody asks.
"""

from __future__ import annotations

from typing import Any

import bpy


def _rna(kind: Any) -> Any:
    """The RNA type of a class, whose properties the type stubs do not tell apart."""
    return kind.bl_rna


def has_geometry_attribute_constraint() -> bool:
    """The constraint that takes a whole matrix from a mesh attribute (5.x): the better sink."""
    types = _rna(bpy.types.Constraint).properties["type"].enum_items
    return 'GEOMETRY_ATTRIBUTE' in types


def keeps_settings_apart() -> bool:
    """Settings of add-ons are no custom properties (5.0). Those of a file of an older Blender are such too."""
    return bpy.app.version >= (5, 0, 0)


def has_quaternion_attributes() -> bool:
    """Rotations are a type of attributes and sockets of their own (4.0)."""
    return 'QUATERNION' in _rna(bpy.types.Attribute).properties["data_type"].enum_items


def has_slotted_actions() -> bool:
    """Actions have slots, layers and strips (4.4), and from 5.0 on nothing else."""
    return hasattr(bpy.types, "ActionSlot")


def has_bone_collections() -> bool:
    """Bones stand in named collections of their armature (4.0), where they were in a group of the pose before."""
    return "collections" in bpy.types.Armature.bl_rna.properties


def eevee_engine() -> str:
    """Identifier of EEVEE, which was renamed twice."""
    engines = _rna(bpy.types.RenderSettings).properties["engine"].enum_items
    return 'BLENDER_EEVEE_NEXT' if 'BLENDER_EEVEE_NEXT' in engines else 'BLENDER_EEVEE'


def has_panel_category() -> bool:
    """The sidebar's open tab can be read and set."""
    return "active_panel_category" in bpy.types.Region.bl_rna.properties


def line_shader(is_uniform: bool) -> str:
    """Name of the built-in shader for wide lines, in one colour or in one a point."""
    name = "POLYLINE_UNIFORM_COLOR" if is_uniform else "POLYLINE_SMOOTH_COLOR"
    return name if bpy.app.version >= (4, 0, 0) else "3D_" + name


def point_shader() -> str:
    """Name of the built-in GPU shader that draws points in one colour.

    Since Blender 4.5 this is a shader for points only, with a uniform for the size of the points.
    """
    if bpy.app.version >= (4, 5, 0):
        return "POINT_UNIFORM_COLOR"
    return "UNIFORM_COLOR" if bpy.app.version >= (4, 0, 0) else "3D_UNIFORM_COLOR"


def has_textures_in_display_colors() -> bool:
    """Whether draw_texture_2d() of gpu_extras draws the colours of a texture unchanged (since Blender 5.0).

    Before 5.0, Blender takes the colours for scene-linear ones and converts them.
    """
    import inspect

    from gpu_extras.presets import draw_texture_2d

    return "is_scene_linear_with_rec709_srgb_target" in inspect.signature(draw_texture_2d).parameters


def has_tree_interface() -> bool:
    """Sockets of a node group belong to its interface (4.0), not to two lists."""
    return "interface" in bpy.types.NodeTree.bl_rna.properties


def has_modifier_inputs() -> bool:
    """Whether inputs of a Geometry Nodes modifier are RNA properties (since Blender 5.2) instead of custom properties."""
    return "properties" in bpy.types.NodesModifier.bl_rna.properties


def has_modifier_order() -> bool:
    """Whether scripts can reorder modifiers without an operator, by ObjectModifiers.move() (since Blender 4.0)."""
    return "move" in _rna(bpy.types.ObjectModifiers).functions


def has_compositing_group() -> bool:
    """The compositor's nodes are a node group that a scene points to (5.0), not a tree within the scene."""
    return "compositing_node_group" in bpy.types.Scene.bl_rna.properties


def has_compositor_sockets() -> bool:
    """Options of the compositor's nodes are sockets (4.5), not properties."""
    return "clip_black" not in bpy.types.CompositorNodeKeying.bl_rna.properties


def has_compositor_in_viewport() -> bool:
    """Whether the viewport can show the compositor's result (since 3.5)."""
    shading = bpy.types.View3DShading.bl_rna.properties
    return "use_compositor" in shading and shading["use_compositor"].type == 'ENUM'


def has_shader_nodes_in_compositor() -> bool:
    """Whether the compositor uses the shader nodes Math and Mix (since Blender 5.0) instead of nodes of its own."""
    return not hasattr(bpy.types, "CompositorNodeMath")


def has_premultiplied_images() -> bool:
    """The compositor's node Image premultiplies pictures of 8 bits by their alpha (before 4.0 it leaves them straight)."""
    return bpy.app.version >= (4, 0, 0)


def computes_nodes_once() -> bool:
    """The compositor computes what a node makes once (4.0 at the latest), not anew for each node that reads it."""
    return bpy.app.version >= (4, 0, 0)


def has_blended_surfaces() -> bool:
    """Materials say how EEVEE draws what is transparent by `surface_render_method` (4.2), not by a blend and a shadow method."""
    return "surface_render_method" in bpy.types.Material.bl_rna.properties


def has_dialog_titles() -> bool:
    """A dialog may be called otherwise than its operator (4.1)."""
    return "title" in _rna(bpy.types.WindowManager).functions["invoke_props_dialog"].parameters
