"""The pilot of the main scene: animation layers, feet that do not slide, hands on the remote control, eyes on the aeroplane."""

import math
from typing import NamedTuple

import bpy
from mathutils import Matrix

from ..character import clips as character_clips, mannequin, skeleton
from ..stage import shapes
from ..stage.keying import key
from . import steps, transmitter

RELEASE, WINDING_UP = 77, 28  # frame at which the pilot releases the aeroplane, and frames of the throw before that
THROW_START, THROW_SPEED = float(RELEASE - WINDING_UP), (character_clips.RELEASE - 1) / WINDING_UP
WALK_WEIGHT = ((1, 1.0), (72, 1.0), (90, 0.0))
CARRY_WEIGHT = ((1, 0.92), (54, 0.92), (66, 0.0))
LOOK_WEIGHT = ((1, 0.0), (RELEASE, 0.0), (RELEASE + 14, 1.0))
REACH_WEIGHT = ((1, 0.0), (RELEASE + 7, 0.0), (RELEASE + 25, 1.0))  # keys of the left hand's reach for the remote control
AT_REMOTE = 0.09, 0.17  # flown fractions of the course between which the left hand moves from beside the remote control onto it
BESIDE = (0.105, 0.012, -0.030)  # m from the hand's final place, in the space of the remote control: where the hand stops at first
SOFTNESS = 0.05
ELBOWS = {"L": (0.80, 0.50, 0.85), "R": (-0.80, 0.50, 0.85)}
# Keys of the pilot's own animation beneath the layers: frame, and degrees or metres in the bone's axes (X left, Y up, Z to the front).
PELVIS = (
    (1, (0.0, -0.016, 0.0)),
    (76, (0.0, -0.030, 0.0)),
    (92, (0.004, -0.012, 0.0)),
    (150, (0.016, -0.016, 0.004)),
    (205, (-0.012, -0.014, 0.0)),
    (264, (0.004, -0.016, 0.004)),
)
PELVIS_TURN = ((1, (0.0, 0.0, 0.0)), (92, (0.0, 0.0, 0.0)), (150, (1.0, 5.0, 1.5)), (205, (0.0, 3.0, -1.2)), (264, (0.5, 0.0, 0.5)))
BREATH = tuple((frame, turn) for start in range(1, 265, 66) for frame, turn in ((start, -0.8), (start + 33, 0.8)))
GRASP = {  # of the index finger and of the other three fingers
    ("index.L", 0): ((1, -26.0), (RELEASE - 1, -26.0), (RELEASE + 2, 6.0), (RELEASE + 22, 4.0), (RELEASE + 34, -16.0)),
    ("fingers.L", 0): ((1, -38.0), (RELEASE - 1, -38.0), (RELEASE + 2, 8.0), (RELEASE + 22, 2.0), (RELEASE + 34, -26.0)),
    ("index.R", 0): ((1, -16.0),),
    ("fingers.R", 0): ((1, -26.0),),
}
BLINKS = (22, 64, 118, 176, 222, 250)
BLINK = ((-3, 0.0), (0, -62.0), (1, -62.0), (6, 0.0))  # frames relative to the blink, and degrees of an eyelid


class Pilot(NamedTuple):
    """The pilot's objects that other modules of the scene need."""

    stage: bpy.types.Object  # empty that moves the pilot along the path
    rig: bpy.types.Object
    marks: dict  # {purpose, such as "hand.L": empty}


def build(context, collection, marks, way):
    """Build the pilot on his path, with the right hand on the remote control; the aeroplane is added later. Returns the Pilot."""
    stage = shapes.link_object(collection, "Pilot Stage", None, way)
    rig = skeleton.build(context, collection, stage)
    mannequin.build(collection, rig)
    remote = transmitter.build(collection, rig)
    pilot = Pilot(stage, rig, _add_marks(marks, way, stage, remote))
    steps.key_way(stage)
    _lay_clips(rig)
    _key_beneath(rig)
    steps.key_feet({side: pilot.marks[f"foot.{side}"] for side in ("L", "R")}, rig)
    context.view_layer.update()
    for side in ("L", "R"):
        _reach(pilot, f"foot.{side}", pilot.marks[f"foot.{side}"])
    _reach(pilot, "hand.R", pilot.marks["hand.R"], pole=pilot.marks["elbow.R"].name)
    return pilot


