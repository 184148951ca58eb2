"""Many flakes that land: Blender goes on answering, says how far it is, and shows in the end what a render finds at once."""

import bpy

import support
from snow import snow_cases as cases
from window import window_support


def build(rate):
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.context.scene.frame_set(1)
    with window_support.override():
        bpy.ops.motus.snow_add(location=(0.0, 0.0, 3.0), rate=rate, lifetime=4.0, start_speed=2.0, use_ground=True, look='POINTS')
    return bpy.context.object


def test_many_are_found_bit_by_bit():
    landings = support.addon("snow.landings")
    emitter = build(25000.0)
    scene = bpy.context.scene
    scene.frame_set(200)
    seen = len(cases.flakes(emitter)["id"])
    assert 0 < seen <= landings.AT_ONCE * 256, seen
    name = emitter.name
    sentence = cases.wiring().problem(cases.system(), emitter, bpy.context.evaluated_depsgraph_get()).sentence
    assert "Flakes appear" in sentence
    shares = []

    def is_done():
        done = landings.done(bpy.data.objects[name])
        shares.append(done)
        return done is None

    yield
    assert landings.done(bpy.data.objects[name]) is not None
    yield from window_support.until(is_done)
    yield
    found = [one for one in shares if one is not None]
    assert found == sorted(found) and all(0.0 < one < 1.0 for one in found), found
    emitter = bpy.data.objects[name]
    shown = cases.state(emitter)
    assert len(cases.flakes(emitter)["id"]) == 100000
    assert cases.wiring().problem(cases.system(), emitter, bpy.context.evaluated_depsgraph_get()) is None
    # What a Blender without a window finds.
    snow = cases.native().Snow(
        rate=25000.0,
        lifetime=4.0,
        start_speed=2.0,
        ground=0.0,
        start_size=0.025,
        emitter_times=[0.0],
        emitter_matrices=[[list(row) for row in emitter.matrix_world]],
    )
    expected = snow.evaluate(cases.seconds(200))
    assert (cases.flakes(emitter)["position"] == expected["position"]).all()
    scene.frame_set(210)
    scene.frame_set(200)
    assert cases.state(emitter) == shown


def test_few_are_there_at_once():
    emitter = build(500.0)
    bpy.context.scene.frame_set(200)
    assert len(cases.flakes(emitter)["id"]) == 2000
    yield
    assert support.addon("snow.landings").done(emitter) is None
