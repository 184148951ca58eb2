"""Chains of one side are given to the other side, with their settings and pins."""

import bpy
import numpy as np

import support
from chains import chain_cases as cases

SETTINGS = {"frequency": 3.0, "tip_frequency": 0.5, "drag": 1.7, "bend_limit": 0.8, "thickness": 0.03}


def ears():
    """A rig with two ears, a tail in the middle, and a bone at each side of the root."""
    rig = support.link("Dog", bpy.data.armatures.new("Dog"))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    for side, x in ((".L", 1.0), (".R", -1.0), ("", 0.0)):
        parent = None
        for index in range(3):
            bone = rig.data.edit_bones.new(f"{'Ear' if side else 'Tail'} {index}{side}")
            bone.head, bone.tail, bone.parent = (x, 0.3 * index, 2.0), (x, 0.3 * index + 0.3, 2.1), parent
            parent = bone
        rig.data.edit_bones.new(f"Hand{side}").tail = (x, 0.0, 1.0)
    bpy.ops.object.mode_set(mode='OBJECT')
    return rig


def mirror(rig, **keywords):
    bpy.ops.motus.chains_mirror(object=rig.name, **keywords)
    bpy.context.view_layer.update()


class MirroringTest(support.SceneTestCase):
    def values(self, entry):
        return {name: getattr(entry, name) for name in support.addon("chains.mirroring").ENTRY}

    def test_chains_that_are_missing_are_made(self):
        rig = ears()
        cases.add(rig, "Ear 0.L, Tail 0", **SETTINGS)
        entries = rig.motus.chains.entries
        entries["Ear 0.L"].weight, entries["Ear 0.L"].hold_end = 0.75, True
        mirror(rig)
        self.assertEqual([entry.name for entry in entries], ["Ear 0.L", "Tail 0", "Ear 0.R"])
        self.assertEqual(self.values(entries["Ear 0.R"]), self.values(entries["Ear 0.L"]))
        self.assertIsNone(cases.problem(rig))
        for frame in (1, 20.5):
            left, right = (cases.tails(rig, frame, [f"Ear {index}{side}" for index in range(3)]) for side in (".L", ".R"))
            np.testing.assert_allclose(right, left * (-1.0, 1.0, 1.0), atol=1e-5)

    def test_a_chain_that_is_there_is_changed(self):
        rig = ears()
        cases.add(rig, "Ear 0.L", **SETTINGS)
        cases.add(rig, "Ear 0.R", frequency=0.0)
        cases.add(rig, "Tail 0")
        entries = rig.motus.chains.entries
        with self.assertRaisesRegex(RuntimeError, "Both sides have chains"):
            mirror(rig)
        mirror(rig, bones="Ear 2.R")
        self.assertEqual(self.values(entries["Ear 0.L"]), self.values(entries["Ear 0.R"]))
        self.assertEqual((entries["Ear 0.L"].frequency, len(entries)), (0.0, 3))

    def test_the_selected_bones(self):
        rig = ears()
        cases.add(rig, "Ear 0.L")
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='POSE')
        bone = rig.pose.bones["Ear 1.L"]
        (bone if hasattr(bone, "select") else bone.bone).select = True
        bpy.ops.motus.chains_mirror()
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assertIn("Ear 0.R", rig.motus.chains.entries)

    def test_pins_come_along(self):
        rig = ears()
        post = support.link("Post", location=(2.0, 0.0, 2.0))
        cases.add(rig, "Ear 0.L", frequency=0.0)
        bpy.ops.motus.chains_pin(object=rig.name, bones="Ear 1.L", target="Post", weight=0.3)
        bpy.ops.motus.chains_pin(object=rig.name, bones="Ear 2.L", target="Dog", target_bone="Hand.L")
        mirror(rig)
        pins = rig.motus.chains.pins
        self.assertEqual((pins["Ear 1.R"].target, pins["Ear 1.R"].target_bone), (post, ""))
        self.assertAlmostEqual(pins["Ear 1.R"].weight, 0.3)
        self.assertEqual((pins["Ear 2.R"].target, pins["Ear 2.R"].target_bone), (rig, "Hand.R"))
        mirror(rig, bones="Ear 0.L")
        self.assertEqual(len(pins), 4)
        bpy.ops.motus.chains_remove(object=rig.name)
        self.assertFalse(rig.motus.is_property_set("chains"))

    def test_refusals(self):
        rig = ears()
        cases.add(rig, "Tail 0")
        with self.assertRaisesRegex(RuntimeError, "No bone of Dog is the other side"):
            mirror(rig)
        with self.assertRaisesRegex(RuntimeError, "Ear 0.L belongs to no chain"):
            mirror(rig, bones="Ear 0.L")
        cases.add(rig, "Ear 0.L")
        bpy.ops.motus.dynamics_add(object=rig.name, bones="Ear 0.R")
        with self.assertRaisesRegex(RuntimeError, "is driven by Dynamics"):
            mirror(rig)
        self.assertNotIn("Ear 0.R", rig.motus.chains.entries)
        bpy.ops.motus.dynamics_remove(object=rig.name)
        bpy.ops.motus.chains_pin(object=rig.name, bones="Ear 2.L", target="Dog", target_bone="Ear 1.R")
        with self.assertRaisesRegex(RuntimeError, "Dog: Ear 1.L moves with the chain|moves with the chain of Ear 2.R"):
            mirror(rig, bones="Ear 0.L")
