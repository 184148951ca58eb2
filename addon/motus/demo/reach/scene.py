"""The scene "Motus Reach": a wooden pilot on a lookout and a daisy reach for a butterfly, by inverse kinematics and look-at."""

import math

import bpy
from mathutils import Euler, Matrix, Vector

from ..character import limbs, mannequin, skeleton
from ..flying import flight
from ..places import landscape, woods
from ..stage import keying, lighting, shapes, staging
from . import butterfly, flower, lookout, motion

SCENE_NAME = "Motus Reach"
FRAMES_PER_SECOND = 24

COURSE = (  # knots of the butterfly's course, m from the lookout's origin
    (-0.86, -0.66, 1.50),
    (-0.40, -1.00, 1.82),
    (0.14, -0.78, 1.68),
    (0.43, -0.52, 1.52),
    (0.51, -0.47, 1.66),
    (0.76, -0.58, 1.84),
    (0.82, -0.74, 1.64),
    (0.50, -0.53, 1.46),
    (0.22, -0.94, 1.16),
    (-0.48, -1.06, 1.20),
)
SHOULDER_MARK = (0.19, 0.0, 1.38)  # shoulder of the reaching arm
HAND_ROLL = math.radians(35.0)  # angle of the reaching hand about its long axis
REACH_SOFTNESS = 0.08

ELBOWS = {"L": (0.95, 0.55, 0.70), "R": (-0.80, 0.95, 0.95)}
KNEES = {"L": (0.30, -1.4, 0.62), "R": (-0.24, -1.4, 0.58)}
FEET = {"L": ((0.168, -0.105, 0.0), math.radians(27.0)), "R": ((-0.100, 0.045, 0.0), math.radians(-15.0))}
REST_DIRECTION = Vector((-0.42, -0.62, -0.55))  # direction of the resting hand's fingers
REST_NORMAL = Vector((-0.20, -0.50, 0.84))  # normal of the ball at the point that the palm touches
PALM = (0.0, 0.050, -0.016)  # point of the palm that touches the ball, in the hand's space

CAMERA_LENS = 43.0
CAMERA_KEYS = ((1, (-0.62, -4.75, 1.40)), (109, (0.22, -4.50, 1.50)))  # there and back in a cycle
CAMERA_AIM = (0.30, 0.0, 0.99)


def build(context):
    """Build the scene, show it in the window and return it."""
    scene = staging.new_scene(context, SCENE_NAME, FRAMES_PER_SECOND, keying.CYCLE)
    land, place, figure, marks = (staging.new_collection(scene, name) for name in ("Land", "Lookout", "Pilot", "Targets"))
    _build_land(scene, land)
    stage = lookout.add_stage(place)
    lookout.build(place, stage)
    rig = skeleton.build(context, figure, stage)
    mannequin.build(figure, rig)
    carrier = _release_butterfly(figure, marks, stage)
    motion.key_pose(rig)
    _add_camera(scene, place, stage)
    _wire(context, marks, stage, rig, carrier)
    flower.build(context, place, stage, carrier)
    scene.frame_set(1)
    return scene


def _build_land(scene, collection):
    """Build the land and the light of the scene "Motus Flight"."""
    sky = lighting.build_sky_group()
    scene.world = lighting.build_world(sky)
    lighting.add_sun(collection)
    lighting.set_color_management(scene)
    haze = lighting.build_haze_group(sky)
    landscape.build(collection, haze)
    woods.build(collection, haze)


def _add_camera(scene, collection, stage):
    """Add a camera that swings to the side and back while it stays aimed at one point."""
    aim = _mark(collection, stage, "Camera Aim", Matrix.Translation(CAMERA_AIM))
    data = bpy.data.cameras.new("Lookout Camera")
    data.lens = CAMERA_LENS
    data.clip_start, data.clip_end = 0.1, 3.0 * landscape.EXTENT
    camera = shapes.link_object(collection, "Lookout Camera", data, stage)
    constraint = camera.constraints.new("TRACK_TO")
    constraint.target, constraint.track_axis, constraint.up_axis = aim, "TRACK_NEGATIVE_Z", "UP_Y"
    keying.key_cycle(camera, "location", CAMERA_KEYS)
    scene.camera = camera


# --- what is reached for, and what is stood on -----------------------------------------------------------------------


def _mark(collection, parent, name, matrix, display="PLAIN_AXES", size=0.08):
    """Add an empty. matrix: in its parent's space."""
    empty = shapes.link_object(collection, name, None, parent)
    empty.matrix_basis = matrix
    empty.empty_display_type, empty.empty_display_size = display, size
    return empty


