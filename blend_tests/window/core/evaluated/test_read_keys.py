"""Keys that are edited by hand: what hangs on them at other frames follows while they are dragged, and once they are inserted or deleted."""

import bpy
import numpy as np

import support
from dynamics import dynamics_cases as cases
from window import window_support

actions = support.addon("core.blender.actions")
FRAME = 25


def build():
    """A ball that follows its keys late, as seen on a frame behind the first of them."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    ball = cases.moved()
    bpy.ops.motus.dynamics_add(object=ball.name, style='BOUNCY')
    bpy.context.view_layer.objects.active = ball
    ball.select_set(True)
    bpy.context.scene.frame_set(FRAME)
    return ball


def place(ball):
    return np.array(ball.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world)[:3, 3]


def place_when_come_back(ball):
    for frame in (FRAME + 30, FRAME):
        bpy.context.scene.frame_set(frame)
    return place(ball)


def test_inserted_and_deleted_in_the_viewport():
    ball = build()
    yield
    with window_support.override():
        bpy.ops.anim.keyframe_insert_by_name(type="Location")
    yield
    assert np.array_equal(place(ball), place_when_come_back(ball))
    before = place(ball)
    ball.keyframe_delete("location", frame=min(curve.range()[0] for curve in actions.fcurves(ball)))
    yield
    now = place(ball)
    assert np.array_equal(now, place_when_come_back(ball)), (now, place(ball))
    bpy.context.view_layer.update()
    with window_support.override():
        bpy.ops.anim.keyframe_clear_v3d()
    yield
    now = place(ball)
    assert np.array_equal(now, place_when_come_back(ball)), (now, place(ball))
    assert not np.array_equal(now, before)


def test_dragged_in_the_graph_editor():
    ball = build()
    area = window_support.area()
    area.type = 'GRAPH_EDITOR'
    try:
        yield
        for curve in actions.fcurves(ball):
            curve.select = True
            for index, key in enumerate(curve.keyframe_points):
                key.select_control_point = key.select_left_handle = key.select_right_handle = index == 0
        yield
        x, y = window_support.centre(window_support.region(of='GRAPH_EDITOR'))
        window_support.move(x, y)
        yield
        seen = [place(ball)]
        window_support.press('G', x, y)
        yield
        for step in (40, 80):
            window_support.move(x, y + step)
            yield
            yield
            seen.append(place(ball))
        window_support.press('LEFTMOUSE', x, y + 80)
        yield
        yield
        assert not np.array_equal(seen[0], seen[1]) and not np.array_equal(seen[1], seen[2]), seen
        now = place(ball)
        assert np.array_equal(now, place_when_come_back(ball)), (now, place(ball))
        with bpy.context.temp_override(window=window_support.window(), area=area, region=window_support.region(of='GRAPH_EDITOR')):
            bpy.ops.graph.delete()
        yield
        now = place(ball)
        assert np.array_equal(now, place_when_come_back(ball)), (now, place(ball))
    finally:
        area.type = 'VIEW_3D'
    yield
