"""A leg is said to be too short on exactly those frames on which its standing foot is not reached."""

import bpy
from mathutils import Matrix, Vector

import support
from walker import walker_cases as cases

HIGH = 0.56
"""m, of the body over the plane: the legs of a spider do not reach it all of the time."""
REACHED = 1e-4
"""m, between the end of a leg and its foot."""
LAST = 100


class Reach(cases.WalkerTestCase):
    def setUp(self):
        super().setUp()
        self.spider = cases.spider(ahead=0.0, use_plane=True, reach_down=2.0)
        support.key_places(self.spider, {1: (0.0, -2.0, HIGH), LAST: (0.0, 2.0, HIGH)})
        self.settings = self.spider.motus.walker
        self.settings.body_height = 0.0

    def lower(self, by, frame=None):
        """Move the body bone down, by its own location; with a frame it is keyed there."""
        body = self.spider.pose.bones["body"]
        body.location = body.bone.matrix_local.to_3x3().inverted() @ Vector((0.0, 0.0, -by))
        if frame is not None:
            body.keyframe_insert("location", frame=frame)

    def missed(self):
        """{(leg, frame)} of standing feet that are told to be too far, and of those that are."""
        told, seen = set(), set()
        fps = self.scene.render.fps / self.scene.render.fps_base
        for frame in range(1, LAST + 1):
            support.go_to(frame)
            walker = cases.plan_of(self.spider).walker
            swing = walker.swing(frame / fps)
            pose = self.spider.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones
            for leg, entry in enumerate(self.settings.legs):
                if swing[leg]:
                    continue
                if any(one == leg and first - 1e-9 <= frame / fps <= last + 1e-9 for one, first, last, _ in walker.problems):
                    told.add((leg, frame))
                if (pose[entry.name].head - pose[entry.name.replace("foot", "lower")].tail).length > REACHED:
                    seen.add((leg, frame))
        return told, seen

    def assert_right(self, is_missed):
        told, seen = self.missed()
        # Softness lets a leg that is nearly straight fall short of its foot a little, though it is long enough.
        self.assertEqual(told - seen, set())
        self.assertEqual((bool(told), bool(seen)), (is_missed, is_missed))

    def harden(self):
        for entry in self.spider.motus.ik.entries:
            entry.softness = 0.0

    def test_a_high_body(self):
        self.harden()
        told, seen = self.missed()
        self.assertEqual(told, seen)
        self.assertTrue(told)

    def test_a_body_bone_that_was_lowered(self):
        self.harden()
        self.lower(0.3)
        self.assert_right(is_missed=False)

    def test_a_body_bone_whose_parts_are_moved_at_rest(self):
        """How a body bone moves its children depends on where it rests."""
        body = self.spider.pose.bones["body"]
        body.rotation_mode = 'XYZ'
        body.rotation_euler.x = 0.4
        bpy.context.view_layer.update()
        before = cases.plan_of(self.spider).stamp
        bpy.context.view_layer.objects.active = self.spider
        bpy.ops.object.mode_set(mode='EDIT')
        for end in ("head", "tail"):
            getattr(self.spider.data.edit_bones["body"], end).y += 0.2
        bpy.ops.object.mode_set(mode='OBJECT')
        bpy.context.view_layer.update()
        self.assertNotEqual(cases.plan_of(self.spider).stamp, before)

    def test_a_body_bone_whose_keys_lower_it_on_the_way(self):
        self.harden()
        self.lower(0.0, 30)
        self.lower(0.3, 60)
        told, seen = self.missed()
        self.assertEqual(told, seen)
        self.assertTrue(told)
        self.assertLess(max(frame for _, frame in told), 60)

    def test_legs_that_stretch_reach(self):
        for entry in self.spider.motus.ik.entries:
            entry.stretch = 1.0
        support.go_to(2)
        self.assert_right(is_missed=False)

    def test_without_a_body_nothing_comes_down(self):
        self.harden()
        self.settings.body_height = 1.0
        self.settings.body_bone = ""
        told, seen = self.missed()
        self.assertEqual(told, seen)
        self.assertTrue(told)

    def test_a_body_that_is_scaled_unevenly(self):
        self.spider.matrix_world = Matrix.Diagonal((2.0, 1.0, 0.6, 1.0))
        told, seen = self.missed()
        self.assertEqual(told - seen, set())

    def test_the_sentence_names_frames_of_the_time_line(self):
        self.harden()
        told = support.addon("walker.told")
        found = []
        for stretch in (1, 3):
            self.scene.render.frame_map_old, self.scene.render.frame_map_new = 100, 100 * stretch
            sentence = told.sentence(bpy.context, self.spider, support.addon("walker.solve").UNREACHED)
            found.append([int(frame) for frame in sentence.split(" on frames ")[1].split(",")[0].split("-")])
        for plain, stretched in zip(*found):
            self.assertLess(abs(stretched - 3 * plain), 3, found)

    def test_the_sentence_names_frames_that_are_missed(self):
        self.harden()
        _, seen = self.missed()
        first, last = map(
            int,
            support.addon("walker.told")
            .sentence(bpy.context, self.spider, support.addon("walker.solve").UNREACHED)
            .split(" on frames ")[1]
            .split(",")[0]
            .split("-"),
        )
        leg = min(cases.plan_of(self.spider).walker.problems, key=lambda one: one[1])[0]
        self.assertTrue(all((leg, frame) in seen for frame in range(max(first, 1), last + 1)))
