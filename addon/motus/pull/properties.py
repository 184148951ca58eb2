"""Settings of the pull brush in Scene.motus.pull, and the record of the last pull, from which a pin can be made."""

import bpy

from ..core.interface.view import viewports
from ..core.settings import drawn_curves
from . import falloff_curve
from .falloff_curve import CURVE_SAMPLES

LARGEST = 1e18
"""Limit of the absolute value of settings; its square is still finite in single precision."""

UNITS = (
    ('WORLD', "World Space", "Lengths and directions are those of the world, whatever the object's scale"),
    ('LOCAL', "Local Space", "Lengths and directions are those of the object"),
)
FALLOFFS = (
    ('SMOOTH', "Smooth", "Rounded at the root and at the rim"),
    ('SPHERE', "Sphere", "A half sphere"),
    ('ROOT', "Root", "Steep at the rim and pointed at the root"),
    ('LINEAR', "Linear", "A cone"),
    ('SHARP', "Sharp", "A thorn with a wide foot"),
    ('CONSTANT', "Constant", "All vertices within the radius move alike"),
    ('GAUSSIAN', "Gaussian", "A bell"),
    ('CLASSIC', "Classic", "Reaches as far as the square root of the radius: 2 at a radius of 4; Scale Factor says how steep it is"),
    ('CURVE', "Curve", "A curve that you draw"),
)
DISTANCES = (
    ('STRAIGHT', "Straight", "Distance in a straight line through space"),
    ('SURFACE', "Surface", "Measured along the surface, so that lips and fingers stay apart"),
    ('EDGES', "Edges", "Distance as the number of edges, which the radius gives"),
)
DIRECTIONS = (
    ('NORMAL', "Normal", "Pull out of the surface at the root"),
    ('VIEW', "View", "Pull towards the viewer"),
    ('X', "X", "Pull along the X axis"),
    ('Y', "Y", "Pull along the Y axis"),
    ('Z', "Z", "Pull along the Z axis"),
    ('CURSOR', "Cursor", "Drag the root along with the mouse"),
)
AXES = (('X', "X", ""), ('Y', "Y", ""), ('Z', "Z", ""))
DAB_KINDS = (('PULL', "Pull", ""), ('SMOOTH', "Smooth", ""), ('DRAG', "Drag", ""))


class BrushKeywords:
    """Mixin with the properties that the scene's brush, the operator and the record of a pull have in common.

    The names of the properties are the operator's keywords in scripts.
    """

    radius: bpy.props.FloatProperty(
        name="Radius",
        description="How far the pull reaches from the vertex that is pulled; a number of edges if Distance is Edges",
        default=1.0,
        min=1e-6,
        soft_min=0.01,
        soft_max=100.0,
        subtype='DISTANCE',
        options=set(),
    )
    unit: bpy.props.EnumProperty(
        name="Unit",
        description="Whether radius, strength and directions are those of the world, or of the object with its scale",
        items=UNITS,
        default='WORLD',
        options=set(),
    )
    strength: bpy.props.FloatProperty(
        name="Strength",
        description="How far one dab moves the vertex that is pulled; negative pushes it instead",
        default=0.1,
        soft_min=-10.0,
        soft_max=10.0,
        subtype='DISTANCE',
        options=set(),
    )
    falloff: bpy.props.EnumProperty(
        name="Falloff",
        description="How the pull fades from the vertex that is pulled, which it moves whole, to the radius, where it moves nothing",
        items=FALLOFFS,
        default='SMOOTH',
        options=set(),
        update=lambda settings, context: _ensure_curve(settings),
    )
    scale_factor: bpy.props.FloatProperty(
        name="Scale Factor",
        description="How steep the falloff Classic is: 0 is the least steep, and larger numbers, negative ones too, are steeper",
        default=0.0,
        soft_min=-10.0,
        soft_max=10.0,
        options=set(),
    )
    distance: bpy.props.EnumProperty(
        name="Distance",
        description="How the distance from the vertex that is pulled is measured, by which the others come along",
        items=DISTANCES,
        default='STRAIGHT',
        options=set(),
    )
    weld: bpy.props.FloatProperty(
        name="Weld Distance",
        description="Vertices within this distance of each other move as one, so that a pull crosses the gaps of a scan; 0 welds none",
        default=0.0,
        min=0.0,
        soft_max=0.1,
        step=0.1,
        precision=4,
        subtype='DISTANCE',
        options=set(),
    )
    direction: bpy.props.EnumProperty(
        name="Direction", description="Direction in which the surface is pulled", items=DIRECTIONS, default='NORMAL', options=set()
    )
    accumulate: bpy.props.BoolProperty(
        name="Accumulate",
        description="Each pull builds on the last; otherwise each starts from the original shape",
        default=True,
        options=set(),
    )
    mirror: bpy.props.EnumProperty(
        name="Mirror",
        description="Pull on the other side of the object too, mirrored across these axes of the object",
        items=AXES,
        default=set(),
        options={'ENUM_FLAG'},
    )
    use_minimum: bpy.props.BoolProperty(
        name="Use Minimum", description="Leave vertices alone that lie below a height", default=False, options=set()
    )
    minimum: bpy.props.FloatProperty(
        name="Minimum", description="Height below which vertices are not moved", default=-1.0, subtype='DISTANCE', options=set()
    )
    use_maximum: bpy.props.BoolProperty(
        name="Use Maximum", description="Leave vertices alone that lie above a height", default=False, options=set()
    )
    maximum: bpy.props.FloatProperty(
        name="Maximum", description="Height above which vertices are not moved", default=1.0, subtype='DISTANCE', options=set()
    )
    clamp_axis: bpy.props.EnumProperty(
        name="Height Axis", description="Axis along which the height is measured", items=AXES, default='Z', options=set()
    )
    vertex_group: bpy.props.StringProperty(
        name="Vertex Group",
        description="Vertex group whose weights tell how far each vertex moves; empty moves all vertices alike",
        options=set(),
    )


