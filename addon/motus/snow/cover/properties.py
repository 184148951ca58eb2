"""Settings of lying snow: the property group Object.motus.snow_cover of the object that shows the layer."""

import math

import bpy

from ...core.file.pointers import to_object
from ...core.settings import ANIMATED, EXTENDABLE, OVERRIDABLE, SystemSettings, rewire, touch
from ...core.settings.declared import number
from . import look


def _dress(settings, _context):
    if settings.is_active:
        look.dress(settings.id_data)


class SnowCoverKeywords:
    """Mixin of a cover's settings and of the operator that adds a cover; in scripts the names are the operator's keywords."""

    lump: number(
        "Snow per Flake",
        "Size of the lump of snow that each landed flake adds, as the edge of a cube: twice the size lets snow grow eight times as fast",
        0.1,
        min=1e-5,
        max=1e3,
        soft_min=0.005,
        soft_max=0.5,
        subtype='DISTANCE',
    )
    resolution: number(
        "Resolution",
        "Length of edges up to which the faces of the snow layer are divided: a small one shows fine detail, and takes longer to compute",
        0.1,
        min=1e-4,
        max=1e6,
        soft_min=0.02,
        soft_max=1.0,
        subtype='DISTANCE',
    )
    viewport_resolution: number(
        "Viewport Resolution",
        "Length of edges in the viewport, where a coarser snow layer is computed faster; up to that of Resolution it has no effect, and "
        "none on renders",
        0.0,
        min=0.0,
        max=1e6,
        soft_max=1.0,
        subtype='DISTANCE',
    )
    repose: number(
        "Slope",
        "Steepest slope on which all snow stays where it lands; the steeper a slope is beyond it, the more of its snow slides down",
        math.radians(50.0),
        min=0.0,
        max=math.radians(89.0),
        subtype='ANGLE',
    )
    smoothing: number("Smoothing", "How far snow spreads to what lies beside it", 0.25, min=0.0, max=1e6, soft_max=2.0, subtype='DISTANCE')
    thinnest: number(
        "Thinnest",
        "Least depth of snow that is shown: thinner snow is hidden, so that the surface shows between the first flakes",
        0.004,
        min=0.0,
        max=1e3,
        soft_max=0.05,
        subtype='DISTANCE',
    )
    packed: number(
        "Packed Snow",
        "Depth of the snow that stays, packed, under what leaves marks: at 0 the surface is swept",
        0.02,
        min=0.0,
        max=1e3,
        soft_max=0.2,
        subtype='DISTANCE',
    )
    depth_group: bpy.props.StringProperty(
        name="Depth Group",
        description="Vertex group, or attribute of numbers, of the surfaces by whose weights the snow's depth is multiplied",
        options=set(),
        update=touch,
        override=OVERRIDABLE,
    )
    influence: number(
        "Influence",
        "Share of the snow's depth that is shown: snow melts as it goes to 0",
        1.0,
        ANIMATED,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
    )


KEYWORDS = tuple(SnowCoverKeywords.__annotations__)


class MOTUS_PG_snow_cover_entry(bpy.types.PropertyGroup):
    """An item in a cover's list of surfaces, emitters or movers."""

    object: to_object(
        name="Object",
        description="Mesh object that snow lies on or that leaves marks, or emitter of snow",
        update=rewire,
        override=OVERRIDABLE,
    )


class MOTUS_PG_snow_cover(SystemSettings, SnowCoverKeywords, bpy.types.PropertyGroup):
    surfaces: bpy.props.CollectionProperty(type=MOTUS_PG_snow_cover_entry, name="Surfaces", override=EXTENDABLE)
    collection: bpy.props.PointerProperty(
        type=bpy.types.Collection,
        name="Collection",
        description="Snow lies on the meshes of this collection too",
        update=rewire,
        override=OVERRIDABLE,
    )
    emitters: bpy.props.CollectionProperty(type=MOTUS_PG_snow_cover_entry, name="Snow", override=EXTENDABLE)
    movers: bpy.props.CollectionProperty(type=MOTUS_PG_snow_cover_entry, name="Movers", override=EXTENDABLE)
    material: bpy.props.PointerProperty(
        type=bpy.types.Material, name="Material", description="Material of the lying snow", update=_dress, override=OVERRIDABLE
    )
    reads: bpy.props.StringProperty(
        name="Reads", description="Objects that the solver waits for, to notice changes", options={'HIDDEN'}, override=OVERRIDABLE
    )
