"""Armature of the spider: body, abdomen, legs of two bones, and bones that are targets of the feet and of the knees."""

import bpy
from mathutils import Vector

from ...core.declare import offered
from . import anatomy

BODY, ABDOMEN, KNEES = "body", "abdomen", "knees"
UPPER, LOWER, FOOT = "upper", "lower", "foot"
"""First words of the names of a leg's bones; anatomy.Leg.name follows."""
SOFTNESS = 0.02
KNEES_OVER = 0.5
"""Height above the body of the bone that the knees bend towards, as a share of the spider's span."""


def build(context, name, place, count, size):
    """Make a spider's armature object in the active collection, and make it the active object; returns the object.

    place: location in the world. count: number of legs. size: span of the legs, metres.
    """
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
    """Add an Inverse Kinematics chain to each leg, whose target is the foot's bone and whose knee bends upwards. count: of legs."""
    ik = offered("ik")
    ik.add(rig, [ik.NewChain(LOWER + leg.name, rig, FOOT + leg.name, rig, KNEES, SOFTNESS) for leg in anatomy.legs(count)])
