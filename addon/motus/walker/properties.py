"""Settings of walkers: the property group Object.motus.walker of the object that the artist moves."""

import math
from functools import partial

import bpy

from ..core.file.pointers import to_object
from ..core.measures.axes import AXES
from ..core.settings import ANIMATED, EXTENDABLE, OVERRIDABLE, SystemSettings, rewire
from ..core.settings.declared import choice, factor, number, switch, vector, whole
from . import ground

MOST_LEGS = 64

_GAITS = (
    (
        'TETRAPOD',
        "Tetrapod",
        "Two groups take turns, each with every second leg of one side and the legs between on the other side, as spiders go",
    ),
    (
        'TRIPOD',
        "Tripod",
        "Two groups take turns without a pause, each with every second leg of one side and those between on the other, as insects run",
    ),
    ('RIPPLE', "Ripple", "One leg after the other from the back to the front, the sides half a cycle apart"),
    ('WAVE', "Wave", "A single leg at a time, slow and safe"),
    ('TROT', "Trot", "Diagonal halves take turns"),
    ('PACE', "Pace", "Left and right legs take turns"),
    ('OWN', "Custom", "Each leg steps when its own Phase in the list of legs says"),
    ('WALK', "Walk", "Left and right in turn on two legs; on four each hind leg, then the fore leg of its side"),
    ('RUN', "Run", "As Trot, or left and right on two legs, with all feet in the air in between"),
    ('CANTER', "Canter", "Three beats: a hind leg, a diagonal, and the fore leg that leads"),
    ('GALLOP', "Gallop", "Four beats: both hind legs, both fore legs, and all in the air"),
    ('HOP', "Hop", "All legs together"),
)
_LAST = 'OWN'
GAITS = tuple(sorted(((*gait, '', number) for number, gait in enumerate(_GAITS)), key=lambda gait: gait[0] == _LAST))
"""Items of the setting Gait, as the menu shows them. The number of each is what files hold."""


_number = partial(number, tells_no_keys=True)
_factor = partial(factor, tells_no_keys=True)


def _length(name, description, default, **more):
    return _number(name, description, default, min=0.0, soft_max=2.0, subtype='DISTANCE', **more)


def _angle(name, description, degrees):
    return _number(name, description, math.radians(degrees), min=0.0, max=math.radians(90.0), subtype='ANGLE')


class WalkerKeywords:
    """Mixin of a walker's settings and of the operators that add a walker; in scripts the names are the operators' keywords.

    Most of these properties cannot be animated, because the steps of all frames follow from a single value of each. Those of keyed.KEYED
    can be: the plan reads their keys.
    """

    gait: choice("Gait", "Which legs step together, and which after them", GAITS, 'TETRAPOD', ANIMATED)
    use_duty: switch("Custom Duty", "Take the setting Duty for how long feet stand, in place of the gait's own value")
    duty: _number(
        "Duty",
        "Share of the time for which each foot stands; for the rest it swings to its next foothold: small in a run, large in a slow walk",
        0.6,
        ANIMATED,
        min=0.05,
        max=0.95,
        subtype='FACTOR',
    )
    stride: _length(
        "Stride",
        "How far the body goes, at most, while a foot stands: a faster body takes more steps, not longer ones",
        0.5,
        options=ANIMATED,
    )
    cadence: _number(
        "Cadence",
        "How many steps each leg takes per second, at least; it takes more if the body would otherwise need steps longer than Stride",
        1.0,
        ANIMATED,
        min=1e-3,
        max=100.0,
        soft_min=0.2,
        soft_max=5.0,
    )
    use_natural: switch(
        "Natural Stride",
        "Take the length of steps from Hip Height and the body's speed, as measured on animals of all sizes, in place of Stride",
    )
    hip_height: _length("Hip Height", "How high the hips are above the ground; 0 takes the height of the legs", 0.0)
    transition: _number(
        "Transition",
        "How many steps each leg takes, from a key of Gait on, until it has gone over to the new gait; 1 is the quickest change",
        1.0,
        min=1.0,
        max=100.0,
        soft_max=4.0,
    )
    clearance: _length("Clearance", "How high feet are carried above the ground", 0.1)
    minimum_step: _length(
        "Minimum Step",
        "Feet that are no further than this from their rest positions do not step, so that a trembling body does not patter",
        0.0,
    )
    reach_up: _length("Reach Up", "How far above the feet's rest positions ground is searched for", 0.5)
    reach_down: _length("Reach Down", "How far below the feet's rest positions ground is searched for", 1.0)
    use_plane: switch("Plane", "Walk on a level plane too, beside the meshes")
    plane_height: _number("Height", "Height of the plane, along the world's Z axis", 0.0, subtype='DISTANCE')
    body_height: _factor("Rise", "How much the body rises and sinks with the feet that stand", 1.0)
    body_tilt: _factor("Tilt", "How much the body leans with the feet that stand", 0.7)
    frequency: _number("Frequency", "How quickly the body follows its feet, in Hz", 1.5, min=1e-3, max=1000.0, soft_min=0.2, soft_max=5.0)
    damping: _number(
        "Damping", "Damping of the body over its feet; below 1 the body overshoots and swings", 1.0, min=0.0, max=100.0, soft_max=2.0
    )
    ankle: _length("Ankle", "How high the feet's origins are above the ground that they stand on", 0.0)
    use_soles: switch(
        "Soles",
        "Turn feet with the ground, and roll them over heel and toe; their rest positions tell where they point",
        update=rewire,
    )
    heel: _length("Heel", "How far behind the feet's origins their heels are", 0.05)
    toe: _length("Toe", "How far ahead of the feet's origins their toes are", 0.15)
    strike: _angle("Heel Strike", "How far the toes are up when the heels touch the ground; less in short steps", 20.0)
    push: _angle("Toe Push", "How far the heels are up when the toes leave the ground; less in short steps", 50.0)
    jump: _number(
        "Jump",
        "A body that goes further than this from one frame to the next jumps, and its feet with it; 0 takes four strides",
        0.0,
        min=0.0,
        soft_max=10.0,
        subtype='DISTANCE',
    )
    forward_axis: choice("Forward", "Axis of the body that points ahead", AXES, 'POS_Y')
    up_axis: choice("Up", "Axis of the body that points away from the ground", AXES, 'POS_Z')
    influence: _factor("Influence", "How much the walk moves feet and body; 0 leaves them to their own animation", 1.0, ANIMATED)