KEYWORDS = tuple(BrushKeywords.__annotations__)


def _ensure_curve(settings):
    # Only the brush has a curve; the operator offers the same enum item.
    if isinstance(settings, MOTUS_PG_brush) and settings.falloff == 'CURVE':
        falloff_curve.ensure(settings)


class MOTUS_PG_pull_record(BrushKeywords, bpy.types.PropertyGroup):
    """Record of the last stroke of pulls, from which a pin can be made."""

    object: bpy.props.StringProperty(name="Object", description="Name of the object that was pulled", options=set())
    is_shape: bpy.props.BoolProperty(
        name="Shape", description="The stroke did more than a pull at one root: a pin of it keeps the shape", options=set()
    )
    vertex: bpy.props.IntProperty(name="Vertex", description="Index of the root", options=set())
    place: bpy.props.FloatVectorProperty(
        name="Place", description="Position of the root before the pull, in the object", size=3, subtype='XYZ', options=set()
    )
    displacement: bpy.props.FloatVectorProperty(
        name="Displacement", description="Displacement of the root, in the object", size=3, subtype='XYZ', options=set()
    )
    metric: bpy.props.FloatVectorProperty(
        name="Metric",
        description="Matrix, row by row, that converts vectors of the object to vectors whose lengths are measured",
        size=9,
        default=(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        options=set(),
    )
    curve: bpy.props.FloatVectorProperty(
        name="Curve", description="Forces at equal steps from the radius to the root", size=CURVE_SAMPLES, options=set()
    )
    welded: bpy.props.IntProperty(
        name="Welded", description="Number of vertices that moved as one with another, by the weld distance", options=set()
    )


class MOTUS_PG_dab(bpy.types.PropertyGroup):
    """Record of one dab (one application of the brush), so that Redo can repeat it."""

    kind: bpy.props.EnumProperty(name="Kind", description="Kind of change that the dab made", items=DAB_KINDS, options=set())
    vertex: bpy.props.IntProperty(name="Vertex", description="Index of the root", options=set())
    displacement: bpy.props.FloatVectorProperty(
        name="Displacement", description="Displacement of the root, in the object", size=3, subtype='XYZ', options=set()
    )
    radius: bpy.props.FloatProperty(name="Radius", description="Distance from the root that the pull reached", options=set())
    strength: bpy.props.FloatProperty(name="Strength", description="Strength of the smoothing", options=set())
    is_first: bpy.props.BoolProperty(name="First", description="A stroke begins with this dab", options=set())


class MOTUS_PG_brush(BrushKeywords, bpy.types.PropertyGroup):
    edge_count: bpy.props.IntProperty(
        name="Radius",
        description="How many edges away from the vertex that is pulled the pull reaches",
        min=1,
        soft_max=100,
        options=set(),
        get=lambda brush: max(1, round(brush.radius)),
        set=lambda brush, count: setattr(brush, "radius", float(count)),
    )
    fitted_radius: bpy.props.FloatProperty(
        name="Fitted Radius", description="The radius that was set by an object's size", options={'HIDDEN'}
    )
    fitted_strength: bpy.props.FloatProperty(
        name="Fitted Strength", description="The strength that was set by an object's size", options={'HIDDEN'}
    )
    curve_nodes: drawn_curves.pointer()
    use_pressure_strength: bpy.props.BoolProperty(
        name="Strength Pressure", description="The pen's pressure sets the strength", default=True, options=set()
    )
    use_pressure_size: bpy.props.BoolProperty(
        name="Size Pressure", description="The pen's pressure sets the radius", default=False, options=set()
    )
    show_inset: bpy.props.BoolProperty(
        name="Inset View",
        description="Show a perspective view in the corner while pulling",
        default=False,
        options=set(),
        update=lambda _brush, _context: viewports.redraw(),
    )
    last: bpy.props.PointerProperty(
        type=MOTUS_PG_pull_record, name="Last Pull", description="Last pull, which a pin can be made of", options={'HIDDEN'}
    )


def is_finite(value):
    """Whether a number, or each number of a sequence, is smaller in size than LARGEST.

    This excludes infinity, which Blender stores as the largest number of a property.
    """
    return all(abs(one) < LARGEST for one in (value if hasattr(value, "__len__") else (value,)))


classes = (MOTUS_PG_pull_record, MOTUS_PG_dab, MOTUS_PG_brush)
