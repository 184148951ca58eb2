"""Targets that a Blend passes to, when one of them is removed from the chain or deleted from the scene."""

import math

import bpy
from mathutils import Vector

import support
from ik.switching.ik_switch_cases import A, B, C, SwitchTestCase

D = (0.3, 0.7, 1.3)


class StationTestCase(SwitchTestCase):
    def setUp(self):
        super().setUp()
        self.target(D, "D")

    def remove(self, index):
        self.assertEqual(bpy.ops.motus.ik_target_remove(object="Rig", bone="Bone 1", index=index), {'FINISHED'})

    def trigger(self, target, start, interpolation='LINEAR'):
        """Switch as the trigger's X goes from `start` to one more."""
        if "Trigger" not in bpy.data.objects:
            self.link("Trigger")
        self.switch(
            target,
            trigger_object="Trigger",
            trigger_data_path="location.x",
            trigger_start=start,
            trigger_end=start + 1.0,
            interpolation=interpolation,
        )

    def assertTriggered(self, *pairs):
        for value, place in pairs:
            bpy.data.objects["Trigger"].location.x = value
            self.assertAt(place, 1)

    @property
    def driver(self):
        curve = support.addon("ik.switching.blend_trigger").driver_of(self.rigged, self.entry)
        return curve and curve.driver

    def between(self, start, end, frame):
        return Vector(start).lerp(end, self.blend_at(frame) % 1.0)


class NotFinite(StationTestCase):
    def test_blend_that_is_not_finite(self):
        """It stops this chain alone, and says so."""
        self.entry.extra_targets.add().object = bpy.data.objects["B"]
        self.assertAt(A, 1)
        for value in (math.nan, math.inf):
            with self.subTest(value=value), self.assertNoLogs():
                self.entry.target_blend = value
                reason = self.output(self.rigged, "Bone 1.reason")
                is_clamped = self.entry.target_blend == self.entry.target_blend < math.inf
                self.assertEqual(reason, 0.0 if is_clamped else -1.0)
                if not is_clamped:
                    self.assertRefused("passes from one target to another", bpy.ops.motus.ik_match_fk, object="Rig")


class RemovedFromKeys(StationTestCase):
    def setUp(self):
        super().setUp()
        self.keyed("B", 10, 20)
        self.keyed("C", 30, 40)
        self.keyed("D", 50, 60)

    def test_the_one_between(self):
        """What passed to it stays where it was; what passed on from it passes on from there."""
        self.remove(0)
        for frame, place in ((1, A), (15, A), (20, A), (30, A), (40, C), (50, C), (60, D), (99, D)):
            self.assertAt(place, frame)
        self.assertAt(self.between(A, C, 34), 34, 5e-6)

    def test_the_last(self):
        self.remove(2)
        for frame, place in ((1, A), (20, B), (40, C), (55, C), (60, C)):
            self.assertAt(place, frame)
        self.keyed("D", 70, 80)
        for frame, place in ((1, A), (20, B), (40, C), (70, C), (80, D)):
            self.assertAt(place, frame)

    def test_all_of_them(self):
        for _ in range(3):
            self.remove(0)
        for frame in (1, 15, 20, 60):
            self.assertAt(A, frame)
        self.keyed("B", 70, 80)
        for frame, place in ((1, A), (60, A), (80, B)):
            self.assertAt(place, frame)

    def test_removed_by_a_script(self):
        """A file of an older version, or a script, may have keys of more targets than there are."""
        self.entry.extra_targets.remove(0)
        self.rigged.update_tag()
        for frame, place in ((20, C), (40, D), (60, D)):
            self.assertAt(place, frame)
        self.keyed("B", 70, 80)
        for frame, place in ((20, C), (40, D), (60, D), (70, D), (80, B)):
            self.assertAt(place, frame)

    def test_another_rig_has_the_action(self):
        other = self.link("Other", bpy.data.armatures.new("Other"))
        actions = support.addon("core.blender.actions")
        animation = self.rigged.animation_data
        actions.assign(other, animation.action, actions.slot_identifier(self.rigged))
        before = [tuple(key.co) for key in actions.fcurves(other)[0].keyframe_points]
        self.remove(0)
        self.assertEqual([tuple(key.co) for key in actions.fcurves(other)[0].keyframe_points], before)
        self.assertAt(C, 40)

    def test_undo(self):
        bpy.ops.ed.undo_push(message="Before")
        self.remove(0)
        bpy.ops.ed.undo_push(message="Removed")
        for step, place in ((bpy.ops.ed.undo, B), (bpy.ops.ed.redo, A)):
            step()
            self.scene, self.rigged = bpy.context.scene, bpy.data.objects["Rig"]
            self.assertAt(place, 20)
            self.assertAt(C, 40)


