"""Drag Chain in the toolbar of Pose Mode: there while the add-on is enabled, with an icon and keys that exist."""

import unittest
from pathlib import Path

import bpy

import support

TOOL = "motus.ik_drag"


class Toolbar(unittest.TestCase):
    def tools(self, mode='POSE'):
        from bl_ui.space_toolsystem_toolbar import VIEW3D_PT_tools_active

        found = VIEW3D_PT_tools_active._tools_flatten(VIEW3D_PT_tools_active._tools[mode])
        return [tool for tool in found if getattr(tool, "idname", "") == TOOL]

    def test_in_pose_mode_while_enabled(self):
        self.assertEqual((len(self.tools()), self.tools('OBJECT')), (1, []))
        support.disable()
        self.addCleanup(support.enable)
        self.assertEqual(self.tools(), [])

    def test_the_icon_is_valid_and_what_its_script_draws(self):
        (tool,) = self.tools()
        icon = bpy.app.icons.new_triangles_from_file(f"{tool.icon}.dat")
        self.assertGreater(icon, 0)
        bpy.app.icons.release(icon)
        script = support.CLONE / "docs" / "scripts" / "tool_icons.py"
        made = {"__name__": "icons", "__file__": str(script)}
        exec(compile(script.read_text(encoding="utf-8"), str(script), "exec"), made)
        self.assertEqual(Path(f"{tool.icon}.dat").read_bytes(), made["drag_chain"]())

    def test_keys_name_operators_that_exist(self):
        for identifier, _, options in support.addon("ik.dragging.tool").KEYMAP:
            area, name = identifier.split(".")
            properties = getattr(getattr(bpy.ops, area), name).get_rna_type().properties
            for key, _ in (options or {}).get("properties", ()):
                self.assertIn(key, properties)
