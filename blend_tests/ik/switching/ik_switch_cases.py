"""What the tests of switching share: an arm that is at A, and two other targets."""

import bpy

from ik.ik_cases import IkTestCase

A, B, C = (0.6, 0.3, 1.4), (0.2, -0.8, 1.2), (0.9, 0.1, 0.6)


class SwitchTestCase(IkTestCase):
    def setUp(self):
        super().setUp()
        self.rigged = self.arm()
        for name, place in (("A", A), ("B", B), ("C", C)):
            self.target(place, name)
        self.entry = self.reach(target="A")

    def switch(self, target, **keywords):
        self.assertEqual(bpy.ops.motus.ik_switch_target(object="Rig", bone="Bone 1", target=target, **keywords), {'FINISHED'})

    def keyed(self, target, start, end, **keywords):
        self.switch(target, frame_start=start, frame_end=end, **keywords)

    def blend_at(self, frame):
        return self.evaluated(self.rigged, frame).motus.ik.entries["Bone 1"].target_blend

    def assertAt(self, place, frame, tolerance=2e-6):
        self.assertNear(self.tail(self.rigged, frame=frame), place, tolerance)

    @property
    def stations(self):
        return [extra.object.name for extra in self.entry.extra_targets]
