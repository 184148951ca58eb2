"""Pins as an artist sees them: the list in the sidebar and among the modifiers, a broken pin, and a stroke of the sculpt brush."""

import bpy
import numpy as np

from pull.pins import pin_cases
from window import properties_editor, window_support


def build():
    """A grid with three pins, seen from above and in front."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    with window_support.override():
        grid = pin_cases.new_grid(61, 4.0)
    for x, way, name in ((-1.2, (0.0, 0.0, 0.8), "Hill"), (0.0, (0.0, 0.0, -0.5), "Hollow"), (1.2, (0.3, 0.0, 1.0), "Horn")):
        pin_cases.add(grid, pin_cases.vertex_at(grid, x, 0.0), way, radius=0.7, name=name)
    with window_support.override():
        bpy.ops.view3d.view_selected()
    return grid


def test_sidebar():
    grid = build()
    yield
    drawn = yield from window_support.open_tab("Motus")
    yield from window_support.picture("pins_sidebar")
    assert any("pins" in name for name in drawn), drawn
    grid.data.attributes.remove(grid.data.attributes["motus_pin"])
    grid.data.vertices[grid.motus.pull.pins[2].vertex].co.z += 0.1
    grid.data.update()
    yield
    yield from window_support.picture("pins_broken")


def test_modifiers():
    build()
    yield from properties_editor.picture_of('MODIFIER', "pins_modifiers")


def stroke():
    """Generator: draws with the sculpt brush across the middle of the view."""
    window, (x, y) = window_support.window(), window_support.centre()
    window_support.move(x - 60, y)
    yield
    window.event_simulate(type='LEFTMOUSE', value='PRESS', x=x - 60, y=y)
    for step in range(12):
        window_support.move(x - 60 + 10 * step, y)
        yield
    window.event_simulate(type='LEFTMOUSE', value='RELEASE', x=x + 60, y=y)


def test_a_stroke_in_sculpt_mode_is_seen_by_the_pins():
    grid = build()
    before = pin_cases.basis(grid)
    with window_support.override():
        bpy.ops.view3d.view_axis(type='TOP')
        bpy.ops.object.mode_set(mode='SCULPT')
    yield
    has_brush = bpy.context.scene.tool_settings.sculpt.brush is not None
    if has_brush:  # Debian's 4.3 comes without the assets that its brushes are
        yield from stroke()
    yield
    with window_support.override():
        bpy.ops.object.mode_set(mode='OBJECT')
    yield
    basis = pin_cases.basis(grid)
    assert not has_brush or np.abs(basis - before).max() > 1e-3, "the brush did nothing"
    wanted = basis
    for pin in grid.motus.pull.pins:
        wanted = pin_cases.pulled(wanted, pin.vertex, pin.displacement, 0.7, source=basis)
    error = np.abs(pin_cases.evaluated(grid) - wanted).max()
    assert error < 2e-6, error
