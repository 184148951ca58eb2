"""Settings that belong to the scene: what the viewport shows."""

import bpy


class MOTUS_PG_scene(bpy.types.PropertyGroup):
    show_overlay: bpy.props.BoolProperty(
        name="Overlay", description="Show what the systems compute in the viewport", default=True, options=set())
    show_curve: bpy.props.BoolProperty(
        name="Curve", description="Draw the curve that is really followed", default=True, options=set())
    show_control_points: bpy.props.BoolProperty(
        name="Control Points", description="Draw the control polygon", default=True, options=set())
    show_tangents: bpy.props.BoolProperty(
        name="Tangents", description="Draw the tangent at equal distances", default=False, options=set())
    show_frames: bpy.props.BoolProperty(
        name="Path Frames", description="Draw the orientation at equal distances", default=True, options=set())
    show_speed: bpy.props.BoolProperty(
        name="Speed", description="Colour the curve by the follower's speed", default=True, options=set())
    show_reach: bpy.props.BoolProperty(
        name="Reach", description="Draw how far a chain reaches, and how near", default=True, options=set())
    show_pole: bpy.props.BoolProperty(
        name="Pole", description="Draw the line from the middle of a chain to its pole", default=True, options=set())
    show_residual: bpy.props.BoolProperty(
        name="Residual", description="Draw what is left between the end of a chain and its target", default=True,
        options=set())


classes = (MOTUS_PG_scene,)
