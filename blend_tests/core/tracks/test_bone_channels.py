"""The stamp of the own transforms of many bones: it changes with every edit that may move one of them, and not with the frame."""

import bpy

import support
from core.tracks.track_cases import TrackTestCase

NAMES = "Bone.1", "Bone.2"


class BoneChannels(TrackTestCase):
    is_marked = True
    """Whether the rig has the marker by which evaluated copies are told apart, as those that Motus moves have."""

    def setUp(self):
        super().setUp()
        self.channels, self.actions = support.addon("core.tracks.bone_channels"), support.addon("core.blender.actions")
        self.rig_object = self.rig()
        if self.is_marked:
            support.addon("core.evaluated.copies").mark(self.rig_object, self.rig_object.data)
        self.bone = self.rig_object.pose.bones["Bone.1"]
        self.key(self.rig_object, 'pose.bones["Bone.1"].location', index=0)
        self.go_to(5)

    def stamp(self, names=NAMES):
        bpy.context.view_layer.update()
        return self.channels.stamp(self.evaluated(self.rig_object), names)

    def assert_changes(self, what, edit):
        with self.subTest(what):
            before = self.stamp()
            self.assertIsNotNone(before)
            edit()
            self.assertNotEqual(self.stamp(), before)

    def test_it_stays_while_frames_pass(self):
        before = self.stamp()
        for frame in (30, 2.5, 61):
            self.go_to(frame)
            self.assertEqual(self.stamp(), before)

    def test_it_stays_with_edits_of_other_things(self):
        before = self.stamp()
        self.rig_object.location.x = 3.0
        self.rig_object.data.update_tag()
        self.rig_object.pose.bones["Bone.3"].location.y = 3.0
        self.assertEqual(self.stamp(), before)

    def test_it_changes_with_every_property(self):
        for name, size in self.channels.SIZES.items():
            if size > 1:
                for index in range(size):
                    if (name, index) != ("location", 0):  # that has keys
                        values = getattr(self.bone, name)
                        self.assert_changes(
                            f"{name} {index}", lambda values=values, index=index: values.__setitem__(index, values[index] + 0.25)
                        )
        self.assert_changes("rotation mode", lambda: setattr(self.bone, "rotation_mode", 'ZYX'))

    def test_it_changes_with_keys(self):
        curve = self.actions.find(self.rig_object, 'pose.bones["Bone.1"].location', 0)

        def move():
            curve.keyframe_points[-1].co[1] += 0.5
            curve.update()

        self.assert_changes("a key", move)
        self.assert_changes("another number", lambda: self.bone.keyframe_insert("location", index=2, frame=3))
        self.assert_changes("a muted curve", lambda: setattr(curve, "mute", True))
        self.assert_changes("what a muted curve has left", lambda: setattr(self.bone.location, "x", 9.0))

    def test_it_changes_with_the_rest_pose(self):
        def lengthen():
            bpy.context.view_layer.objects.active = self.rig_object
            bpy.ops.object.mode_set(mode='EDIT')
            self.rig_object.data.edit_bones["Bone.2"].tail.x += 0.5
            bpy.ops.object.mode_set(mode='OBJECT')

        self.assert_changes("rest pose", lengthen)

    def test_bones_that_more_than_keys_move(self):
        for what, edit, undo in (
            (
                "a driver",
                lambda: self.bone.driver_add("scale", 1),
                lambda: self.bone.driver_remove("scale", 1),
            ),
            (
                "keys of the rotation mode",
                lambda: self.bone.keyframe_insert("rotation_mode", frame=1),
                lambda: self.bone.keyframe_delete("rotation_mode", frame=1),
            ),
            (
                "an NLA strip",
                lambda: self.rig_object.animation_data.nla_tracks.new().strips.new("Strip", 1, self.rig_object.animation_data.action),
                lambda: self.rig_object.animation_data.nla_tracks.remove(self.rig_object.animation_data.nla_tracks[0]),
            ),
        ):
            with self.subTest(what):
                self.assertIsNotNone(self.stamp())
                edit()
                self.rig_object.update_tag()
                self.assertIsNone(self.stamp())
                undo()
                self.rig_object.update_tag()

    def test_bones_whose_edits_are_not_seen(self):
        """Those of an original."""
        self.assertIsNone(self.channels.stamp(self.rig_object, NAMES))


class BoneChannelsOfOthers(BoneChannels):
    """Of a rig that Motus only reads, such as one that chains touch."""

    is_marked = False
