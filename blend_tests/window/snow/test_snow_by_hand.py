"""Snow added by hand: it looks like snow at once, frames backwards are those forwards, and edits while it plays are seen."""

import bpy

from snow import snow_cases as cases
from window import window_support


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.context.scene.frame_set(1)
    with window_support.override():
        assert bpy.ops.motus.snow_add('INVOKE_DEFAULT') == {'FINISHED'}
    return bpy.context.object


def test_added_and_scrubbed():
    emitter = build()
    yield
    assert len(cases.flakes(emitter)["id"]) > 500
    assert emitter.location.z > bpy.context.scene.cursor.location.z
    with window_support.override():
        bpy.ops.view3d.view_axis(type='FRONT')
        bpy.ops.view3d.view_all()
    states = {}
    for frame in (*range(1, 30, 4), *range(29, 0, -4)):
        bpy.context.scene.frame_set(frame)
        yield
        assert states.setdefault(frame, cases.state(emitter)) == cases.state(emitter), frame
    yield from window_support.picture("snow")


def test_edited_while_it_plays():
    emitter = build()
    scene = bpy.context.scene
    with window_support.override():
        bpy.ops.screen.animation_play()
    start = scene.frame_current
    yield from window_support.until(lambda: scene.frame_current > start + 3)
    name = emitter.name
    for rate in (40.0, 400.0):
        bpy.data.objects[name].motus.snow.rate = rate
        frame = scene.frame_current
        yield from window_support.until(lambda before=frame: scene.frame_current != before)
    with window_support.override():
        bpy.ops.screen.animation_cancel(restore_frame=False)
    yield
    emitter = bpy.data.objects[name]
    shown = cases.state(emitter)
    scene.frame_set(scene.frame_current + 7)
    scene.frame_set(scene.frame_current - 7)
    assert cases.state(emitter) == shown
    assert len(cases.flakes(emitter)["id"]) > 2000
