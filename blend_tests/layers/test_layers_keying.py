"""Keys that go into layers: the pose that is seen is keyed, and seen again, whatever lies above and below."""

import itertools

import bpy
from mathutils import Quaternion

from layers.layer_cases import LayerTestCase, new_action, turning
from look_at.look_at_cases import BONES

ARM = ("UpperArm.L", "LowerArm.L")
CLOSE = 1e-5


def bend(rig, bones, angle=0.15):
    """Turn bones further, as an artist does in Pose Mode, without keys."""
    for name in bones:
        bone = rig.pose.bones[name]
        bone.rotation_quaternion = bone.rotation_quaternion @ Quaternion((0.0, 0.6, 0.8), angle)


class KeyingTestCase(LayerTestCase):
    def seen(self):
        return {name: self.own(name) for name in BONES}

    def assertSeen(self, wanted, message=""):
        for name, found in self.seen().items():
            difference = max(abs(a - b) for row, other in zip(found, wanted[name]) for a, b in zip(row, other))
            self.assertLess(difference, CLOSE, f"{name} {message}")

    def key(self, layer="", bones="UpperArm.L,LowerArm.L", **keywords):
        self.assertEqual(bpy.ops.motus.layer_key(object="Rig", layer=layer, bones=bones, **keywords), {'FINISHED'})


class Keying(KeyingTestCase):
    def test_the_pose_is_seen_again_in_any_mode_under_and_over_other_layers(self):
        below, above = turning("Below", {"UpperArm.L": (0.2, 0.0, 0.3)}), turning("Above", {"UpperArm.L": (0.1, 0.3, 0.0)})
        for mode, weight, steady, upper in itertools.product(('OVERRIDE', 'ADDITIVE'), (0.3, 1.0), (False, True), (False, True)):
            with self.subTest(mode=mode, weight=weight, steady=steady, upper=upper):
                mine = turning("Mine", {"UpperArm.L": (0.3, 0.2, 0.0)})
                self.add(action=below.name, bones="UpperArm.L", weight=0.5)
                entry = self.add(action=mine.name, bones="Chest", mode=mode, reference='REST', in_armature=steady, layer="Mine")
                entry.mask[0].weight = weight
                if upper:
                    self.add(action=above.name, bones="UpperArm.L", weight=0.3)
                    self.add(action=above.name, bones="UpperArm.L", mode='ADDITIVE', reference='REST', in_armature=True)
                self.go_to(8)
                bend(self.rig, ARM)
                bpy.context.view_layer.update()
                wanted = self.seen()
                self.key("Mine", channels={'LOCATION', 'ROTATION', 'SCALE'})
                bpy.context.view_layer.update()
                self.assertSeen(wanted, "at once")
                self.go_to(3)
                self.go_to(8)
                self.assertSeen(wanted, "again")
                while self.rig.motus.layers.entries:
                    bpy.ops.motus.layer_remove(object="Rig")

    def test_keys_land_in_the_layer_at_its_own_time_and_nowhere_else(self):
        entry = self.add(bones="UpperArm.L", start=5.0, speed=0.5, mode='ADDITIVE', reference='REST')
        walk = self.keys_of(self.walk)
        self.go_to(15)
        bend(self.rig, ("UpperArm.L",))
        self.key(bones="UpperArm.L", channels={'ROTATION'})
        self.assertEqual(self.keys_of(self.walk), walk)
        frames = {
            frame
            for (path, _), points in self.keys_of(entry.action).items()
            if "UpperArm" in path and path.endswith("rotation_quaternion")
            for frame, _ in points
        }
        self.assertEqual(frames, {1.0, 6.0, 11.0, 21.0})
        self.assertNotIn("location", "".join(path for path, _ in self.keys_of(entry.action)))

    def keys_of(self, action):
        return {
            (curve.data_path, curve.array_index): [tuple(point.co) for point in curve.keyframe_points]
            for curves in self.actions.all_fcurves(action)
            for curve in curves
        }

    def test_unkeyed_changes_go_where_the_rig_has_keys(self):
        self.add(bones="UpperArm.L", mode='ADDITIVE', reference='REST')
        self.go_to(8)
        bone = self.rig.pose.bones["UpperArm.L"]
        was = bone.rotation_quaternion.copy()
        bend(self.rig, ("UpperArm.L",))
        self.key(bones="UpperArm.L")
        self.assertLess((bone.rotation_quaternion - was).magnitude, 1e-6)

    def test_euler_angles_stay_near_to_their_keys(self):
        for bone in self.rig.pose.bones:
            bone.rotation_mode = 'ZXY'
        new_action("Turn", {('pose.bones["UpperArm.L"].rotation_euler', 0): [(1, 0.0), (21, 2.8)]})
        entry = self.add(action="Turn", bones="UpperArm.L")
        self.go_to(20)
        wanted = self.seen()
        self.key(bones="UpperArm.L", channels={'ROTATION'})
        self.go_to(20)
        self.assertSeen(wanted)
        (curve,) = next(iter(self.actions.all_fcurves(entry.action)))
        self.assertEqual(len(curve.keyframe_points), 3)
        self.assertEqual(curve.data_path, 'pose.bones["UpperArm.L"].rotation_euler')

    def test_the_reference_stays_what_it_was(self):
        entry = self.add(bones="UpperArm.L", mode='ADDITIVE', reference='FIRST')
        self.go_to(8)
        bend(self.rig, ARM)
        bpy.context.view_layer.update()
        wanted = self.seen()
        self.key()
        self.go_to(8)
        self.assertSeen(wanted)
        self.go_to(1)
        self.assertRefused("At the frame of its reference", bpy.ops.motus.layer_key, object="Rig", bones="UpperArm.L")
        # A bone without keys of its own is compared with its pose at rest.
        other = turning("Arm", {"UpperArm.L": (0.3, 0.0, 0.0)})
        entry.action = other
        self.go_to(8)
        bend(self.rig, ("LowerArm.L",))
        bpy.context.view_layer.update()
        wanted = self.seen()
        self.key(bones="LowerArm.L")
        self.go_to(8)
        self.assertSeen(wanted)

    def test_refusals(self):
        def refused(words, **keywords):
            self.assertRefused(words, bpy.ops.motus.layer_key, object="Rig", **({"bones": "UpperArm.L"} | keywords))

        entry = self.add(bones="UpperArm.L", start=10.0)
        self.go_to(5)
        refused("does not play at this frame")
        self.go_to(12)
        refused("Select bones in Pose Mode", bones="")
        refused("The mask of Throw has none of these bones", bones="Hips")
        refused("no bone Tail", bones="Tail")
        entry.weight = 0.0
        refused("has no weight here")
        entry.weight = 1.0
        self.add(action="Walk", bones="UpperArm.L")
        self.go_to(12)
        self.assertRefused(
            "cannot make all of this pose", bpy.ops.motus.layer_key, object="Rig", layer="Throw", bones="UpperArm.L", channels={'ROTATION'}
        )
        entry = self.rig.motus.layers.entries["Throw"]
        entry.action = None
        refused("Choose an action", layer="Throw")
