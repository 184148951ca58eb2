"""Tests for features of the running Blender, by name. No other module tells Blender versions apart.

The tests are functions and not constants, because several of them read RNA, which takes time only if a test is called.
"""

from __future__ import annotations

from typing import Any

import bpy


def _rna(kind: Any) -> Any:
    """RNA type of a class, as Any: the type stubs do not declare the individual properties of RNA types."""
    return kind.bl_rna


def has_geometry_attribute_constraint() -> bool:
    """Whether Blender has the constraint that takes a whole matrix from a mesh attribute, Geometry Attribute (5.x).

    This constraint is the better one to bring a solver's result to an object or bone.
    """
    types = _rna(bpy.types.Constraint).properties["type"].enum_items
    return 'GEOMETRY_ATTRIBUTE' in types


def keeps_settings_apart() -> bool:
    """Whether properties of add-ons are stored apart from custom properties (since Blender 5.0).

    Properties of add-ons in a file of an older Blender are custom properties as well.
    """
    return bpy.app.version >= (5, 0, 0)


def has_quaternion_attributes() -> bool:
    """Whether attributes and node sockets have a data type of their own for rotations (since Blender 4.0)."""
    return 'QUATERNION' in _rna(bpy.types.Attribute).properties["data_type"].enum_items


def has_slotted_actions() -> bool:
    """Whether actions have slots, layers and strips (since Blender 4.4). From 5.0 on actions have no F-curves elsewhere."""
    return hasattr(bpy.types, "ActionSlot")


def has_bone_collections() -> bool:
    """Whether bones are in named collections of their armature (since Blender 4.0) instead of groups of the pose."""
    return "collections" in bpy.types.Armature.bl_rna.properties


def eevee_engine() -> str:
    """Identifier of the render engine EEVEE, which Blender has renamed twice: 'BLENDER_EEVEE_NEXT' or 'BLENDER_EEVEE'."""
    engines = _rna(bpy.types.RenderSettings).properties["engine"].enum_items
    return 'BLENDER_EEVEE_NEXT' if 'BLENDER_EEVEE_NEXT' in engines else 'BLENDER_EEVEE'


def has_panel_category() -> bool:
    """Whether scripts can read and set the open tab of a sidebar, by Region.active_panel_category."""
    return "active_panel_category" in bpy.types.Region.bl_rna.properties


def line_shader(is_uniform: bool) -> str:
    """Name of the built-in GPU shader for wide lines. is_uniform: one color for all points, otherwise one color for each point."""
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
    """Whether a node group's sockets are in NodeTree.interface (since Blender 4.0) instead of the lists `inputs` and `outputs`."""
    return "interface" in bpy.types.NodeTree.bl_rna.properties


def has_modifier_inputs() -> bool:
    """Whether inputs of a Geometry Nodes modifier are RNA properties (since Blender 5.2) instead of custom properties."""
    return "properties" in bpy.types.NodesModifier.bl_rna.properties


def has_modifier_order() -> bool:
    """Whether scripts can reorder modifiers without an operator, by ObjectModifiers.move() (since Blender 4.0)."""
    return "move" in _rna(bpy.types.ObjectModifiers).functions


def has_compositing_group() -> bool:
    """Whether the compositor's nodes are a node group to which a scene points (since Blender 5.0) instead of a tree in the scene."""
    return "compositing_node_group" in bpy.types.Scene.bl_rna.properties


def has_compositor_sockets() -> bool:
    """Whether numbers of the compositor's nodes, such as the size of a blur in pixels, are sockets (since Blender 4.5) instead of properties.

    Blender 4.5 has the properties as well, which set the sockets.
    """
    return bpy.app.version >= (4, 5, 0)


def has_compositor_menus() -> bool:
    """Whether choices of the compositor's nodes, such as the size that Scale makes, are sockets (since Blender 5.0) instead of properties."""
    return "space" not in bpy.types.CompositorNodeScale.bl_rna.properties


def has_compositor_in_viewport() -> bool:
    """Whether the viewport can show the compositor's result (since Blender 3.5)."""
    shading = bpy.types.View3DShading.bl_rna.properties
    return "use_compositor" in shading and shading["use_compositor"].type == 'ENUM'


def has_shader_nodes_in_compositor() -> bool:
    """Whether the compositor uses the shader nodes Math and Mix (since Blender 5.0) instead of nodes of its own."""
    return not hasattr(bpy.types, "CompositorNodeMath")


def has_premultiplied_images() -> bool:
    """Whether the compositor's Image node multiplies the colours of 8-bit pictures by their alpha (since Blender 4.0).

    Before 4.0 the node leaves the alpha of these pictures straight.
    """
    return bpy.app.version >= (4, 0, 0)


def computes_nodes_once() -> bool:
    """Whether the compositor computes each node once, not again for every node that reads it (since Blender 4.0 at the latest)."""
    return bpy.app.version >= (4, 0, 0)


def has_blended_surfaces() -> bool:
    """Whether materials choose EEVEE's transparency by `surface_render_method` (since 4.2), not by blend and shadow methods."""
    return "surface_render_method" in bpy.types.Material.bl_rna.properties


def has_dialog_titles() -> bool:
    """Whether an operator's dialog may have a title that differs from the operator's label (since Blender 4.1)."""
    return "title" in _rna(bpy.types.WindowManager).functions["invoke_props_dialog"].parameters


def has_asset_shelves() -> bool:
    """Whether add-ons can show assets in a shelf at the bottom of a 3D viewport (since Blender 4.2).

    Motus does not use the first form of shelves, which 4.0 and 4.1 have.
    """
    return bpy.app.version >= (4, 2, 0)


def has_drags_from_shelves() -> bool:
    """Whether an asset shelf calls an operator when an asset is dragged from it (since Blender 5.0). Before, keys of the shelf call it."""
    return has_asset_shelves() and "bl_drag_operator" in _rna(bpy.types.AssetShelf).properties
