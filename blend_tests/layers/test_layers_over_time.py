"""Where bones under layers are at any times, as other systems ask for it."""

import bpy

import support
from layers.layer_cases import LayerTestCase

TIMES = (1.0, 7.0, 13.5, 21.0, 30.0)


class OverTime(LayerTestCase):
    def check(self, name, kind="SOLVED"):
        """The track of a bone's world matrix is what Blender makes of it on each frame."""
        tracks = support.addon("core.tracks")
        wanted = []
        for time in TIMES:
            self.go_to(time)
            wanted.append(self.pose(name))
        self.go_to(3)
        track = tracks.world_track(self.evaluated().pose.bones[name], self.scene)
        self.assertEqual(track.kind.name, kind, track.sentence)
        for time, matrix, found in zip(TIMES, wanted, track.values(TIMES)):
            worst = max(abs(found[row][column] - matrix[row][column]) for row in range(4) for column in range(4))
            self.assertLess(worst, 1e-5, f"{name} {time}")
        self.assertIsNotNone(track.stamp)

    def test_what_hangs_on_layers(self):
        entry = self.add(bones="Chest", feather=1, after='REPEAT')
        for frame, weight in ((1, 0.2), (30, 1.0)):
            entry.weight = weight
            entry.keyframe_insert("weight", frame=frame)
        for name in ("Chest", "LowerArm.L", "Head"):
            self.check(name)

    def test_steady_and_additive(self):
        self.add(bones="Chest", in_armature=True)
        self.add(bones="UpperArm.L", mode='ADDITIVE', weight=0.5)
        self.check("LowerArm.L")

    def test_no_other_times_are_known_while_a_layer_is_edited(self):
        tracks = support.addon("core.tracks")
        self.add(bones="Chest", mode='ADDITIVE', reference='REST')
        for kind, words in (("SOLVED", ""), ("RECORDED", "not known ahead"), ("SOLVED", "")):
            track = tracks.world_track(self.evaluated().pose.bones["LowerArm.L"], self.scene)
            self.assertEqual(track.kind.name, kind)
            self.assertIn(words, track.sentence)
            self.assertEqual(bpy.ops.motus.layer_edit(object="Rig"), {'FINISHED'})
            bpy.context.view_layer.update()

    def test_an_edited_action_changes_the_stamp(self):
        self.add(bones="Chest")
        tracks = support.addon("core.tracks")
        self.go_to(3)
        before = tracks.world_track(self.evaluated().pose.bones["Chest"], self.scene).stamp
        self.assertEqual(tracks.world_track(self.evaluated().pose.bones["Chest"], self.scene).stamp, before)
        for curve in self.actions.curves_for_object(self.throw):
            curve.keyframe_points[-1].co.y += 0.25
            curve.update()
        bpy.context.view_layer.update()
        self.assertNotEqual(tracks.world_track(self.evaluated().pose.bones["Chest"], self.scene).stamp, before)

    def test_dynamics_follow_what_layers_do(self):
        self.add(bones="Chest")
        self.assertEqual(bpy.ops.motus.dynamics_add(object="Rig", bones="Head", style='FLOPPY'), {'FINISHED'})
        bpy.context.view_layer.update()
        dynamics = support.addon("dynamics").SYSTEM
        problem = self.wiring.problem(dynamics, self.rig, bpy.context.evaluated_depsgraph_get())
        self.assertIsNone(problem)
        played = {}
        for frame in range(1, 30):
            self.go_to(frame)
            played[frame] = self.poses()
        for frame in (12, 3, 29, 20):
            self.go_to(frame)
            self.assertSamePoses(self.poses(), played[frame], 0.0)