class RemovedFromTriggers(StationTestCase):
    def setUp(self):
        super().setUp()
        self.trigger("B", 1.0)
        self.trigger("C", 3.0)
        self.trigger("D", 5.0)

    def test_the_one_between(self):
        self.remove(0)
        self.assertTriggered((0.0, A), (2.0, A), (3.0, A), (4.0, C), (5.0, C), (6.0, D), (1.5, A))
        self.assertEqual(len(self.driver.variables), 2)

    def test_switched_again(self):
        """A new trigger has a variable of its own, whichever were removed."""
        self.remove(0)
        self.trigger("A", 7.0, 'BEZIER')
        self.assertEqual(self.stations, ["C", "D", "A"])
        self.assertTriggered((0.0, A), (2.0, A), (4.0, C), (6.0, D), (8.0, A))
        names = [variable.name for variable in self.driver.variables]
        self.assertEqual(len(names), len(set(names)))

    def test_the_last(self):
        self.remove(2)
        self.assertTriggered((2.0, B), (4.0, C), (6.0, C))
        self.switch("A", frame_start=40, frame_end=50)
        self.assertEqual(self.stations, ["B", "C", "A"])

    def test_all_of_them(self):
        for _ in range(3):
            self.remove(0)
        self.assertIsNone(self.driver)
        self.assertTriggered((6.0, A))

    def test_one_that_it_has_left_already(self):
        for count in (3, 2, 1):
            self.remove(count - 1)
        for name in "BC":
            bpy.ops.motus.ik_target_add(object="Rig", bone="Bone 1", target=name)
        self.entry.target_blend = 2.0
        self.trigger("D", 1.0)
        self.remove(0)
        self.assertTriggered((0.0, C), (2.0, D))
        self.remove(0)
        self.assertTriggered((0.0, A), (2.0, D))

    def test_removed_by_a_script(self):
        """Refused, before anything is changed: which of its passages is the one too many is not known."""
        self.entry.extra_targets.remove(1)
        expression = self.driver.expression
        for keywords in ({}, {"trigger_object": "Trigger", "trigger_data_path": "location.x"}):
            self.assertRefused(
                "targets that there are no more", bpy.ops.motus.ik_switch_target, object="Rig", bone="Bone 1", target="A", **keywords
            )
        self.assertEqual((self.stations, self.driver.expression), (["B", "D"], expression))

    def test_a_driver_of_ones_own_is_left(self):
        self.driver.expression = "v0 * 0.5"
        self.remove(0)
        self.assertEqual(self.driver.expression, "v0 * 0.5")


class RemovedUnderAStandingBlend(StationTestCase):
    def test_the_chain_stays(self):
        for blend, index, wanted, place in ((0.0, 0, 0.0, A), (3.0, 1, 2.0, D), (2.0, 2, 2.0, C), (2.0, 1, 1.0, B)):
            with self.subTest(blend=blend, index=index):
                self.setUp()
                for name in "BCD":
                    bpy.ops.motus.ik_target_add(object="Rig", bone="Bone 1", target=name)
                self.entry.target_blend = blend
                self.remove(index)
                self.assertEqual(self.entry.target_blend, wanted)
                self.assertAt(place, 1)


def _unlinked(name):
    """As Delete in the interface does it."""
    bpy.context.scene.collection.objects.unlink(bpy.data.objects[name])


def _removed(name):
    bpy.data.objects.remove(bpy.data.objects[name])


