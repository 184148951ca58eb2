"""Viewport overlay of a rig's chains: circles of their reach, lines to their poles, and lines of the distance left to their targets."""

import itertools
import math

from mathutils import Quaternion

from ..core.file import deleted
from ..core.file.pointers import pointed
from ..core.interface.overlay import Batch, Overlay, Switch
from ..core.lazy import numpy as np
from . import chains, limits_picture, status
from .goals import controls, places as goal_places, placing

STEPS = 64  # lines of which a circle is drawn
LEAST_RESIDUAL = 1e-4  # in lengths of the chain: a smaller distance to the target is not drawn
PLAIN_BEND = math.radians(0.5)  # joints that bend by a smaller angle do not show the plane of the bend

REACH_COLOR = (0.98, 0.80, 0.25, 0.7)
NEAR_COLOR = (0.98, 0.80, 0.25, 0.35)
POLE_COLOR = (0.30, 0.75, 1.0, 0.8)
RESIDUAL_COLOR = (0.95, 0.25, 0.30, 1.0)
LIMITS_COLOR = (0.70, 0.45, 0.95, 0.8)


def _batches(context, owner):
    """List of Batches to draw for the chains of a rig. Circles and limits are drawn only for the chain that the panel shows."""
    if owner.type != 'ARMATURE' or not owner.motus.ik.is_active:
        return []
    shown = context.scene.motus
    depsgraph = context.evaluated_depsgraph_get()
    rig = owner.evaluated_get(depsgraph)
    active = owner.motus.ik.active_entry
    found, poles, residuals = [], [], []
    for index, entry in enumerate(rig.motus.ik.entries):
        chain = chains.find(rig, entry)
        if chain is None or entry.is_muted:
            continue
        joints = placing.posed_joints(rig, chain)
        if shown.show_reach and index == active:
            report = status.report(owner, entry.name, depsgraph)
            found += _circles(rig, chain, entry, joints, report.reach if report else 0.0)
        if shown.show_limits and index == active and entry.use_limits:
            bordered = [point for name in chain.bones for point in limits_picture.lines(rig, name)]
            if bordered:
                found.append(_lines(bordered, LIMITS_COLOR, 1.0))
        pole = _place(pointed(entry, "pole"), entry.pole_bone)
        if pole:
            poles += [_middle(joints), pole]
        target = _target(rig, entry)
        if target and (target - joints[-1]).length > LEAST_RESIDUAL * placing.length(joints):
            residuals += [joints[-1], target]
    if shown.show_pole and poles:
        found.append(_lines(poles, POLE_COLOR, 1.5))
    if shown.show_residual and residuals:
        found.append(_lines(residuals, RESIDUAL_COLOR, 2.0))
    return found


def _place(goal, bone):
    if goal is None or deleted.is_deleted(goal):
        return None
    matrix = goal_places.world_matrix(goal, bone)
    return matrix.translation.copy() if matrix else None


def _target(rig, entry):
    """World position of the target of an entry; None if the weight is 0, if Blend is between two targets, or if the target is missing."""
    goal = controls.goal_at(entry, entry.target_blend)
    if goal is None or entry.position_weight * rig.motus.ik.influence == 0.0:
        return None
    return _place(*goal)


def _middle(joints):
    """World position of the joint of a chain that is farthest from the line between the chain's root and tip."""
    along = joints[-1] - joints[0]
    return max(joints[1:-1] or joints[:1], key=lambda joint: (joint - joints[0]).cross(along).length)


def _circles(rig, chain, entry, joints, reach):
    """Batches of two circles in the plane of the bend: the farthest and the nearest places that the tip can reach without stretch.

    joints: world positions from root to tip. reach: farthest distance as the solver has reported it; 0 if it was not reported.
    """
    normal = placing.bend_normal(joints, PLAIN_BEND) or placing.hinge_normal(rig, chain, entry.hinge_angle)
    links = [(end - start).length for start, end in itertools.pairwise(joints)]
    total = sum(links)
    if total == 0.0:  # the rig is scaled to nothing
        return []
    reach = reach or total
    found = [_circle(joints[0], normal, reach, REACH_COLOR, 1.5)]
    nearest = reach * (2.0 * max(links) / total - 1.0)
    if nearest > 1e-6 * reach:
        found.append(_circle(joints[0], normal, nearest, NEAR_COLOR, 1.0))
    return found


def _circle(centre, normal, radius, color, width):
    side = normal.orthogonal().normalized() * radius
    points = [centre + Quaternion(normal, math.tau * step / STEPS) @ side for step in range(STEPS + 1)]
    return Batch('LINE_STRIP', np.array(points, dtype=np.float32), color, width)


def _lines(points, color, width):
    return Batch('LINES', np.array(points, dtype=np.float32), color, width)


overlay = Overlay(
    _batches,
    (
        Switch("show_reach", "Reach", "Draw between which distances a chain can reach"),
        Switch("show_pole", "Pole", "Draw the line from the middle of a chain to its pole"),
        Switch("show_limits", "Joint Limits", "Draw how far the joints of a chain may swing and twist"),
        Switch("show_residual", "What Is Missing", "Draw what is left between the end of a chain and its target"),
    ),
)
