"""The toy aeroplane of the main scene: the pilot throws it, it flies one round, and lands on the trodden path."""

import math

import bpy
from mathutils import Matrix, Vector

from ...core.blender import actions
from ..flying import aeroplane, flight
from ..stage import shapes
from ..stage.keying import key
from . import terrain

SIZE = 0.078  # scale of the toy relative to the aeroplane in which pilots fly
HAND = "hand.L"
IN_HAND = (0.006, 0.066, -0.046)  # position of the aeroplane's middle in the space of the hand's bone, m
CLIMB = math.radians(4.0)  # pitch of the nose at the release
SECONDS, EASE_IN, EASE_OUT = 6.4, 0.10, 0.22
# Frames after the throw until the aeroplane has slowed to its normal speed, and until it has lost the lead that it gained.
FASTER, EVEN = 16, 110
BANK_SMOOTHING, BANK_LIMIT = 1.4, math.radians(58.0)
SETTLING = 14  # frames in which the aeroplane turns from its orientation in the hand to that of the course
KNOTS = (  # x, y, m above the ground: the course goes left, across the picture in front of the camera, and back on the right
    (-1.5, 2.35, 2.45),
    (-2.65, 2.2, 3.0),
    (-3.3, 1.35, 3.25),
    (-2.6, 0.45, 3.1),
    (-0.3, 0.2, 2.7),
    (2.3, 0.55, 2.65),
    (3.8, 1.75, 2.75),
    (3.65, 3.05, 2.25),
    (2.75, 3.2, 1.35),
)
FINAL = (0.62, 1.75), math.radians(216.0)  # place at which the aeroplane stops, and its heading there
GLIDE = ((1.95, 0.42), (1.15, 0.0), (0.0, 0.0))  # knots of the glide: m before the stop, m above the ground
WHEEL_AHEAD, WHEELS = 1.16, 1.53  # m from the unscaled aeroplane's middle to its wheels: ahead and below
FLARE, TAIL_DOWN = math.radians(7.0), math.radians(21.0)  # pitch of the nose during the landing and at the end


def build(scene, context, collection, rig, release):
    """Build the course and the aeroplane, which the hand releases at the frame `release`.

    Returns the empty that follows the course. It does so even while the aeroplane is still in the hand.
    """
    hand, before = (_hand(scene, context, rig, frame) for frame in (release, release - 1))
    place = hand @ Vector(IN_HAND)
    thrown = place - before @ Vector(IN_HAND)
    speed = thrown.length * scene.render.fps
    nose = thrown.xy.normalized().to_3d() + Vector((0.0, 0.0, math.tan(CLIMB)))
    held = Matrix.Translation(place) @ nose.to_track_quat("Y", "Z").to_matrix().to_4x4()
    ramp, pace, course = _add_course(collection, held, speed)
    carrier = shapes.link_object(collection, "Flight", None)
    carrier.empty_display_size = 0.2
    start = release - ramp * scene.render.fps
    _follow(carrier, course, start)
    _key_slowing(carrier, release, (speed - pace) / scene.render.fps)
    end = round(start + SECONDS * scene.render.fps)
    toy = shapes.link_object(collection, "Toy", None, carrier)
    aeroplane.build(collection, last_frame=end).parent = toy
    toy.scale, toy.rotation_mode = 3 * [SIZE], "QUATERNION"
    _hold(collection, rig, toy, release, hand, held)
    _key_pitch(scene, context, carrier, toy, held, release, end)
    return carrier


def _heading(angle):
    return Vector((math.cos(angle), math.sin(angle), 0.0))


def _hand(scene, context, rig, frame):
    """Return the world matrix of the hand's bone at a frame."""
    scene.frame_set(frame)
    evaluated = rig.evaluated_get(context.evaluated_depsgraph_get())
    return evaluated.matrix_world @ evaluated.pose.bones[HAND].matrix


