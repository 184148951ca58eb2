"""Animation layers as an artist sees them: adding one in Pose Mode by its button, sidebar, armature properties, and the overlay."""

import bpy
from mathutils import Vector

import support
from layers import layer_cases
from look_at import look_at_cases
from window import properties_editor, window_support


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    rig = look_at_cases.build_rig(name="Puppet")
    layer_cases.turning("Throw", layer_cases.THROWING)
    for obj in bpy.context.scene.objects:
        obj.select_set(obj == rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='POSE')
    for bone in rig.pose.bones:
        (bone if hasattr(bone, "select") else bone.bone).select = bone.name == "Chest"
    rig.data.bones.active = rig.data.bones["Chest"]
    return rig


def frame_the_figure():
    space = window_support.area().spaces.active
    space.region_3d.view_perspective = 'PERSP'
    space.region_3d.view_rotation = Vector((0.5, 1.0, -0.25)).to_track_quat('-Z', 'Y')
    space.region_3d.view_location = (0.35, 0.0, 0.95)
    space.region_3d.view_distance = 3.2
    space.shading.type = 'SOLID'


def test_adding_by_the_button_and_the_panels():
    rig = build()
    frame_the_figure()
    drawn = yield from window_support.open_tab("Motus")
    assert "MOTUS_PT_layers" not in drawn, drawn
    with window_support.override():
        assert bpy.ops.motus.layer_add('INVOKE_DEFAULT', action="Throw", after='HOLD', feather=1) == {'FINISHED'}
    yield
    (entry,) = rig.motus.layers.entries
    assert [item.name for item in entry.mask] == ["Chest"]
    bpy.context.scene.frame_set(15)
    drawn = yield from window_support.open_tab("Motus")
    path = yield from window_support.picture("layers_sidebar")
    assert "MOTUS_PT_layers" in drawn, drawn
    _, _, values = window_support.pixels(path)
    assert len({round(value, 2) for value in values[0::4]}) > 20
    entry.action = None
    yield
    yield from window_support.picture("layers_without_action")
    bpy.ops.object.mode_set(mode='OBJECT')


def test_armature_properties():
    rig = build()
    bpy.ops.motus.layer_add(object=rig.name, action="Throw", bones="Chest", mode='ADDITIVE')
    yield from properties_editor.picture_of('DATA', "layers_properties")
    bpy.ops.object.mode_set(mode='OBJECT')


def test_the_mask_is_drawn():
    """The outlines of the mask are orange where all of the layer counts: counted in the picture, without the sidebar."""
    window_support.area().spaces.active.show_region_ui = False
    counts = []
    for muted in (False, True):
        rig = build()
        bpy.ops.motus.layer_add(object=rig.name, action="Throw", bones="Chest", after='HOLD')
        rig.motus.layers.entries[0].is_muted = muted
        frame_the_figure()
        yield
        path = yield from window_support.picture(f"layers_mask_{len(counts)}")
        _, _, values = window_support.pixels(path)
        colors = zip(values[0::4], values[1::4], values[2::4])
        counts.append(sum(1 for red, green, blue in colors if red > 0.7 and 0.3 < green < 0.75 and blue < 0.35))
        bpy.ops.object.mode_set(mode='OBJECT')
    assert counts[0] > counts[1] + 200, counts


def test_the_key_of_the_keyboard_goes_into_the_layer():
    rig = build()
    walk = layer_cases.turning("Walk", layer_cases.WALKING)
    layer_cases.play(rig, walk)
    bpy.ops.motus.layer_add(object=rig.name, action="Throw", bones="Chest", weight=0.5, start=3.0)
    scene = bpy.context.scene
    scene.keying_sets_all.active = next(one for one in scene.keying_sets_all if one.bl_idname == "Rotation")
    frame_the_figure()
    yield
    with window_support.override():
        assert bpy.ops.motus.layer_edit('INVOKE_DEFAULT') == {'FINISHED'}
    scene.frame_set(9)
    yield
    rig.pose.bones["Chest"].rotation_quaternion = (0.8, 0.0, 0.6, 0.0)
    yield
    before = rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones["Chest"].matrix.copy()
    x, y = window_support.centre()
    window_support.move(x, y)
    window_support.press('I', x, y)
    assert (yield from window_support.until(lambda: 7.0 in frames_of("Throw", "Chest"))), frames_of("Throw", "Chest")
    assert 9.0 not in frames_of("Walk", "Chest"), frames_of("Walk", "Chest")
    drawn = yield from window_support.open_tab("Motus")
    assert "MOTUS_PT_layers" in drawn, drawn
    yield from window_support.picture("layers_edited")
    with window_support.override():
        assert bpy.ops.motus.layer_edit('INVOKE_DEFAULT') == {'FINISHED'}
    assert rig.animation_data.action == walk
    scene.frame_set(4)
    scene.frame_set(9)
    after = rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones["Chest"].matrix
    assert max(abs(a - b) for one, other in zip(before, after) for a, b in zip(one, other)) < 1e-5, (before, after)
    bpy.ops.object.mode_set(mode='OBJECT')


def frames_of(name, bone):
    """Frames of the keys that an action has for a bone."""
    curves = [curve for some in support.addon("core.blender.actions").all_fcurves(bpy.data.actions[name]) for curve in some]
    return {point.co.x for curve in curves if f'"{bone}"' in curve.data_path for point in curve.keyframe_points}
