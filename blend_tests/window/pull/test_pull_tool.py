"""The tool in the toolbar: strokes, cursor, adjusting, the inset; in the modes."""

import bpy
import numpy as np

import support
from window import window_support
from window.pull import pull_support as pull

brush = lambda: bpy.context.scene.motus.pull  # noqa: E731


def ends(dx=60, dy=0):
    x, y = window_support.centre()
    return (x - dx, y - dy), (x + dx, y + dy)


def hover():
    """Generator: the mouse comes over the grid, and the tool reads it."""
    x, y = window_support.centre()
    for step in range(4):
        window_support.move(x + step, y + step)
        yield


def strokes_in(mode):
    pull.build(mode)
    pull.take_tool()
    yield from hover()
    flat = pull.places()
    yield from pull.drag('LEFTMOUSE', *ends())
    assert pull.pulling() is None
    one = pull.places()
    assert pull.heights().max() > 0.05
    yield from window_support.picture(f"pull_tool_{mode.lower()}")
    yield from pull.drag('RIGHTMOUSE', *ends(0, 77))
    two = pull.places()
    assert pull.heights().min() < -0.02
    for act, wanted in ((pull.undo, one), (pull.undo, flat), (pull.redo, one), (pull.redo, two), (pull.undo, one)):
        act()
        yield
        assert np.array_equal(pull.places(), wanted), act
    yield from hover()
    x, y = window_support.centre()
    aside = (x - 133, y + 119), (x - 91, y + 119)
    bottom = pull.heights().min()
    yield from pull.drag('LEFTMOUSE', *aside, ctrl=True)
    assert pull.heights().min() < min(bottom, -0.1)
    bottom = pull.heights().min()
    yield from pull.drag('LEFTMOUSE', *aside, steps=15, shift=True)
    assert pull.heights().min() > bottom
    pull.undo()
    yield
    pull.undo()
    yield
    assert np.array_equal(pull.places(), one)


def test_object_mode():
    yield from strokes_in('OBJECT')


def test_edit_mode():
    yield from strokes_in('EDIT')


def test_sculpt_mode():
    yield from strokes_in('SCULPT')


def test_mirror_images_that_cancel_each_other_out_are_told():
    pull.build()
    brush().mirror, brush().direction = {'X'}, 'X'
    pull.take_tool()
    yield from hover()
    flat = pull.places()
    modal, told = support.addon("pull.window.modal"), []
    why, modal.why_cancelled = modal.why_cancelled, lambda session: told.append(why(session)) or told[-1]
    try:
        yield from pull.drag('LEFTMOUSE', window_support.centre(), window_support.centre(), steps=1)
    finally:
        modal.why_cancelled = why
    assert np.array_equal(pull.places(), flat)
    assert len(told) == 1 and "mirror image cancel" in told[0], told
    brush().mirror, brush().direction = set(), 'NORMAL'


def test_escape_in_a_stroke():
    pull.build()
    pull.take_tool()
    yield from hover()
    flat = pull.places()
    yield from pull.drag('LEFTMOUSE', *ends(), release=False)
    assert not np.array_equal(pull.places(), flat)
    yield from pull.key('ESC')
    assert np.array_equal(pull.places(), flat)
    assert pull.pulling() is None


def test_what_is_kept_is_used_again_and_dropped_when_stale():
    pull.build()
    pull.take_tool()
    yield from hover()
    module = support.addon("pull.window.hover")
    first = module._kept.get("session")
    assert first is not None, "the mesh under the tool was not read"
    yield from pull.drag('LEFTMOUSE', *ends())
    yield from hover()
    assert module._kept.get("session") is first, "the mesh was read again though only the stroke changed it"
    top = pull.heights().max()
    # Somebody else changes the mesh.
    mesh = bpy.data.objects["Grid"].data
    for vertex in mesh.vertices:
        vertex.co.z += 1.0
    mesh.update()
    yield
    yield from hover()
    assert module._kept.get("session") is not first
    yield from pull.drag('LEFTMOUSE', *ends(0, 90))
    assert pull.heights().min() > 0.99, "the stroke went out from the old shape"
    assert pull.heights().max() > top + 0.9


def test_f_and_brackets():
    pull.build()
    pull.take_tool()
    yield from hover()
    x, y = window_support.centre()
    yield from pull.key('RIGHT_BRACKET', x, y)
    assert brush().radius > 0.8
    yield from pull.key('LEFT_BRACKET', x, y)
    assert abs(brush().radius - 0.8) < 1e-5
    yield from pull.key('F', x, y)
    window_support.move(x + 60, y)
    yield
    assert brush().radius > 0.9
    yield from pull.key('ESC', x + 60, y)
    assert abs(brush().radius - 0.8) < 1e-5
    yield from pull.key('F', x, y, shift=True)
    for one in ('PERIOD', 'FIVE'):
        yield from pull.key(one, x, y)
    yield from pull.key('RET', x, y)
    assert abs(brush().strength - 0.5) < 1e-6
    assert pull.pulling() is None
    assert pull.heights().max() == 0.0


