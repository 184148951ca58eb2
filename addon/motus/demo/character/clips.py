"""Actions for the wooden pilot, each of few keys: a walk on the spot, a throw, a jump, and a pose with a raised left arm.

Scenes lay these actions over the pilot's own animation as animation layers.
"""

import itertools
import math

import bpy

from ...core.blender import actions
from ..stage.keying import key
from . import skeleton

STRIDE = 24  # frames of two steps
THROW_FRAMES, RELEASE = 40, 21
JUMP_FRAMES, TAKE_OFF, TOUCH_DOWN = 44, 13, 29
JUMP_HEIGHT = 0.42  # m
CROUCH, LANDING = 0.15, 0.17  # m that the hips sink

# A foot from one contact with the ground to the next. Columns: share of the stride, m ahead of the hip, m above the ground, angle of
# the sole in degrees, positive if the toes point up.
STEP = (
    (0.000, 0.245, 0.012, 16.0),
    (0.125, 0.125, 0.0, 0.0),
    (0.250, 0.000, 0.0, 0.0),
    (0.375, -0.125, 0.004, -6.0),
    (0.500, -0.235, 0.055, -32.0),
    (0.625, -0.190, 0.150, -44.0),
    (0.750, 0.020, 0.140, -14.0),
    (0.875, 0.215, 0.062, 12.0),
)
# (share of the stride, m by which the hips sink), repeated in the second half of the stride.
HIP_SINK = ((0.0, 0.060), (0.125, 0.072), (0.250, 0.038), (0.375, 0.034))
SWAY = 0.022  # m by which the hips move towards the foot that stands
# Degrees about the bone's X, Y and Z axes at the start of the stride; the second half of the stride mirrors them.
SWINGS = {
    "pelvis": (0.0, 7.0, 2.0),
    "spine.002": (2.0, -6.0, -1.5),
    "spine.003": (1.0, -7.0, -1.0),
    "neck": (-2.0, 4.0, 0.0),
    "head": (-1.0, 3.0, 0.5),
}
ARM_SWING, ELBOW, ELBOW_SWING = 27.0, 16.0, 12.0  # degrees

# Keys (frame, degrees) of the throw for (bone, axis). Of the throwing arm X swings ahead and up, Z aside.
THROW = {
    ("upper_arm.R", 0): ((1, 0.0), (13, 150.0), (17, 176.0), (RELEASE, 128.0), (27, 30.0), (THROW_FRAMES, 0.0)),
    ("upper_arm.R", 2): ((1, 0.0), (13, 24.0), (17, 20.0), (RELEASE, 4.0), (27, -14.0), (THROW_FRAMES, 0.0)),
    ("forearm.R", 0): ((1, 12.0), (11, 88.0), (17, 96.0), (RELEASE, 22.0), (27, 14.0), (THROW_FRAMES, 12.0)),
    ("hand.R", 2): ((1, 0.0), (15, 26.0), (RELEASE, -24.0), (28, -10.0), (THROW_FRAMES, 0.0)),
    ("upper_arm.L", 0): ((1, 0.0), (14, 62.0), (23, -18.0), (THROW_FRAMES, 0.0)),
    ("upper_arm.L", 2): ((1, 0.0), (14, -26.0), (23, -20.0), (THROW_FRAMES, 0.0)),
    ("forearm.L", 0): ((1, 12.0), (14, 26.0), (23, 44.0), (THROW_FRAMES, 12.0)),
    ("spine.002", 0): ((1, 0.0), (15, -9.0), (24, 13.0), (THROW_FRAMES, 0.0)),
    ("spine.002", 1): ((1, 0.0), (15, -14.0), (23, 12.0), (THROW_FRAMES, 0.0)),
    ("spine.003", 0): ((1, 0.0), (15, -8.0), (24, 12.0), (THROW_FRAMES, 0.0)),
    ("spine.003", 1): ((1, 0.0), (15, -24.0), (23, 20.0), (THROW_FRAMES, 0.0)),
    ("neck", 1): ((1, 0.0), (15, 16.0), (23, -12.0), (THROW_FRAMES, 0.0)),
    ("head", 1): ((1, 0.0), (15, 20.0), (23, -14.0), (THROW_FRAMES, 0.0)),
    ("index.R", 0): ((1, -30.0), (17, -34.0), (RELEASE, 6.0), (THROW_FRAMES, -18.0)),
    ("fingers.R", 0): ((1, -42.0), (17, -46.0), (RELEASE, 8.0), (THROW_FRAMES, -20.0)),
}
WHIP = ("upper_arm.R", "forearm.R")
"""Bones whose F-curves accelerate from the wound-up pose to the release."""

