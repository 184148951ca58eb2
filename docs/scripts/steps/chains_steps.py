"""Move a rig, add a chain to its tail, choose a preset, play, and let it touch a ball."""

import math

import bpy
from mathutils import Euler

from window import window_support

from . import hand

BONES, LENGTH = 8, 0.3  # of the tail; m
MOVES = ((1, 0.0), (15, 0.0), (23, 1.5), (60, 1.5))
"""Frame, and place along X."""
PRESETS = 175
"""How far right of the panel's name its menu of presets is, in pixels."""


def steps(strip):
    """Generator: the five steps of the Chains page."""
    yield from hand.fresh()
    yield from hand.empty_view()
    rig = _build_rig()
    view = window_support.area().spaces.active.region_3d
    view.view_rotation = Euler((math.radians(82.0), 0.0, math.radians(8.0))).to_quaternion()
    view.view_location, view.view_distance = (1.6, 0.0, 1.9), 7.5
    yield from hand.over_view()
    yield from hand.key('TAB', ctrl=True)
    yield from hand.to_frame(23)
    yield from strip.shot(400, 200, has_mouse=False)

    yield from hand.on("Chain from Tail 1", hand.box('UI'))
    yield from strip.shot(620, 80, is_moved=True)
    yield from hand.click()

    yield from hand.click("Chains", hand.box('UI'), beside=PRESETS)
    yield 0.5
    yield from hand.on("Ponytail")
    yield from strip.shot(620, 60)
    yield from hand.click()

    yield from hand.to_frame(28)
    yield from strip.shot(400, 200, has_mouse=False)
    yield from strip.panel("chains_panel", 0, 28, 1050, 720)

    _add_ball(rig)
    yield from hand.to_frame(45)
    yield from hand.click("Surroundings", hand.box('UI'))
    yield from hand.on("Colliders", hand.box('UI'))
    yield from strip.shot(250, 260)


def _build_rig():
    """A rig that keys move, with a tail whose first bone is selected."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    rig.select_set(True)
    bpy.ops.object.mode_set(mode='EDIT')
    parent = None
    for index in range(BONES):
        bone = rig.data.edit_bones.new(f"Tail {index + 1}")
        bone.head, bone.tail = (index * LENGTH, 0.0, 2.5), ((index + 1) * LENGTH, 0.0, 2.5)
        bone.parent, bone.use_connect = parent, parent is not None
        parent = bone
    bpy.ops.object.mode_set(mode='OBJECT')
    for frame, place in MOVES:
        rig.location.x = place
        rig.keyframe_insert("location", index=0, frame=frame)
    bpy.context.scene.frame_end = MOVES[-1][0]
    first = rig.data.bones["Tail 1"]
    rig.data.bones.active = first
    for bone in rig.pose.bones:
        selected = bone if hasattr(bone, "select") else bone.bone
        selected.select = bone.name == first.name
    return rig


def _add_ball(rig):
    """A ball in the way of the tail, in the collection of its colliders."""
    ball = bpy.data.objects.new("Ball", None)
    ball.empty_display_type, ball.empty_display_size = 'SPHERE', 0.45
    ball.location = (2.15, 0.0, 1.5)
    solid = bpy.data.collections.new("Solid")
    solid.objects.link(ball)
    bpy.context.scene.collection.children.link(solid)
    rig.motus.chains.colliders = solid
    rig.motus.chains.entries[0].thickness = 0.05
