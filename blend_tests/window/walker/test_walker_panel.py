"""Walkers as an artist sees them: a spider from the Add menu, its panel, an edit while the scene plays, feet that find no ground, the overlay."""

from unittest import mock

import bpy
import numpy as np
from mathutils import Vector

import support
from walker import walker_cases as cases
from window import properties_editor, window_support


def clear():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.context.scene.frame_set(1)


def look(place=(0.0, 0.4, 0.1), distance=3.4):
    space = window_support.area().spaces.active
    space.region_3d.view_perspective = 'PERSP'
    space.region_3d.view_rotation = Vector((0.8, 1.0, -0.7)).to_track_quat('-Z', 'Y')
    space.region_3d.view_location, space.region_3d.view_distance = place, distance
    space.shading.type = 'SOLID'
    space.shading.color_type = 'MATERIAL'


def add(**keywords):
    with window_support.override():
        assert bpy.ops.motus.spider_add('INVOKE_DEFAULT', location=(0.0, 0.0, 0.0), **keywords) == {'FINISHED'}
    return bpy.context.object


def test_a_spider_is_added_and_has_a_panel():
    clear()
    look()
    spider = add()
    assert spider.select_get() and spider.motus.walker.is_active
    support.key_places(spider, {1: (0.0, 0.0, 0.0), 60: (0.0, 1.5, 0.0)})
    bpy.context.scene.frame_set(30)
    drawn = yield from window_support.open_tab("Motus")
    path = yield from window_support.picture("walker_sidebar")
    assert "MOTUS_PT_walker" in drawn, drawn
    _, _, values = window_support.pixels(path)
    assert len({round(value, 2) for value in values[0::4]}) > 20


def test_a_setting_is_changed_while_it_plays():
    clear()
    look()
    spider = add()
    support.key_places(spider, {1: (0.0, 0.0, 0.0), 250: (0.0, 4.0, 0.0)})
    bpy.context.scene.frame_end = 250
    with window_support.override():
        bpy.ops.screen.animation_play()
    started = yield from window_support.until(lambda: bpy.context.scene.frame_current > 5)
    assert started
    spider.motus.walker.gait = 'WAVE'
    spider.motus.walker.clearance = 0.2
    reached = bpy.context.scene.frame_current + 5
    went_on = yield from window_support.until(lambda: bpy.context.scene.frame_current > reached)
    with window_support.override():
        bpy.ops.screen.animation_cancel(restore_frame=False)
    yield
    assert went_on
    frame = bpy.context.scene.frame_current
    walker = cases.plan_of(spider).walker
    np.testing.assert_allclose(cases.places(spider), walker.feet(cases.seconds(frame)), atol=2e-6)
    assert walker.swing(cases.seconds(np.arange(20, 240))).astype(bool).sum(axis=1).max() <= 2, "the wave has one leg up, or two"


def test_feet_that_find_no_ground_are_told():
    clear()
    look()
    land = cases.grid("Land", lambda x, y: np.where(y > 0.6, -9.0, 0.0), half=2.0, count=41)
    spider = add()
    spider.motus.walker.ground = land
    support.key_places(spider, {1: (0.0, 0.0, 0.0), 60: (0.0, 1.2, 0.0)})
    bpy.context.scene.frame_set(60)
    told, shown = support.addon("walker.told"), []
    sentence = told.sentence

    def noting(*arguments):
        shown.append(sentence(*arguments))
        return shown[-1]

    with mock.patch.object(told, "sentence", noting):
        yield from window_support.open_tab("Motus")
        yield from window_support.picture("walker_unreached")
    assert shown and all("finds no ground within reach on frames" in one for one in shown), shown


def test_footholds_are_drawn():
    """Blue on the left and orange on the right: counted in the picture, without the sidebar."""
    window_support.area().spaces.active.show_region_ui = False
    shown, counts = bpy.context.scene.motus, []
    for is_shown in (True, False):
        clear()
        look()
        spider = add(color=(0.3, 0.3, 0.3, 1.0))
        support.key_places(spider, {1: (0.0, 0.0, 0.0), 60: (0.0, 1.5, 0.0)})
        bpy.context.scene.frame_set(30)
        shown.show_walker_footholds = is_shown
        yield
        path = yield from window_support.picture(f"walker_footholds_{len(counts)}")
        _, _, values = window_support.pixels(path)
        colors = list(zip(values[0::4], values[1::4], values[2::4]))
        counts.append(
            (
                sum(1 for red, green, blue in colors if blue > 0.7 and green > 0.5 and red < 0.55),
                sum(1 for red, green, blue in colors if red > 0.75 and 0.4 < green < 0.8 and blue < 0.5),
            )
        )
    shown.show_walker_footholds = True
    assert all(with_them > without + 100 for with_them, without in zip(*counts)), counts


def test_object_properties():
    clear()
    add()
    panels = [panel for panel in support.addon("walker.panel").classes if panel.__name__.startswith("MOTUS_PT_walker_constraint")]
    with window_support.drawn_settings(panels) as drawn:
        yield from properties_editor.picture_of('CONSTRAINT', "walker_properties")
    assert {"gait", "stride", "cadence"} <= drawn["MOTUS_PT_walker_constraint"], drawn
    assert {"ground", "grounds", "use_plane"} <= drawn["MOTUS_PT_walker_constraint_ground"], drawn
