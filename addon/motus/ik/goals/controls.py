"""Move targets and poles of chains. A Control is a target or pole: an object, or the bone of an object.

An entry's setting Blend passes a chain from its target (Blend 0) to its further targets (1, 2, ...).
"""

import math

from mathutils import Matrix

from ...core.bake.sampling import rotation_path
from ...core.blender.datablocks import Named
from ...core.file import deleted
from ...core.file.pointers import pointed
from ...core.refusals import Refused, check_no_tweak_mode
from ...core.translations import tr
from ..groups import goals
from . import blend_targets, places as goal_places
from .orientation import frame_of


class Control(Named):
    """Target or pole of a chain: an object, or its bone by name. `thing` is the Object or PoseBone that has the channels."""

    __slots__ = ()

    @property
    def label(self):
        return f"{self.object.name}: {self.bone}" if self.bone else self.object.name


def _control(obj, bone):
    """Control for an object and the name of its bone. The bone may be missing. If the object has no bones, the name has no effect."""
    return Control(obj, bone if obj.pose else "")


def _has_lost(control):
    return bool(control.bone) and control.bone not in control.object.pose.bones


def goal_at(entry, blend):
    """(object or None, bone name) of the target at which a chain is at a value of its setting Blend.

    None if the value is between two targets, or not finite. The object is None if no target is chosen there.
    """
    if not math.isfinite(blend):
        return None
    whole = round(blend)
    if abs(blend - whole) > blend_targets.STANDS:
        return None
    whole = min(whole, len(entry.extra_targets))
    if whole == 0:
        return pointed(entry, "target"), entry.target_bone
    extra = entry.extra_targets[whole - 1]
    return pointed(extra, "object"), extra.bone


def blend_target(entry, blend):
    """Control of the target at which a chain is at a value of its setting Blend; None if the value is between two targets.

    Raises Refused if no target is chosen there. The target may be missing: check_present() refuses a deleted object,
    check_movable() a missing bone.
    """
    goal = goal_at(entry, blend)
    if goal is None:
        return None
    if goal[0] is None:
        raise Refused(tr("{bone} has no target: choose one").format(bone=entry.name))
    return _control(*goal)


def pole(entry):
    """Control of an entry's pole; None if there is no pole.

    None also if the pole was deleted, or lacks its bone: the chain then bends as without a pole.
    """
    pole = pointed(entry, "pole")
    if pole is None or deleted.is_deleted(pole):
        return None
    control = _control(pole, entry.pole_bone)
    return None if _has_lost(control) else control


def check_present(control):
    """Refuse a control whose object was deleted, so that it is in no collection any more."""
    if deleted.is_deleted(control.object):
        raise Refused(tr("{target} is in no collection any more: choose another target").format(target=control.object.name))


def check_movable(control, channels):
    """Refuse a control whose bone is missing, or whose channels cannot be set or do not alone determine its place.

    The latter is so if it is linked, has an active constraint or a driver, or is a bone connected to its parent. channels: those
    that will be set, of "location", "rotation".
    """
    if _has_lost(control):
        raise Refused(tr("{object} has no bone {bone}").format(object=control.object.name, bone=control.bone))
    obj, thing = control.object, control.thing
    if obj.library:
        raise Refused(tr("{object} is linked from another file: make a library override of it first").format(object=obj.name))
    check_no_tweak_mode(obj)
    for constraint in thing.constraints:
        if not constraint.mute and constraint.influence > 0.0:
            raise Refused(
                tr("{target} has a constraint, so it cannot be moved: {constraint}").format(
                    target=control.label, constraint=constraint.name
                )
            )
    if control.bone and "location" in channels and thing.bone.use_connect:
        raise Refused(tr("{target} is connected to its parent, so it cannot be moved").format(target=control.label))
    check_undriven(thing, channels, control.label)


def check_undriven(thing, channels, label):
    """Refuse an Object or PoseBone that has a driver on one of the channels. label: name of the thing in the message."""
    animation = thing.id_data.animation_data
    paths = {thing.path_from_id(name) for name in channel_names(thing, channels)}
    if animation and any(curve.data_path in paths and not curve.mute for curve in animation.drivers):
        raise Refused(tr("{target} is moved by a driver").format(target=label))


def channel_names(thing, channels):
    """Names of the properties of an Object or PoseBone that hold the channels "location", "rotation" or "scale"."""
    names = {"location": "location", "rotation": rotation_path(thing), "scale": "scale"}
    return [names[channel] for channel in channels]


def world_matrix(control, depsgraph):
    """Evaluated world matrix of a control, as a copy."""
    return goal_places.world_matrix(control.object.evaluated_get(depsgraph), control.bone).copy()


def basis_for(control, depsgraph, matrix, offset=None):
    """Matrix of the location and rotation channels by which a control gets the place and orientation of a world matrix.

    The result is relative to the control's parents and has no scale: the control keeps its own scale. matrix: rigid world Matrix.
    offset: 3 x 3 Matrix of a turn in the control's own space, after which the control has the orientation; None for no turn.
    """
    local, scale = _in_parents(control, control.object.evaluated_get(depsgraph), matrix)
    own = Matrix.Diagonal(scale) @ (offset or Matrix.Identity(3))
    return Matrix.LocRotScale(local.translation, frame_of(local) @ frame_of(own).inverted(), None)


def _in_parents(control, evaluated, matrix):
    """(world matrix in the space of the control's parents, the control's own scale)."""
    if not control.bone:
        parents = evaluated.matrix_world @ evaluated.matrix_basis.inverted_safe()
        return parents.inverted_safe() @ matrix, evaluated.scale * evaluated.delta_scale
    bone = evaluated.pose.bones[control.bone]
    return evaluated.convert_space(
        pose_bone=bone, matrix=evaluated.matrix_world.inverted_safe() @ matrix, from_space='POSE', to_space='LOCAL'
    ), bone.scale


def animated_with(rig, entries):
    """Dictionary whose keys are the rig and the objects of the entries' targets and poles: the animation of all these acts together."""
    return dict.fromkeys([rig, *(goal for entry in entries for goal, _ in goals(entry))])