def _release_butterfly(collection, marks, stage):
    """Add the butterfly on its course, banked in the bends. Returns the empty that follows the course."""
    course = butterfly.add_course(marks, stage, COURSE)
    carrier = _mark(collection, stage, "Butterfly", Matrix())
    flight.follow(
        carrier,
        course,
        orientation="BANKING",
        bank_strength=3.0,
        bank_smoothing=0.25,
        bank_limit=math.radians(50.0),
        forward_axis="POS_Y",
        up_axis="POS_Z",
    )
    motion.pin_pace(carrier)
    carrier.motus.path.timing = "PINS"
    butterfly.build(collection, carrier, keying.CYCLE)
    return carrier


def _reach_goal(collection, stage, carrier):
    """Add the wrist's target, on the line from shoulder to butterfly, so that the index finger touches it. Returns the empty."""
    shoulder = _mark(collection, stage, "Shoulder Mark", Matrix.Translation(SHOULDER_MARK))
    aim = _mark(collection, stage, "Reach", Matrix())
    constraint = aim.constraints.new("COPY_LOCATION")
    constraint.target = carrier
    constraint = aim.constraints.new("TRACK_TO")
    constraint.target, constraint.track_axis, constraint.up_axis = shoulder, "TRACK_NEGATIVE_Y", "UP_Z"
    roll = Matrix.Rotation(HAND_ROLL, 4, "Y")
    tip = limbs.index_tip("L", math.radians(motion.INDEX_EXTENDED))
    in_hand = skeleton.rest_matrix("hand.L").inverted() @ Vector(tip)
    return _mark(collection, aim, "Reach Goal", roll @ Matrix.Translation(-in_hand), "ARROWS")


def _rest_goal():
    """Return the matrix of the resting hand, whose palm lies on the ball of the post."""
    normal = REST_NORMAL.normalized()
    along = (REST_DIRECTION - normal * REST_DIRECTION.dot(normal)).normalized()
    turn = Matrix((along.cross(normal), along, normal)).transposed()
    touch = Vector(lookout.BALL_CENTRE) + lookout.BALL_RADIUS * normal
    return Matrix.Translation(touch - turn @ Vector(PALM)) @ turn.to_4x4()


def _foot_goal(side):
    """Return the matrix of a foot that stands flat at its place, turned outwards. side: "L" or "R"."""
    (x, y, z), turn = FEET[side]
    ankle = skeleton.rest_matrix(f"foot.{side}")
    place = Vector((x, y, z + ankle.translation.z))
    return Matrix.Translation(place) @ Euler((0.0, 0.0, turn)).to_matrix().to_4x4() @ ankle.to_3x3().to_4x4()


def _wire(context, marks, stage, rig, carrier):
    """Add inverse kinematics to the four limbs, and Look At to the head and eyes, each with its public operator."""
    goals = {"hand.L": _reach_goal(marks, stage, carrier)}
    goals["hand.R"] = _mark(marks, stage, "Resting Hand", _rest_goal(), "ARROWS")
    for side in ("L", "R"):
        goals[f"foot.{side}"] = _mark(marks, stage, f"Foot {side}", _foot_goal(side), "ARROWS")
    context.view_layer.update()
    for bone, places in (("hand", ELBOWS), ("foot", KNEES)):
        for side, place in places.items():
            kind = "Elbow" if bone == "hand" else "Knee"
            pole = _mark(marks, stage, f"{kind} {side}", Matrix.Translation(place), "SPHERE", 0.04)
            _reach(rig, f"{bone}.{side}", goals[f"{bone}.{side}"], pole)
    motion.key_weight(rig.motus.ik.entries["hand.L"])
    _check(
        bpy.ops.motus.look_at_add(
            object=rig.name,
            bone="head",
            target=carrier.name,
            body_length=4,
            eyes="eye.L,eye.R",
            weight=1.0,
            body_weight=0.3,
            head_weight=1.0,
            eyes_weight=1.0,
            head_forward="POS_Z",
            eyes_forward="POS_Y",
        ),
        rig,
    )


def _reach(rig, bone, goal, pole):
    """Let a hand or foot reach its goal by inverse kinematics; the elbow or knee points to the pole."""
    is_reaching = bone == "hand.L"  # the weights of the left hand are keyed
    _check(
        bpy.ops.motus.ik_add(
            object=rig.name,
            bone=bone,
            target=goal.name,
            pole=pole.name,
            chain_length=2,
            use_tail=False,
            softness=REACH_SOFTNESS if is_reaching else 0.0,
            position_weight=0.0 if is_reaching else 1.0,
            rotation_weight=0.0 if is_reaching else 1.0,
            keep_rotation=False,
        ),
        rig,
    )


def _check(result, rig):
    if result != {"FINISHED"}:
        raise RuntimeError(f"{rig.name} could not be wired")
