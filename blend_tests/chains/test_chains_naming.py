"""Names of entries: bones, rows and splines of one owner never take each other's entries."""

import bpy

import support
from chains import chain_cases as cases


class NamingTest(support.SceneTestCase):
    def listed(self, owner):
        return [(entry.name, len(entry.links), entry.spline) for entry in owner.motus.chains.entries]

    def test_a_row_gives_way_to_bones(self):
        rig = cases.still_rope(2, chains=2)
        for name in ("Tail 0 0", "Below"):
            support.link(name, location=(1.0, 0.0, 0.0))
        cases.add(rig, "Tail 1 0")
        for _ in range(2):  # once more changes the row
            bpy.ops.motus.chains_add(objects=f"{rig.name}, Tail 0 0, Below", frequency=0.5)
        self.assertEqual(self.listed(rig), [("Tail 1 0", 0, -1), ("Tail 0 0.001", 2, -1)])
        cases.add(rig, "Tail 0 0", frequency=3.0)
        self.assertEqual(self.listed(rig), [("Tail 1 0", 0, -1), ("Tail 0 0.001", 2, -1), ("Tail 0 0", 0, -1)])
        self.assertEqual([round(entry.frequency, 3) for entry in rig.motus.chains.entries], [1.5, 0.5, 3.0])
        self.assertIsNone(cases.problem(rig))

    def test_a_row_that_has_the_name_of_a_later_bone(self):
        """As when the bone was made, or renamed, after the row: keys by name follow the row."""
        for is_renamed in (False, True):
            with self.subTest(is_renamed=is_renamed):
                support.empty_scene()
                rig = cases.still_rope(2)
                support.link("Later")
                if is_renamed:
                    cases.add(rig, "Tail 0 0")
                bpy.ops.motus.chains_add(objects=f"{rig.name}, Later")
                entry = rig.motus.chains.entries["Later"]
                entry.weight = 0.25
                entry.keyframe_insert("weight", frame=1)
                (curve,) = support.addon("core.blender.actions").fcurves(rig)
                curve.data_path = 'motus.chains.entries["Later"].weight'  # as a script may write it
                rig.data.bones["Tail 0 0"].name = "Later"
                bpy.context.view_layer.update()
                if not is_renamed:
                    cases.add(rig, "Later")
                names = {entry.name: len(entry.links) for entry in rig.motus.chains.entries}
                self.assertEqual(names, {"Later": 0, "Later.001": 1})
                (curve,) = support.addon("core.blender.actions").fcurves(rig)
                self.assertEqual(curve.data_path, 'motus.chains.entries["Later.001"].weight')
                cases.go_to(5)
                self.assertIsNone(cases.problem(rig))

    def test_splines_and_rows_of_a_curve(self):
        data = bpy.data.curves.new("Rope", 'CURVE')
        for number in range(2):
            data.splines.new('POLY').points.add(2)
            for index, point in enumerate(data.splines[number].points):
                point.co = (number, index, 0.0, 1.0)
        curve = support.link("Rope", data)
        support.link("Spline 2", location=(3.0, 1.0, 0.0))
        bpy.ops.motus.chains_add(objects="Rope, Spline 2")
        for _ in range(2):
            bpy.ops.motus.chains_add(object="Rope")
        self.assertEqual(self.listed(curve), [("Spline 2", 1, -1), ("Spline 1", 3, 0), ("Spline 2.001", 3, 1)])
        self.assertIsNone(cases.problem(curve))
