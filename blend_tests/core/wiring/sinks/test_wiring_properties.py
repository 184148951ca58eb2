"""Systems that drive properties: numbers of any datablock, in the place of their own values and keys."""

from unittest import mock

import bpy

import support
import toy_dial_system
from core.wiring.property_cases import FRAMES, SYSTEM, PropertyTestCase, build, key, places, shown, state, values
from core.wiring.wiring_cases import assert_playback_equals_jumps, frame_set

wiring = support.addon("core.wiring")
outbox = support.addon("core.wiring.hubs.outbox")
results = support.addon("core.wiring.solving.results")
refusals = support.addon("core.refusals")


class EvaluationTest(PropertyTestCase):
    def test_frames_in_any_order(self):
        owner = build()
        self.assert_shown(owner)
        self.assertIsNone(self.problem(owner))

    def test_playback_equals_jumps(self):
        owner = build()
        owner.motus.dial.influence = 0.3
        assert_playback_equals_jumps(self, lambda: values(owner), 0.5)

    def test_influence_lays_it_over_the_own_values(self):
        owner = build()
        own = self.own_values(owner)
        for influence in (0.0, 0.4):
            owner.motus.dial.influence = influence
            for frame in FRAMES:
                frame_set(frame)
                wanted = [one + influence * (value - one) for one, value in zip(own[frame], shown(owner))]
                self.assert_close(values(owner), wanted, 1e-6)

    def test_keyed_influence(self):
        owner = build()
        own = self.own_values(owner)
        for frame, value in ((1, 0.0), (60, 1.0)):
            owner.motus.dial.influence = value
            owner.keyframe_insert("motus.dial.influence", frame=frame)
        frame_set(2)
        for frame in FRAMES:
            frame_set(frame)
            graph = bpy.context.evaluated_depsgraph_get()
            influence = owner.evaluated_get(graph).motus.dial.influence
            wanted = [one + influence * (value - one) for one, value in zip(own[frame], shown(owner))]
            self.assert_close(values(owner), wanted, 1e-6)

    def test_a_problem_leaves_the_own_values(self):
        owner = build()
        own = self.own_values(owner)
        owner.motus.dial.target = None
        self.assert_own(owner, own)
        self.assertIs(self.problem(owner), toy_dial_system.NO_TARGET)

    def test_an_error_of_our_own_leaves_the_own_values(self):
        owner = build()
        own = self.own_values(owner)
        with mock.patch.object(toy_dial_system, "shown", side_effect=RuntimeError), self.assertLogs(results.log, "ERROR"):
            self.assert_own(owner, own)

    def test_edited_keys_show_below_a_problem(self):
        owner = build()
        owner.motus.dial.target = None
        frame_set(60)
        key(owner, '["custom"]', -1, 60, 0.5)
        bpy.context.view_layer.update()
        bpy.context.view_layer.update()
        self.assertAlmostEqual(values(owner)[0], 0.5, places=6)

    def assert_own(self, owner, own):
        for frame in FRAMES:
            frame_set(frame)
            self.assert_close(values(owner), own[frame], 1e-6)

    @staticmethod
    def problem(owner):
        return wiring.problem(SYSTEM, owner, bpy.context.evaluated_depsgraph_get())


class EditingTest(PropertyTestCase):
    def test_removal_leaves_nothing(self):
        with mock.patch.object(wiring, "attach"):
            owner = build()
        before = state(owner)
        wiring.attach(SYSTEM, owner)
        self.assertNotEqual(state(owner), before)
        self.assert_shown(owner)
        wiring.detach(SYSTEM, owner)
        frame_set(1)
        bpy.context.view_layer.update()
        after = state(owner)
        for one, other in zip(after, before):
            self.assertEqual(one[1:], other[1:])
        for order in range(1, len(before), 2):
            self.assertEqual(after[order][0], before[order][0])
        self.assertFalse([mesh for mesh in bpy.data.meshes if outbox.is_hub(mesh)])

    def test_what_is_refused(self):
        owner = build()
        for path, index, word in (
            ('modifiers["None"].strength', -1, "number"),
            ("name", -1, "number"),
            ("pass_index", -1, "decimal"),
            ("location", -1, "number"),
            ("location", 5, "number"),
            ('["custom"]', -1, "driver"),
            ("modifiers[", -1, "number"),
            ("", -1, "number"),
            ("data", -1, "number"),
        ):
            with self.subTest(path), self.assertRaisesRegex(refusals.Refused, word):
                wiring.check_property(owner, path, index)
        curve = owner.driver_add("location", 0)
        with self.assertRaisesRegex(refusals.Refused, "driver"):
            wiring.check_property(owner, "location", 0)
        toy_dial_system.dial(owner, owner.motus.dial.target, (None, "location", 0))
        self.assertEqual(owner.animation_data.drivers.find("location", index=0), curve)
        self.assertFalse(EvaluationTest.problem(owner).blocking)

    def test_a_property_that_is_gone(self):
        owner = build()
        frame_set(3)
        owner.modifiers.clear()
        del owner["custom"]
        frame_set(4)
        self.assertIn("gone", EvaluationTest.problem(owner).sentence)
        owner.motus.dial.influence = 0.5
        frame_set(5)
        wiring.detach(SYSTEM, owner)
        drivers = owner.animation_data.drivers if owner.animation_data else ()
        self.assertEqual(len(drivers), 0)

    def test_copies(self):
        owner = build()
        frame_set(2)
        bpy.ops.object.select_all(action='DESELECT')
        owner.select_set(True)
        bpy.context.view_layer.objects.active = owner
        copy = owner.copy()
        copy.data = owner.data.copy()
        copy.active_material = owner.active_material.copy()
        copy.motus.dial.entries.remove(len(copy.motus.dial.entries) - 1)
        bpy.context.scene.collection.objects.link(copy)
        frame_set(3)
        copy.motus.dial.influence = 0.0
        self.assert_shown(owner)
        self.assertNotEqual(values(copy), values(owner)[:-1])
        copy.motus.dial.influence = 1.0
        self.assert_shown(copy)
        self.assertIsNone(EvaluationTest.problem(copy))
        wiring.detach(SYSTEM, copy)
        self.assertFalse([one for one in places(copy) if one.driver])
        self.assert_shown(owner)

    def test_a_copy_that_shares_its_data(self):
        owner = build()
        frame_set(2)
        copy = owner.copy()
        bpy.context.scene.collection.objects.link(copy)
        frame_set(3)
        self.assert_shown(owner)
        self.assertIn("another driver", EvaluationTest.problem(copy).sentence)
        wiring.detach(SYSTEM, copy)
        self.assert_shown(owner)

    def test_bake_and_unbake(self):
        owner = build()
        before = self.own_values(owner)
        wanted = {}
        for frame in (1, 4, 8):
            frame_set(frame)
            wanted[frame] = values(owner)
        self.assertEqual(bpy.ops.motus.bake(object=owner.name, frame_start=1, frame_end=8), {'FINISHED'})
        self.assertFalse([one for one in places(owner) if one.driver])
        for frame, found in wanted.items():
            frame_set(frame)
            self.assert_close(values(owner), found, 1e-6)
        self.assertEqual(bpy.ops.motus.unbake(object=owner.name), {'FINISHED'})
        self.assert_shown(owner)
        self.assertFalse([one for one in places(owner) if "motus_bake" in one.id_data])
        self.assertTrue(all("motus_copy" in one.id_data for one in places(owner)))
        self.assertEqual(self.own_values(owner), before)
