"""Targets that a Blend passes to, when one of them is removed from the chain or deleted from the scene."""

import bpy
from ik_switch_cases import A, B, C, SwitchTestCase
from mathutils import Vector

D = (0.3, 0.7, 1.3)


class StationTestCase(SwitchTestCase):
    def setUp(self):
        super().setUp()
        self.target(D, "D")


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
        self.assertRefused("Bone 1 has no target", bpy.ops.motus.ik_switch_target, object="Rig", bone="Bone 1",
                           target="D", frame_start=2, frame_end=5)
