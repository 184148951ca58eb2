"""Settings of Follow Path in Object.motus.path, and mixins with the properties that its operators have too."""

from functools import partial

import bpy

from ..core.file.pointers import to_object
from ..core.measures.axes import AXES
from ..core.settings import ANIMATED, EXTENDABLE, OVERRIDABLE, SystemSettings, rewire, touch
from ..core.settings.declared import choice, number, whole

EASE_TOLERANCE = 1e-6  # in single precision 0.7 + 0.3 exceeds 1
DEFAULT_GAP = 2.0  # gap between objects without extent, m
DEFAULT_DELAY = 1.0  # gap by time, s
SLOWEST = 1e-3  # least speed at a place, m/s: at 0 the follower would never leave

TIMINGS = (
    ('DURATION', "Duration", "The whole path takes a given time"),
    ('SPEED', "Speed", "The object goes at a speed, which may be keyed"),
    ('PINS', "Pins", "Pins say where the object is at given frames"),
    ('MANUAL', "Manual", "The distance is keyed or driven as a fraction of the path"),
    ('DISTANCE', "Distance", "The distance is keyed or driven in metres"),
    ('PLACES', "Speed by Place", "The speed depends on the place: a list gives it at distances along the path"),
)
EXTENDS = (
    ('CLAMP', "Stop", "Stay at the end of the path"),
    ('EXTRAPOLATE', "Go On", "Go on along the tangent of the path's end"),
    ('LOOP', "Loop", "Begin again at the start of the path"),
    ('PING_PONG', "Ping-Pong", "Go back and forth along the path"),
    (
        'LINE_UP',
        "Line Up",
        "The leader of a train stops at the ends; the wagons stand in line behind it, also before the start of the path",
    ),
)
ORIENTATIONS = (
    ('NONE', "None", "Keep the object's own rotation"),
    ('WORLD_UP', "World Up", "Up is as near to the world's Z axis as the path allows"),
    ('MINIMAL', "Minimal Twist", "Never turn about the direction of travel"),
    ('BANKING', "Banking", "Lean into the bends like an aircraft, by speed and curvature"),
    ('CURVATURE', "Curvature", "Up points to the centre of the bend, as in a loop"),
    ('TILT', "Curve Tilt", "Up is turned by the tilt of the curve's points"),
    ('RAIL', "Rail", "Up points to a second curve, or is across to it, as between the two rails of a roller coaster"),
)
LAGS = (
    ('ACCELERATION', "Acceleration", "Turns lag more on large curves and long handles; Curvature depends on the shape alone"),
    ('CURVATURE', "Curvature", "Turns lag by the curvature, which depends on the shape of the curve alone"),
)
GAP_UNITS = (
    ('DISTANCE', "Distance", "Each wagon keeps a distance along the path to the object in front"),
    ('TIME', "Time", "Each wagon is where the object in front was some seconds before"),
)
SIDES_BY = (
    ('FRAME', "Leaning", "Side and Height lean along with the orientation"),
    ('LEVEL', "Level", "Side is level and Height upright, whatever the orientation"),
)
SPACES = (
    ('WORLD', "World", "Up is the world's Z axis, and gravity acts along it"),
    ('PATH', "Path", "Up is the Z axis of the curve object: on a ship that rolls, followers roll with it"),
)
RAIL_POINTS = (
    ('SHARE', "Same Share", "The point at the same share of the rail's length"),
    ('NEAREST', "Nearest", "The point of the rail that is nearest to the place on the path"),
)
RAIL_SIDES = (
    ('ABOVE', "Above", "The rail lies above the path: up points to it"),
    ('RIGHT', "Right", "The rail lies to the right of the path"),
    ('LEFT', "Left", "The rail lies to the left of the path"),
)
PIN_UNITS = (
    ('FRACTION', "Fraction", "Pins give a fraction of the path's length"),
    ('DISTANCE', "Distance", "Pins give a distance from the start of the path"),
)


def _push_ease_out(settings, context):
    if _has_too_much_ease(settings):
        settings.ease_out = 1.0 - settings.ease_in
    touch(settings, context)


def _push_ease_in(settings, context):
    if _has_too_much_ease(settings):
        settings.ease_in = 1.0 - settings.ease_out
    touch(settings, context)


def _has_too_much_ease(settings):
    # Settings are clamped to their limits; operators refuse such keywords instead.
    return isinstance(settings, SystemSettings) and settings.ease_in + settings.ease_out > 1.0 + EASE_TOLERANCE


_number = partial(number, options=ANIMATED)


