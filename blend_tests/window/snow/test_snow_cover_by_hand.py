"""Snow that lies, added by hand on what is selected: frames backwards are those forwards; work that takes long is asked for."""

from unittest import mock

import bpy

import support
from snow import cover_cases as cases
from window import window_support


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
        work._done.clear()
        cover.motus.snow_cover.lump = 0.2
        bpy.context.scene.frame_set(100)
        yield
        assert len(cases.layer(cover)[0]) == 0
        assert work.asked(cover.name) is not None
        yield from window_support.open_tab("Motus")
        yield from settled()
        before = window_support.screen()
        with window_support.override():
            assert bpy.ops.motus.snow_cover_work_out('INVOKE_DEFAULT', object=cover.name) == {'RUNNING_MODAL'}
        name = cover.name
        # Nothing here has Blender evaluate or draw: what shows is what the job itself has left.
        assert (yield from window_support.until(lambda: work.asked(name) is None))
        for _ in range(3):
            yield
        after = window_support.screen()
        yield from settled()
        wanted = window_support.screen()
        assert shown(before, wanted, VIEW) > 0.01 and shown(before, wanted, SIDEBAR) > 0.01
        assert shown(after, wanted, VIEW) == 0.0 and shown(after, wanted, SIDEBAR) == 0.0
        assert len(cases.layer(bpy.data.objects[name])[0]) > 0


VIEW, SIDEBAR = 'WINDOW', 'UI'


def settled():
    """Generator: all is drawn as it is."""
    for _ in range(2):
        window_support.draw_all()
        yield


def shown(one, other, kind):
    """Which share of a region of the 3D viewport differs in two screens."""
    region = window_support.region(kind)
    height = one.shape[0]
    rows = slice(height - region.y - region.height, height - region.y)
    columns = slice(region.x, region.x + region.width)
    return float((one[rows, columns] != other[rows, columns]).any(axis=2).mean())
