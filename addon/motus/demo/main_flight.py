"""The aeroplane of the main scene: in the pilot's hand, thrown, once around, and down on the trodden way."""

import math

import bpy
from mathutils import Matrix, Vector

from . import aeroplane, flight, main_land, main_steps, shapes

SIZE = 0.078  # of the aeroplane that the pilots fly
HAND = "hand.L"
IN_HAND = (0.006, 0.066, -0.046)  # of the aeroplane's middle: along the palm, and before it
CLIMB = math.radians(13.0)  # of the nose as it is let go
SECONDS, EASE_IN, EASE_OUT = 6.9, 0.10, 0.22
BANK_SMOOTHING, BANK_LIMIT = 1.4, math.radians(58.0)
SETTLING = 14  # frames in which it turns from the hand's hold to the course
KNOTS = (  # world, m: out along the picture, round over the houses' roofs, and back before the pilot
    (2.6, -0.85, 2.75), (6.3, 0.5, 3.9), (7.7, 4.2, 4.9), (4.6, 8.0, 5.3), (0.9, 7.2, 4.6), (-0.35, 4.3, 3.2), (0.35, 1.6, 1.75),
)
FINAL = ((2.75, 0.62), (3.75, 0.0), (5.75, 0.0))  # m before where the pilot stands, and above the ground: down to a stop
WHEEL_AHEAD, WHEELS = 1.16, 1.53  # of the aeroplane: before and below its middle
FLARE, TAIL_DOWN = math.radians(7.0), math.radians(21.0)  # its nose is up as it comes down, and in the end


def build(scene, context, collection, rig, release):
    """Course and aeroplane, which is let go at the frame `release`; gives (what flies the course, the frame of the landing)."""
    hand, before = (_hand(scene, context, rig, frame) for frame in (release, release - 1))
    place = hand @ Vector(IN_HAND)
    speed = (place - before @ Vector(IN_HAND)).length * scene.render.fps
    nose = Vector((math.cos(main_land.WAY_ANGLE), math.sin(main_land.WAY_ANGLE), math.tan(CLIMB)))
    held = Matrix.Translation(place) @ nose.to_track_quat("Y", "Z").to_matrix().to_4x4()
    ramp, course = _add_course(collection, held, speed)
    carrier = shapes.link_object(collection, "Flight", None)
    carrier.empty_display_size = 0.2
    start = release - ramp * scene.render.fps
    _follow(carrier, course, start)
    end = round(start + SECONDS * scene.render.fps)
    toy = shapes.link_object(collection, "Toy", None, carrier)
    aeroplane.build(collection, last_frame=end).parent = toy
    toy.scale, toy.rotation_mode = 3 * [SIZE], "QUATERNION"
    _hold(collection, rig, toy, release, hand, held)
    _key_pitch(scene, context, carrier, toy, held, release, end)
    return carrier, end


def _hand(scene, context, rig, frame):
    """The hand's matrix in the world at a frame."""
    scene.frame_set(frame)
    evaluated = rig.evaluated_get(context.evaluated_depsgraph_get())
    return evaluated.matrix_world @ evaluated.pose.bones[HAND].matrix


def _add_course(collection, held, speed):
    """(seconds from the start of the course to where the aeroplane is let go, the course).

    It starts behind the hand, so that the aeroplane leaves the hand as fast as the hand moves.
    """
    ahead = held.col[1].xyz.normalized()
    let_go = held.translation
    ground = main_land.on_way_at(0.0)[2] + SIZE * WHEELS
    final = [(*main_land.on_way_at(main_steps.STAND + far)[:2], ground + high) for far, high in FINAL]
    course = flight.add_course(collection, (let_go - ahead, let_go, *KNOTS, *final))
    course.name = "Flight Course"
    points = course.data.splines[0].bezier_points
    _lead(points[0], ahead, 0.15, 0.15)
    _lead(points[1], ahead, 0.15, 0.9)
    along = Vector((math.cos(main_land.WAY_ANGLE), math.sin(main_land.WAY_ANGLE), 0.0))
    for point in (points[-2], points[-1]):
        _lead(point, along, 0.55, 0.55)
    rest = flight.course_length(course) - 1.0
    top = 1.0 / (1.0 - 0.5 * EASE_IN - 0.5 * EASE_OUT)  # of the speed, by the mean one
    ramp = EASE_IN * SECONDS
    before = 0.5
    for _ in range(20):
        most = top * (rest + before) / SECONDS
        share = min(speed / most, 1.0)
        before = 0.5 * share * share * ramp * most
    move = ahead * (1.0 - before)
    for name in ("co", "handle_left", "handle_right"):
        setattr(points[0], name, getattr(points[0], name) + move)
    return share * ramp, course


def _lead(point, direction, behind, before):
    """Let a knot's handles lie along a direction, so far behind and before it."""
    point.handle_left_type = point.handle_right_type = "FREE"
    point.handle_left, point.handle_right = point.co - behind * direction, point.co + before * direction


def _follow(carrier, course, start):
    if bpy.ops.motus.path_follow_add(
            object=carrier.name, curve=course.name, start_frame=start, timing="DURATION", duration=SECONDS, ease_in=EASE_IN,
            ease_out=EASE_OUT, orientation="BANKING", bank_smoothing=BANK_SMOOTHING, bank_limit=BANK_LIMIT,
            forward_axis="POS_Y", up_axis="POS_Z") != {"FINISHED"}:
        raise RuntimeError("The aeroplane could not be put on its course")


def _hold(collection, rig, toy, release, hand, held):
    """Keep the aeroplane in the hand until it is let go."""
    grip = shapes.link_object(collection, "Grip", None, rig)
    grip.parent_type, grip.parent_bone = "BONE", HAND
    grip.empty_display_size = 0.5
    grip.matrix_parent_inverse = Matrix.Translation((0.0, -rig.data.bones[HAND].length, 0.0))  # such a child stands at the tail
    grip.matrix_basis = hand.inverted() @ held @ Matrix.Scale(SIZE, 4)
    constraint = toy.constraints.new("COPY_TRANSFORMS")
    constraint.name, constraint.target = "Held", grip
    for frame, influence in ((release - 1, 1.0), (release, 0.0)):
        constraint.influence = influence
        constraint.keyframe_insert("influence", frame=frame)


def _key_pitch(scene, context, carrier, toy, held, release, end):
    """How the aeroplane lies on what flies: as in the hand at first, soon level, its nose up as it comes down, and its tail last."""
    scene.frame_set(release)
    flown = carrier.evaluated_get(context.evaluated_depsgraph_get()).matrix_world
    _key_lying(toy, release, flown.inverted() @ held)
    _key_lying(toy, release + SETTLING, Matrix())
    _key_lying(toy, end - 34, Matrix())
    _key_lying(toy, end - 22, Matrix.Rotation(FLARE, 4, "X"))
    _key_lying(toy, end - 13, Matrix.Rotation(FLARE, 4, "X"))
    sunk = SIZE * (WHEEL_AHEAD * math.sin(TAIL_DOWN) - WHEELS * (math.cos(TAIL_DOWN) - 1.0))
    _key_lying(toy, end + 3, Matrix.Translation((0.0, 0.0, -sunk)) @ Matrix.Rotation(TAIL_DOWN, 4, "X"))


def _key_lying(toy, frame, matrix):
    toy.location, toy.rotation_quaternion = matrix.translation, matrix.to_quaternion()
    toy.keyframe_insert("location", frame=frame)
    toy.keyframe_insert("rotation_quaternion", frame=frame)
