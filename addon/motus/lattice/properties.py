"""Settings of a fitted lattice: Object.motus.lattice of the lattice object."""

import bpy

from ..core.settings import OVERRIDABLE


class MOTUS_PG_lattice(bpy.types.PropertyGroup):
    is_fitted: bpy.props.BoolProperty(
        name="Fitted", description="Motus has made this lattice, and removes it with its last modifier",
        options=set(), override=OVERRIDABLE)
    vertex_group: bpy.props.StringProperty(
        name="Vertex Group", description="Vertex group that was made for the vertices that the lattice deforms",
        options=set(), override=OVERRIDABLE)


class FitKeywords:
    """How a lattice is laid around what it deforms: the names are the keywords of scripts."""

    resolution: bpy.props.IntVectorProperty(
        name="Resolution", description="Points of the lattice along its three axes", size=3, default=(4, 4, 4), min=1,
        max=64, soft_max=16, subtype='XYZ')
    margin: bpy.props.FloatProperty(
        name="Margin", description="Room that is left on each side, as a share of the largest side", default=0.02,
        min=0.0, soft_max=1.0, subtype='FACTOR')
    orientation: bpy.props.EnumProperty(
        name="Orientation", description="Which way the lattice's axes point", default='LOCAL', items=(
            ('LOCAL', "Local", "Along the axes of the active object"),
            ('GLOBAL', "Global", "Along the axes of the world"),
            ('FIT', "Fit", "However the lattice becomes smallest")))
    interpolation: bpy.props.EnumProperty(
        name="Interpolation", description="What shape the lattice gives between its points", default='BSPLINE', items=(
            ('LINEAR', "Linear", "Straight from point to point"),
            ('CARDINAL', "Cardinal", "Smooth and tight, through the points"),
            ('CATMULL_ROM', "Catmull-Rom", "Smooth, through the points"),
            ('BSPLINE', "BSpline", "Smoothest; near the points, not through them")))
    use_parent: bpy.props.BoolProperty(
        name="Parent to Object", default=True,
        description="Where the lattice deforms one object only, let it move along as the object's child")
