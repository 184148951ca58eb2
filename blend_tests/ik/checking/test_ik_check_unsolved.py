"""Checking chains of which some are not solved, muted, or left to their animation."""

import bpy

import support
from ik.checking.ik_check_cases import CheckTestCase
from ik.ik_cases import REACHABLE


class Unsolved(CheckTestCase):
    """Chains that were not solved are not good, and are told so by the report and by the panel."""

    def reported(self, **keywords):
        """Kinds and sentences of the operator's reports."""
        cls, reports = support.addon("ik.checking.operators").MOTUS_OT_ik_check, []
        walker = type(
            "Walker",
            (),
            {
                **{name: value for name, value in vars(cls).items() if callable(value)},
                "object": "Rig",
                "bone": "",
                "step": 1.0,
                "total": 10,
                **keywords,
                "report": lambda _self, kind, text: reports.append((*kind, text)),
            },
        )()
        for _ in walker.steps(bpy.context, list(range(1, 11))):
            pass
        walker.result(bpy.context)
        return reports

    def icon(self, entry):
        """That of what the panel says of the check."""
        return support.addon("ik.tools_panel").ICONS.get(entry.check_reason, 'ERROR')

    def is_outdated(self, entry):
        bpy.context.view_layer.update()
        return support.addon("ik.tools_panel").is_outdated(bpy.context, self.rigged, entry)

    def assertUnsolved(self, entry):
        sentence = "Not solved on frames 1-10: the panel says why (checked 1-10)"
        self.assertEqual(self.reported(), [('WARNING', f"{entry.name}: {sentence}")])
        self.assertEqual((self.told(entry), self.icon(entry)), (sentence, 'ERROR'))
        self.assertFalse(self.is_outdated(entry))

    def test_without_target(self):
        entry = self.reach()
        entry.target = None
        self.assertUnsolved(entry)
        entry.target = bpy.data.objects["Target"]
        self.assertTrue(self.is_outdated(entry))
        entry.target.location = (3.0, 0.0, 1.0)
        self.assertTrue(self.is_outdated(entry))

    def test_deleted_target(self):
        entry = self.reach()
        self.assertEqual(self.reported(), [('INFO', "Bone 1: Reaches its target on all frames 1-10")])
        self.assertEqual(self.icon(entry), 'CHECKMARK')
        self.scene.frame_set(2)
        self.scene.collection.objects.unlink(bpy.data.objects["Target"])
        self.assertTrue(self.is_outdated(entry))
        self.assertUnsolved(entry)

    def test_loop(self):
        entry = self.reach()
        entry.target, entry.target_bone = self.rigged, "Hand"
        self.assertUnsolved(entry)

    def test_bones_of_another_chain(self):
        self.reach("Hand", chain_length=1)
        self.reach()
        self.rigged.motus.ik.entries["Hand"].chain_length = 2
        self.assertEqual(
            self.reported(bone="Bone 1"), [('WARNING', "Bone 1: Not solved on frames 1-10: the panel says why (checked 1-10)")]
        )

    def test_muted_chains_do_not_count(self):
        self.reach()
        muted = self.reach("Hand", chain_length=1, target="Far")
        muted.is_muted = True
        self.assertEqual(self.reported(), [('INFO', "Bone 1: Reaches its target on all frames 1-10")])
        self.assertEqual(self.told(self.rigged.motus.ik.entries["Hand"]), "")
        self.assertEqual(self.reported(bone="Hand"), [('INFO', "Muted chains are not checked")])

    def test_without_weight(self):
        sentence = "The weights leave it to its animation on all frames 1-10"
        entry = self.reach()
        for holder, name in ((entry, "position_weight"), (self.rigged.motus.ik, "influence")):
            setattr(holder, name, 0.0)
            self.assertEqual(self.reported(), [('INFO', f"Bone 1: {sentence}")])
            self.assertEqual((self.told(entry), self.icon(entry), entry.check_frames), (sentence, 'INFO', ""))
            self.assertFalse(self.is_outdated(entry))
            setattr(holder, name, 1.0)
            self.assertTrue(self.is_outdated(entry))

    def test_weight_on_some_frames(self):
        entry = self.reach()
        for frame, weight in ((1, 0.0), (5, 0.0), (6, 1.0)):
            entry.position_weight = weight
            entry.keyframe_insert("position_weight", frame=frame)
        self.assertEqual(self.reported(), [('INFO', "Bone 1: Reaches its target on all frames 6-10")])
        for frame in (3, 8):
            self.scene.frame_set(frame)
            self.assertFalse(self.is_outdated(entry))

    def test_on_some_frames(self):
        """A number that is not finite, where one of the others is out of reach."""
        target = self.moving(((1, REACHABLE), (3, (2.0, 0.0, 1.0)), (4, REACHABLE)))
        target.parent = self.target((0.0, 0.0, 0.0), "Carrier")
        target.parent.driver_add("scale", 2).driver.expression = "3e38 if frame > 7 else 1"
        entry = self.reach()
        self.assertEqual(self.reported(), [('WARNING', "Bone 1: Not solved on frames 8-10: the panel says why (checked 1-10)")])
        for frame in (1, 3, 9):
            self.scene.frame_set(frame)
            self.assertFalse(self.is_outdated(entry), frame)

    def test_good_ones_share_a_sentence(self):
        self.reach()
        hand = self.reach("Hand", chain_length=1, target="Far")
        hand.position_weight = 0.0
        self.assertEqual(self.reported()[-1][1], "Hand: The weights leave it to its animation on all frames 1-10")
        shoulder = self.reach("Shoulder", chain_length=1, target="Above", stretch=1.0)
        shoulder.target.location = (0.0, 0.0, 1.2)
        reports = self.reported()
        self.assertEqual(reports[0], ('INFO', "2 chains reach their targets on all frames 1-10"))
        self.assertEqual(len(reports), 2)

    def test_after_a_change_of_mode(self):
        """Blender 5 copies the rig anew without solving it; what was checked still holds."""
        entry = self.reach()
        self.check(frame_start=1, frame_end=3)
        bpy.ops.object.mode_set(mode='POSE')
        self.assertFalse(self.is_outdated(entry))
        self.check(frame_start=1, frame_end=3)
        self.assertEqual(self.told(entry), "Reaches its target on all frames 1-3")