def attend(pilot, carrier):
    """Let the pilot's left hand reach for the remote control, and his eyes follow the aeroplane, once the aeroplane flies."""
    rig = pilot.rig
    _reach(
        pilot,
        "hand.L",
        pilot.marks["beside"],
        pole=pilot.marks["elbow.L"].name,
        position_weight=0.0,
        rotation_weight=0.0,
        softness=SOFTNESS,
    )
    _check(
        bpy.ops.motus.ik_switch_target(
            object=rig.name,
            bone="hand.L",
            target=pilot.marks["hand.L"].name,
            trigger_object=carrier.name,
            trigger_output="fraction",
            trigger_start=AT_REMOTE[0],
            trigger_end=AT_REMOTE[1],
        ),
        rig,
    )
    for weight in ("position_weight", "rotation_weight"):
        key(rig.motus.ik.entries["hand.L"], weight, REACH_WEIGHT)
    _check(
        bpy.ops.motus.look_at_add(
            object=rig.name,
            bone="head",
            target=carrier.name,
            body_length=4,
            eyes="eye.L,eye.R",
            weight=0.0,
            body_weight=0.3,
            head_weight=1.0,
            eyes_weight=1.0,
            clamp=0.3,
            head_forward="POS_Z",
            eyes_forward="POS_Y",
        ),
        rig,
    )
    key(rig.motus.look_at.entries["head"], "weight", LOOK_WEIGHT)


def _add_marks(collection, way, stage, remote):
    """Add empties that mark where the feet stand, where the hands hold, and where the elbows point. Returns {purpose: empty}."""
    hold = transmitter.grip("L")
    found = {
        "hand.L": (remote, "Hold L", hold),
        "hand.R": (remote, "Hold R", transmitter.grip("R")),
        "beside": (remote, "Beside the Remote", Matrix.Translation(BESIDE) @ hold),
    }
    for side, elbow in ELBOWS.items():
        found[f"foot.{side}"] = way, f"Foot {side}", Matrix()
        found[f"elbow.{side}"] = stage, f"Elbow {side}", Matrix.Translation(elbow)
    marks = {}
    for purpose, (parent, name, matrix) in found.items():
        marks[purpose] = shapes.link_object(collection, name, None, parent)
        marks[purpose].matrix_basis, marks[purpose].empty_display_size = matrix, 0.06
    return marks


def _lay_clips(rig):
    """Add three animation layers: the walk, the left arm that holds the aeroplane up, and the throw."""
    clips = {"Throw": character_clips.throw(rig, "L"), "Carry": character_clips.carry(rig), "Walk": character_clips.walk(rig)}
    walk = character_clips.lay(rig, clips["Walk"], mask='ALL', start=steps.WALK_START, after='REPEAT')
    key(walk, "weight", WALK_WEIGHT)
    carry = character_clips.lay(rig, clips["Carry"], bones="upper_arm.L", start=1.0, after='HOLD')
    key(carry, "weight", CARRY_WEIGHT)
    character_clips.lay(
        rig,
        clips["Throw"],
        bones="spine.002",
        start=THROW_START,
        speed=THROW_SPEED,
        blend_in=10.0,
        blend_out=14.0,
        feather=1,
        in_armature=True,
    )


def _key_beneath(rig):
    """Key the pilot's own animation beneath the layers: he breathes, shifts his weight, blinks, grasps and lets go."""
    bones = rig.pose.bones
    key(bones["pelvis"], "location", PELVIS)
    key(bones["pelvis"], "rotation_euler", [(frame, [math.radians(angle) for angle in turn]) for frame, turn in PELVIS_TURN])
    blinks = [(frame + step, turn) for frame in BLINKS for step, turn in BLINK]
    for (name, axis), keys in {("spine.003", 0): BREATH, ("lid.L", 0): blinks, ("lid.R", 0): blinks, **GRASP}.items():
        key(bones[name], "rotation_euler", [(frame, math.radians(turn)) for frame, turn in keys], axis)


def _reach(pilot, bone, target, **keywords):
    """Add inverse kinematics to a hand or foot and the two bones above, so that it takes the target's place and orientation."""
    given = {"position_weight": 1.0, "rotation_weight": 1.0, **keywords}
    _check(
        bpy.ops.motus.ik_add(
            object=pilot.rig.name, bone=bone, target=target.name, chain_length=2, use_tail=False, keep_rotation=False, **given
        ),
        pilot.rig,
    )


def _check(result, rig):
    if result != {"FINISHED"}:
        raise RuntimeError(f"{rig.name} could not be wired")
