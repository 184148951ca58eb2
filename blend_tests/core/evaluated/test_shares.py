"""All owners of a system in a scene share the work that it may do for a frame."""

from unittest import mock

import bpy

import support
from dynamics.dynamics_cases import add, link, moved, system


class SharesTest(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.balls = [moved(f"Ball {index}") for index in range(3)]

    def share(self, owner, of=None, mode='VIEWPORT'):
        """The share of an owner in the next evaluation."""
        owner.update_tag()
        bpy.context.view_layer.update()
        depsgraph = mock.Mock(mode=mode, scene=bpy.context.evaluated_depsgraph_get().scene)
        return support.addon("core.evaluated.shares").share_of(of or system(), owner, depsgraph)

    def test_one_has_all(self):
        add(self.balls[0])
        self.assertEqual(self.share(self.balls[0]), 1.0)

    def test_owners_share(self):
        for ball in self.balls:
            add(ball)
        self.assertEqual([self.share(ball) for ball in self.balls], [0.25] * 3)
        self.balls[1].hide_viewport = True
        self.assertEqual(self.share(self.balls[0]), 0.25, "hidden ones may be shown on the next frame")
        bpy.data.objects.remove(self.balls[1])
        self.assertEqual(self.share(self.balls[0]), 0.5)

    def test_in_proportion_to_their_entries(self):
        for ball in self.balls[:2]:
            add(ball)
        for path in ("rotation_euler", "scale", "delta_location"):
            self.balls[0].keyframe_insert(path, frame=1)
            add(self.balls[0], data_path=path)
        self.assertEqual(len(self.balls[0].motus.dynamics.entries), 4)
        self.assertEqual([self.share(ball) for ball in self.balls[:2]], [0.5, 0.125])

    def test_shares_are_no_more_than_all(self):
        """Whatever the numbers of entries are."""
        for count, ball in enumerate(self.balls):
            for path in ("location", "rotation_euler", "scale")[: count + 1]:
                ball.keyframe_insert(path, frame=1)
                add(ball, data_path=path)
        self.assertLessEqual(sum(map(self.share, self.balls)), 1.0)

    def test_different_systems_and_scenes_count_apart(self):
        add(self.balls[0])
        bpy.ops.motus.pendulum_add()
        other = link("Other")
        scene = bpy.data.scenes.new("Second")
        scene.collection.objects.link(other)
        bpy.context.scene.collection.objects.unlink(other)
        other.motus.dynamics.is_active = True
        self.assertEqual(self.share(self.balls[0]), 1.0)

    def test_an_owner_that_comes_counts_on_the_next_frame(self):
        """Blender tells nobody of an edit before it evaluates a different frame."""
        shares, declare = support.addon("core.evaluated.shares"), support.addon("core.declare")
        add(self.balls[0])
        self.assertEqual(self.share(self.balls[0]), 1.0)
        wiring = support.addon("core.wiring")
        entry = self.balls[1].motus.dynamics.entries.add()
        entry.name = ""
        wiring.attach(system(), self.balls[1])
        self.assertTrue(declare.is_owner(system(), self.balls[1]))
        depsgraph = mock.Mock(mode='VIEWPORT', scene=bpy.context.evaluated_depsgraph_get().scene)
        bpy.context.scene.frame_set(7)
        self.assertEqual(shares.share_of(system(), self.balls[0], depsgraph), 0.5)

    def test_playback_sums_nothing(self):
        for ball in self.balls:
            add(ball)
        bpy.context.scene.frame_set(3)
        shares = support.addon("core.evaluated.shares")
        with mock.patch.object(shares, "_sum", wraps=shares._sum) as summed:
            for frame in (5, 900, 1):
                bpy.context.scene.frame_set(frame)
        summed.assert_not_called()

    def test_renders_wait_for_everything(self):
        for ball in self.balls:
            add(ball)
        self.assertEqual(self.share(self.balls[0], mode='RENDER'), 1.0)

    def test_systems_without_a_limit(self):
        for ball in self.balls:
            add(ball)
        self.assertEqual(self.share(self.balls[0], support.addon("core.declare").registered["ik"]), 1.0)
