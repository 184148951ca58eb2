"""Look At as an artist sees it: sidebar, the bone's constraint properties, and the overlay on a figure that looks."""

import sys

import bpy
from mathutils import Vector

import support
from window import properties_editor, window_support

sys.path.insert(0, str(support.CLONE / "docs" / "scripts"))

import look_at_figure


def build(target=(0.62, -0.6, 1.62), **keywords):
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    rig = look_at_figure.build(name="Puppet")
    goal = bpy.data.objects.new("Firefly", None)
    goal.empty_display_type, goal.empty_display_size = 'SPHERE', 0.06
    goal.location = target
    bpy.context.scene.collection.objects.link(goal)
    bpy.ops.motus.look_at_add(object="Puppet", bone="Head", target="Firefly", **keywords)
    for obj in bpy.context.scene.objects:
        obj.select_set(obj == rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='POSE')
    rig.data.bones.active = rig.data.bones["Head"]
    return rig, goal


def frame_the_figure():
    """The viewport from the front, close to the figure."""
    space = window_support.area().spaces.active
    space.region_3d.view_perspective = 'PERSP'
    space.region_3d.view_rotation = Vector((0.35, 1.0, -0.22)).to_track_quat('-Z', 'Y')
    space.region_3d.view_location = (0.42, -0.2, 1.12)
    space.region_3d.view_distance = 2.1
    space.shading.type = 'SOLID'
    space.shading.color_type = 'MATERIAL'
    space.overlay.show_bones = False


def test_sidebar_and_overlay():
    rig, goal = build(eyes_weight=1.0, head_weight=0.7)
    frame_the_figure()
    drawn = yield from window_support.open_tab("Motus")
    path = yield from window_support.picture("look_at_sidebar")
    assert "MOTUS_PT_look_at" in drawn, drawn
    _, _, values = window_support.pixels(path)
    assert len({round(value, 2) for value in values[0::4]}) > 20
    goal.location = (-0.4, 1.5, 1.5)
    yield
    yield from window_support.picture("look_at_beyond_the_limits")
    rig.motus.look_at.entries[0].target = None
    yield
    yield from window_support.picture("look_at_problem")
    bpy.ops.object.mode_set(mode='OBJECT')


def test_gaze_is_red_where_it_misses():
    """Beyond the limits the overlay's gaze turns red: counted in the picture, without the sidebar."""
    window_support.area().spaces.active.show_region_ui = False
    counts = []
    for target in ((0.5, -1.2, 1.45), (-0.4, 1.5, 1.5)):
        build(target)
        frame_the_figure()
        yield
        path = yield from window_support.picture(f"look_at_gaze_{len(counts)}")
        _, _, values = window_support.pixels(path)
        reds = zip(values[0::4], values[1::4], values[2::4])
        counts.append(sum(1 for red, green, blue in reds if red > 0.8 and green < 0.4 and blue < 0.45))
        bpy.ops.object.mode_set(mode='OBJECT')
    assert counts[1] > counts[0] + 50, counts


def test_constraint_properties():
    build()
    yield from properties_editor.picture_of('BONE_CONSTRAINT', "look_at_constraints")
    bpy.ops.object.mode_set(mode='OBJECT')
