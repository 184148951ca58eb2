"""What is kept to be found again: its bounds, when it is let go, and that results are the same with nothing kept."""

import threading
from unittest import mock

import bpy

import live_scenes
import support

keeping = support.addon("core.keeping")


class Latest(support.SceneTestCase):
    @support.in_one_blender
    def test_no_more_than_the_bound(self):
        for most in (1, 3, 10):
            kept = keeping.Latest(most)
            for number in range(25):
                kept.add(number, -number)
            self.assertEqual(kept.items(), [(number, -number) for number in range(25 - most, 25)])

    @support.in_one_blender
    def test_no_larger_than_the_bound_but_for_the_newest(self):
        kept = keeping.Latest(most_size=10, size=lambda key, value: value)
        for key, value in (("a", 4), ("b", 3), ("c", 3)):
            kept.add(key, value)
        self.assertEqual(len(kept), 3)
        kept.add("b", 4)
        self.assertEqual(kept.items(), [("c", 3), ("b", 4)])
        kept.add("huge", 100)
        self.assertEqual(kept.items(), [("huge", 100)])
        kept.drop("huge")
        for key in "xyz":
            kept.add(key, 3)
        self.assertEqual(len(kept), 3)

    @support.in_one_blender
    def test_what_is_in_use_stays(self):
        made, kept = [], keeping.Latest(8)
        for number in range(100):
            kept.made(number, lambda: None)
            kept.made("in use", lambda: made.append(1))
        self.assertEqual(made, [1])

    @support.in_one_blender
    def test_nothing_found_is_kept_too(self):
        made, kept = [], keeping.Latest(8)
        for _ in range(3):
            self.assertIsNone(kept.made("none", lambda: made.append(1)))
        self.assertEqual(made, [1])

    @support.in_one_blender
    def test_threads_share_it(self):
        kept, errors = keeping.Latest(16, 64, lambda key, value: value), []

        def work(seed):
            try:
                for number in range(2000):
                    key = (seed * number) % 37
                    if kept.made(key, lambda key=key: key % 5) != key % 5:
                        errors.append(key)
                    if number % 11 == 0:
                        kept.drop(key)
            except Exception as error:
                errors.append(error)

        threads = [threading.Thread(target=work, args=(seed,)) for seed in (3, 5, 7, 11)]
        for one in threads:
            one.start()
        for one in threads:
            one.join()
        self.assertEqual(errors, [])
        self.assertEqual(kept._size, sum(value for _, value in kept.items()))
        self.assertLessEqual(len(kept), 16)


class Lifetimes(support.SceneTestCase):
    def test_of_a_file_and_of_the_process(self):
        for kind in (keeping.OfFile, keeping.OfProcess):
            self.assertGreater(len(kind.declarations()), 4)
            for one in kind.declarations():
                one.add("test", None) if one._size_of is None else one._values.update(test=None)
        support.empty_scene()
        for one in keeping.OfFile.declarations():
            self.assertNotIn("test", dict(one.items()), one.what)
        for one in keeping.OfProcess.declarations():
            self.assertIn("test", dict(one.items()), one.what)
        self.addCleanup(support.enable)
        support.disable()
        for one in keeping.OfProcess.declarations():
            self.assertEqual(len(one), 0, one.what)

    @support.in_one_blender
    def test_of_threads(self):
        arrays, plans = (one for one in keeping.OfThread.declarations()[:2])
        with mock.patch.object(keeping, "_threads", {}), mock.patch.object(keeping.threading, "get_ident") as thread:
            for thread.return_value in range(3 * keeping.MOST_THREADS):
                arrays.here().add("test", thread.return_value)
                self.assertIsNone(plans.here().get("test"))
                self.assertLessEqual(len(keeping._threads), keeping.MOST_THREADS)
            self.assertEqual(arrays.here().get("test"), thread.return_value)
            arrays.clear()
            self.assertIsNone(arrays.here().get("test"))

    @support.in_one_blender
    def test_aside(self):
        arrays = keeping.OfThread.declarations()[0]
        arrays.here().add("test", 1)
        with keeping.aside():
            self.assertIsNone(arrays.here().get("test"))
            arrays.here().add("test", 2)
        self.assertEqual(arrays.here().get("test"), 1)
        arrays.clear()

    def test_each_says_what_it_is(self):
        for one in keeping.declared:
            with self.subTest(one.what):
                self.assertTrue(all((one.what, one.key, one.bound, one.until, one.module)))
                self.assertNotIn("|", one.what + one.key + one.bound + one.until)
                self.assertIn(one.lifetime, [kind.lifetime for kind in keeping.LIFETIMES])
        self.assertEqual(len({(one.what, one.module) for one in keeping.declared}), len(keeping.declared))


class Same(support.SceneTestCase):
    def test_results_are_the_same_with_nothing_kept(self):
        live_scenes.opened()
        before = live_scenes.states()
        motus, forgotten = support.addon(), []

        def forget(*_):
            motus.forget_all()
            forgotten.append(1)

        bpy.app.handlers.frame_change_pre.append(forget)
        self.addCleanup(lambda: forget in bpy.app.handlers.frame_change_pre and bpy.app.handlers.frame_change_pre.remove(forget))
        after = live_scenes.states()
        self.assertGreaterEqual(len(forgotten), len(live_scenes.FRAMES))
        for frame, found in before.items():
            self.assertEqual(support.differ(after[frame], found, 0.0), set(), f"on frame {frame}")
