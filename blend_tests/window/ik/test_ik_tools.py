"""The tools of inverse kinematics in the window: their panel, and walks over frames with progress and Esc."""

import bpy
from mathutils import Quaternion

import support
from window import window_support

LAST = 400


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    rig = bpy.data.objects.new("Figure", bpy.data.armatures.new("Figure"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    rig.select_set(True)
    bpy.ops.object.mode_set(mode='EDIT')
    parent = None
    for name, head, tail in (("thigh", (0.0, 0.0, 2.0), (0.0, -0.2, 1.0)), ("shin", (0.0, -0.2, 1.0), (0.0, 0.0, 0.0))):
        bone = rig.data.edit_bones.new(name)
        bone.head, bone.tail, bone.parent, bone.use_connect = head, tail, parent, parent is not None
        parent = bone
    bpy.ops.object.mode_set(mode='OBJECT')
    bone = rig.pose.bones["thigh"]
    for frame, angle in ((1, 0.0), (LAST, 1.0)):
        bone.rotation_quaternion = Quaternion((1.0, 0.0, 0.0), angle)
        bone.keyframe_insert("rotation_quaternion", frame=frame)
    bpy.context.scene.frame_end = LAST
    bpy.ops.motus.ik_add(object="Figure", bone="shin", make_pole=True)
    rig.data.bones.active = rig.data.bones["shin"]
    bpy.ops.object.mode_set(mode='POSE')
    return rig


def tail(frame):
    bpy.context.scene.frame_set(frame)
    rig = bpy.data.objects["Figure"].evaluated_get(bpy.context.evaluated_depsgraph_get())
    return rig.matrix_world @ rig.pose.bones["shin"].tail


def key_count():
    target = bpy.data.objects["Figure shin Target"]
    return sum(len(curve.keyframe_points) for curve in support.addon("core.blender.actions").fcurves(target))


def run(operator, **keywords):
    with window_support.override():
        return getattr(bpy.ops.motus, operator)('INVOKE_DEFAULT', object="Figure", bone="shin", **keywords)


def test_panel():
    rig = build()
    run("ik_check", use_range=False)
    yield
    rig.motus.ik.entries["shin"].check_frames = "12-40, 77"
    rig.motus.ik.entries["shin"].check_reason = 'FAR'
    drawn = yield from window_support.open_tab("Motus")
    x, y = window_support.centre(window_support.region('UI'))
    window_support.move(x, y)
    for _ in range(12):
        window_support.press('WHEELDOWNMOUSE', x, y)
        yield
    yield from window_support.picture("ik_tools")
    assert "MOTUS_PT_ik_tools" in drawn, drawn


def test_match_runs_to_its_end():
    build()
    bpy.context.scene.frame_set(5)
    yield from asked_and_answered("ik_match_fk", 'RET', "ik_match_question")
    yield from window_support.until(lambda: key_count() and bpy.context.scene.frame_current == 5)
    assert key_count() > 3 * LAST, key_count()
    assert bpy.context.scene.frame_current == 5
    assert (tail(LAST) - tail(1)).length > 0.5


def asked_and_answered(operator, key, picture):
    """Generator: calls a job over frames, takes a picture of its question for the range, and presses a key in it."""
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    assert run(operator) == {'RUNNING_MODAL'}
    yield
    yield from window_support.picture(picture)
    window_support.press(key, x, y)
    yield


def test_it_asks_before_it_begins():
    for operator in ("ik_match_fk", "ik_check"):
        rig = build()
        bpy.context.scene.frame_set(5)
        yield from asked_and_answered(operator, 'ESC', f"{operator}_question")
        for _ in range(5):
            assert bpy.context.scene.frame_current == 5, "it has begun"
            yield
        assert key_count() == 0
        assert not rig.motus.ik.entries["shin"].check_range


def test_preview_range():
    rig = build()
    scene = bpy.context.scene
    scene.use_preview_range = True
    scene.frame_preview_start, scene.frame_preview_end = 11, 14
    yield from asked_and_answered("ik_check", 'RET', "ik_check_preview")
    yield from window_support.until(lambda: rig.motus.ik.entries["shin"].check_range)
    assert rig.motus.ik.entries["shin"].check_range == "11-14", rig.motus.ik.entries["shin"].check_range


def test_escape_leaves_nothing():
    for operator in ("ik_match_fk", "ik_check"):
        rig = build()
        bpy.context.scene.frame_set(5)
        x, y = window_support.centre()
        window_support.move(x, y)
        yield
        assert run(operator, frame_start=1, frame_end=LAST) == {'RUNNING_MODAL'}
        window_support.press('ESC', x, y)
        yield
        assert bpy.context.scene.frame_current == 5
        assert key_count() == 0
        assert not rig.motus.ik.entries["shin"].check_range
        assert not any(constraint.mute for bone in rig.pose.bones for constraint in bone.constraints)
