"""The curve along a chain: drawn in Blender's widget, read once by the motion, and kept with the chain's settings."""

import bpy
import numpy as np

import support
from chains import chain_cases as cases

FRAMES = (1, 15, 22.5, 40)
TIP = {"tip_mass": 3.0, "tip_frequency": 0.5, "tip_thickness": 0.2, "thickness": 0.1}
LATE = "0 0, 0.5 0.1, 1 1"
NAME = ".Motus Chain Shape"


def trees():
    return [tree.name for tree in bpy.data.node_groups if tree.name.startswith(NAME)]


def node(entry):
    return support.addon("core.settings.drawn_curves").node(entry)


def draw(entry, *places):
    """Move the points of the widget's curve to places, and tell of it as the widget does."""
    mapping = node(entry).mapping
    for point, place in zip(mapping.curves[0].points, places):
        point.location = place
    mapping.update()
    node(entry).id_data.update_tag()
    bpy.context.view_layer.update()


def seen(rig):
    return {frame: cases.matrix(rig, frame, "Tail 0 3").tobytes() for frame in FRAMES}


class ShapeTest(support.SceneTestCase):
    def build(self, **settings):
        rig = cases.rope(4)
        (entry,) = cases.add(rig, **TIP | settings)
        return rig, entry

    def test_a_curve_says_how_much_of_the_tips_values_is_reached(self):
        rig = cases.rope(4)
        (found,) = cases.made(lambda: cases.add(rig, **TIP, use_curve=True, curve="0 0.5 VECTOR, 0.5 1 VECTOR, 1 0 VECTOR"))
        shares = np.array([0.5, 0.5, 0.5 + 1.0 / 3.0, 2.0 / 3.0, 0.0])  # of the head, then of four bones
        np.testing.assert_allclose(found.mass, 1.0 + 2.0 * shares, atol=0.02)
        np.testing.assert_allclose(found.frequency, 1.5 * (1.0 - 0.5 * shares), atol=0.02)
        np.testing.assert_allclose(found.thickness, 0.1 * (1.0 - 0.8 * shares), atol=0.02)

    def test_it_begins_as_tip_shape_has_it_and_goes_back_to_that(self):
        rig, entry = self.build(tip_shape=2.0)
        plain = seen(rig)
        (found,) = cases.made(lambda: setattr(entry, "use_curve", True))
        np.testing.assert_allclose(found.mass, 1.0 + 2.0 * np.array([0.0, 0.0, 1.0, 2.0, 3.0]) ** 2 / 9.0, atol=0.02)
        self.assertEqual(len(node(entry).mapping.curves[0].points), 5)
        drawn = entry.curve
        entry.use_curve = False
        self.assertEqual(seen(rig), plain)
        entry.use_curve = True
        self.assertEqual((entry.curve, len(trees())), (drawn, 1))

    def test_what_is_drawn_makes_a_new_motion(self):
        rig, entry = self.build(use_curve=True, curve=LATE)
        before = seen(rig)
        (found,) = cases.made(lambda: draw(entry, (0.0, 0.0), (0.5, 0.9), (1.0, 1.0)))
        np.testing.assert_allclose(found.mass[2:4], 1.0 + 2.0 * np.array([0.7, 1.0]), atol=0.15)
        self.assertEqual(entry.curve, "0 0, 0.5 0.899999976, 1 1")
        after = seen(rig)
        self.assertNotEqual(after, before)
        support.addon().forget_all()
        self.assertEqual({frame: seen(rig)[frame] for frame in reversed(FRAMES)}, after)
        self.assertEqual(cases.made(lambda: cases.go_to(30)), [], "nothing is made anew from frame to frame")
        entry.curve = LATE
        bpy.context.view_layer.update()
        np.testing.assert_allclose(node(entry).mapping.curves[0].points[1].location, (0.5, 0.1))
        self.assertEqual(seen(rig), before)

    def test_bad_texts(self):
        rig, entry = self.build()
        for text in ("0 0", "0 0, 1", "0 0, 1 nan", "0 0, 1 2", "0 0, x 1", "0 0, 1 1 SHARP", "0 0 0 0, 1 1", "-1 0, 1 1"):
            with self.assertRaisesRegex(RuntimeError, "is no curve: name two points or more"):
                bpy.ops.motus.chains_add(object=rig.name, bones="Tail 0 0", use_curve=True, curve=text)
        entry.curve, entry.use_curve = "nonsense", True
        self.assertEqual(entry.curve, "0 0, 1 1")

    def test_opened_again_and_appended(self):
        rig, _ = self.build(use_curve=True, curve=LATE)
        wanted, path = seen(rig), self.save()
        bpy.ops.wm.open_mainfile(filepath=path)
        self.assertEqual(seen(bpy.data.objects["Rope"]), wanted)
        self.assertEqual(len(trees()), 1)
        draw(bpy.data.objects["Rope"].motus.chains.entries[0], (0.0, 0.0), (0.5, 0.9), (1.0, 1.0))
        self.assertNotEqual(seen(bpy.data.objects["Rope"]), wanted)
        for is_link in (True, False):
            rig = self.load(path, is_link, "Rope")
            self.assertEqual(seen(rig), wanted)
            self.assertEqual(len(trees()), 1)
        draw(rig.motus.chains.entries[0], (0.0, 0.0), (0.5, 0.9), (1.0, 1.0))
        self.assertNotEqual(seen(rig), wanted)

    def test_an_override_has_a_curve_of_its_own(self):
        rig, _ = self.build(use_curve=True, curve=LATE)
        wanted, path = seen(rig), self.save()
        rig = self.load(path, True, "Rope")
        mine = rig.override_create(remap_local_usages=True)
        bpy.context.view_layer.update()
        self.assertEqual(seen(mine), wanted)
        entry = mine.motus.chains.entries[0]
        draw(entry, (0.0, 0.0), (0.5, 0.9), (1.0, 1.0))
        self.assertIsNone(node(entry).id_data.library)
        drawn = seen(mine)
        self.assertNotEqual(drawn, wanted)
        for _ in range(2):
            path = self.save("second.blend")
            bpy.ops.wm.open_mainfile(filepath=path)
            mine = next(obj for obj in bpy.data.objects if obj.override_library and obj.name.startswith("Rope"))
            self.assertEqual(seen(mine), drawn)
            self.assertIsNotNone(node(mine.motus.chains.entries[0]))

    def test_a_copied_object_has_a_curve_of_its_own(self):
        rig, entry = self.build(use_curve=True, curve=LATE)
        wanted = seen(rig)
        copy = rig.copy()
        bpy.context.scene.collection.objects.link(copy)
        bpy.context.view_layer.update()
        other = copy.motus.chains.entries[0]
        self.assertNotEqual(node(entry).id_data, node(other).id_data)
        draw(other, (0.0, 0.0), (0.5, 0.9), (1.0, 1.0))
        self.assertEqual(seen(rig), wanted)
        self.assertNotEqual(seen(copy), wanted)
        bpy.ops.motus.chains_remove(object=copy.name)
        self.assertEqual(len(trees()), 1)
        self.assertEqual(seen(rig), wanted)

    def test_copies_to_other_chains(self):
        rig = cases.rope(4, chains=2)
        for number, side in enumerate(("L", "R")):
            rig.data.bones[f"Tail {number} 0"].name = f"Ear.{side}"
        bpy.context.view_layer.update()
        first, second = cases.add(rig, "Ear.L, Ear.R", **TIP)
        first.curve, first.use_curve = LATE, True
        bpy.ops.motus.to_selected(object=rig.name, system="chains", bone="Ear.L", bones="Ear.R")
        self.assertEqual((second.use_curve, second.curve), (True, first.curve))
        self.assertNotEqual(node(first).id_data, node(second).id_data)
        draw(first, (0.0, 0.0), (0.5, 0.9), (1.0, 1.0))
        self.assertNotEqual(second.curve, first.curve)
        bpy.ops.motus.chains_mirror(object=rig.name, bones="Ear.L")
        second = rig.motus.chains.entries["Ear.R"]
        self.assertEqual(second.curve, rig.motus.chains.entries["Ear.L"].curve)
        bpy.context.view_layer.objects.active = rig
        bpy.ops.motus.chains_preset_use(preset='EARRING')
        self.assertTrue(all(entry.use_curve and node(entry) for entry in rig.motus.chains.entries))
        bpy.ops.motus.chains_remove(object=rig.name)
        self.assertEqual(trees(), [])

    def test_a_preset_of_the_user_keeps_the_curve(self):
        paths = support.addon("chains.presets").OPERATOR.preset_values
        self.assertTrue({"curve", "use_curve"} < {path.rpartition(".")[2] for path in paths})

    def test_one_step_is_undone(self):
        rig, entry = self.build()
        bpy.ops.ed.undo_push(message="before")
        entry.use_curve = True
        bpy.context.view_layer.update()
        plain = seen(rig)
        bpy.ops.ed.undo_push(message="made")
        draw(entry, (0.0, 0.9), (1.0, 1.0))
        drawn = seen(rig)
        bpy.ops.ed.undo_push(message="drawn")
        bpy.ops.ed.undo()
        rig = bpy.data.objects["Rope"]
        self.assertEqual(seen(rig), plain)
        bpy.ops.ed.redo()
        rig = bpy.data.objects["Rope"]
        self.assertEqual(seen(rig), drawn)
        bpy.ops.ed.undo()
        bpy.ops.ed.undo()
        self.assertFalse(bpy.data.objects["Rope"].motus.chains.entries[0].use_curve)
        self.assertEqual(trees(), [])

    def test_a_step_that_was_kept_before_the_curve_was_read(self):
        """Blender keeps the step of the widget before it evaluates: the settings follow what undo brings."""
        rig, entry = self.build(use_curve=True, curve=LATE)
        bpy.ops.ed.undo_push(message="before")
        mapping = node(entry).mapping
        mapping.curves[0].points[1].location = (0.5, 0.9)
        mapping.update()
        bpy.ops.ed.undo_push(message="drawn")
        node(entry).id_data.update_tag()
        bpy.context.view_layer.update()
        drawn = seen(rig)
        rig.location.x = 1.0
        bpy.ops.ed.undo_push(message="moved")
        bpy.ops.ed.undo()
        bpy.context.view_layer.update()
        self.assertEqual(seen(bpy.data.objects["Rope"]), drawn)

    def test_files_of_others(self):
        rig, entry = self.build(use_curve=True, curve=LATE)
        wanted = seen(rig)
        tree = node(entry).id_data
        tree.nodes.clear()  # a group without the node
        bpy.ops.motus.refresh(object=rig.name)
        self.assertEqual((seen(rig), node(entry) is not None), (wanted, True))
        bpy.data.node_groups.remove(node(entry).id_data)  # no group
        bpy.context.view_layer.update()
        self.assertEqual(seen(rig), wanted)
        bpy.ops.motus.refresh(object=rig.name)
        self.assertIsNotNone(node(entry))
        entry.curve_nodes = None
        entry["curve_nodes"] = bpy.data.meshes.new("No Group")  # what is no group
        bpy.context.view_layer.update()
        self.assertEqual((seen(rig), node(entry)), (wanted, None))
        bpy.ops.motus.refresh(object=rig.name)
        self.assertEqual((seen(rig), node(entry) is not None), (wanted, True))

    def test_two_chains_that_share_a_group_are_parted(self):
        rig = cases.rope(4, chains=2)
        first, second = cases.add(rig, "Tail 0 0, Tail 1 0", **TIP, use_curve=True, curve=LATE)
        second.curve_nodes = node(first).id_data
        bpy.ops.motus.refresh(object=rig.name)
        self.assertNotEqual(node(first).id_data, node(second).id_data)
        self.assertEqual(first.curve, second.curve)

    def test_values_that_are_none(self):
        rig, entry = self.build(use_curve=True)
        entry.curve_values = [1e30] * 32
        bpy.context.view_layer.update()
        self.assertTrue(np.isfinite(cases.matrix(rig, 30, "Tail 0 3")).all())
        entry.curve_values = [float("nan")] * 32
        bpy.context.view_layer.update()
        self.assertIn("outside of what a motion", support.addon("chains.told").sentence(rig, cases.problem(rig), bpy.context.scene))
