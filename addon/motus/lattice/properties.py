"""Settings of a fitted lattice: Object.motus.lattice of the lattice object."""

import bpy

from ..core.settings import OVERRIDABLE


class MOTUS_PG_lattice(bpy.types.PropertyGroup):
    is_fitted: bpy.props.BoolProperty(
        name="Fitted",
        description="Motus has made this lattice, and removes it with its last modifier",
        options={'HIDDEN'},
        override=OVERRIDABLE,
    )
    vertex_group: bpy.props.StringProperty(
        name="Vertex Group",
        description="Vertex group that was made for the vertices that the lattice deforms",
        options={'HIDDEN'},
        override=OVERRIDABLE,
    )


class FitKeywords:
    """Keywords that say how a lattice is laid around objects; their names are keywords of scripts."""

    resolution: bpy.props.IntVectorProperty(
        name="Resolution",
        description="Points of the lattice along its three axes",
        size=3,
        default=(4, 4, 4),
        min=1,
        max=64,
        soft_max=16,
        subtype='XYZ',
    )
    margin: bpy.props.FloatProperty(
        name="Margin",
        description="Room between the objects and the lattice on each side, as a share of the lattice's largest side",
        default=0.02,
        min=0.0,
        soft_max=1.0,
        subtype='FACTOR',
    )
    orientation: bpy.props.EnumProperty(
        name="Orientation",
        description="Orientation of the lattice's axes",
        default='LOCAL',
        items=(
            ('LOCAL', "Local", "The lattice's axes are those of the active object"),
            ('GLOBAL', "Global", "The lattice's axes are those of the world"),
            ('FIT', "Fit", "The lattice is turned so that it becomes smallest"),
        ),
    )
    interpolation: bpy.props.EnumProperty(
        name="Interpolation",
        description="Interpolation between the lattice's points",
        default='BSPLINE',
        items=(
            ('LINEAR', "Linear", "Straight lines from point to point"),
            ('CARDINAL', "Cardinal", "A smooth and tight shape through the points"),
            ('CATMULL_ROM', "Catmull-Rom", "A smooth shape through the points"),
            ('BSPLINE', "BSpline", "The smoothest shape, near the points, not through them"),
        ),
    )
    use_parent: bpy.props.BoolProperty(
        name="Parent to Object",
        default=True,
        description="Parent the lattice to the object, if it deforms one object only, so that it moves along",
    )
