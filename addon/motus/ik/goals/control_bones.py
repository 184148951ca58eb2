"""Make and delete control bones: bones of the rig itself that are targets and poles of its chains.

A control bone has no parent, and deforms nothing.
"""

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
"""Length of a control bone, as a share of the chain's length."""


def check(context, rig):
    """Refuse a rig to which no bones can be added, because its armature is linked, or it is not evaluated."""
    if rig.data.library or rig.data.override_library:
        raise Refused(
            tr("The armature of {object} is linked from another file and can be given no bones: choose an object").format(object=rig.name)
        )
    check_evaluated(rig, context.view_layer)


def new_target(context, rig, chain, matrix=None):
    """Add a control bone as the target of a chain. Returns the bone's name.

    At rest, the bone is at the end of the chain at rest. Its pose is the end of the posed chain, or a given world matrix.
    """
    bones = rig.data.bones
    rest = bones[chain.effector].matrix_local.to_quaternion().to_matrix().to_4x4()
    rest.translation = placing.rest_joints(rig, chain)[-1]
    if matrix is None:
        evaluated = _evaluated(context, rig)
        matrix = placing.effector_orientation(evaluated, chain).to_matrix().to_4x4()
        matrix.translation = placing.posed_joints(evaluated, chain)[-1]
    return _add(context, rig, tr("Target {bone}").format(bone=chain.effector), rest, matrix, chain)


def new_pole(context, rig, chain, place):
    """Add an upright control bone as the pole of a chain, posed and at rest at a world position. Returns the bone's name."""
    matrix = Matrix.Translation(place) @ Matrix.Rotation(math.pi / 2.0, 4, 'X')
    return _add(context, rig, tr("Pole {bone}").format(bone=chain.effector), None, matrix, chain)


def is_made(rig, bone):
    """Whether the bone of a name is a control bone that Motus has made; False for "", or if the rig is no armature object."""
    found = rig.data.bones.get(bone) if rig.type == 'ARMATURE' and bone else None
    return found is not None and CONTROL_KEY in found


def remove(context, rig, names):
    """Delete the bones of these names from a rig, with their keys and drivers."""
    with _edited(context, rig) as bones:
        for name in names:
            bones.remove(bones[name])
    actions.remove(rig, tuple(f'pose.bones["{bpy.utils.escape_identifier(name)}"]' for name in names))


def _evaluated(context, rig):
    context.view_layer.update()
    return rig.evaluated_get(context.view_layer.depsgraph)


def _add(context, rig, name, rest, matrix, chain):
    """Add a control bone to the rig. Returns its name, which Blender may have made unique.

    name: wanted name. rest: Matrix at rest in the armature's space; None takes the posed Matrix. matrix: posed world Matrix
    without scale.
    """
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
    rig.pose.bones[name].scale = (1.0, 1.0, 1.0)  # exactly, without the rounding of matrix_basis
    context.view_layer.update()
    return name


@contextmanager
def _edited(context, rig):
    """Context manager that gives the rig's edit bones in Edit Mode, and restores the mode and the active object at its end."""
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