CARRY = {
    ("upper_arm.L", 0): 30.0,
    ("upper_arm.L", 2): -41.0,
    ("forearm.L", 0): 124.0,
    ("hand.L", 0): -34.0,
    ("hand.L", 1): 22.0,
    ("hand.L", 2): 18.0,
}

JUMP = {
    ("pelvis", 0): ((1, 0.0), (8, 26.0), (TAKE_OFF, 6.0), (21, 8.0), (TOUCH_DOWN, 4.0), (34, 22.0), (JUMP_FRAMES, 0.0)),
    ("spine.002", 0): ((1, 0.0), (8, 12.0), (15, -8.0), (21, 4.0), (34, 12.0), (JUMP_FRAMES, 0.0)),
    ("head", 0): ((1, 0.0), (8, -24.0), (16, -12.0), (34, -20.0), (JUMP_FRAMES, 0.0)),
    ("upper_arm.L", 0): ((1, 0.0), (8, -46.0), (16, 152.0), (22, 160.0), (34, 30.0), (JUMP_FRAMES, 0.0)),
    ("upper_arm.L", 2): ((1, 0.0), (16, -22.0), (22, -34.0), (34, -12.0), (JUMP_FRAMES, 0.0)),
    ("forearm.L", 0): ((1, 12.0), (8, 24.0), (17, 16.0), (34, 42.0), (JUMP_FRAMES, 12.0)),
}
LEGS_OF_JUMP = (  # frame, m by which the hips sink or the feet are drawn up, angle of the soles in degrees
    (1, 0.030, 0.0),
    (8, CROUCH, 0.0),
    (TAKE_OFF, 0.012, -34.0),
    (21, 0.150, -24.0),
    (TOUCH_DOWN, 0.020, -12.0),
    (33, LANDING, 0.0),
    (JUMP_FRAMES, 0.030, 0.0),
)


def walk(rig):
    """Make the action of one stride, two steps, of walking on the spot. The rig is left at rest without an action."""
    bones = rig.pose.bones
    turns = {}
    for side, shift in (("L", 0.0), ("R", 0.5)):
        for share, ahead, lift, sole in STEP:
            when = (share + shift) % 1.0
            sink = _sink(when)
            _add_leg(turns, side, 1 + STRIDE * when, ahead, sink - lift, sole)
    for side, sign in (("L", -1.0), ("R", 1.0)):
        for when, swing in ((0.0, 1.0), (0.5, -1.0)):
            frame = 1 + STRIDE * when
            turns.setdefault((f"upper_arm.{side}", 0), []).append((frame, sign * swing * ARM_SWING))
            turns.setdefault((f"forearm.{side}", 0), []).append((frame + 2, ELBOW + sign * swing * ELBOW_SWING))
            turns.setdefault((f"upper_arm.{side}", 2), []).append((frame, sign * 5.0))
    for name, angles in SWINGS.items():
        for axis, angle in enumerate(angles):
            mirrored = angle if axis == 0 else -angle
            turns[name, axis] = [(1, angle), (1 + STRIDE / 2, mirrored)]
    for (name, axis), keys in turns.items():
        _key_turns(bones[name], axis, _closed(keys))
    pelvis = bones["pelvis"]
    key(pelvis, "location", _closed([(1 + STRIDE * (share + half), -sink) for half in (0.0, 0.5) for share, sink in HIP_SINK]), 1)
    key(pelvis, "location", _closed([(1 + STRIDE * 0.22, SWAY), (1 + STRIDE * 0.72, -SWAY)]), 0)
    action = _named(rig, "Walk")
    action.use_frame_range, action.frame_start, action.frame_end = True, 1, 1 + STRIDE
    actions.assign(rig, None)
    return action


