"""Settings of snow: the property group Object.motus.snow of the emitter."""

import math

import bpy

from ..core.file import former_names
from ..core.file.pointers import to_object
from ..core.settings import ANIMATED, EXTENDABLE, OVERRIDABLE, SystemSettings, rewire, touch
from ..core.settings.declared import number, switch, whole
from . import look

SHAPES = (
    ('SQUARE', "Square", "Flakes leave a square along the emitter's +Z"),
    ('DISC', "Disc", "Flakes leave a disc along the emitter's +Z"),
    ('BOX', "Box", "Flakes are born within a cube and leave along the emitter's +Z"),
    ('SPHERE', "Sphere", "Flakes are born within a ball and leave its middle"),
    ('CONE', "Cone", "Flakes leave a disc, leaning outwards, at its edge by the cone angle"),
    ('SURFACE', "Mesh Surface", "A mesh emits the flakes from its faces along their normals, evenly over their area"),
    ('CAMERA', "Camera View", "Flakes are born evenly in the view of a camera, and fall down"),
)
LOOKS = (
    ('FLAKE', "Six-Armed Flake", "A flat crystal with six arms"),
    ('PETAL', "Petal", "A petal, bent up at its ends"),
    ('SPECK', "Speck", "A small solid"),
    ('SPARK', "Spark", "A small solid that glows"),
    ('OBJECT', "Object", "Instances of an object"),
    ('COLLECTION', "Collection", "Instances of a collection's objects, which flakes choose among by their numbers"),
    ('POINTS', "Points", "Bare points, which Blender draws fastest"),
)
COLLISIONS = (
    ('STAY', "Stay", "Flakes lie where they have landed, as long as they live"),
    ('SLIDE', "Slide", "Flakes slide down what is steep, and lie where they come to rest"),
    ('MELT', "Melt", "Flakes that have landed shrink to nothing"),
)
WHITE = (1.0, 1.0, 1.0, 1.0)


def _dress(settings, context):
    if isinstance(settings, SystemSettings) and settings.is_active:
        look.dress(settings.id_data)
    touch(settings, context)


def _redress(settings, context):
    rewire(settings, context)
    _dress(settings, context)