class FollowKeywords:
    """Mixin with the properties that the settings of a follower and the operators of Follow Path have in common.

    The names of the properties are the operators' keywords in scripts.
    """

    spline: bpy.props.IntProperty(
        name="Spline",
        description="Index of the curve's spline; -1 follows all of them, one after another",
        default=0,
        min=-1,
        update=touch,
        options=ANIMATED,
        override=OVERRIDABLE,
    )
    timing: choice("Timing", "What says where the object is at a time: a duration, a speed, pins, or keys of your own", TIMINGS, 'DURATION')
    duration: _number("Duration", "Time for the whole path", 5.0, min=1e-4, soft_min=0.1, soft_max=60.0, subtype='TIME_ABSOLUTE')
    speed: _number("Speed", "Distance per second; negative goes backwards", 5.0, soft_min=0.0, soft_max=100.0, unit='VELOCITY')
    start_frame: _number("Start", "Frame at which the motion starts", 1.0, step=100)
    offset: _number("Offset", "Distance by which the object is ahead along the path; negative for behind", 0.0, subtype='DISTANCE')
    distance_factor: _number(
        "Fraction",
        "Where the object is on the path: 0 at its start, 1 at its end; to be keyed or driven",
        0.0,
        soft_min=0.0,
        soft_max=1.0,
        subtype='FACTOR',
    )
    distance: _number("Distance", "Distance along the path at which the object is, to be keyed or driven", 0.0, subtype='DISTANCE')
    ease_in: _number(
        "Ease In", "Fraction of the time that is used to gain speed", 0.0, min=0.0, max=1.0, subtype='FACTOR', update=_push_ease_out
    )
    ease_out: _number(
        "Ease Out", "Fraction of the time that is used to lose speed", 0.0, min=0.0, max=1.0, subtype='FACTOR', update=_push_ease_in
    )
    extend: choice("Ends", "What the object does before the start and after the end of the path", EXTENDS, 'CLAMP')
    pins_by: choice("Pins By", "Whether the pins give fractions of the path's length, or distances from its start", PIN_UNITS, 'FRACTION')

    orientation: choice(
        "Orientation", "Whether the object turns along the path, and which way is up for it", ORIENTATIONS, 'WORLD_UP', update=rewire
    )
    curvature_outward: bpy.props.BoolProperty(
        name="Outward",
        description="Up points away from the centre of the bend",
        default=False,
        update=touch,
        options=ANIMATED,
        override=OVERRIDABLE,
    )
    forward_axis: choice("Forward", "Axis of the object that points along the path", AXES, 'POS_Y')
    up_axis: choice("Up", "Axis of the object that points up", AXES, 'POS_Z')
    lag_rate: _number(
        "Lag",
        "How quickly the object turns along with bends: small values trail far behind, large ones hardly do; 0 follows at once",
        0.0,
        min=0.0,
        soft_max=10.0,
    )
    lag_by: choice("Lag By", "What counts as a bend for Lag: the shape alone, or the curve's size and handles too", LAGS, 'ACCELERATION')

    bank_strength: _number(
        "Strength",
        "How much the object leans into bends: 1 as an aircraft does, 0 not at all, negative outward",
        1.0,
        soft_min=0.0,
        soft_max=3.0,
    )
    bank_limit: _number(
        "Limit",
        "Largest angle by which the object leans into bends; 180 degrees is no limit",
        3.1415927,
        min=0.0,
        max=3.1415927,
        subtype='ANGLE',
    )
    bank_smoothing: _number(
        "Smoothing",
        "Length of path over which bends are averaged, so that the object leans into them softly",
        0.0,
        min=0.0,
        soft_max=50.0,
        subtype='DISTANCE',
    )
    gravity: _number(
        "Gravity",
        "Gravity that the object leans against in bends: the weaker it is, the more it leans",
        9.81,
        min=1e-3,
        soft_max=30.0,
        unit='ACCELERATION',
    )
    space: choice("Space", "Space in which up and gravity are meant, if the path itself is moved", SPACES, 'WORLD')
    rail_spline: whole("Rail Spline", "Index of the rail's spline; -1 takes all of them, one after another", 0, options=ANIMATED, min=-1)
    rail_by: choice("Rail By", "Which point of the rail belongs to a place on the path", RAIL_POINTS, 'SHARE')
    rail_side: choice("Rail Is", "Where the rail lies, seen along the path", RAIL_SIDES, 'ABOVE')

    side: _number("Side", "Distance to the right of the path; the speed along the path stays the same", 0.0, subtype='DISTANCE')
    height: _number("Height", "Distance above the path; the speed along the path stays the same", 0.0, subtype='DISTANCE')
    side_by: choice("Side By", "Whether Side and Height lean along with the object", SIDES_BY, 'FRAME')
    wheelbase: _number(
        "Wheelbase",
        "Straight distance between two points of the path that carry the object, as the bogies of a wagon do; 0 is one point",
        0.0,
        min=0.0,
        subtype='DISTANCE',
    )
    influence: _number(
        "Influence", "How much the path moves the object; 0 leaves it at its own transform", 1.0, min=0.0, max=1.0, subtype='FACTOR'
    )


KEYWORDS = tuple(FollowKeywords.__annotations__)


class NewFollowKeywords(FollowKeywords):
    """Mixin with the properties of the operators that create followers.

    If the caller does not give *Ends*, the curve decides: on closed curves followers loop; on open curves trains line up and single objects
    stop.
    """

    extend: choice(
        "Ends",
        "What happens beyond the ends of the path; if it is not given, a closed path loops and a train lines up",
        EXTENDS,
        'CLAMP',
        options={'SKIP_SAVE'},
    )
    rail: bpy.props.StringProperty(
        name="Rail", description="Name of the curve object that is the rail; empty keeps the present one", options={'SKIP_SAVE'}
    )


