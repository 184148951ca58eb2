"""Control bones: bones without parent that deform nothing, made in the rig itself for its chains to go to or bend towards."""

import math
from contextlib import contextmanager

import bpy
from mathutils import Matrix

from ...core.blender import actions
from ...core.refusals import Refused, check_evaluated
from ...core.translations import tr
from . import placing
from .placing import CONTROL_KEY

SHARE = 0.2
"""Of the chain's length: so long is a control bone."""


def check(context, rig):
    """Refuse a rig to which no bones can be added."""
    if rig.data.library or rig.data.override_library:
        raise Refused(
            tr("The armature of {object} is linked from another file and can be given no bones: choose an object").format(object=rig.name)
        )
    check_evaluated(rig, context.view_layer)


def new_target(context, rig, chain, matrix=None):
    """A bone at the end of the chain, or where a world matrix says; gives its name. At rest it is at the end of the chain at rest."""
    bones = rig.data.bones
    rest = bones[chain.effector].matrix_local.to_quaternion().to_matrix().to_4x4()
    rest.translation = placing.rest_joints(rig, chain)[-1]
    if matrix is None:
        evaluated = _evaluated(context, rig)
        matrix = placing.effector_orientation(evaluated, chain).to_matrix().to_4x4()
        matrix.translation = placing.posed_joints(evaluated, chain)[-1]
    return _add(context, rig, tr("Target {bone}").format(bone=chain.effector), rest, matrix, chain)


def new_pole(context, rig, chain, place):
    """An upright bone at a place in the world, where it is at rest too; gives its name."""
    matrix = Matrix.Translation(place) @ Matrix.Rotation(math.pi / 2.0, 4, 'X')
    return _add(context, rig, tr("Pole {bone}").format(bone=chain.effector), None, matrix, chain)


def is_made(rig, bone):
    """Whether a bone was made here."""
    found = rig.data.bones.get(bone) if rig.type == 'ARMATURE' and bone else None
    return found is not None and CONTROL_KEY in found


def remove(context, rig, names):
    """Delete bones, with their keys and drivers."""
    with _edited(context, rig) as bones:
        for name in names:
            bones.remove(bones[name])
    actions.remove(rig, tuple(f'pose.bones["{bpy.utils.escape_identifier(name)}"]' for name in names))


def _evaluated(context, rig):
    context.view_layer.update()
    return rig.evaluated_get(context.view_layer.depsgraph)


def _add(context, rig, name, rest, matrix, chain):
    """rest: in the armature; None: the bone is there at rest already. matrix: in the world, without scale."""
    world = _evaluated(context, rig).matrix_world
    local = world.inverted_safe() @ matrix
    posed = Matrix.LocRotScale(local.translation, local.to_quaternion(), None)
    rest = posed if rest is None else rest
    length = SHARE * placing.length(placing.rest_joints(rig, chain)) or placing.DEFAULT_LENGTH
    with _edited(context, rig) as bones:
        bone = bones.new(name)
        bone.head, bone.tail = (0.0, 0.0, 0.0), (0.0, length, 0.0)
        bone.matrix = rest
        bone.use_deform = False
        name = bone.name
    rig.data.bones[name][CONTROL_KEY] = True
    rig.pose.bones[name].matrix_basis = rest.inverted() @ posed
    rig.pose.bones[name].scale = (1.0, 1.0, 1.0)  # to the last bit
    context.view_layer.update()
    return name


@contextmanager
def _edited(context, rig):
    """The rig's edit bones; mode and active object are afterwards as they were."""
    objects = context.view_layer.objects
    active = objects.active
    mode = active.mode if active else 'OBJECT'
    if active and active != rig and mode != 'OBJECT':
        bpy.ops.object.mode_set(mode='OBJECT')
    objects.active = rig
    own = rig.mode
    bpy.ops.object.mode_set(mode='EDIT')
    try:
        yield rig.data.edit_bones
    finally:
        bpy.ops.object.mode_set(mode=own)
        objects.active = active
        if active and active != rig and mode != 'OBJECT':
            bpy.ops.object.mode_set(mode=mode)
