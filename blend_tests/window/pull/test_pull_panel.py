"""The panel of Pick & Pull and the tool's settings in the header."""

import bpy

import support
from window import window_support
from window.pull import pull_support as pull


def test_panel():
    pull.build()
    brush = bpy.context.scene.motus.pull
    brush.falloff = 'CURVE'
    panels = [cls for cls in support.addon("pull.panel").classes if issubclass(cls, bpy.types.Panel)]
    with window_support.drawn_settings(panels) as drawn:
        yield from window_support.open_tab("Motus")
        window_support.draw_all()
        yield from window_support.picture("pull_panel_curve")
        brush.falloff = 'CLASSIC'
        bpy.context.object.vertex_groups.new(name="Group")
        window_support.draw_all()
        yield from window_support.picture("pull_panel_classic")
        assert {"radius", "strength", "falloff", "scale_factor"} <= drawn["MOTUS_PT_pull"], drawn
        assert drawn["MOTUS_PT_pull_extent"] == {"mirror", "vertex_group"}, drawn
        brush.falloff, brush.distance = 'SMOOTH', 'EDGES'
        brush.edge_count = 4
        assert brush.radius == 4.0
        window_support.draw_all()
        yield from window_support.picture("pull_panel_edges")
    brush.distance, brush.radius = 'STRAIGHT', 1.0


def test_header_of_the_tool():
    pull.build()
    pull.take_tool()
    window_support.area().spaces.active.show_region_tool_header = True
    window_support.area().spaces.active.show_region_toolbar = True
    yield
    yield from window_support.picture("pull_header")
    brush = bpy.context.scene.motus.pull
    brush.distance, brush.radius = 'EDGES', 5.0
    window_support.draw_all()
    yield from window_support.picture("pull_header_edges")
    brush.distance, brush.radius = 'STRAIGHT', 1.0


def test_panel_says_why_not():
    pull.build()
    bpy.ops.object.modifier_add(type='MULTIRES')
    yield from window_support.open_tab("Motus")
    yield from window_support.picture("pull_problem")
