"""The spider's armature: a body, an abdomen, legs of two bones, and bones that the feet and the knees go by."""

import bpy
from mathutils import Vector

from ...core.declare import offered
from . import anatomy

BODY, ABDOMEN, KNEES = "body", "abdomen", "knees"
UPPER, LOWER, FOOT = "upper", "lower", "foot"
"""Beginnings of the names of a leg's bones."""
SOFTNESS = 0.02
KNEES_OVER = 0.5
"""How far over the body the place is that knees bend towards, of the span."""


def build(context, name, place, count, size):
    """A new armature object in the active collection, which becomes the active one."""
    armature = bpy.data.armatures.new(name)
    armature.display_type = 'STICK'
    rig = bpy.data.objects.new(name, armature)
    rig.location = place
    (context.collection or context.scene.collection).objects.link(rig)
    context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    try:
        _add_bones(armature.edit_bones, count, size)
    finally:
        bpy.ops.object.mode_set(mode='OBJECT')
    return rig


def _add_bones(bones, count, size):
    def add(name, head, tail, parent=None, deforms=True):
        bone = bones.new(name)
        bone.head, bone.tail, bone.parent, bone.use_deform = size * head, size * tail, parent, deforms
        return bone

    longer = anatomy.stretch(count)
    height = Vector((0.0, 0.0, anatomy.HEIGHT))
    body = add(BODY, height, height + Vector((0.0, 0.12 * longer, 0.0)))
    behind = height + Vector((0.0, -0.07 * longer, 0.01))
    add(ABDOMEN, behind, behind + Vector((0.0, -0.27, 0.05)), body)
    over = height + Vector((0.0, 0.0, KNEES_OVER))
    add(KNEES, over, over + Vector((0.0, 0.0, 0.06)), body, deforms=False)
    for leg in anatomy.legs(count):
        upper = add(UPPER + leg.name, leg.hip, leg.knee, body)
        lower = add(LOWER + leg.name, leg.knee, leg.foot, upper)
        lower.use_connect = True
        add(FOOT + leg.name, leg.foot, leg.foot + Vector((0.0, 0.0, 0.06)), deforms=False)


def reach(rig, count):
    """Let the legs reach for their feet by the system ik, with the knees up."""
    ik = offered("ik")
    ik.add(rig, [ik.NewChain(LOWER + leg.name, rig, FOOT + leg.name, rig, KNEES, SOFTNESS) for leg in anatomy.legs(count)])
