"""Snow that lies, added by hand on what is selected: frames backwards are those forwards; work that takes long is asked for."""

from unittest import mock

import bpy
import support
from window import window_support

from snow import cover_cases as cases


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    cases.forget_work()
    bpy.context.scene.frame_set(1)
    with window_support.override():
        bpy.ops.mesh.primitive_plane_add(size=8.0)
        meadow = bpy.context.object
        assert bpy.ops.motus.snow_add('INVOKE_DEFAULT') == {'FINISHED'}
        emitter = bpy.context.object
        emitter.select_set(False)
        meadow.select_set(True)
        bpy.context.view_layer.objects.active = meadow
        assert bpy.ops.motus.snow_cover_add('INVOKE_DEFAULT') == {'FINISHED'}
    return bpy.context.object, emitter


def test_added_and_scrubbed():
    cover, emitter = build()
    yield
    assert [entry.object for entry in cover.motus.snow_cover.emitters] == [emitter]
    with window_support.override():
        bpy.ops.view3d.view_axis(type='FRONT')
        bpy.ops.view3d.view_all()
    states = {}
    for frame in (*range(1, 200, 30), *range(181, 0, -30)):
        bpy.context.scene.frame_set(frame)
        yield
        assert states.setdefault(frame, cases.state(cover)) == cases.state(cover), frame
    assert len(set(states.values())) == len(states)
    emitter.motus.snow.rate *= 2.0
    yield
    assert cases.state(cover) != states[1]
    yield from window_support.picture("snow_cover")


def test_work_is_asked_for():
    cover, _ = build()
    work = support.addon("snow.cover.work")
    with mock.patch.object(work, "LONG", 0.0):
        cover.motus.snow_cover.lump = 0.2
        bpy.context.scene.frame_set(100)
        yield
        assert len(cases.layer(cover)[0]) == 0
        assert work.asked(cover.name) is not None
        with window_support.override():
            assert bpy.ops.motus.snow_cover_work_out('INVOKE_DEFAULT', object=cover.name) == {'RUNNING_MODAL'}
        yield from window_support.until(lambda: len(cases.layer(cover)[0]) > 0)
        assert work.asked(cover.name) is None
