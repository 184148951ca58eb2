"""Keys of the scene "Motus Reach": sway of the hips, weights of the hand, fingers, eyelids, and the butterfly's speed."""

import math

import bpy

from ..stage.keying import CYCLE, key_cycle

# Keys (frame of the cycle, value): metres along the bone's axes (X left, Y up, Z to the front) or degrees about these.
PELVIS_PLACE = (
    (1, (-0.036, -0.038, 0.004)),
    (48, (-0.004, -0.037, 0.010)),
    (92, (0.048, -0.036, 0.034)),
    (118, (0.056, -0.035, 0.040)),
    (150, (0.026, -0.038, 0.018)),
    (186, (-0.030, -0.042, 0.000)),
)
PELVIS_TURN = (
    (1, (0.0, -4.0, -4.5)),
    (48, (1.5, 2.0, -0.5)),
    (92, (4.0, 9.0, 3.5)),
    (118, (4.5, 11.0, 4.0)),
    (150, (2.0, 6.0, 1.5)),
    (186, (-0.5, -3.0, -4.0)),
)
SPINE_TURN = (  # opposite to the turn of the hips
    (1, (1.0, 2.0, 3.5)),
    (48, (1.0, 0.0, 0.5)),
    (92, (2.5, 2.0, -3.5)),
    (118, (3.0, 3.0, -4.5)),
    (150, (1.5, 1.0, -1.5)),
    (186, (1.0, 1.5, 3.0)),
)
SHOULDER_TURN = (
    (1, (0.0, 0.0, 0.0)),
    (34, (0.0, 0.0, 0.0)),
    (64, (9.0, 0.0, 5.0)),
    (112, (15.0, 0.0, 9.0)),
    (150, (7.0, 0.0, 4.0)),
    (176, (0.0, 0.0, 0.0)),
)
# Keys (frame, degrees about X).
BREATH = tuple((frame, turn) for start in (1, 73, 145) for frame, turn in ((start, -1.0), (start + 36, 0.6)))
UPPER_ARM_SWING = ((1, -2.0), (60, 4.0), (180, 4.0))
INDEX_EXTENDED = 14.0
INDEX_TURN = ((1, 0.0), (40, 0.0), (62, INDEX_EXTENDED), (150, INDEX_EXTENDED), (176, 0.0))
FINGERS_TURN = ((1, -6.0), (40, -6.0), (66, -30.0), (94, -4.0), (114, -4.0), (130, -30.0), (150, -26.0), (178, -6.0))
RESTING_TURNS = (("index.R", -22.0), ("fingers.R", -28.0))
BLINKS = (20, 128, 198)
LID_SHUT = -62.0
BLINK = ((-3, 0.0), (0, LID_SHUT), (1, LID_SHUT), (6, 0.0))  # frames relative to the blink, degrees

REACH_WEIGHT = ((1, 0.0), (34, 0.0), (62, 1.0), (146, 1.0), (176, 0.0))
FULL_REACH = (62, 146)  # frames between which the weight is 1
PACE = (  # frame, fraction of the course: the butterfly lingers at the hand twice
    (1, 0.0),
    (40, 0.235),
    (62, 0.342),
    (86, 0.390),
    (102, 0.478),
    (126, 0.585),
    (146, 0.625),
    (166, 0.735),
    (190, 0.870),
)


def key_pose(rig):
    """Key the bones of the pilot as a loop."""
    bones = rig.pose.bones
    key_cycle(bones["pelvis"], "location", PELVIS_PLACE)
    for name, turns in (("pelvis", PELVIS_TURN), ("spine.001", SPINE_TURN), ("shoulder.L", SHOULDER_TURN)):
        radians = [(frame, [math.radians(angle) for angle in turn]) for frame, turn in turns]
        key_cycle(bones[name], "rotation_euler", radians)
    blinks = [(frame + step, turn) for frame in BLINKS for step, turn in BLINK]
    for name, turns in (  # type: ignore[assignment]
        ("spine.003", BREATH),
        ("upper_arm.L", UPPER_ARM_SWING),
        ("index.L", INDEX_TURN),
        ("fingers.L", FINGERS_TURN),
        ("lid.L", blinks),
        ("lid.R", blinks),
    ):
        key_cycle(bones[name], "rotation_euler", [(frame, math.radians(turn)) for frame, turn in turns], index=0)
    for name, turn in RESTING_TURNS:
        bones[name].rotation_euler.x = math.radians(turn)


def key_weight(entry):
    """Key the weights of the hand's chain, so that it reaches while the butterfly is near. entry: settings of the IK chain."""
    for name in ("position_weight", "rotation_weight"):
        key_cycle(entry, name, REACH_WEIGHT)


def pin_pace(carrier):
    """Add meeting pins that fix at which frames the butterfly is at which fraction of its path. carrier: the object on the path."""
    for turn in (-1, 0, 1):
        for frame, fraction in PACE:
            result = bpy.ops.motus.path_pin_add(object=carrier.name, frame=frame + turn * CYCLE, fraction=fraction + turn)
            if result != {"FINISHED"}:
                raise RuntimeError(f"{carrier.name} could not be pinned")
