"""What the panel says of a chain: why it does not reach, and of what it has lost."""

import bpy
import support
from ik_cases import IkTestCase, tentacle


class Levels(IkTestCase):
    COUNT = 20

    def test_many_that_wait_for_one_another(self):
        rig = self.arm(tentacle(self.COUNT), hand=False)
        target = self.target((0.1, 0.2, 3.0))
        with support.addon("ik.setup").at_once(rig):
            for index in range(self.COUNT):
                support.addon("ik.setup").add(rig, f"Bone {index}", {"target": target, "chain_length": 1})
        bpy.context.view_layer.update()
        report = support.addon("ik.status").report
        told = [report(rig, f"Bone {index}", bpy.context.view_layer.depsgraph) for index in range(self.COUNT)]
        self.assertNotIn(None, told)
        self.assertIn("too far away", self.sentence(rig, f"Bone {self.COUNT - 1}"))