KEYWORDS = tuple(WalkerKeywords.__annotations__)
NUMBERS = (
    "duty",
    "stride",
    "cadence",
    "clearance",
    "minimum_step",
    "reach_up",
    "reach_down",
    "plane_height",
    "body_height",
    "body_tilt",
    "frequency",
    "damping",
    "ankle",
    "heel",
    "toe",
    "strike",
    "push",
    "jump",
    "transition",
    "hip_height",
)
"""Names of the number settings that the plan is made from. A script can give them values that are not finite."""


def _numbers(name, description):
    return vector(name, description, subtype='XYZ', unit='LENGTH', options={'HIDDEN'})


class MOTUS_PG_walker_leg(bpy.types.PropertyGroup):
    name: bpy.props.StringProperty(
        name="Bone",
        description="Bone of the armature that is the foot; empty where it is an object",
        update=rewire,
        options=set(),
        override=OVERRIDABLE,
    )
    foot: to_object(name="Foot", description="Object that is the foot", update=rewire, override=OVERRIDABLE, options={'HIDDEN'})
    rest: _numbers("Rest", "Position of the foot, in the body's space, if the body stands on level ground")
    turn: vector(
        "Turn",
        "Rotation of the foot, in the body's space, if the body stands on level ground",
        4,
        default=(1.0, 0.0, 0.0, 0.0),
        subtype='QUATERNION',
        options={'HIDDEN'},
    )
    hip: _numbers("Hip", "Position where the leg begins, in the body's space")
    length: _length("Length", "Length of the whole leg, before the body's scale; 0 for a leg that reaches everywhere", 0.0)
    phase: _factor(
        "Phase",
        "When this leg steps if the gait is Custom, as a share of the time from step to step: legs of the same "
        "phase step together, and 0 and 1 are the same",
        0.0,
    )


class MOTUS_PG_walker_step(bpy.types.PropertyGroup):
    leg: whole("Leg", "Index of the leg whose step was changed", 0, min=0, options={'HIDDEN'})
    frame: _number("Frame", "Frame on which the foot stands, or swings to its foothold", 0.0)
    offset: _numbers("Offset", "How far the foothold was moved, along the body's axes; the foot stands on the ground there")
    turn: _number(
        "Turn",
        "Angle by which the foot is turned about the ground's normal",
        0.0,
        subtype='ANGLE',
        soft_min=-math.pi,
        soft_max=math.pi,
    )
    use_touch: switch("Set Landing", "Have the foot land on a frame of its own; its steps before and after make room")
    touch: _number("Lands", "Frame on which the foot touches the ground, if it is set", 0.0)
    use_lift: switch("Set Lifting", "Have the foot stand until a frame of its own; its steps before and after make room")
    lift: _number("Lifts", "Frame until which the foot stands, if it is set", 0.0)
    is_locked: switch("Locked", "The foot stands at the place, whatever body and ground do", options={'HIDDEN'})
    place: _numbers("Place", "Where the foot of a locked step stands, in the world or in the carrier's space")
    rotation: vector(
        "Rotation",
        "Rotation of the sole of a locked step, from the body's space",
        4,
        default=(1.0, 0.0, 0.0, 0.0),
        subtype='QUATERNION',
        options={'HIDDEN'},
    )


class MOTUS_PG_walker(SystemSettings, WalkerKeywords, bpy.types.PropertyGroup):
    legs: bpy.props.CollectionProperty(type=MOTUS_PG_walker_leg, name="Legs", override=EXTENDABLE)
    steps: bpy.props.CollectionProperty(type=MOTUS_PG_walker_step, name="Changed Steps", override=EXTENDABLE)
    body: to_object(
        name="Body",
        description="Object below the one that is moved, which rises and leans with the feet",
        update=rewire,
        override=OVERRIDABLE,
        also=lambda settings, obj: obj.parent == settings.id_data,
    )
    body_bone: bpy.props.StringProperty(
        name="Body",
        description="Bone of the armature that rises and leans with the feet",
        update=rewire,
        options=set(),
        override=OVERRIDABLE,
    )
    ground: to_object(
        'MESH',
        name="Ground",
        description="Mesh object that the feet stand on",
        update=rewire,
        override=OVERRIDABLE,
        also=lambda _settings, obj: not ground.is_walking(obj),
    )
    carrier: to_object(
        name="Carrier",
        description="Object that carries body and ground, such as a ship, a lift or a turntable: feet stand on the meshes that hang on it",
        update=rewire,
        override=OVERRIDABLE,
        also=lambda _settings, obj: not ground.is_walking(obj),
    )
    grounds: bpy.props.PointerProperty(
        type=bpy.types.Collection,
        name="Collection",
        description="Collection whose mesh objects the feet stand on",
        update=rewire,
        override=OVERRIDABLE,
    )


classes = (MOTUS_PG_walker_leg, MOTUS_PG_walker_step, MOTUS_PG_walker)
