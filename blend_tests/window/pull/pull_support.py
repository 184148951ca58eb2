"""What the window tests of Pick & Pull share: a grid seen from above, the mouse's ways, and the heights."""

import bpy
import numpy as np

import support
from window import window_support

SIDE = 41
SIZE = 4.0


def build(mode='OBJECT', side=SIDE):
    """A flat grid, seen from straight above, active, in that mode; the brush at known values."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=side - 1, y_subdivisions=side - 1, size=SIZE)
    bpy.context.object.name = "Grid"
    brush = bpy.context.scene.motus.pull
    brush.radius, brush.strength, brush.direction, brush.accumulate = 0.8, 0.1, 'Z', True
    brush.show_inset = False
    with window_support.override():
        bpy.ops.object.mode_set(mode=mode)
        bpy.ops.view3d.view_axis(type='TOP')
        bpy.ops.view3d.view_all()
    bpy.ops.ed.undo_push(message="built")


def heights():
    """Heights of the grid's vertices, whatever the mode."""
    grid = bpy.data.objects["Grid"]
    if grid.mode == 'EDIT':
        grid.update_from_editmode()
    values = np.empty(3 * len(grid.data.vertices), np.float32)
    grid.data.vertices.foreach_get("co", values)
    return values[2::3].copy()


def places():
    """All coordinates, as they are stored."""
    grid = bpy.data.objects["Grid"]
    if grid.mode == 'EDIT':
        grid.update_from_editmode()
    values = np.empty(3 * len(grid.data.vertices), np.float32)
    grid.data.vertices.foreach_get("co", values)
    return values


def evaluated_top():
    """The highest vertex of what Blender shows."""
    evaluated = bpy.data.objects["Grid"].evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    values = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", values)
    evaluated.to_mesh_clear()
    return float(values[2::3].max())


def simulate(kind, value, x, y, **modifiers):
    window_support.window().event_simulate(type=kind, value=value, x=x, y=y, **modifiers)


def key(kind, x=None, y=None, **modifiers):
    """Generator: presses a key over the viewport."""
    if x is None:
        x, y = window_support.centre()
    window_support.press(kind, x, y, **modifiers)
    yield


def drag(button, start, end, steps=6, release=True, **modifiers):
    """Generator: presses a button at a place and moves to another."""
    window_support.move(*start)
    yield
    simulate(button, 'PRESS', *start, **modifiers)
    yield
    for step in range(1, steps + 1):
        x, y = (round(one + (other - one) * step / steps) for one, other in zip(start, end))
        simulate('MOUSEMOVE', 'NOTHING', x, y, **modifiers)
        yield 0.0
    if release:
        simulate(button, 'RELEASE', *end, **modifiers)
        yield


def session(**keywords):
    """Generator: starts the operator as the menu does."""
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    with window_support.override():
        assert bpy.ops.motus.pick_pull('INVOKE_DEFAULT', **keywords) == {'RUNNING_MODAL'}
    yield


def undo():
    with window_support.override():
        bpy.ops.ed.undo()


def redo():
    with window_support.override():
        bpy.ops.ed.redo()


def undo_and_redo(before, after):
    """Generator: one undo takes back what was done, and redo brings it again."""
    for act, wanted in ((undo, before), (redo, after)):
        act()
        yield
        assert np.array_equal(places(), wanted), act


def take_tool():
    with window_support.override():
        bpy.ops.wm.tool_set_by_id(name="motus.pick_pull")


def pulling():
    """What runs, or None."""
    return support.addon("pull.window.stage").current()
