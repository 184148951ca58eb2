"""Targets and poles as things that can be moved: an object, or a bone of one."""

import math

from mathutils import Matrix

from ...core.bake.sampling import rotation_path
from ...core.blender.datablocks import Named
from ...core.file import deleted
from ...core.file.pointers import pointed
from ...core.refusals import Refused, check_no_tweak_mode
from ...core.translations import tr
from ..groups import goals
from . import places as goal_places, stations
from .orientation import frame_of


class Control(Named):
    """Its thing has the channels."""

    __slots__ = ()

    @property
    def label(self):
        return f"{self.object.name}: {self.bone}" if self.bone else self.object.name


def _control(obj, bone):
    """The Control for an object and the name of its bone, which may be gone; the name has no effect if the object has no bones."""
    return Control(obj, bone if obj.pose else "")


def _has_lost(control):
    return bool(control.bone) and control.bone not in control.object.pose.bones


def goal_at(entry, blend):
    """(object or None, bone) that the chain goes to at a value of Blend; None between two of them."""
    if not math.isfinite(blend):
        return None
    whole = round(blend)
    if abs(blend - whole) > stations.STANDS:
        return None
    whole = min(whole, len(entry.extra_targets))
    if whole == 0:
        return pointed(entry, "target"), entry.target_bone
    extra = entry.extra_targets[whole - 1]
    return pointed(extra, "object"), extra.bone


def station(entry, blend):
    """The station as a Control, which may be gone: check_movable() says so."""
    goal = goal_at(entry, blend)
    if goal is None:
        return None
    if goal[0] is None:
        raise Refused(tr("{bone} has no target: choose one").format(bone=entry.name))
    return _control(*goal)


def pole(entry):
    """The pole's Control; None where there is no pole, or where it is gone, so that the chain bends as without one."""
    pole = pointed(entry, "pole")
    if pole is None or deleted.is_deleted(pole):
        return None
    control = _control(pole, entry.pole_bone)
    return None if _has_lost(control) else control


def check_present(control):
    """Refuse a target that stands in no collection any more."""
    if deleted.is_deleted(control.object):
        raise Refused(tr("{target} is in no collection any more: choose another target").format(target=control.object.name))


def check_movable(control, channels):
    """Refuse a control that is gone, or whose own channels do not say where it stands.

    channels: "location", "rotation".
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
    """Refuse an Object or PoseBone with a driver on one of the channels."""
    animation = thing.id_data.animation_data
    paths = {thing.path_from_id(name) for name in channel_names(thing, channels)}
    if animation and any(curve.data_path in paths and not curve.mute for curve in animation.drivers):
        raise Refused(tr("{target} is moved by a driver").format(target=label))


def channel_names(thing, channels):
    """Names of the properties that hold these channels."""
    names = {"location": "location", "rotation": rotation_path(thing), "scale": "scale"}
    return [names[channel] for channel in channels]


def world_matrix(control, depsgraph):
    """Evaluated world matrix of a control."""
    return goal_places.world_matrix(control.object.evaluated_get(depsgraph), control.bone).copy()


def basis_for(control, depsgraph, matrix, offset=None):
    """Rotation and place relative to what the parents do, by which the control has those of a world matrix.

    matrix: rigid. offset: Matrix of a turn in the control's own space after which it has that orientation. The control
    keeps its own scale.
    """
    local, scale = _in_parents(control, control.object.evaluated_get(depsgraph), matrix)
    own = Matrix.Diagonal(scale) @ (offset or Matrix.Identity(3))
    return Matrix.LocRotScale(local.translation, frame_of(local) @ frame_of(own).inverted(), None)


def _in_parents(control, evaluated, matrix):
    """A world matrix as the control's parents see it, and the control's own scale."""
    if not control.bone:
        parents = evaluated.matrix_world @ evaluated.matrix_basis.inverted_safe()
        return parents.inverted_safe() @ matrix, evaluated.scale * evaluated.delta_scale
    bone = evaluated.pose.bones[control.bone]
    return evaluated.convert_space(
        pose_bone=bone, matrix=evaluated.matrix_world.inverted_safe() @ matrix, from_space='POSE', to_space='LOCAL'
    ), bone.scale


def animated_with(rig, entries):
    """The rig and all that its entries go to or bend towards: objects whose frames matter to each other."""
    return dict.fromkeys([rig, *(goal for entry in entries for goal, _ in goals(entry))])
