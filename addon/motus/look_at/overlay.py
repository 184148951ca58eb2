"""Viewport overlay of Look At: lines along the gaze of head and eyes, and a line from the head to its target.

A gaze that misses the target is red.
"""

from mathutils import Vector

from ..core.file.choices import chosen
from ..core.interface.overlay import Batch, Overlay
from ..core.lazy import numpy as np
from ..core.measures import axes
from . import anatomy, groups, panel, reasons

GAZE_COLOR = (0.25, 0.85, 0.45, 0.9)
OFF_COLOR = (0.95, 0.25, 0.30, 0.9)
ON_THE_WAY_COLOR = (0.95, 0.75, 0.25, 0.9)  # color of the head's gaze if it misses the target, but all eyes look at the target
TARGET_COLOR = (0.75, 0.75, 0.80, 0.6)
GAZE_WIDTH, TARGET_WIDTH = 2.5, 1.0  # pixels
EYES_REACH = 0.6  # share of the distance to the target: the lines of the eyes end before the line of the head
POINT_SIZE = 6.0
FACE_COLOR = (0.35, 0.65, 1.0, 0.9)
FACE_LENGTH, HEAD_SIZE, FACE_WIDTH = 1.5, 0.25, 2.0  # arrow's length and its head's size in lengths of the head bone; pixels


def _batches_of(context, owner):
    """List of Batches to draw for an armature object on which Look At is set up; empty for any different object."""
    if owner.type != 'ARMATURE' or not owner.motus.look_at.is_active:
        return []
    depsgraph = context.evaluated_depsgraph_get()
    rig = owner.evaluated_get(depsgraph)
    found = []
    for entry in rig.motus.look_at.entries:
        told = panel.outputs_of(context, owner, entry.name)
        points = _targets_of(entry)
        if told is None or points[0] is None or told["reason"] < reasons.REACHED or entry.name not in rig.pose.bones:
            continue
        found += _batches(rig, entry, [point for point in points if point is not None], told["angle"])
    return found


def _batches(rig, entry, points, angle):
    """Batches of a head that looks at points. angle: radians that are left to the direction between several points."""
    names = [eye.name for eye in entry.eyes if eye.name in rig.pose.bones] if entry.eyes_weight > 0.0 else []
    forwards = anatomy.eyes_forward(rig, entry, names)
    shared = angle if len(points) > 1 else None
    of_eyes = angle if entry.use_saccades else shared  # the reported angle knows nothing of jumps
    eyes = [_gaze(rig, name, forward, points[0], EYES_REACH, of_eyes) for name, forward in zip(names, forwards)]
    head = _gaze(rig, entry.name, anatomy.head_forward(rig, entry), points[0], 1.0, shared)
    if eyes and head.colors == OFF_COLOR and all(eye.colors == GAZE_COLOR for eye in eyes):
        head = head._replace(colors=ON_THE_WAY_COLOR)
    return [
        *(Batch('LINES', _array(_place(rig, entry.name), point), TARGET_COLOR, TARGET_WIDTH) for point in points),
        Batch('POINTS', _array(*points), TARGET_COLOR, POINT_SIZE),
        head,
        *eyes,
        _face(rig, entry),
    ]


def _face(rig, entry):
    """Batch with an arrow along the facing direction of a head in its present pose, with a tick at the arrow's tip that points up."""
    bone = rig.pose.bones[entry.name]
    carried = (rig.matrix_world @ bone.matrix).to_3x3() @ bone.bone.matrix_local.to_3x3().inverted_safe()
    forward, up = (bone.bone.length * (carried @ Vector(axes.vector(axis))) for axis in (chosen(entry, "forward"), chosen(entry, "up")))
    place, tip = _place(rig, entry.name), _place(rig, entry.name) + FACE_LENGTH * forward
    side = forward.cross(up).normalized() * up.length
    ends = [tip - HEAD_SIZE * forward + HEAD_SIZE * across for across in (side, -side)]
    return Batch('LINES', _array(place, tip, tip, ends[0], tip, ends[1], tip, tip + HEAD_SIZE * up), FACE_COLOR, FACE_WIDTH)


def _targets_of(entry):
    """World positions of the target of an evaluated entry, and of its further targets of weight; None for a target that is missing."""
    goals = zip(groups.goals(entry), groups.weights(entry))
    return [_point(*goal) for number, (goal, weight) in enumerate(goals) if weight > 0.0 or number == 0]


def _point(target, bone):
    if target is None:
        return None
    if not bone or target.pose is None:
        return target.matrix_world.translation
    return _place(target, bone) if bone in target.pose.bones else None


def _place(rig, bone):
    return rig.matrix_world @ rig.pose.bones[bone].head


def _gaze(rig, bone, forward, point, reach, angle):
    """Batch with the line along which a bone looks; its color says whether the bone looks at the target.

    forward: unit vector in the bone's space. point: world position of the target. reach: length of the line, as a share of the
    distance from the bone to the target. angle: radians by which the bone misses what it looks at; None measures the angle to the point.
    """
    pose = rig.matrix_world @ rig.pose.bones[bone].matrix
    along = (pose.to_3x3() @ forward).normalized()
    way = point - pose.translation
    missed = along.angle(way, 0.0) if angle is None else angle
    color = OFF_COLOR if missed >= reasons.SLIGHT else GAZE_COLOR
    return Batch('LINES', _array(pose.translation, pose.translation + reach * way.length * along), color, GAZE_WIDTH)


def _array(*points):
    return np.array([tuple(Vector(point)) for point in points], np.float32)


overlay = Overlay(_batches_of)