def test_f_is_the_tools_even_where_nothing_is_read():
    """Blender's own F makes a face of what is selected."""
    pull.build('EDIT')
    pull.take_tool()
    module = support.addon("pull.window.hover")
    most, module.MOST_IN_EDIT_MODE = module.MOST_IN_EDIT_MODE, 0
    grid = bpy.data.objects["Grid"]
    with window_support.override():
        bpy.ops.mesh.select_all(action='SELECT')
        bpy.ops.mesh.delete(type='ONLY_FACE')
        bpy.ops.mesh.select_all(action='SELECT')
    yield from hover()
    assert not module._kept, "it was read"
    x, y = window_support.centre()
    yield from pull.key('F', x, y)
    window_support.move(x + 60, y)
    yield
    assert brush().radius > 0.9
    yield from pull.key('ESC', x + 60, y)
    grid.update_from_editmode()
    assert len(grid.data.polygons) == 0
    module.MOST_IN_EDIT_MODE = most


def test_inset_beside_the_sidebar():
    pull.build()
    brush().show_inset = True
    pull.take_tool()
    area = window_support.window().screen.areas
    view = next(one for one in area if one.type == 'VIEW_3D')
    view.spaces.active.show_region_ui = True
    yield from hover()
    yield from window_support.picture("pull_inset_sidebar")
    region, sidebar = (next(one for one in view.regions if one.type == kind) for kind in ('WINDOW', 'UI'))
    assert sidebar.width > 50
    x, _, width, _ = support.addon("pull.window.inset").rectangle(region, view.regions)
    assert region.x + x + width <= sidebar.x
    view.spaces.active.show_region_ui = False
    brush().show_inset = False
    yield


def test_inset_on_and_off():
    pull.build()
    bpy.ops.mesh.primitive_monkey_add(size=3.0)
    bpy.context.object.name = "Suzanne"
    brush().direction, brush().radius, brush().strength = 'NORMAL', 0.5, 0.1
    pull.take_tool()
    yield from hover()
    without = window_support.pixels((yield from window_support.picture("pull_inset_off")))[2]
    brush().show_inset = True
    yield from hover()
    with_inset = window_support.pixels((yield from window_support.picture("pull_inset_on")))[2]
    region = window_support.region()
    x, y, width, height = support.addon("pull.window.inset").rectangle(region)
    shape = (window_support.window().height, window_support.window().width, 4)
    parts = [
        np.frombuffer(picture, np.float32).reshape(shape)[region.y + y : region.y + y + height, region.x + x : region.x + x + width]
        for picture in (without, with_inset)
    ]
    assert np.abs(parts[0] - parts[1]).max(axis=2).mean() > 0.02, "the corner looks the same"
    # What is in the inset is a picture of a mesh, not one flat colour.
    assert len(np.unique(parts[1].round(2).reshape(-1, 4), axis=0)) > 30
    brush().show_inset = False
    yield from hover()
    again = window_support.pixels((yield from window_support.picture("pull_inset_off_again")))[2]
    part = np.frombuffer(again, np.float32).reshape(shape)[region.y + y : region.y + y + height, region.x + x : region.x + x + width]
    assert np.abs(part - parts[0]).mean() < 0.02


def test_the_cursor_is_drawn_on_the_surface():
    pull.build()
    pull.take_tool()
    brush().falloff = 'SMOOTH'
    x, y = window_support.centre()
    window_support.move(x + 280, y - 210)
    yield
    yield from hover()
    path = yield from window_support.picture("pull_cursor")
    width, height, values = window_support.pixels(path)
    values = np.frombuffer(values, np.float32).reshape(height, width, 4)
    part = values[y - 105 : y + 105, x - 105 : x + 105, :3]
    orange = (part[..., 0] > 0.8) & (part[..., 2] < 0.45) & (part[..., 1] > 0.35) & (part[..., 1] < 0.75)
    assert orange.sum() > 150, orange.sum()
    log = support.addon("pull.window.cursor")._failed
    assert not log, log


def test_surface_distance_shows_the_vertices():
    pull.build()
    pull.take_tool()
    brush().distance = 'SURFACE'
    yield from hover()
    yield from window_support.picture("pull_cursor_surface")
    brush().distance = 'EDGES'
    brush().radius = 5.0
    yield from hover()
    yield from window_support.picture("pull_cursor_edges")
    brush().distance = 'STRAIGHT'
    assert not support.addon("pull.window.cursor")._failed


def test_after_another_file_the_tool_works():
    pull.build()
    pull.take_tool()
    yield from hover()
    support.empty_scene()
    yield
    pull.build()
    pull.take_tool()
    yield from hover()
    assert support.addon("pull.window.hover")._kept.get("session") is not None, "no cursor after a file was opened"
    yield from pull.drag('LEFTMOUSE', *ends())
    assert pull.heights().max() > 0.05


def test_disabled_while_in_hand():
    pull.build()
    pull.take_tool()
    yield from hover()
    keymaps = lambda: sum(  # noqa: E731
        len(keymap.keymap_items)
        for config in (bpy.context.window_manager.keyconfigs.addon,)
        for keymap in config.keymaps
        if "Pick & Pull" in keymap.name
    )
    assert keymaps() > 0
    support.disable()
    yield
    assert keymaps() == 0
    with window_support.override():
        tool = bpy.context.workspace.tools.from_space_view3d_mode('OBJECT', create=False)
        assert tool.idname != "motus.pick_pull"
    window_support.move(*window_support.centre())
    yield
    support.enable()
    yield
