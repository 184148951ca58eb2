"""Tools that write keys, on rigs and targets whose action is linked from a library: it is copied first."""

import bpy

import support
from ik.ik_cases import REACHABLE
from ik.matching.ik_match_cases import MatchTestCase, state_of

RANGE = {"frame_start": 1, "frame_end": 30}


class LinkedActionTestCase(MatchTestCase):
    def setUp(self):
        super().setUp()
        self.actions = support.addon("core.blender.actions")
        self.rigged = self.animated_arm()
        self.goal = self.target()
        for frame, place in ((1, REACHABLE), (30, (0.9, -0.2, 1.2))):
            self.goal.location = place
            self.goal.keyframe_insert("location", frame=frame)

    def link_action(self, obj):
        """Let an object play its own action from a library; returns it."""
        action, slot = obj.animation_data.action, self.actions.slot_identifier(obj)
        library = str(self.folder / f"{obj.name}.blend")
        bpy.data.libraries.write(library, {action}, fake_user=True)
        bpy.data.actions.remove(action)
        with bpy.data.libraries.load(library, link=True) as (found, chosen):
            chosen.actions = found.actions
        self.actions.assign(obj, chosen.actions[0], slot)
        return chosen.actions[0]

    def keys_of(self, action):
        return [
            (curve.data_path, curve.array_index, [tuple(point.co) for point in curve.keyframe_points])
            for curves in self.actions.all_fcurves(action)
            for curve in curves
        ]

    def assertCopied(self, obj, linked):
        action = obj.animation_data.action
        self.assertIsNone(action.library)
        self.assertNotEqual(action, linked)
        self.assertNotEqual(self.keys_of(action), self.keys_of(linked))


class Matching(LinkedActionTestCase):
    def setUp(self):
        super().setUp()
        self.linked = self.link_action(self.rigged)

    def test_bones(self):
        self.reach()
        wanted, before = self.recorded(self.rigged), self.keys_of(self.linked)
        self.match("fk_match_ik", switch=True, **RANGE)
        self.assertRecorded(self.rigged, wanted)
        self.assertCopied(self.rigged, self.linked)
        self.assertEqual(self.keys_of(self.linked), before)
        path = str(self.folder / "matched.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        self.scene = bpy.context.scene
        self.assertRecorded(bpy.data.objects["Rig"], wanted)

    def test_weights_over_a_part(self):
        self.reach()
        wanted = self.recorded(self.rigged, range(10, 21))
        self.match("fk_match_ik", switch=True, frame_start=10, frame_end=20)
        self.assertRecorded(self.rigged, wanted)
        self.assertCopied(self.rigged, self.linked)

    def test_an_action_that_is_overridden(self):
        self.reach()
        slot = self.actions.slot_identifier(self.rigged)
        overridden = self.linked.override_create()
        self.actions.assign(self.rigged, overridden, slot)
        wanted = self.recorded(self.rigged)
        self.match("fk_match_ik", switch=True, **RANGE)
        self.assertRecorded(self.rigged, wanted)
        self.assertIsNone(self.rigged.animation_data.action.override_library)
        self.assertCopied(self.rigged, overridden)

    def test_targets(self):
        wanted = self.recorded(self.rigged)
        linked = self.link_action(self.goal)
        before = self.keys_of(linked)
        self.reach()
        self.match("ik_match_fk", **RANGE)
        self.assertRecorded(self.rigged, wanted, 2e-5)
        self.assertCopied(self.goal, linked)
        self.assertEqual(self.keys_of(linked), before)
        self.assertEqual(self.rigged.animation_data.action, self.linked, "nothing of the rig is keyed")

    def test_cancelled(self):
        self.link_action(self.goal)
        self.reach()
        jobs = support.addon("ik.matching.job")
        before = [(obj.animation_data.action, self.actions.slot_identifier(obj), state_of(obj)) for obj in (self.rigged, self.goal)]
        count = len(bpy.data.actions)
        for job in (jobs.match_fk, jobs.match_ik):
            steps = job(bpy.context, self.rigged, "", list(range(1, 31)), True, {})
            for _ in range(32):  # how many steps there are, then the frames, then into the writing
                next(steps)
            self.assertGreater(len(bpy.data.actions), count)
            steps.close()
            self.assertEqual(len(bpy.data.actions), count)
            self.assertEqual(
                [(obj.animation_data.action, self.actions.slot_identifier(obj), state_of(obj)) for obj in (self.rigged, self.goal)], before
            )


class Others(LinkedActionTestCase):
    def test_switching_the_target(self):
        linked, entry = self.link_action(self.rigged), self.reach()
        self.target((0.5, 0.5, 1.2), "Other")
        wanted = self.poses(self.rigged, 9)
        self.assertEqual(
            bpy.ops.motus.ik_switch_target(object="Rig", bone="Bone 1", target="Other", frame_start=10, frame_end=20), {'FINISHED'}
        )
        self.assertSamePose(self.rigged, wanted, frame=9)
        self.assertNear(self.tail(self.rigged, frame=20), (0.5, 0.5, 1.2))
        self.assertCopied(self.rigged, linked)
        self.assertEqual(len(entry.extra_targets), 1)

    def test_dragging_with_automatic_keys(self):
        linked = self.link_action(self.goal)
        before = self.keys_of(linked)
        self.reach()
        self.scene.tool_settings.use_keyframe_insert_auto = True
        self.scene.frame_set(12)
        place = (0.7, 0.1, 1.35)
        self.assertEqual(bpy.ops.motus.ik_drag(object="Rig", bone="Bone 1", location=place), {'FINISHED'})
        self.assertNear(self.tail(self.rigged, frame=12), place, 2e-5)
        self.assertCopied(self.goal, linked)
        self.assertEqual(self.keys_of(linked), before)

    def test_an_override(self):
        self.reach()
        library = str(self.folder / "library.blend")
        bpy.data.libraries.write(library, {self.rigged, self.goal}, fake_user=True)
        bpy.data.batch_remove([self.rigged, self.goal, *bpy.data.actions])
        with bpy.data.libraries.load(library, link=True) as (_, chosen):
            chosen.objects = ["Rig", "Target"]
        for obj in chosen.objects:
            self.scene.collection.objects.link(obj.override_create(remap_local_usages=True))
        rig = bpy.data.objects["Rig", None]
        linked = rig.animation_data.action
        self.assertIsNotNone(linked.library)
        wanted = self.recorded(rig)
        self.match("fk_match_ik", switch=True, **RANGE)
        self.assertRecorded(rig, wanted)
        self.assertCopied(rig, linked)
        path = str(self.folder / "matched.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        self.scene = bpy.context.scene
        self.assertRecorded(bpy.data.objects["Rig", None], wanted)