class SnowKeywords:
    """Mixin of an emitter's settings and of the operator that adds snow; in scripts the names are the operator's keywords.

    Most of these properties cannot be animated: all flakes of all times follow from a single value of each, and with keys there would be
    different flakes on each frame.
    """

    start_speed: number("Speed", "Speed at which flakes leave the emitter", 5.0, soft_min=0.0, soft_max=10.0, unit='VELOCITY')
    lifetime: number("Lifetime", "Seconds after which a flake is gone", 2.0, min=0.0, soft_min=0.1, soft_max=100.0, unit='TIME_ABSOLUTE')
    start_size: number(
        "Size", "Size of the flakes, as a multiple of Flake Width or the scale of an object", 1.0, min=0.0, soft_min=0.1, soft_max=10.0
    )
    rate: number("Rate", "Flakes that are born in a second; it may be keyed", 5.0, ANIMATED, min=0.0, soft_max=1000.0, step=1000)
    delay: number(
        "Delay", "Seconds from the start frame until the first flakes are born", 0.0, min=0.0, soft_max=10.0, unit='TIME_ABSOLUTE'
    )
    duration: number("Duration", "Seconds for which flakes are born", 5.0, min=0.0, soft_max=10.0, unit='TIME_ABSOLUTE')
    looping: switch("Looping", "Flakes are born for ever, whatever the duration is", True)
    burst: whole("Burst", "Flakes that are born all at once, beside those of the rate", 0, min=0, soft_max=1000)
    burst_time: number("Burst Time", "Seconds after the delay at which they are born", 0.0, min=0.0, soft_max=10.0, unit='TIME_ABSOLUTE')
    start_frame: number(
        "Start", "Frame at which the snow's time starts; before the scene's first frame, flakes are already in the air there", 1.0, step=100
    )

    time_speed: number(
        "Tempo",
        "Speed of the snow's own time: 0.5 is slow motion, and at 0 it stands still; it may be keyed",
        1.0,
        ANIMATED,
        min=0.0,
        max=1000.0,
        soft_max=2.0,
    )
    use_loop: switch("Loop", "Let the snowfall repeat over a range of frames, without a seam")
    loop_start: whole("Start", "First frame of the loop", 1)
    loop_end: whole("End", "Frame on which the loop begins again, which looks like its first one", 251)

    shape: bpy.props.EnumProperty(
        name="Emitter",
        description="Shape in which the flakes are born",
        items=SHAPES,
        default='SQUARE',
        options=set(),
        update=rewire,
        override=OVERRIDABLE,
    )
    emitter_radius: number(
        "Radius", "Radius of the disc, ball or cone; half the width of the square or box", 1.0, min=0.0, soft_max=10.0, subtype='DISTANCE'
    )
    cone_angle: number(
        "Cone Angle",
        "Largest angle by which flakes lean outwards: at the edge of a cone, or at random",
        0.0,
        min=0.0,
        max=math.pi,
        soft_max=0.5 * math.pi,
        subtype='ANGLE',
    )

    emitter_velocity: number(
        "Emitter Velocity",
        "Share of the emitter's velocity that flakes leave with, beside their own",
        0.0,
        min=-1e3,
        max=1e3,
        soft_min=0.0,
        soft_max=1.0,
    )
    use_local: switch("Local Space", "Flakes follow the emitter, as if it had always stood where it stands now")
    use_scale: switch("Size by Scale", "The emitter's scale counts for the size of the flakes")

    closest: number(
        "Closest", "Smallest distance from the camera at which flakes are born", 0.5, min=0.0, soft_max=10.0, subtype='DISTANCE'
    )
    farthest: number(
        "Farthest", "Largest distance from the camera at which flakes are born", 20.0, min=1e-3, soft_max=100.0, subtype='DISTANCE'
    )

    follow_markers: switch(
        "Follow Markers",
        "Where markers of the timeline bind the camera, flakes are born in the view of whichever camera is bound",
        True,
        update=rewire,
    )

    random_speed: switch("Random Speed", "Vary the speed by up to 1 m/s")
    random_orientation: switch("Random Orientation", "Flakes leave anywhere within the cone angle")
    random_lifetime: switch("Random Lifetime", "Vary the lifetime by up to 1 s")
    random_size: switch("Random Size", "Vary the size by up to 10 %")
    random_color: switch("Random Color", "Each flake has a colour from anywhere on the gradient, not its first one")
    seed: whole("Seed", "Seed of all random numbers", 0, min=0)

    use_steering: switch("Snow", "Flakes steer through the air, as a smooth noise of their age turns them")
    max_angle: number(
        "Max Angle",
        "Largest angle by which steering turns the flakes' way about the world's X and Y axes",
        math.radians(80.0),
        min=0.0,
        soft_max=math.pi,
        subtype='ANGLE',
    )
    steering_frequency: number("Frequency", "Approximate number of turns of a flake per second", 1.0, min=1e-3, max=1000.0, soft_max=5.0)
    steering_per_flake: switch(
        "Individual Paths", "Each flake steers along a path of its own; otherwise all flakes of the same age turn alike"
    )

    gravity: switch("Gravity", "The scene's gravity pulls flakes down")
    drag: number(
        "Air Drag",
        "How quickly flakes take on the velocity of the air, per second: at 0 they do not feel the wind, at 10 they drift with it "
        "almost at once",
        0.0,
        min=0.0,
        max=1000.0,
        soft_max=10.0,
    )
    wind: bpy.props.FloatVectorProperty(
        name="Wind",
        description="Velocity of the air along the world's axes, which flakes feel if Air Drag is above 0; it may be keyed",
        size=3,
        subtype='XYZ',
        unit='VELOCITY',
        options=ANIMATED,
        update=touch,
        override=OVERRIDABLE,
    )
    gusts: number("Gusts", "Share of the wind by which gusts vary it", 0.0, min=0.0, soft_max=1.0)
    gust_frequency: number("Gust Frequency", "Approximate number of gusts per second", 0.3, min=1e-3, max=1000.0, soft_max=5.0)
    turbulence: number("Turbulence", "Velocity of the eddies that carry flakes along", 0.0, min=0.0, max=1e6, soft_max=5.0, unit='VELOCITY')
    turbulence_size: number("Eddy Size", "Diameter of the eddies", 1.0, min=1e-6, soft_min=0.1, soft_max=10.0, subtype='DISTANCE')
    tumble: number(
        "Tumble",
        "Largest angle per second by which flakes turn about their own axes",
        0.0,
        min=0.0,
        max=1e6,
        soft_max=20.0,
        subtype='ANGLE',
    )

    use_ground: switch("Ground", "Flakes land on a level plane")
    ground: number("Height", "Height of the ground, along the world's Z axis", 0.0, subtype='DISTANCE')
    collision: bpy.props.EnumProperty(
        name="Landed",
        description="What a flake does after it has landed on a collider or on the ground: it lies still, slides downhill, or melts",
        items=COLLISIONS,
        default='STAY',
        options=set(),
        update=touch,
        override=OVERRIDABLE,
    )
    melt_time: number("Melt Time", "Seconds in which landed flakes melt", 1.0, min=0.01, max=1e6, soft_max=10.0, unit='TIME_ABSOLUTE')
    friction: number(
        "Friction",
        "Friction of what flakes land on; flakes do not slide on slopes whose tangent is smaller",
        0.5,
        min=0.0,
        max=1e3,
        soft_max=2.0,
    )

    look: bpy.props.EnumProperty(
        name="Flakes",
        description="What each flake looks like: a shape that Motus makes, an object or a collection of your own, or a bare point",
        items=LOOKS,
        default='FLAKE',
        options=set(),
        update=_redress,
        override=OVERRIDABLE,
    )
    flake_width: number(
        "Flake Width", "Width of flakes and points of size 1", 0.05, min=0.0, soft_min=0.001, soft_max=1.0, subtype='DISTANCE'
    )
    all_attributes: switch(
        "All Attributes",
        "For nodes of your own, flakes also have what Blender does not need of them: instances a velocity, and bare points a turn",
        update=rewire,
    )
    preview: number(
        "Preview",
        "Percentage of the flakes that the viewport shows; they are some of those that are rendered",
        100.0,
        min=0.0,
        max=100.0,
        subtype='PERCENTAGE',
    )
    influence: number("Influence", "Whether it snows: 0 hides the snow", 1.0, ANIMATED, min=0.0, max=1.0, subtype='FACTOR')