def _add_course(collection, held, speed):
    """Add the course; returns (seconds from its start to the release, speed at the release in m/s, the course).

    The course starts behind the hand, so that the aeroplane is already at speed at the place of the release.
    held: world matrix of the aeroplane at the release. speed: of the hand at the release, in m/s.
    """
    ahead = held.col[1].xyz.normalized()
    let_go = held.translation
    ground, along = terrain.LEVEL, _heading(FINAL[1])
    stop = Vector((*FINAL[0], ground + SIZE * WHEELS))
    knots = [Vector((x, y, ground + high)) for x, y, high in KNOTS]
    knots += [stop - far * along + Vector((0.0, 0.0, high)) for far, high in GLIDE]
    course = flight.add_course(collection, (let_go - ahead, let_go, *knots))
    course.name = "Flight Course"
    points = course.data.splines[0].bezier_points
    _lead(points[0], ahead, 0.15, 0.15)
    _lead(points[1], ahead, 0.15, 0.9)
    for point in (points[-2], points[-1]):
        _lead(point, along, 0.38, 0.38)
    rest = flight.course_length(course) - 1.0
    top = 1.0 / (1.0 - 0.5 * EASE_IN - 0.5 * EASE_OUT)  # ratio of the greatest speed to the mean speed
    ramp = EASE_IN * SECONDS
    before = 0.5  # m from the start to the release; iterated, because it depends on the speed, which depends on the whole length
    for _ in range(20):
        most = top * (rest + before) / SECONDS
        share = min(speed / most, 1.0)
        before = 0.5 * share * share * ramp * most
    move = ahead * (1.0 - before)
    for name in ("co", "handle_left", "handle_right"):
        setattr(points[0], name, getattr(points[0], name) + move)
    return share * ramp, share * most, course


def _lead(point, direction, behind, before):
    """Set a knot's handles along a direction, at the distances `behind` and `before` from the knot, in m."""
    point.handle_left_type = point.handle_right_type = "FREE"
    point.handle_left, point.handle_right = point.co - behind * direction, point.co + before * direction


def _follow(carrier, course, start):
    if bpy.ops.motus.path_follow_add(
        object=carrier.name,
        curve=course.name,
        start_frame=start,
        timing="DURATION",
        duration=SECONDS,
        ease_in=EASE_IN,
        ease_out=EASE_OUT,
        orientation="BANKING",
        bank_smoothing=BANK_SMOOTHING,
        bank_limit=BANK_LIMIT,
        forward_axis="POS_Y",
        up_axis="POS_Z",
    ) != {"FINISHED"}:
        raise RuntimeError("The aeroplane could not be put on its course")


def _key_slowing(carrier, release, excess):
    """Key the offset on the course so that the aeroplane leaves the hand at the hand's speed and slows to its normal speed.

    excess: m per frame by which the hand is faster than the normal flight. The aeroplane then loses the lead that it has gained.
    """
    key(carrier.motus.path, "offset", ((release, 0.0), (release + FASTER, 0.5 * excess * FASTER), (release + EVEN, 0.0)))
    curve = next(curve for curve in actions.fcurves(carrier) if curve.data_path.endswith("offset"))
    first, ahead, last = curve.keyframe_points
    for point in (first, ahead, last):
        point.handle_left_type = point.handle_right_type = 'FREE'
        point.handle_left = point.co.x - 1.0, point.co.y
    third = FASTER / 3.0
    first.handle_right = first.co.x + third, third * excess
    ahead.handle_left, ahead.handle_right = (ahead.co.x - third, ahead.co.y), (ahead.co.x + EVEN / 3.0, ahead.co.y)
    last.handle_left = last.co.x - EVEN / 3.0, 0.0
    curve.update()


def _hold(collection, rig, toy, release, hand, held):
    """Keep the aeroplane in the hand until the release, by a constraint whose influence is keyed."""
    grip = shapes.link_object(collection, "Grip", None, rig)
    grip.parent_type, grip.parent_bone = "BONE", HAND
    grip.empty_display_size = 0.5
    grip.matrix_parent_inverse = Matrix.Translation((0.0, -rig.data.bones[HAND].length, 0.0))  # a child of a bone stands at the bone's tail
    grip.matrix_basis = hand.inverted() @ held @ Matrix.Scale(SIZE, 4)
    constraint = toy.constraints.new("COPY_TRANSFORMS")
    constraint.name, constraint.target = "Held", grip
    for frame, influence in ((release - 1, 1.0), (release, 0.0)):
        constraint.influence = influence
        constraint.keyframe_insert("influence", frame=frame)


def _key_pitch(scene, context, carrier, toy, held, release, end):
    """Key the aeroplane's pose relative to the empty that flies the course.

    At first the pose is that in the hand, then level; the nose is up for the landing, and in the end the tail is on the ground.
    """
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