def throw(rig, hand="R"):
    """Make the action of a throw, which moves only the upper body. hand: "R" or "L"."""
    for (name, axis), keys in THROW.items():
        if hand == "L":
            name, keys = _mirrored(name), [(frame, angle if axis == 0 else -angle) for frame, angle in keys]  # type: ignore[assignment]
        _key_turns(rig.pose.bones[name], axis, keys)
    action = _named(rig, "Throw")
    whip = [name if hand == "R" else _mirrored(name) for name in WHIP]
    for curve in actions.curves_for_object(action):
        if any(f'"{name}"' in curve.data_path for name in whip) and curve.array_index == 0:
            _shape_whip(curve)
    actions.assign(rig, None)
    return action


def carry(rig):
    """Make an action of one pose, in which the left hand holds something up in front of the shoulder."""
    for (name, axis), angle in CARRY.items():
        _key_turns(rig.pose.bones[name], axis, ((1, angle),))
    action = _named(rig, "Carry")
    actions.assign(rig, None)
    return action


def lay(rig, action, **keywords):
    """Lay an action over the rig's animation with the public operator motus.layer_add. Returns the new layer's settings."""
    if bpy.ops.motus.layer_add(object=rig.name, action=action.name, **keywords) != {"FINISHED"}:
        raise RuntimeError(f"{rig.name} could not be given the layer {action.name}")
    return rig.motus.layers.entries[rig.motus.layers.active_entry]


def jump(rig):
    """Make the action of a jump. Two keys of the hips' height, with suitable handles, make the flight a parabola."""
    bones = rig.pose.bones
    for (name, axis), keys in JUMP.items():
        _key_turns(bones[name], axis, keys)
        if name.endswith(".L"):
            mirrored = [(frame, -angle if axis == 2 else angle) for frame, angle in keys]
            _key_turns(bones[name[:-1] + "R"], axis, mirrored)
    lean = dict(JUMP["pelvis", 0])
    turns = {}
    for frame, sink, sole in LEGS_OF_JUMP:
        for side in ("L", "R"):
            _add_leg(turns, side, frame, 0.01, sink, sole, lean.get(frame, lean.get(frame + 1, 0.0)))
    for (name, axis), keys in turns.items():
        _key_turns(bones[name], axis, keys)
    key(
        bones["pelvis"],
        "location",
        ((1, -0.030), (8, -CROUCH), (TAKE_OFF, -0.012), (TOUCH_DOWN, -0.020), (33, -LANDING), (JUMP_FRAMES, -0.030)),
        1,
    )
    action = _named(rig, "Jump")
    rise = next(curve for curve in actions.curves_for_object(action) if curve.data_path.endswith("location") and curve.array_index == 1)
    _shape_flight(rise)
    actions.assign(rig, None)
    return action


def _sink(share):
    """Return by how many metres the hips have sunk at a share of the stride, interpolated linearly in HIP_SINK."""
    share = share % 0.5
    keys = (*HIP_SINK, (0.5, HIP_SINK[0][1]))
    for (first, low), (second, high) in itertools.pairwise(keys):
        if share <= second:
            return low + (high - low) * (share - first) / (second - first)
    return keys[-1][1]


def _add_leg(turns, side, frame, ahead, sink, sole, lean=0.0):
    """Add keys at a frame that put a leg's ankle `ahead` of the hip and raise it by `sink` towards the hip, in metres.

    turns: {(bone, axis): [(frame, degrees)]}, extended. sole, lean: degrees by which the sole and the hips tilt.
    """
    thigh, shin, foot = _leg(ahead, sink, sole, lean)
    for name, angle in (("thigh", thigh), ("shin", shin), ("foot", foot)):
        turns.setdefault((f"{name}.{side}", 0), []).append((frame, angle))


