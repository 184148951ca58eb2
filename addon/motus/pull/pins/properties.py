"""Settings of pins in Object.motus.pull: a list of pulls that the solver applies on each evaluation."""

import bpy

from ...core.settings import ANIMATED, EXTENDABLE, OVERRIDABLE, SystemSettings, touch
from ...core.settings.declared import choice, number, switch, vector
from ..falloff_curve import CURVE_SAMPLES
from ..properties import AXES, DISTANCES, FALLOFFS

UNIT_METRIC = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


class MOTUS_PG_pin(bpy.types.PropertyGroup):
    name: bpy.props.StringProperty(name="Name", description="Name of the pin", options=set(), override=OVERRIDABLE)
    strength: number(
        "Strength",
        "How much of its displacement the pinned vertex moves by: 0 nothing, 1 all of it; negative moves it the other way",
        1.0,
        options=ANIMATED,
        soft_min=-2.0,
        soft_max=2.0,
    )
    is_muted: switch("Mute", "Switch the pin off", options=ANIMATED)
    radius: number(
        "Radius",
        "How far the pull reaches from the vertex that is pulled; a number of edges if Distance is Edges",
        1.0,
        min=1e-6,
        soft_min=0.01,
        soft_max=100.0,
    )
    falloff: choice(
        "Falloff",
        "How the pull fades from the vertex that is pulled, which it moves whole, to the radius, where it moves nothing",
        FALLOFFS,
        'SMOOTH',
    )
    scale_factor: number(
        "Scale Factor",
        "How steep the falloff Classic is: 0 is the least steep, and larger numbers, negative ones too, are steeper",
        0.0,
        soft_min=-10.0,
        soft_max=10.0,
    )
    curve: vector("Curve", "Forces at equal steps from the radius to the root", CURVE_SAMPLES, options={'HIDDEN'})
    distance: choice(
        "Distance", "How the distance from the vertex that is pulled is measured, by which the others come along", DISTANCES, 'STRAIGHT'
    )
    weld: number("Weld Distance", "Vertices within this distance of each other move as one; 0 welds none", 0.0, min=0.0, soft_max=0.1)
    displacement: vector(
        "Displacement", "How far the pinned vertex goes at a strength of 1, along the object's own axes and in its units", 3, subtype='XYZ'
    )
    mirror: choice(
        "Mirror", "Pull on the other side of the object too, mirrored across these axes of the object", AXES, set(), options={'ENUM_FLAG'}
    )
    use_minimum: switch("Use Minimum", "Leave vertices alone that lie below a height")
    minimum: number("Minimum", "Height below which the pin moves no vertices, in the object", -1.0)
    use_maximum: switch("Use Maximum", "Leave vertices alone that lie above a height")
    maximum: number("Maximum", "Height above which the pin moves no vertices, in the object", 1.0)
    clamp_axis: choice("Height Axis", "Axis along which the height is measured", AXES, 'Z')
    vertex_group: bpy.props.StringProperty(
        name="Vertex Group",
        description="Vertex group whose weights tell how far each vertex moves; empty moves all vertices alike",
        options=set(),
        update=touch,
        override=OVERRIDABLE,
    )
    shape: bpy.props.StringProperty(
        name="Shape",
        description="Name of the mesh's attribute that stores the displacement of each vertex, for a pin that was made of a stroke; empty "
        "for a pin with a root",
        options={'HIDDEN'},
        update=touch,
        override=OVERRIDABLE,
    )
    metric: vector(
        "Metric",
        "Matrix, row by row, that converts vectors of the object to vectors whose lengths are measured",
        9,
        default=UNIT_METRIC,
        options={'HIDDEN'},
    )
    place: vector("Place", "Position of the root in the mesh", 3, subtype='XYZ', options={'HIDDEN'})
    anchor: bpy.props.IntProperty(
        name="Anchor",
        description="Number by which the mesh marks the root; 0 if the mesh has no mark",
        options={'HIDDEN'},
        override=OVERRIDABLE,
    )
    vertex: bpy.props.IntProperty(
        name="Vertex", description="Index that the root had at the last evaluation", options={'HIDDEN'}, override=OVERRIDABLE
    )


class MOTUS_PG_pull(SystemSettings, bpy.types.PropertyGroup):
    influence: bpy.props.FloatProperty(
        name="Influence",
        description="How much all pins together move the mesh",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
        options=ANIMATED,
        override=OVERRIDABLE,
        update=touch,
    )
    pins: bpy.props.CollectionProperty(type=MOTUS_PG_pin, name="Pins", override=EXTENDABLE)
    active_pin: bpy.props.IntProperty(name="Active Pin", options=set(), override=OVERRIDABLE)


classes = (MOTUS_PG_pin, MOTUS_PG_pull)
