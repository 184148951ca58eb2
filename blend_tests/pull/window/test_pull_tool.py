"""What the tool's settings show in the header and in the sidebar, seen by a layout that writes down what is drawn."""

from types import SimpleNamespace

import support
from pull.pull_cases import PullTestCase


class Settings(PullTestCase):
    def drawn(self, region):
        layout = _Layout()
        context = SimpleNamespace(scene=self.scene, region=SimpleNamespace(type=region))
        for tool in support.addon("pull.window.tool").TOOLS:
            layout.names, layout.texts = [], {}
            tool.draw_settings(context, layout, None)
        for name in layout.names:
            self.assertIn(name, self.brush.bl_rna.properties)
        return layout

    def test_header(self):
        layout = self.drawn('TOOL_HEADER')
        self.assertEqual(
            layout.names,
            [
                "radius",
                "use_pressure_size",
                "strength",
                "use_pressure_strength",
                "direction",
                "falloff",
                "distance",
                "accumulate",
                "mirror",
                "show_inset",
            ],
        )
        for name in ("falloff", "distance", "direction"):
            self.assertIsNone(layout.texts[name])
        self.assertIn("Mirror", layout.labels)
        self.assertFalse(layout.use_property_split)

    def test_elsewhere_there_is_room_for_names(self):
        layout = self.drawn('UI')
        for name in ("radius", "strength", "falloff", "distance", "direction"):
            self.assertIn(name, layout.names)
            self.assertIsNone(layout.texts[name])
        self.assertFalse(layout.labels)
        self.assertTrue(layout.use_property_split)

    def test_along_edges_the_radius_counts_them(self):
        self.brush.distance = 'EDGES'
        names = self.drawn('TOOL_HEADER').names
        self.assertIn("edge_count", names)
        self.assertNotIn("radius", names)

    def test_a_drag_asks_for_no_strength(self):
        self.assertTrue(self.drawn('TOOL_HEADER').active)
        self.brush.direction = 'CURSOR'
        layout = self.drawn('TOOL_HEADER')
        self.assertFalse(layout.active)
        self.assertIn("direction", layout.names)

    def test_blender_has_the_tool_in_each_mode(self):
        tools = support.addon("pull.window.tool")
        from bl_ui.space_toolsystem_common import ToolSelectPanelHelper

        bar = ToolSelectPanelHelper._tool_class_from_space_type('VIEW_3D')
        for tool in tools.TOOLS:
            found = [one for one in bar._tools[tool.bl_context_mode] if getattr(one, "idname", None) == tool.bl_idname]
            self.assertEqual(len(found), 1, tool.bl_context_mode)
            self.assertIs(found[0].draw_settings, tool.draw_settings)


class _Layout:
    def __init__(self):
        self.names, self.texts, self.labels = [], {}, []
        self.use_property_split = False

    def row(self, **_options):
        return self

    def label(self, text=""):
        self.labels.append(text)

    def prop(self, _data, name, text=None, **_options):
        self.names.append(name)
        self.texts[name] = text
