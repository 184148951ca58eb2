"""Settings of a stereo rig, in Object.motus.stereo of the camera object."""

import math
from functools import partial

import bpy

from ..core.file.pointers import to_object
from ..core.settings import ANIMATED, OVERRIDABLE, SystemSettings, rewire, touch
from ..core.settings.declared import number
from . import screens

CONVERGENCES = (
    ('DISTANCE', "Distance", "The screen is at a distance along the camera's axis"),
    ('OBJECT', "Object", "The screen is where an object is along the camera's axis"),
    (
        'BUDGET',
        "Depth Budget",
        "Convergence and interocular distance follow from the depths of the scene and the parallax that they may have",
    ),
)


_number = partial(number, options=ANIMATED)
_parallax = partial(_number, min=0.0, soft_max=5.0, subtype='PERCENTAGE', precision=2)


class StereoKeywords:
    """Mixin with the properties that a rig's settings and the operator that adds a rig have in common.

    The names of the properties are the operator's keywords in scripts.
    """

    convergence: bpy.props.EnumProperty(
        name="Convergence",
        description="What sets the convergence distance, at which things are neither in front of the screen nor behind it",
        items=CONVERGENCES,
        default='DISTANCE',
        options=ANIMATED,
        update=touch,
        override=OVERRIDABLE,
    )
    interocular: _number(
        "Interocular",
        "Distance between the camera's eyes, in the scene's units",
        0.065,
        min=0.0,
        soft_max=1.0,
        subtype='DISTANCE',
        precision=4,
        step=0.1,
    )
    distance: _number(
        "Distance",
        "Distance from the camera at which things lie on the screen; nearer ones come out of it, farther ones lie behind",
        2.0,
        min=0.0,
        soft_min=0.1,
        soft_max=1000.0,
        subtype='DISTANCE',
    )
    near: _number(
        "Near",
        "Distance from the camera to the nearest thing that counts for the depth budget: it gets Near Parallax",
        2.0,
        min=0.0,
        soft_min=0.01,
        soft_max=1000.0,
        subtype='DISTANCE',
    )
    far: _number(
        "Far",
        "Distance from the camera to the farthest thing that counts for the depth budget: it gets Far Parallax",
        10.0,
        min=0.0,
        soft_min=0.01,
        soft_max=10000.0,
        subtype='DISTANCE',
    )
    near_parallax: _parallax(
        "Near Parallax",
        "How far both eyes' pictures of the nearest thing are apart, in front of the screen, in percent of the image's width",
        1.0,
        max=100.0,
    )
    far_parallax: _parallax(
        "Far Parallax",
        "How far both eyes' pictures of the farthest thing are apart, behind the screen, in percent of the image's width",
        2.0,
        max=100.0,
    )
    screen: bpy.props.EnumProperty(
        name="Screen",
        description="Screen that the audience looks at; warnings are about this screen",
        items=screens.ITEMS,
        default='TELEVISION',
        options=set(),
        override=OVERRIDABLE,
    )
    screen_width: _number("Screen Width", "Width of a custom screen, in metres", 2.0, options=set(), min=0.01, soft_max=50.0)
    screen_distance: _number(
        "Seen From", "Distance from the audience to a custom screen, in metres", 3.0, options=set(), min=0.05, soft_max=50.0
    )
    eye_separation: _number(
        "Eye Separation", "Distance between the eyes of the audience, in metres", 0.065, options=set(), min=0.01, max=0.2, precision=3
    )


KEYWORDS = tuple(StereoKeywords.__annotations__)


class MOTUS_PG_stereo(StereoKeywords, SystemSettings, bpy.types.PropertyGroup):
    focus: to_object(
        name="Focus", description="Object that lies on the screen, if Convergence is Object", update=rewire, override=OVERRIDABLE
    )
    influence: _number(
        "Influence",
        "How much the rig sets the camera's eyes; 0 leaves them at the camera's own values",
        1.0,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
    )
    window_left: _parallax(
        "Left Window",
        "Parallax of the picture's left edge in front of the screen, in percent of the image's width: so much of the left eye is masked",
        0.0,
        max=50.0,
    )
    window_right: _parallax(
        "Right Window",
        "Parallax of the picture's right edge in front of the screen, in percent of the image's width: so much of the right eye is masked",
        0.0,
        max=50.0,
    )
    before_mode: bpy.props.StringProperty(
        name="Mode Before", description="Convergence mode that the camera had without the rig", options={'HIDDEN'}
    )
    before_pivot: bpy.props.StringProperty(name="Pivot Before", description="Pivot that the camera had without the rig", options={'HIDDEN'})
    before_type: bpy.props.StringProperty(
        name="Type Before", description="Type that the camera had before it was made to see all around", options={'HIDDEN'}
    )
    before_panorama: bpy.props.StringProperty(
        name="Panorama Before", description="Kind of panorama that the camera had before it was made to see all around", options={'HIDDEN'}
    )
    before_spherical: bpy.props.BoolProperty(
        name="Spherical Before",
        description="Whether the camera's stereo was spherical before it was made to see all around",
        options={'HIDDEN'},
    )
    before_merge: bpy.props.BoolProperty(
        name="Merge Before",
        description="Whether the eyes met at the poles before the camera was made to see all around",
        options={'HIDDEN'},
    )
    before_angles: bpy.props.FloatVectorProperty(
        name="Angles Before",
        description="Limits of latitude and longitude that the camera's panorama had before it was made to see all around",
        size=4,
        default=(-0.5 * math.pi, 0.5 * math.pi, -math.pi, math.pi),
        options={'HIDDEN'},
    )


class MOTUS_PG_stereo_scene(bpy.types.PropertyGroup):
    is_multiview_made: bpy.props.BoolProperty(
        name="Multiview Made", description="A rig has switched multiview on in the scene", options={'HIDDEN'}
    )
    before_views: bpy.props.StringProperty(
        name="Views Before", description="Format of views that the scene had before a rig switched multiview on", options={'HIDDEN'}
    )
    before_height: bpy.props.IntProperty(
        name="Height Before",
        description="Height of pictures that the scene had before a camera was made to see all around",
        options={'HIDDEN'},
    )
