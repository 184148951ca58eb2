"""Keys that go into layers: the pose that is seen is keyed, and seen again, whatever lies above and below."""

import itertools

import bpy
from mathutils import Quaternion, Vector

import support
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

    def test_a_layer_that_is_compared_with_a_different_action(self):
        turning("Other", {"UpperArm.L": (0.5, 0.2, 0.1), "LowerArm.L": (0.1, 0.4, 0.2)})
        mine = turning("Mine", {"UpperArm.L": (0.3, 0.2, 0.0)})
        keywords = {"mode": 'ADDITIVE', "reference": 'ACTION', "reference_action": "Other", "reference_frame": 16.0}
        self.add(action=mine.name, bones="Chest", weight=0.5, **keywords)
        self.go_to(8)
        bend(self.rig, ARM)
        bpy.context.view_layer.update()
        wanted = self.seen()
        self.key()
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


class Editing(KeyingTestCase):
    def edit(self, layer=""):
        self.assertEqual(bpy.ops.motus.layer_edit(object="Rig", layer=layer), {'FINISHED'})
        bpy.context.view_layer.update()

    def insert(self, bone, frame=None):
        """Insert a key as Blender's own operator does."""
        options = {} if frame is None else {"frame": frame}
        self.assertTrue(self.rig.pose.bones[bone].keyframe_insert("rotation_quaternion", **options))

    def test_what_is_seen_stays_and_the_rig_comes_back_as_it_was(self):
        self.rig.pose.bones["Head"].location = (0.1, 0.2, 0.3)
        below = turning("Below", {"UpperArm.L": (0.2, 0.0, 0.3)})
        for mode, weight, steady in itertools.product(('OVERRIDE', 'ADDITIVE'), (0.3, 1.0), (False, True)):
            with self.subTest(mode=mode, weight=weight, steady=steady):
                self.add(action=below.name, bones="Chest", weight=0.5)
                self.add(bones="Chest", mode=mode, reference='REST', in_armature=steady, weight=weight, start=4.0, speed=0.5)
                self.add(action=below.name, bones="UpperArm.L", weight=0.3)
                wanted = {}
                for frame in (8, 12.5, 30, 2):
                    self.go_to(frame)
                    wanted[frame] = self.seen()
                own = [tuple(tuple(row) for row in bone.matrix_basis) for bone in self.rig.pose.bones]
                slot = self.actions.slot_identifier(self.rig)
                self.edit("Throw")
                self.assertEqual(self.rig.animation_data.action, self.throw)
                self.assertTrue(self.rig.animation_data.use_tweak_mode)
                for frame, poses in wanted.items():
                    self.go_to(frame)
                    self.assertSeen(poses, f"edited {frame}")
                self.edit("Throw")
                self.assertEqual(self.rig.animation_data.action, self.walk)
                self.assertEqual(self.actions.slot_identifier(self.rig), slot)
                self.assertFalse(self.rig.animation_data.nla_tracks)
                self.assertFalse(self.rig.motus.layers.kept_channels)
                self.assertEqual([tuple(tuple(row) for row in bone.matrix_basis) for bone in self.rig.pose.bones], own)
                for frame, poses in wanted.items():
                    self.go_to(frame)
                    self.assertSeen(poses, f"left {frame}")
                while self.rig.motus.layers.entries:
                    bpy.ops.motus.layer_remove(object="Rig")

    def test_keys_by_hand_go_into_the_layer_and_are_seen_again(self):
        for mode in ('OVERRIDE', 'ADDITIVE'):
            mine = turning("Mine", {"UpperArm.L": (0.3, 0.2, 0.0)})
            entry = self.add(action=mine.name, bones="Chest", mode=mode, reference='REST', start=3.0)
            entry.mask[0].weight = 0.3
            self.add(bones="UpperArm.L", weight=0.3)
            self.edit(entry.name)
            self.go_to(9)
            bend(self.rig, ("UpperArm.L",), 0.4)
            bpy.context.view_layer.update()
            wanted = self.seen()
            self.insert("UpperArm.L")
            for layer_is_edited in (True, False):
                self.go_to(5)
                self.go_to(9)
                self.assertSeen(wanted, f"{mode} {layer_is_edited}")
                if layer_is_edited:
                    self.edit(entry.name)
            curves = next(iter(self.actions.all_fcurves(mine)))
            self.assertEqual({point.co.x for curve in curves for point in curve.keyframe_points}, {1.0, 7.0, 11.0, 21.0})
            while self.rig.motus.layers.entries:
                bpy.ops.motus.layer_remove(object="Rig")

    def test_keys_by_hand_take_bones_into_a_layer_without_keys(self):
        for mode, weight, steady in itertools.product(('OVERRIDE', 'ADDITIVE'), (0.3, 1.0), (False, True)):
            with self.subTest(mode=mode, weight=weight, steady=steady):
                before = {}
                for frame in (9, 5):
                    self.go_to(frame)
                    before[frame] = self.seen()
                self.assertEqual(bpy.ops.motus.layer_new(object="Rig", bones="Chest", mode=mode), {'FINISHED'})
                entry = self.rig.motus.layers.entries[-1]
                entry.mask[0].weight, entry.in_armature = weight, steady
                self.edit()
                for frame, poses in before.items():
                    self.go_to(frame)
                    self.assertSeen(poses, f"nothing {frame}")
                self.go_to(9)
                bend(self.rig, ARM, 0.4)
                bpy.context.view_layer.update()
                wanted = self.seen()
                self.assertNotEqual(wanted["LowerArm.L"], before[9]["LowerArm.L"])
                for name in ARM:
                    self.insert(name)
                self.go_to(5)
                self.go_to(9)
                self.assertSeen(wanted, "edited")
                self.edit()
                self.go_to(5)
                self.go_to(9)
                self.assertSeen(wanted, "left")
                actions = set(bpy.data.actions.keys())
                bpy.ops.motus.layer_remove(object="Rig")
                bpy.data.actions.remove(bpy.data.actions["Rig Layer"])
                self.assertEqual(actions - set(bpy.data.actions.keys()), {"Rig Layer"})
                self.assertFalse([name for name in actions if name.startswith("Walk.")])

    def test_poses_are_keyed_into_an_edited_layer(self):
        mine = turning("Mine", {"UpperArm.L": (0.3, 0.2, 0.0)})
        entry = self.add(action=mine.name, bones="Chest", mode='ADDITIVE', reference='REST')
        self.edit()
        self.go_to(9)
        bend(self.rig, ARM)
        bpy.context.view_layer.update()
        wanted = self.seen()
        self.key(entry.name)
        self.go_to(9)
        self.assertSeen(wanted, "edited")
        self.edit()
        self.go_to(9)
        self.assertSeen(wanted, "left")

    def test_keys_beyond_the_action_stay_at_their_frames(self):
        entry = self.add(bones="UpperArm.L", start=11.0, speed=-1.0)
        self.edit()
        self.assertTrue(entry.use_range)
        (curve, *_) = next(iter(self.actions.all_fcurves(self.throw)))
        for frame in (-9.0, 24.0):
            curve.keyframe_points.insert(frame, 0.0)
        self.edit()
        self.assertFalse(entry.use_range)
        self.assertEqual((tuple(self.throw.frame_range), entry.start), ((-9.0, 24.0), 8.0))

    def test_a_file_that_is_saved_while_a_layer_is_edited(self):
        self.add(bones="UpperArm.L", weight=0.5)
        self.go_to(8)
        wanted = self.seen()
        self.edit()
        path = self.save()
        bpy.ops.wm.open_mainfile(filepath=path)
        self.rig = bpy.data.objects["Rig"]
        self.go_to(3)
        self.go_to(8)
        self.assertSeen(wanted, "opened")
        self.edit()
        self.assertEqual(self.rig.animation_data.action.name, "Walk")
        self.go_to(8)
        self.assertSeen(wanted, "left")

    def test_removing_an_edited_layer_and_leaving_by_the_nla_editor(self):
        for by_hand in (False, True):
            self.add(bones="UpperArm.L")
            self.go_to(8)
            self.edit()
            if by_hand:
                self.rig.animation_data.use_tweak_mode = False
            self.assertEqual(support.addon("layers.live").was_left(self.rig), by_hand)
            self.assertEqual(bpy.ops.motus.layer_remove(object="Rig"), {'FINISHED'})
            self.assertEqual(self.rig.animation_data.action, self.walk)
            self.assertFalse(self.rig.animation_data.nla_tracks)
            walk = self.played(self.walk, 8)
            self.go_to(8)
            self.assertSeen(walk)

    def test_poses_made_after_the_nla_editor_was_used_to_leave_are_kept(self):
        self.rig.animation_data_clear()
        head, arm = self.rig.pose.bones["Head"], self.rig.pose.bones["UpperArm.L"]
        for mode in ('OVERRIDE', 'ADDITIVE'):
            with self.subTest(mode=mode):
                head.location, arm.location = (0.1, 0.2, 0.3), (0.0, 0.4, 0.0)
                own = tuple(arm.rotation_quaternion)
                self.add(mode=mode, reference='REST')
                self.go_to(8)
                self.edit()
                self.rig.animation_data.use_tweak_mode = False
                self.go_to(9)
                head.location = (0.7, 0.0, 0.0)
                self.edit()
                self.go_to(10)
                self.assertEqual(tuple(head.location), tuple(Vector((0.7, 0.0, 0.0))))
                self.assertEqual(tuple(arm.rotation_quaternion), own)  # which the layer's action animates
                self.assertEqual(tuple(arm.location), tuple(Vector((0.0, 0.4, 0.0))))
                self.assertEqual(bpy.ops.motus.layer_remove(object="Rig"), {'FINISHED'})

    def test_clearing_the_animation_ends_the_editing(self):
        for is_left in (False, True):
            for operator in ("layer_edit", "layer_remove"):
                with self.subTest(is_left=is_left, operator=operator):
                    entry = self.add(bones="UpperArm.L")
                    self.go_to(8)
                    self.edit()
                    if is_left:
                        self.rig.animation_data.use_tweak_mode = False
                    self.rig.animation_data_clear()
                    self.go_to(9)
                    self.assertEqual(getattr(bpy.ops.motus, operator)(object="Rig"), {'FINISHED'})
                    self.assertFalse(self.rig.motus.layers.kept_channels)
                    if operator == "layer_edit":
                        self.assertFalse(entry.is_edited)
                        self.edit()
                        self.edit()
                        bpy.ops.motus.layer_remove(object="Rig")
                    self.assertEqual([one.name for one in self.rig.motus.layers.entries], [])

    def test_editing_is_one_step_of_undo(self):
        self.add(bones="UpperArm.L")
        bpy.ops.ed.undo_push(message="before")
        self.edit()
        bpy.ops.ed.undo_push(message="edited")
        bpy.ops.ed.undo()
        rig = bpy.data.objects["Rig"]
        self.assertEqual((rig.animation_data.action.name, len(rig.animation_data.nla_tracks)), ("Walk", 0))
        self.assertFalse(rig.motus.layers.entries[0].is_edited)
        bpy.ops.ed.redo()
        rig = bpy.data.objects["Rig"]
        self.assertEqual((rig.animation_data.action.name, rig.animation_data.use_tweak_mode), ("Throw", True))
        self.rig = rig
        self.edit()
        self.assertEqual(rig.animation_data.action.name, "Walk")

    def test_library_overrides(self):
        path = self.save()
        self.rig = self.load(path, True, "Rig").override_create(remap_local_usages=True)
        bpy.context.view_layer.update()
        bpy.context.view_layer.update()
        self.assertEqual(bpy.ops.motus.layer_new(object="Rig", bones="UpperArm.L", mode='ADDITIVE'), {'FINISHED'})
        self.go_to(8)
        bend(self.rig, ("UpperArm.L",))
        bpy.context.view_layer.update()
        wanted = self.seen()
        self.key(bones="UpperArm.L")
        self.go_to(3)
        self.go_to(8)
        self.assertSeen(wanted)
        self.assertRefused("is a library override", bpy.ops.motus.layer_edit, object="Rig")

    def test_strips_beneath_go_on(self):
        animation = self.rig.animation_data
        action, slot = animation.action, self.actions.slot_identifier(self.rig)
        strip = animation.nla_tracks.new().strips.new("Walk", 1, action)
        if slot:
            strip.action_slot = action.slots[slot]
        strip.influence = 0.5
        animation.action = None
        self.add(bones="Chest", weight=0.6)
        self.go_to(8)
        wanted = self.seen()
        self.edit()
        self.go_to(8)
        self.assertSeen(wanted, "edited")
        self.edit()
        self.assertIsNone(animation.action)
        self.assertEqual(len(animation.nla_tracks), 1)
        self.go_to(8)
        self.assertSeen(wanted, "left")

    def test_refusals(self):
        entry = self.add(bones="UpperArm.L", speed=0.0)
        self.assertRefused("stands still", bpy.ops.motus.layer_edit, object="Rig")
        entry.speed = 1.0
        self.rig.pose.bones["UpperArm.L"].rotation_mode = 'XYZ'
        self.assertRefused("different rotation mode", bpy.ops.motus.layer_edit, object="Rig")
        self.rig.pose.bones["UpperArm.L"].rotation_mode = 'QUATERNION'
        self.edit()
        self.assertRefused("tweak mode", bpy.ops.motus.layer_duplicate, object="Rig")
        self.edit()
        entry.mode, entry.reference = 'ADDITIVE', 'REST'
        track = self.rig.animation_data.nla_tracks.new()
        track.strips.new("Walk", 1, self.walk)
        self.assertRefused("Strips of the NLA move bones", bpy.ops.motus.layer_edit, object="Rig")
        self.rig.animation_data.nla_tracks.remove(track)
        self.rig.animation_data.use_nla = False
        self.assertRefused("switched off", bpy.ops.motus.layer_edit, object="Rig")
        self.assertIsNone(self.actions.find(self.rig, "location"))
