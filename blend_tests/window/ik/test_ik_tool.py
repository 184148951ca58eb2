"""Drag Chain in the toolbar of Pose Mode, control bones and poles by their buttons, and the question when chains are removed."""

import bpy

import support
from window import window_support
from window.ik import test_ik_drag as dragging

TOOL = "motus.ik_drag"


def take_tool():
    with window_support.override():
        bpy.ops.wm.tool_set_by_id(name=TOOL)


def drag(name, factor, dx, dy):
    """Generator: presses on a bone, moves and lets go; its value is how far from the cursor the point is then, pixels."""
    x, y = dragging.in_window(dragging.on_screen(dragging.point(name, factor)))
    window_support.move(x, y)
    yield
    dragging.button('PRESS', x, y)
    yield
    for step in (1, 2, 3, 4):
        window_support.move(x + dx * step // 4, y + dy * step // 4)
        yield
    dragging.button('RELEASE', x + dx, y + dy)
    yield
    found = dragging.in_window(dragging.on_screen(dragging.point(name, factor)))
    return max(abs(found[0] - x - dx), abs(found[1] - y - dy))


def test_one_drag_after_another():
    dragging.build()
    take_tool()
    bpy.ops.ed.undo_push(message="built")
    yield
    before = poses = [dragging.pose()]
    for name, factor, way in (("Bone 2", 0.5, (30, 20)), ("Bone 1", 0.5, (-20, 15)), ("Bone 2", 0.8, (25, -10))):
        off = yield from drag(name, factor, *way)
        assert off <= dragging.NEAR, (name, off)
        assert dragging.difference(dragging.pose(), poses[-1]) > 0.01
        poses = [*poses, dragging.pose()]
    yield from window_support.picture("ik_tool")
    for wanted in poses[-2::-1]:
        with window_support.override():
            bpy.ops.ed.undo()
        yield
        assert dragging.difference(dragging.pose(), wanted) < 1e-5, "each drag is an undo step"
    assert dragging.difference(dragging.pose(), before[0]) < 1e-5


def selected():
    rig = bpy.data.objects["Figure"]
    return {bone.name for bone in rig.pose.bones if (bone.select if hasattr(bone, "select") else bone.bone.select)}


def test_a_click_selects_and_beside_the_bones_deselects():
    rig = dragging.build()
    take_tool()
    before = dragging.pose()
    yield
    for name in ("Bone 1", "Bone 2", "Bone 0"):
        x, y = dragging.in_window(dragging.on_screen(dragging.point(name, 0.5)))
        window_support.move(x, y)
        yield
        window_support.press('LEFTMOUSE', x, y)
        yield
        assert (selected(), rig.data.bones.active.name) == ({name}, name)
    region = window_support.region()
    window_support.press('LEFTMOUSE', region.x + 120, region.y + 60)
    yield
    assert selected() == set()
    assert dragging.difference(dragging.pose(), before) == 0.0


def test_axis():
    dragging.build(with_ik=True)
    take_tool()
    yield
    start = dragging.point("Bone 2", 0.9)
    x, y = dragging.in_window(dragging.on_screen(start))
    window_support.move(x, y)
    yield
    dragging.button('PRESS', x, y)
    yield
    window_support.move(x + 28, y + 21)
    yield
    window_support.press('Z', x + 28, y + 21)
    yield
    yield from window_support.picture("ik_tool_axis")
    way = dragging.point("Bone 2", 0.9) - start
    assert abs(way.x) < 1e-3 and abs(way.y) < 1e-3 and abs(way.z) > 0.02, way
    window_support.move(x + 28, y + 42, shift=True)
    yield
    further = dragging.point("Bone 2", 0.9) - start
    assert abs(further.z / way.z - 1.1) < 0.01, "with Shift a tenth as far"
    dragging.button('PRESS', x, y, 'ESC')
    yield
    dragging.button('RELEASE', x, y)
    yield
    assert (dragging.point("Bone 2", 0.9) - start).length < 1e-5


def test_put_down_when_the_add_on_goes():
    dragging.build()
    take_tool()
    yield
    toolbar = support.addon("core.interface.view.toolbar")
    with window_support.override():
        assert toolbar.in_hand(bpy.context) == TOOL
    tool = support.addon("ik.dragging.tool")
    tool.unregister()
    try:
        with window_support.override():
            assert toolbar.in_hand(bpy.context) == "builtin.select_box"
    finally:
        tool.register()
    yield


def run(operator, **keywords):
    with window_support.override():
        return getattr(bpy.ops.motus, operator)('INVOKE_DEFAULT', **keywords)


def test_panel_and_controls():
    rig = dragging.build(with_ik=True)
    rig.data.bones.active = rig.data.bones["Bone 2"]
    bpy.ops.ed.undo_push(message="built")
    before = dragging.pose()
    yield from window_support.open_tab("Motus")
    yield from window_support.picture("ik_controls_before")
    assert run("ik_control_bone_add", object="Figure", bone="Bone 2") == {'FINISHED'}
    assert run("ik_pole_add", object="Figure", bone="Bone 2", as_bone=True) == {'FINISHED'}
    yield
    assert bpy.context.mode == 'POSE'
    assert dragging.difference(dragging.pose()[:3], before[:3]) < 1e-4
    yield from window_support.picture("ik_controls_after")
    bpy.ops.ed.undo_push(message="controls made")
    assert run("ik_remove", object="Figure") == {'RUNNING_MODAL'}
    yield
    yield from window_support.picture("ik_remove_dialog")
    x, y = window_support.centre()
    window_support.press('ESC', x, y)
    yield
    assert len(rig.motus.ik.entries) == 1
    window_support.move(x, y)
    yield
    run("ik_remove", object="Figure")
    yield
    window_support.press('RET', x, y)
    yield
    rig = bpy.data.objects["Figure"]
    assert len(rig.motus.ik.entries) == 0
    assert [bone.name for bone in rig.data.bones] == ["Bone 0", "Bone 1", "Bone 2"]
    assert "Figure Bone 2 Target" in bpy.data.objects, "that one was not the chain's any more"
    with window_support.override():
        bpy.ops.ed.undo()
    yield
    rig = bpy.data.objects["Figure"]
    assert (len(rig.motus.ik.entries), len(rig.data.bones), bpy.context.mode) == (1, 5, 'POSE')