class MOTUS_PG_path_pin(bpy.types.PropertyGroup):
    frame: bpy.props.FloatProperty(
        name="Frame",
        description="Frame at which the object is at the pin's place",
        default=1.0,
        step=100,
        options=set(),
        update=touch,
        override=OVERRIDABLE,
    )
    fraction: bpy.props.FloatProperty(
        name="Fraction",
        description="Where the object is at the pin's frame: 0 at the start of the path, 1 at its end",
        subtype='FACTOR',
        soft_min=0.0,
        soft_max=1.0,
        options=set(),
        update=touch,
        override=OVERRIDABLE,
    )
    distance: bpy.props.FloatProperty(
        name="Distance",
        description="Distance from the start of the path",
        subtype='DISTANCE',
        options=set(),
        update=touch,
        override=OVERRIDABLE,
    )


class MOTUS_PG_path_speed(bpy.types.PropertyGroup):
    distance: number("Distance", "Distance from the start of the path", 0.0, subtype='DISTANCE')
    speed: number(
        "Speed",
        "Speed of the object at this place; on the way to the next place it changes evenly",
        5.0,
        min=SLOWEST,
        soft_max=100.0,
        unit='VELOCITY',
    )


class MOTUS_PG_path_wagon(bpy.types.PropertyGroup):
    object: to_object(name="Object", description="Object that is this wagon of the train", update=rewire, override=OVERRIDABLE)
    gap: bpy.props.FloatProperty(
        name="Gap",
        description="Distance along the path to the object in front",
        default=DEFAULT_GAP,
        subtype='DISTANCE',
        options=set(),
        update=touch,
        override=OVERRIDABLE,
    )
    delay: number("Delay", "Seconds after the object in front", DEFAULT_DELAY, min=0.0, subtype='TIME_ABSOLUTE')
    wheelbase: number(
        "Wheelbase",
        "Straight distance between the two points of the path that carry this wagon; 0 is one point",
        0.0,
        min=0.0,
        subtype='DISTANCE',
    )


def _gap_of_all(settings):
    return settings.wagons[0].gap if settings.wagons else DEFAULT_GAP


def _set_gap_of_all(settings, gap):
    for wagon in settings.wagons:
        wagon.gap = gap


def _delay_of_all(settings):
    return settings.wagons[0].delay if settings.wagons else DEFAULT_DELAY


def _set_delay_of_all(settings, delay):
    for wagon in settings.wagons:
        wagon.delay = delay


def _set_wheelbase_of_all(settings, wheelbase):
    settings.wheelbase = wheelbase
    for wagon in settings.wagons:
        wagon.wheelbase = wheelbase


class MOTUS_PG_path(SystemSettings, FollowKeywords, bpy.types.PropertyGroup):
    curve: to_object('CURVE', name="Curve", description="Curve to follow", update=rewire, override=OVERRIDABLE)
    rail: to_object(
        'CURVE',
        name="Rail",
        description="Second curve, towards which up points; the followed curve itself is the rail if its second spline is",
        update=rewire,
        override=OVERRIDABLE,
    )
    pins: bpy.props.CollectionProperty(type=MOTUS_PG_path_pin, name="Pins", override=EXTENDABLE)
    active_pin: bpy.props.IntProperty(name="Active Pin", options=set())
    speeds: bpy.props.CollectionProperty(type=MOTUS_PG_path_speed, name="Speeds", override=EXTENDABLE)
    active_speed: bpy.props.IntProperty(name="Active Speed", options=set())
    gaps_by: choice("Gaps By", "Whether the wagons of a train keep a distance or a time to the object in front", GAP_UNITS, 'DISTANCE')
    wagons: bpy.props.CollectionProperty(type=MOTUS_PG_path_wagon, name="Wagons", override=EXTENDABLE)
    active_wagon: bpy.props.IntProperty(name="Active Wagon", options=set())
    gap_of_all: bpy.props.FloatProperty(
        name="Gap of All",
        description="Distance along the path from each wagon to the object in front, the same for all wagons",
        subtype='DISTANCE',
        options={'SKIP_SAVE'},
        get=_gap_of_all,
        set=_set_gap_of_all,
    )
    delay_of_all: bpy.props.FloatProperty(
        name="Delay of All",
        description="Seconds from each wagon to the object in front, the same for all wagons",
        subtype='TIME_ABSOLUTE',
        options={'SKIP_SAVE'},
        get=_delay_of_all,
        set=_set_delay_of_all,
    )
    wheelbase_of_all: bpy.props.FloatProperty(
        name="Wheelbase of All",
        description="Straight distance between the two points of the path that carry the leader, and each wagon; 0 is one point",
        min=0.0,
        subtype='DISTANCE',
        options={'SKIP_SAVE'},
        get=lambda settings: settings.wheelbase,
        set=_set_wheelbase_of_all,
    )
