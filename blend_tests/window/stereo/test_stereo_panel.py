"""A stereo rig as an artist sees it: the planes in the viewport, the panel, and a warning that is read there."""

import bpy
import numpy as np

import support
from stereo import stereo_cases as cases
from window import window_support

LABELS, MARGIN = 0.4, 45.0
"""Of a panel's width, where labels stand beside their fields; what of a region's width is none of that, at a scale of 1."""
WIDE = 240.0
"""Of a sidebar as it is opened by a newer Blender; in 3.4 it is narrower."""
SHOWN = (
    "convergence",
    "interocular",
    "distance",
    "near",
    "far",
    "near_parallax",
    "far_parallax",
    "screen",
    "screen_width",
    "screen_distance",
    "eye_separation",
    "window_left",
    "window_right",
    "influence",
)


def build(**keywords):
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    camera = cases.camera()
    camera.select_set(True)
    cases.square("Wall", (0.0, 12.0, 0.0), 30.0)
    bpy.ops.motus.stereo_rig_add(object=camera.name, **keywords)
    with window_support.override():
        bpy.ops.view3d.view_axis(type='TOP')
        bpy.ops.view3d.view_all()
    return camera


def test_planes_are_drawn():
    build(interocular=0.1, distance=3.0, screen='CINEMA')
    seen = []
    for is_shown in (True, False):
        bpy.context.scene.motus.show_stereo = is_shown
        window_support.draw_all()
        yield
        path = yield from window_support.picture(f"stereo_planes_{'on' if is_shown else 'off'}")
        seen.append(np.array(window_support.pixels(path)[2]))
    bpy.context.scene.motus.show_stereo = True
    assert (np.abs(seen[0] - seen[1]) > 0.1).sum() > 200


def test_a_warning_is_read():
    camera = build(interocular=0.3, distance=3.0, screen='CINEMA')
    drawn = yield from window_support.open_tab("Motus")
    assert "MOTUS_PT_stereo" in drawn and "MOTUS_PT_stereo_readouts" in drawn, drawn
    bpy.ops.motus.stereo_check(object=camera.name, range='CURRENT')
    window_support.draw_all()
    yield
    yield from window_support.picture("stereo_warning")
    (sentence,) = support.addon("stereo.results").of(camera).sentences
    assert sentence.startswith("Diverges on a 12 m screen by"), sentence


def test_the_graphs_of_a_shot_are_drawn():
    camera = build(convergence='BUDGET', near=2.0, far=12.0, screen='CINEMA')
    for frame, parallax in ((1, 0.1), (20, 1.5)):
        camera.motus.stereo.far_parallax = parallax
        camera.keyframe_insert("motus.stereo.far_parallax", frame=frame)
    bpy.ops.motus.stereo_check(object=camera.name, frame_start=1, frame_end=20)
    result = support.addon("stereo.results").of(camera)
    assert 0 < result.is_faulty.sum() < 20, result.is_faulty
    yield from window_support.open_tab("Motus")
    window_support.draw_all()
    yield
    yield from window_support.picture("stereo_graphs")
    graph = support.addon("core.interface.view.graph")
    assert {"stereo", "stereo_parallax", "stereo_convergence"} <= set(graph._graphs[0].keys())
    pixels = np.array(graph._graphs[0]["stereo_parallax"].image_pixels_float).reshape(graph.HEIGHT, graph.WIDTH, 4)
    is_red = np.abs(pixels[2] - graph.FLAG).max(axis=1) < 0.01
    assert is_red.any() and not is_red.all()
    assert is_red[-1] and not is_red[0]


def test_the_ruler_shows_what_is_selected():
    build(interocular=0.1, distance=3.0, screen='CINEMA')
    things = [cases.square(f"Thing {index}", place, 0.3) for index, place in enumerate(((0.6, 3.05, 0.0), (-0.8, 5.0, 0.0)))]
    seen = []
    for is_selected in (True, False):
        for thing in things:
            thing.select_set(is_selected)
        window_support.draw_all()
        yield
        path = yield from window_support.picture(f"stereo_ruler_{'on' if is_selected else 'off'}")
        seen.append(np.array(window_support.pixels(path)[2]))
    assert (np.abs(seen[0] - seen[1]) > 0.1).sum() > 50


def test_labels_fit_beside_their_fields():
    camera = build(interocular=0.1, distance=3.0, screen='CUSTOM')
    labels = support.addon("stereo.properties").MOTUS_PG_stereo.bl_rna.properties
    shown = [labels[name].name for name in SHOWN]
    yield from window_support.open_tab("Motus")
    camera.motus.stereo.convergence = 'BUDGET'
    window_support.draw_all()
    yield
    yield from window_support.picture("stereo_budget")
    width, scale = window_support.region('UI').width, bpy.context.preferences.system.ui_scale
    if width < WIDE * scale:  # there Blender clips its own labels too
        return
    room = LABELS * (width - MARGIN * scale)
    clipped = {label: width for label in shown if (width := window_support.text_width(label)) > room}
    assert not clipped, (clipped, room)