KEYWORDS = tuple(SnowKeywords.__annotations__)
FORMER_NAMES = {
    "cone_radius": "emitter_radius",
    "snow": "use_steering",
    "snow_frequency": "steering_frequency",
    "snow_offsets": "steering_per_flake",
}
"""{former name: present name} of settings and keywords, for scripts and files of earlier versions."""


class FormerSettings:
    """Mixin of an emitter's settings: the former names of SnowKeywords."""

    __annotations__ = former_names.of_settings(SnowKeywords.__annotations__, FORMER_NAMES)


class FormerKeywords:
    """Mixin of the operator that adds snow: the former names of SnowKeywords."""

    __annotations__ = former_names.of_keywords(SnowKeywords.__annotations__, FORMER_NAMES)


class MOTUS_PG_snow_stop(bpy.types.PropertyGroup):
    position: bpy.props.FloatProperty(
        name="Position",
        description="Position on the gradient, from 0 to 1",
        min=0.0,
        max=1.0,
        options=set(),
        update=touch,
        override=OVERRIDABLE,
        subtype='FACTOR',
    )
    color: bpy.props.FloatVectorProperty(
        name="Color",
        description="Color of the gradient at this position",
        size=4,
        subtype='COLOR',
        default=WHITE,
        min=0.0,
        soft_max=1.0,
        options=set(),
        update=touch,
        override=OVERRIDABLE,
    )