def _leg(ahead, sink, sole, lean):
    """Return the angles of thigh, shin and foot about their X axes, in degrees, by the law of cosines.

    ahead, sink: metres by which the ankle is ahead of the hip and raised towards the hip. sole, lean: tilt of the sole and hips, degrees.
    """
    upper, lower = skeleton.JOINTS["thigh.L"], skeleton.JOINTS["shin.L"]
    thigh, shin = _way(upper.head, upper.tail), _way(lower.head, lower.tail)
    down = thigh[1] + shin[1] - sink
    far = min(math.hypot(ahead, down), 0.9995 * (math.hypot(*thigh) + math.hypot(*shin)))
    a, b = math.hypot(*thigh), math.hypot(*shin)
    at_hip = math.acos((a * a + far * far - b * b) / (2.0 * a * far))
    at_knee = math.acos((a * a + b * b - far * far) / (2.0 * a * b))
    forward = math.atan2(ahead, down) + at_hip
    back = forward - (math.pi - at_knee)
    of_thigh = math.degrees(forward - math.atan2(*thigh)) + lean
    of_shin = math.degrees(back - forward - (math.atan2(*shin) - math.atan2(*thigh)))
    return of_thigh, of_shin, sole + lean - of_thigh - of_shin


def _way(head, tail):
    """Return (ahead, down), the distances from one position in the rig to another. The rig faces -Y."""
    return head[1] - tail[1], head[2] - tail[2]


def _closed(keys):
    """Sort the keys of a stride and add the keys of the strides before and after, so that the ends of the stride are smooth."""
    keys = sorted(((frame - 1) % STRIDE + 1, value) for frame, value in keys)
    around = [(frame + turn * STRIDE, value) for turn in (-1, 0, 1, 2) for frame, value in keys]
    return [one for one in around if -STRIDE / 2 < one[0] <= 1.5 * STRIDE + 2]


def _key_turns(bone, axis, keys):
    key(bone, "rotation_euler", [(frame, math.radians(angle)) for frame, angle in keys], index=axis)


def _mirrored(name):
    """Return a bone's name with the endings .L and .R exchanged."""
    return name[:-2] + {".L": ".R", ".R": ".L"}.get(name[-2:], name[-2:])


def _named(rig, name):
    """Name the action that has been keyed on the rig, and set the rig's bones back to rest. Returns the action."""
    action = rig.animation_data.action
    action.name, action.use_fake_user = name, True
    for bone in rig.pose.bones:
        bone.location, bone.rotation_euler = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    return action


def _shape_whip(curve):
    """Shape the handles of an arm's F-curve so that the arm waits, and then accelerates until the hand lets go."""
    points = {round(point.co.x): point for point in curve.keyframe_points}
    wound, let_go = points[17], points[RELEASE]
    for point in (wound, let_go):
        point.handle_left_type = point.handle_right_type = 'FREE'
    rise = let_go.co.y - wound.co.y
    wound.handle_right = (wound.co.x + 2.6, wound.co.y)
    let_go.handle_left = (let_go.co.x - 0.7, let_go.co.y - 0.42 * rise)
    let_go.handle_right = (let_go.co.x + 2.0, let_go.co.y + 0.55 * rise)
    curve.update()


def _shape_flight(curve):
    """Shape the F-curve of the hips' height into a parabola between take-off and touch-down.

    A cubic Bezier segment whose inner control points lie 4/3 of a height above its ends is the parabola of that height.
    """
    points = {round(point.co.x): point for point in curve.keyframe_points}
    start, end = points[TAKE_OFF], points[TOUCH_DOWN]
    third, level = (TOUCH_DOWN - TAKE_OFF) / 3.0, 4.0 / 3.0 * JUMP_HEIGHT
    start.handle_left_type = start.handle_right_type = end.handle_left_type = end.handle_right_type = 'FREE'
    start.handle_right = (TAKE_OFF + third, start.co.y + level)
    end.handle_left = (TOUCH_DOWN - third, end.co.y + level)
    curve.update()
