"""Dragging a chain with the mouse: no jump, the point stays under the cursor, one undo step, Esc puts all back."""

import itertools

import bpy
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

from window import window_support

JOINTS = ((0.0, 0.0, 2.0), (0.1, -0.2, 1.2), (0.0, 0.0, 0.4), (0.1, -0.1, -0.2))
NEAR = 1.5  # pixels


def build(with_ik=False):
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    rig = bpy.data.objects.new("Figure", bpy.data.armatures.new("Figure"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    rig.select_set(True)
    bpy.ops.object.mode_set(mode='EDIT')
    parent = None
    for index, (head, tail) in enumerate(itertools.pairwise(JOINTS)):
        bone = rig.data.edit_bones.new(f"Bone {index}")
        bone.head, bone.tail, bone.parent, bone.use_connect = head, tail, parent, parent is not None
        parent = bone
    bpy.ops.object.mode_set(mode='OBJECT')
    if with_ik:
        bpy.ops.motus.ik_add(object="Figure", bone="Bone 2", chain_length=3)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='POSE')
    with window_support.override():
        bpy.ops.view3d.view_axis(type='FRONT')
        bpy.ops.view3d.view_all()
    return rig


def point(name, factor):
    rig = bpy.data.objects["Figure"]
    evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    bone = evaluated.pose.bones[name]
    return evaluated.matrix_world @ bone.head.lerp(bone.tail, factor)


def on_screen(place):
    """Place in the viewport's region, pixels."""
    region = window_support.region()
    return location_3d_to_region_2d(region, region.data, place)


def in_window(place):
    region = window_support.region()
    return round(region.x + place.x), round(region.y + place.y)


def button(value, x, y, kind='LEFTMOUSE'):
    window_support.window().event_simulate(type=kind, value=value, x=x, y=y)


def pose():
    rig = bpy.data.objects["Figure"]
    evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return [tuple(value for row in bone.matrix for value in row) for bone in evaluated.pose.bones]


def difference(first, second):
    return max(abs(a - b) for one, other in zip(first, second) for a, b in zip(one, other))


def start(name, factor, aside=(6, 3)):
    """Generator: starts the operator and presses near a point of a bone; its value is the place pressed at."""
    yield
    bpy.ops.ed.undo_push(message="built")
    with window_support.override():
        assert bpy.ops.motus.ik_drag('INVOKE_DEFAULT') == {'RUNNING_MODAL'}
    yield
    x, y = in_window(on_screen(point(name, factor)))
    x, y = x + aside[0], y + aside[1]
    window_support.move(x, y)
    yield
    button('PRESS', x, y)
    yield
    return x, y


def drags(name, factor, with_ik):
    """Generator: drags a point there and back, and releases elsewhere; checks every step."""
    build(with_ik)
    x, y = yield from start(name, factor)
    before, held = pose(), on_screen(point(name, factor))
    window_support.move(x + 1, y)
    yield
    assert difference(pose(), before) < 0.05, "it jumped at the first pixel"
    for step in ((10, 0), (25, 10), (40, 30), (0, 0), (30, 25)):
        window_support.move(x + step[0], y + step[1])
        yield
        found = on_screen(point(name, factor))
        # The point that is nearest to the cursor is held, to some pixels the one that was meant.
        assert (found - held - Vector(step)).length < 6.0, (step, found, held)
    button('RELEASE', x + 30, y + 25)
    yield
    after = pose()
    assert difference(after, before) > 0.01, "nothing was dragged"
    window_support.press('Z', x, y, ctrl=True)
    yield
    assert difference(pose(), before) < 1e-5, "it was not undone by one step"
    window_support.press('Z', x, y, ctrl=True, shift=True)
    yield
    assert difference(pose(), after) < 1e-5, "it was not redone"


def test_bones_follow():
    yield from drags("Bone 2", 0.5, with_ik=False)


def test_target_follows():
    yield from drags("Bone 2", 0.9, with_ik=True)
    assert (bpy.data.objects["Figure Bone 2 Target"].location - Vector(JOINTS[-1])).length > 0.01


def test_held_exactly():
    build()
    x, y = yield from start("Bone 1", 0.5, aside=(0, 0))
    window_support.move(x + 20, y + 15)
    yield
    found = in_window(on_screen(point("Bone 1", 0.5)))
    assert abs(found[0] - x - 20) <= NEAR and abs(found[1] - y - 15) <= NEAR, (found, x + 20, y + 15)
    yield from window_support.picture("ik_drag")
    button('RELEASE', x + 20, y + 15)
    yield


def test_escape_puts_back():
    for kind in ('ESC', 'RIGHTMOUSE'):
        for with_ik in (False, True):
            rig = build(with_ik)
            if with_ik:
                target = bpy.data.objects["Figure Bone 2 Target"]
            own = [tuple(bone.rotation_quaternion) for bone in rig.pose.bones]
            places = [tuple(obj.location) for obj in bpy.data.objects]
            x, y = yield from start("Bone 2", 0.8)
            window_support.move(x + 40, y + 30)
            yield
            moved = (
                tuple(target.location) not in places if with_ik else ([tuple(bone.rotation_quaternion) for bone in rig.pose.bones] != own)
            )
            assert moved, "nothing was dragged"
            button('PRESS', x + 40, y + 30, kind)
            yield
            button('RELEASE', x + 40, y + 30, kind)
            button('RELEASE', x + 40, y + 30)
            yield
            assert [tuple(bone.rotation_quaternion) for bone in rig.pose.bones] == own
            assert [tuple(obj.location) for obj in bpy.data.objects] == places


def test_a_press_beside_the_bones_does_nothing():
    build()
    before = pose()
    yield
    with window_support.override():
        bpy.ops.motus.ik_drag('INVOKE_DEFAULT')
    region = window_support.region()
    x, y = region.x + 100, region.y + 60
    window_support.press('LEFTMOUSE', x, y)
    yield
    window_support.move(x + 50, y + 50)
    yield
    window_support.press('ESC', x, y)
    yield
    assert difference(pose(), before) == 0.0
