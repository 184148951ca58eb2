"""Keys that matching adds, and how undo takes them back."""

import bpy

import support
from ik.ik_cases import state
from ik.matching.ik_match_cases import MatchTestCase, state_of

WEIGHT = "motus.ik.entries[0].position_weight"


class OneKey(MatchTestCase):
    def test_curves_with_one_key_are_continued(self):
        """Blender works out no handles of a lone key: kept as they are they would lead the curve to zero."""
        self.animated_arm()
        self.reach(make_pole=True, target="")
        for frame in (10, 20):
            self.scene.frame_set(frame)
            self.match(use_range=False)
        for curve in support.addon("core.blender.actions").fcurves(bpy.data.objects["Rig Bone 1 Target"]):
            ends = [curve.evaluate(frame) for frame in (10, 20)]
            for frame in range(11, 20):
                self.assertLessEqual(min(ends) - 1e-5, curve.evaluate(frame))
                self.assertLessEqual(curve.evaluate(frame), max(ends) + 1e-5)


class Undo(MatchTestCase):
    def all_of_it(self):
        """Keys and transforms of the rig and its controls, the weights, and where the bones stand."""
        rig, *controls = (bpy.data.objects[name] for name in ("Rig", "Target", "Rig Bone 1 Pole"))
        entry = rig.motus.ik.entries[0]
        return (
            [state_of(obj) for obj in (rig, *controls)],
            state(rig),
            self.poses(rig).tolist(),
            (entry.position_weight, entry.rotation_weight),
            self.scene.frame_current,
            len(bpy.data.actions),
        )

    def test_matching_is_one_step(self):
        for operator in ("ik_match_fk", "fk_match_ik"):
            with self.subTest(operator):
                self.setUp()
                self.animated_arm()
                entry = self.reach(make_pole=True, position_weight=0.5, rotation_weight=0.25)
                self.scene.frame_set(3)
                bpy.ops.ed.undo_push(message="Before everything")
                entry.rotation_weight = 0.75
                before = self.all_of_it()
                bpy.ops.ed.undo_push(message="Before")
                # True: as from a button, with a step of undo.
                getattr(bpy.ops.motus, operator)('EXEC_DEFAULT', True, object="Rig", switch=True)
                after = self.all_of_it()
                self.assertNotEqual(after[0], before[0], "keys")
                self.assertNotEqual(after[3], before[3], "weights")
                for step, wanted in ((bpy.ops.ed.undo, before), (bpy.ops.ed.redo, after), (bpy.ops.ed.undo, before)):
                    step()
                    self.scene = bpy.context.scene
                    self.assertEqual(self.all_of_it(), wanted)

    def test_one_step(self):
        for name in ("ik_match_fk", "fk_match_ik", "ik_switch_target", "ik_drag", "ik_check"):
            self.assertLessEqual({'REGISTER', 'UNDO'}, getattr(bpy.types, f"MOTUS_OT_{name}").bl_options)
