"""Step 5 of the manual: the curve is dragged in Edit Mode, and follower and overlay go along before the drag is confirmed."""

import bpy
import numpy as np

import support
from window import window_support
from window.path.test_path_panel import build


def test_follows_while_it_is_dragged():
    glider, overlay, drawn = build(), support.addon("core.interface.overlay"), []
    course = bpy.data.objects["Course"]
    bpy.context.view_layer.objects.active = course
    for switch in ("control_points", "tangents", "frames", "speed"):
        setattr(bpy.context.scene.motus, f"show_{switch}", False)
    with window_support.override():
        bpy.ops.view3d.view_axis(type='TOP')
        bpy.ops.view3d.view_all()
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.curve.select_all(action='SELECT')

    def place():
        return np.array(glider.evaluated_get(bpy.context.view_layer.depsgraph).matrix_world.translation)

    def drawn_near():
        """Whether the line that was drawn last passes the follower."""
        return bool(drawn) and np.linalg.norm(drawn[-1] - place(), axis=1).min() < 0.1

    original = overlay.batches
    overlay.batches = lambda context: [drawn.append(one.points) or one for one in original(context)]
    try:
        yield
        before = start = place()
        x, y = window_support.centre()
        window_support.move(x, y)
        yield
        window_support.press('G', x, y)
        yield
        for step in (1, 2):
            window_support.move(x + 60 * step, y + 40 * step)
            went = yield from window_support.until(lambda before=before: np.linalg.norm(place() - before) > 0.2, seconds=20.0)
            assert went, (before, place())
            assert (yield from window_support.until(drawn_near, seconds=20.0)), place()
            before = place()
        assert course.data.splines[0].bezier_points[0].select_control_point
        window_support.press('ESC', x + 120, y + 80)
        yield from window_support.until(lambda: np.linalg.norm(place() - start) < 1e-4, seconds=20.0)
        np.testing.assert_allclose(place(), start, atol=1e-4)
    finally:
        overlay.batches = original
        with window_support.override():
            bpy.ops.object.mode_set(mode='OBJECT')
