"""Every two systems that may meet on one owner, in both orders: both show, or a sentence says why not."""

import itertools
import tempfile
from pathlib import Path

import bpy
import numpy as np

import support
from core import pair_cases as cases

FAR = 2e-3
"""m: by which keys on every frame, with what Blender makes between them, are off a layer."""


class Pairs(support.SceneTestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.files, cls.kept = tempfile.TemporaryDirectory(prefix="motus-test-"), {}
        cls.addClassCleanup(cls.files.cleanup)

    def alone(self, kind, name, beside):
        """Of a new scene with one system on its owner, as it is put there beside another one: (path of its file, what is seen). Made once."""
        key = kind, name, cases.bones_beside(name, kind, beside)
        if key not in self.kept:
            support.empty_scene()
            cases.build(kind)
            cases.add(name, kind, beside)
            bpy.context.view_layer.update()
            path = str(Path(self.files.name, f"{len(self.kept)}.blend"))
            bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
            self.kept[key] = path, cases.seen()
        return self.kept[key]

    def made(self, kind, first, second):
        """(the owner, what refused the second system or "") of a scene in which the owner has been given two systems."""
        bpy.ops.wm.open_mainfile(filepath=self.alone(kind, first, second)[0])
        refused = ""
        try:
            cases.add(second, kind, first)
        except RuntimeError as error:
            refused = str(error)
        bpy.context.view_layer.update()
        return bpy.data.objects["Owner"], refused

    def test_all_systems_are_in_the_table(self):
        named = {name.split()[0] for names in cases.KINDS.values() for name in names}
        self.assertEqual(named, {one.name for one in support.addon("systems").SYSTEMS} - {"pendulum_trail", "hand_over"})

    def test_both_show_or_a_sentence_says_why(self):
        for kind, first, second in cases.pairs():
            alone = {name: self.alone(kind, name, other)[1] for name, other in ((first, second), (second, first))}
            found = {}
            for order in ((first, second), (second, first)):
                with self.subTest(kind=kind, order=order):
                    owner, refused = self.made(kind, *order)
                    if refused or cases.sentences(owner):
                        continue
                    found[order] = cases.seen()
                    for name, other in (order, order[::-1]):
                        self.assertTrue(support.differ(found[order], alone[other]), f"{name} does nothing")
            with self.subTest(kind=kind, pair=(first, second)):
                self.assertIn(len(found), (0, 2), "one order is told, the other is not")
                if len(found) == 2 and not {first, second} & cases.IN_ORDER:
                    self.assertFalse(support.differ(*found.values()), "the order matters")

    def test_what_moves_above_layers_is_as_above_keys(self):
        """The layers' own result as keys is the reference."""
        for name in ("dynamics", "dynamics own", "ik", "look_at"):
            support.empty_scene()
            cases.build("rig")
            cases.add("layers", "rig")
            bpy.ops.motus.layers_flatten(object="Owner", frame_start=1, frame_end=60)
            cases.add(name, "rig", "layers")
            bpy.context.view_layer.update()
            wanted = cases.seen()
            for order in itertools.permutations(("layers", name)):
                with self.subTest(order=order):
                    owner, refused = self.made("rig", *order)
                    self.assertFalse(refused or cases.sentences(owner))
                    found = cases.seen()
                    self.assertFalse(support.differ(found, wanted, FAR))
                    for frame in reversed(cases.FRAMES):
                        again = cases.seen((frame,))
                        for what, numbers in again.items():
                            np.testing.assert_array_equal(numbers, found[what], str(what))

    def test_an_edited_layer_is_followed(self):
        self.made("rig", "layers", "dynamics")
        before = cases.seen((20,))
        for curve in support.addon("core.blender.actions").curves_for_object(bpy.data.actions["Wave"]):
            if "UpperArm" in curve.data_path:
                for point in curve.keyframe_points:
                    point.co.y *= 0.5 if curve.array_index else 1.0
                curve.update()
        bpy.context.view_layer.update()
        edited = cases.seen((20,))
        self.assertTrue(support.differ(before, edited))
        bpy.ops.motus.refresh(object="Owner", system="dynamics")
        self.assertFalse(support.differ(cases.seen((20,)), edited, 0.0))

    def test_an_object_that_waits_for_its_own_layers_is_healed_in_a_file_of_an_older_version(self):
        """Version 2 of the wiring had the object's dynamics wait for the layers, which wait for the object: a dependency cycle."""
        owner, _ = self.made("rig", "layers", "dynamics object")
        wanted = cases.seen()
        hub_of, outbox = support.addon("core.wiring.hubs.hub_lookup").hub_of, support.addon("core.wiring.hubs.outbox")
        systems = support.addon("core.declare").registered

        def variables(name):
            curve = hub_of(systems["dynamics"], bpy.data.objects[name], "").data.animation_data.drivers[0]
            return {variable.name: variable for variable in curve.driver.variables}, curve.driver.variables

        waits = variables("Owner")[1].new()
        waits.name = "l0"
        waits.targets[0].id_type, waits.targets[0].id = 'MESH', hub_of(systems["layers"], owner, "").data
        waits.targets[0].data_path = outbox.out_path(systems["layers"], outbox.STATUS)
        for name in ("layers", "dynamics"):
            settings = getattr(owner.motus, name)
            settings.wired = f"2 {settings.wired.split()[1]}"
        bpy.ops.wm.open_mainfile(filepath=self.save())
        self.assertIn("l0", variables("Owner")[0])
        self.go_to(2)
        self.assertNotIn("l0", variables("Owner")[0])
        self.assertFalse(support.differ(cases.seen(), wanted))

    def test_the_panel_names_what_it_knows_by(self):
        owner, _ = self.made("rig", "dynamics own", "layers")
        source = support.addon("dynamics.panel").input_of(owner, owner.motus.dynamics.entries[0], bpy.context.scene)
        self.assertEqual([track.sentence for track in source.tracks], ["Exact at any frame: solved by Animation Layers"])
        self.assertEqual(source.extent, (1.0, 40.0))

    def test_layers_that_repeat_go_on_under_dynamics(self):
        owner, _ = self.made("rig", "layers", "dynamics own")
        owner.motus.layers.entries[0].after = 'REPEAT'
        frames = [40 + step for step in cases.FRAMES]
        bpy.context.view_layer.update()
        found = cases.seen(frames)
        owner.motus.dynamics.entries[0].is_muted = True
        bpy.context.view_layer.update()
        self.assertTrue(support.differ(found, cases.seen(frames)))