def _is_other(settings, obj):
    """Whether an object is different from the emitter that has the settings."""
    return obj != settings.id_data


def _is_other_mesh(settings, obj):
    # If a script sets an object that is no mesh, the panel says that it has no faces.
    return obj.type == 'MESH' and _is_other(settings, obj)


class MOTUS_PG_snow_recorded(bpy.types.PropertyGroup):
    object: to_object(name="Object", description="Collider that was recorded", override=OVERRIDABLE, options={'HIDDEN'})
    count: bpy.props.IntProperty(
        name="Count", description="How many of the recorded triangles are the collider's", min=0, options={'HIDDEN'}, override=OVERRIDABLE
    )


class MOTUS_PG_snow_collider(bpy.types.PropertyGroup):
    object: to_object(
        name="Collider", description="Mesh object that flakes land on", update=rewire, override=OVERRIDABLE, also=_is_other_mesh
    )


class MOTUS_PG_snow(SystemSettings, SnowKeywords, FormerSettings, bpy.types.PropertyGroup):
    stops: bpy.props.CollectionProperty(type=MOTUS_PG_snow_stop, name="Gradient", override=EXTENDABLE)
    surface: to_object('MESH', name="Mesh", description="Mesh that emits the flakes", update=rewire, override=OVERRIDABLE, also=_is_other)
    collider: to_object(
        name="Collider", description="Mesh object that flakes land on", update=rewire, override=OVERRIDABLE, also=_is_other_mesh
    )
    colliders: bpy.props.PointerProperty(
        type=bpy.types.Collection,
        name="Colliders",
        description="Collection whose mesh objects flakes land on",
        update=rewire,
        override=OVERRIDABLE,
    )
    more_colliders: bpy.props.CollectionProperty(
        type=MOTUS_PG_snow_collider, name="More Colliders", description="Further mesh objects that flakes land on", override=EXTENDABLE
    )
    recorded: to_object(
        'MESH', name="Recorded", description="Recorded mesh that flakes land on", update=rewire, override=OVERRIDABLE, options={'HIDDEN'}
    )
    recorded_of: bpy.props.CollectionProperty(
        type=MOTUS_PG_snow_recorded,
        name="Recorded Colliders",
        description="Colliders of the recorded mesh, in the order of its faces",
        override=EXTENDABLE,
        options={'HIDDEN'},
    )
    recorded_frame: bpy.props.FloatProperty(
        name="Recorded Frame", description="Frame on which the colliders were recorded", options={'HIDDEN'}, override=OVERRIDABLE
    )
    camera: to_object('CAMERA', name="Camera", description="Camera in whose view the flakes are born", update=rewire, override=OVERRIDABLE)
    flake: to_object(name="Flake", description="Object that flakes are instances of", update=_dress, override=OVERRIDABLE)
    flakes: bpy.props.PointerProperty(
        type=bpy.types.Collection,
        name="Flakes",
        description="Collection whose objects flakes are instances of",
        update=_dress,
        override=OVERRIDABLE,
    )
    reads: bpy.props.StringProperty(
        name="Reads",
        description="What the solver waits for beside its settings, to notice where it has changed since",
        options={'HIDDEN'},
        override=OVERRIDABLE,
    )
    has_made_emitter: bpy.props.BoolProperty(
        name="Made", description="Motus has made the emitter, and removes it with the snow", options={'HIDDEN'}, override=OVERRIDABLE
    )
