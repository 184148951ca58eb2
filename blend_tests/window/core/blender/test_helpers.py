"""Helpers in a window: pasted ones are out of the scene at once, and a deleted owner takes its own with it."""

import bpy

from window import window_support
from window.path.test_path_panel import build


def helpers():
    return [obj for obj in bpy.data.objects if "motus_helper" in obj]


def test_pasted_and_deleted():
    glider = build()
    yield
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj == glider)
    with window_support.override():
        bpy.ops.view3d.copybuffer()
        bpy.ops.view3d.pastebuffer(autoselect=True)
    pasted = yield from window_support.until(
        lambda: "Glider.001" in bpy.data.objects and all(not obj.users_collection for obj in helpers()), seconds=20.0
    )
    assert pasted, [(obj.name, obj.users_collection) for obj in helpers()]
    assert not [obj.name for obj in bpy.context.view_layer.objects if obj.name.startswith(".")]
    for obj in bpy.context.view_layer.objects:
        obj.select_set(True)
    with window_support.override():
        bpy.ops.object.delete()
    gone = yield from window_support.until(lambda: not helpers(), seconds=20.0)
    assert gone, [obj.name for obj in bpy.data.objects]
