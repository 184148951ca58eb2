"""What every system shares in the interface, as an artist sees it: menus, the redo panel, what is baked, and a narrow sidebar."""

import bpy
import support
from window import window_support

TOOLTIP = 1.5
"""Seconds after which Blender surely shows the tooltip of what is under the mouse."""
JOINTS = ((0.0, 0.0, 2.0), (0.0, -0.2, 1.0), (0.0, 0.0, 0.0))


def build():
    """A curve and an object that follows it, and a rig with one chain."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    data = bpy.data.curves.new("Course", 'CURVE')
    data.dimensions = '3D'
    spline = data.splines.new('POLY')
    spline.points.add(1)
    spline.points[1].co = (4.0, 1.0, 1.0, 1.0)
    glider, course = bpy.data.objects.new("Glider", None), bpy.data.objects.new("Course", data)
    rig = bpy.data.objects.new("Figure", bpy.data.armatures.new("Figure"))
    for obj in (course, glider, rig):
        bpy.context.scene.collection.objects.link(obj)
    choose(rig)
    bpy.ops.object.mode_set(mode='EDIT')
    parent = None
    for name, head, tail in zip(("thigh", "shin"), JOINTS, JOINTS[1:]):
        bone = rig.data.edit_bones.new(name)
        bone.head, bone.tail, bone.parent, bone.use_connect = head, tail, parent, parent is not None
        parent = bone
    rig.data.edit_bones.active = parent
    bpy.ops.object.mode_set(mode='OBJECT')
    return glider, course, rig


def choose(*objects):
    for obj in bpy.context.scene.objects:
        obj.select_set(obj in objects)
    bpy.context.view_layer.objects.active = objects[0] if objects else None


def menu(kind, picture):
    """Generator: opens a menu of Motus, and takes a picture of it."""
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    with window_support.override():
        bpy.ops.wm.call_menu(name=f"MOTUS_MT_{kind}")
    yield
    for step in range(3):
        window_support.move(x - step, y)
        yield
    yield TOOLTIP
    yield from window_support.picture(picture)
    window_support.press('ESC', x, y)
    yield


def test_menus():
    """Grouped by system; what the selection cannot have is grey, and the tooltip says why."""
    glider, _, rig = build()
    for kind in ("add", "object"):
        choose(glider)
        yield from menu(kind, f"menu_{kind}")
    choose(rig)
    bpy.ops.object.mode_set(mode='POSE')
    yield from menu("pose", "menu_pose")
    bpy.ops.object.mode_set(mode='OBJECT')


def redo(picture):
    """Generator: opens the panel Adjust Last Operation under the mouse, and takes a picture of it."""
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    with window_support.override():
        bpy.ops.screen.redo_last('INVOKE_DEFAULT')
    yield
    yield from window_support.picture(picture)
    window_support.press('ESC', x, y)
    yield


def test_redo_panel():
    glider, course, rig = build()
    for name, objects, keywords in (
            ("path_follow_add", (glider, course), {"orientation": 'BANKING'}), ("ik_add", (rig,), {"make_pole": True}),
            ("look_at_add", (rig,), {"bone": "shin"}), ("grid_add", (), {})):
        choose(*objects)
        with window_support.override():
            assert getattr(bpy.ops.motus, name)('INVOKE_DEFAULT', True, **keywords) == {'FINISHED'}
        yield
        yield from redo(f"redo_{name}")
        bpy.ops.motus.ik_remove(object=rig.name) if name == "ik_add" else None


def baked_follower():
    glider, course, _ = build()
    bpy.ops.motus.path_follow_add(object=glider.name, curve=course.name)
    choose(glider)
    bpy.ops.motus.bake(object=glider.name, frame_start=1, frame_end=50)
    return glider


def test_baked():
    baked_follower()
    drawn = yield from window_support.open_tab("Motus")
    path = yield from window_support.picture("baked_sidebar")
    assert "MOTUS_PT_path" in drawn and "MOTUS_PT_path_readouts" not in drawn, drawn
    assert path.exists()
    bpy.ops.motus.unbake(object="Glider")
    window_support.draw_all()
    yield
    yield from window_support.until(lambda: "MOTUS_PT_path_readouts" in drawn)
    assert "MOTUS_PT_path_readouts" in drawn, drawn


def drag(start, end):
    """Generator: drags with the left button from one place of the window to another."""
    window, ((x, y), (to_x, to_y)) = window_support.window(), (start, end)
    window_support.move(x, y)
    yield
    window.event_simulate(type='LEFTMOUSE', value='PRESS', x=x, y=y)
    yield
    for step in range(1, 13):
        share = step / 12
        window_support.move(round(x + share * (to_x - x)), round(y + share * (to_y - y)))
        yield
    window.event_simulate(type='LEFTMOUSE', value='RELEASE', x=to_x, y=to_y)
    yield


def widen(sidebar, by):
    """Generator: drags the sidebar's edge so that it becomes wider by some pixels, or narrower where these are negative."""
    before, x, y = sidebar.width, sidebar.x, sidebar.y + sidebar.height // 2
    for beside in (0, 3, 6, -3, -6):  # where the edge can be taken hold of is not the same in all Blenders
        if sidebar.width == before:
            yield from drag((x + beside, y), (x + beside - by, y))


def test_narrow_sidebar():
    """A rig's systems, what an object can be given, and the overlay's switches, in a sidebar that was made narrow."""
    glider, _, rig = build()
    bpy.ops.motus.ik_add(object=rig.name, bone="shin", make_pole=True)
    choose(rig)
    with window_support.drawn_settings([support.addon("core.panels").MOTUS_PT_overlay]) as drawn:
        yield from window_support.open_tab("Motus")
        sidebar = window_support.region('UI')
        before = sidebar.width
        yield from widen(sidebar, -75)
        yield from window_support.picture("narrow_sidebar")
        width = sidebar.width
        choose(glider)
        window_support.draw_all()
        yield from window_support.picture("narrow_sidebar_add")
        yield from widen(sidebar, before - width)
    assert width < before - 40 and abs(sidebar.width - before) < 10, (before, width, sidebar.width)
    wanted = {"show_path", "show_curve", "show_ik", "show_reach", "show_look_at"}
    assert wanted <= drawn["MOTUS_PT_overlay"], drawn
