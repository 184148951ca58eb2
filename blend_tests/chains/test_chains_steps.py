"""A motion that takes long is solved in steps: what was there stays shown meanwhile, and who reads a frame waits."""

import time
import types
import unittest.mock

import bpy
import numpy as np

import support
from chains import chain_cases as cases

FRAME = 30


class Steps(support.SceneTestCase):
    """As in a window, in an evaluation that has no time."""

    def setUp(self):
        super().setUp()
        self.steps = support.addon("chains.steps")
        app = types.SimpleNamespace(background=False, timers=bpy.app.timers)
        for name, value in (("bpy", types.SimpleNamespace(app=app, data=bpy.data)), ("AT_FIRST", 0.0)):
            patch = unittest.mock.patch.object(self.steps, name, value)
            patch.start()
            self.addCleanup(patch.stop)
        self.addCleanup(self.steps.unregister)
        self.rig = cases.rope(6)
        cases.key(self.rig, "location", {1: (0.0, 0.0, 0.0), 20: (1.0, 0.0, 0.0)})
        self.names = cases.chain(self.rig)

    def shown(self, frame=FRAME):
        """Where the tails of the bones are shown on a frame."""
        bpy.context.scene.frame_set(frame)
        rig = self.rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
        return np.array([rig.matrix_world @ rig.pose.bones[name].tail for name in self.names])

    def read(self, frame=FRAME):
        support.addon("core.blender.frames").go_to(bpy.context.scene, frame)
        return self.shown(frame)

    def go_on(self):
        """The timer, until it ends."""
        self.assertTrue(bpy.app.timers.is_registered(self.steps._go_on))
        for _ in range(1000):
            if self.steps._go_on() is None:
                break
        bpy.context.view_layer.update()

    def test_the_animation_is_shown_until_it_is_solved(self):
        animated = self.shown()
        cases.add(self.rig, frequency=1.0)
        np.testing.assert_allclose(self.shown(), animated, atol=1e-5)
        self.assertLess(self.steps.done(self.rig), 1.0)
        self.go_on()
        self.assertIsNone(self.steps.done(self.rig))
        solved = self.shown()
        self.assertGreater(np.abs(solved - animated).max(), 0.05)
        np.testing.assert_array_equal(self.read(), solved)

    def test_the_former_motion_is_shown_until_it_is_solved(self):
        (entry,) = cases.add(self.rig, frequency=1.0)
        former, later = self.read(), self.read(FRAME + 5)
        entry.frequency = 3.0
        np.testing.assert_array_equal(self.shown(), former)
        np.testing.assert_array_equal(self.shown(FRAME + 5), later)
        self.go_on()
        self.assertGreater(np.abs(self.shown() - former).max(), 0.01)

    def test_who_reads_a_frame_waits(self):
        cases.add(self.rig, frequency=1.0, settle=5.0)
        self.shown()
        self.assertIsNotNone(self.steps.done(self.rig))
        read = self.read()
        self.assertIsNone(self.steps.done(self.rig))
        np.testing.assert_array_equal(self.shown(), read)

    def test_a_loop_is_solved_whole(self):
        self.rig.animation_data_clear()
        cases.add(self.rig, frequency=1.0, use_loop=True)
        self.shown()
        self.assertEqual(self.steps.done(self.rig), 0.0)
        self.go_on()
        self.assertIsNone(self.steps.done(self.rig))

    def test_nobody_waits_for_who_solves(self):
        """A motion that a different thread is solving, such as a render's, is as good as unfinished."""
        cases.add(self.rig, frequency=1.0)
        self.shown()
        (_, unfinished), *_ = self.steps._unfinished.items()
        with unfinished.moved._lock:
            begun = time.perf_counter()
            self.assertIsNone(unfinished.moved.places(unfinished.seconds, 0.0))
            self.assertIsNone(unfinished.moved.places(unfinished.seconds, 0.01))
            self.assertLess(time.perf_counter() - begun, 5.0)

    def test_a_rig_that_is_gone_ends_the_timer(self):
        cases.add(self.rig, frequency=1.0)
        self.shown()
        bpy.data.objects.remove(self.rig)
        self.assertIsNone(self.steps._go_on())