class Missing(StationTestCase):
    """The chain is at A, at B from frame 20 on and at C from 40 on; they were seen on the first frame only."""

    def setUp(self):
        super().setUp()
        self.entry.is_muted = True
        self.animated = self.poses(self.rigged)
        self.entry.is_muted = False
        self.keyed("B", 10, 20, interpolation='LINEAR')
        self.keyed("C", 30, 40, interpolation='LINEAR')
        self.assertAt(A, 1)

    def told(self, frame):
        """The problem that the panel shows, or ""."""
        self.evaluated(self.rigged, frame)
        found = self.wiring.problem(self.system, self.rigged, bpy.context.evaluated_depsgraph_get())
        return found.sentence if found else ""

    def assertTold(self, frames, part):
        for frame in frames:
            self.assertIn(part, self.told(frame), f"frame {frame}")

    def assertNotTold(self, frames):
        for frame in frames:
            self.assertEqual(self.told(frame), "", f"frame {frame}")
            self.assertEqual(self.sentence(self.rigged, frame=frame), "")

    def test_the_first(self):
        """The chain is off until it stands on another target."""
        for delete, sentence in ((_unlinked, "A is in no collection any more"), (_removed, "Bone 1 has no target")):
            with self.subTest(sentence):
                self.setUp()
                delete("A")
                for frame in (20, 25, 40, 60):
                    self.assertAt((B, C)[frame >= 40], frame)
                self.assertAt(Vector(B).lerp(C, 0.5), 35, 5e-6)
                self.assertNotTold((20, 25, 35, 40, 60))
                for frame in (1, 10, 15, 19):
                    self.assertNear(self.poses(self.rigged, frame), self.animated)
                    self.assertIn(sentence, self.sentence(self.rigged, frame=frame))
                self.assertTold((1, 15), "Some chains have no target")

    def test_the_first_deleted_where_the_chain_has_left_it(self):
        """In the film: the hand holds the remote control when the aeroplane goes."""
        self.assertAt(B, 25)
        _unlinked("A")
        self.assertAt(B, 25)
        self.assertNotTold((25,))

    def test_a_further_one(self):
        """The one before it counts instead, and the panel says so where it matters."""
        for delete in (_unlinked, _removed):
            with self.subTest(delete.__name__):
                self.setUp()
                delete("B")
                for frame, place in ((1, A), (10, A), (15, A), (20, A), (30, A), (35, Vector(A).lerp(C, 0.5)), (40, C)):
                    self.assertAt(place, frame, 5e-6)
                self.assertTold((11, 15, 20, 30, 35), "is missing: the one before it counts instead")
                self.assertNotTold((1, 10, 40, 60))

    def test_the_last(self):
        _unlinked("C")
        for frame, place in ((20, B), (30, B), (35, B), (40, B)):
            self.assertAt(place, frame)
        self.assertTold((35, 40, 60), "is missing")
        self.assertNotTold((1, 15, 20, 30))
        self.scene.collection.objects.link(bpy.data.objects["C"])
        self.assertAt(C, 40)
        self.assertNotTold((40,))

    def test_the_bone_of_a_further_one(self):
        other = self.arm(name="Other", joints=((0.0, 0.5, 1.0), (0.5, 0.6, 1.0), (0.9, 0.5, 1.0)))
        self.keyed("Other", 50, 60, target_bone="Bone 1")
        self.assertAt(self.head(other, "Bone 1", 60), 60)
        self.entry.extra_targets[2].bone = "Nose"
        self.assertAt(C, 60)
        self.assertTold((55, 60), "is missing")

    def test_both(self):
        _unlinked("A")
        _unlinked("B")
        for frame in (1, 15, 20, 30, 35):
            self.assertNear(self.poses(self.rigged, frame), self.animated)
            self.assertIn("A is in no collection any more", self.sentence(self.rigged, frame=frame))
        self.assertAt(C, 40)
        self.assertNotTold((40,))

    def test_muted(self):
        _unlinked("B")
        self.entry.is_muted = True
        self.assertNear(self.poses(self.rigged, 20), self.animated)
        self.assertNotTold((20,))

    def test_switched_on_from_there(self):
        """A chain that has left its first target may pass on without it."""
        _removed("A")
        self.keyed("D", 50, 60)
        self.assertAt(C, 50)
        self.assertAt(D, 60)
        self.assertRefused(
            "Bone 1 has no target", bpy.ops.motus.ik_switch_target, object="Rig", bone="Bone 1", target="D", frame_start=2, frame_end=5
        )
