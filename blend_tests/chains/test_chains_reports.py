"""What users of add-ons for jiggle report of these, as tests of chains. Contacts and uneven scales are in test_chains_colliders.py."""

import sys

import bpy
import numpy as np

import support
from chains import chain_cases as cases
from dynamics import dynamics_cases

LAST = 60
PLAYED = range(1, LAST + 1)


def seen(rig, frames, bone="Tail 0 3"):
    return {frame: cases.matrix(rig, frame, bone) for frame in frames}


class ReportsTest(support.SceneTestCase):
    def assertSame(self, found, wanted):
        for frame, one in found.items():
            np.testing.assert_array_equal(one, wanted[frame], f"{frame}")

    @staticmethod
    def bake(rig, last):
        bpy.context.view_layer.objects.active = rig
        bpy.ops.motus.bake(frame_start=1, frame_end=last)

    def test_a_cycle_that_is_baked_closes(self):
        """Its last frame meets the first (Wiggle 2, issue 99)."""
        rig = cases.rope(4)
        rig.animation_data_clear()
        bpy.context.scene.frame_end = LAST
        cases.key(rig.pose.bones["Root"], "location", {1: (0.0, 0.0, 0.0), 20: (0.3, 0.1, 0.0), LAST + 1: (0.0, 0.0, 0.0)})
        cases.add(rig, frequency=1.0, damping=0.2, use_loop=True)
        self.assertIsNone(cases.problem(rig))
        self.bake(rig, LAST + 1)
        for name in cases.chain(rig):
            np.testing.assert_allclose(cases.matrix(rig, LAST + 1, name), cases.matrix(rig, 1, name), atol=1e-4)

    def test_settling_acts_without_a_loop(self):
        """What is called pre-roll elsewhere is not ignored there (Wiggle 2, issue 90)."""
        found = {}
        for settle in (0.0, 60.0):
            support.empty_scene()
            rig = cases.still_rope(4)
            pose = cases.tails(rig, 1, cases.chain(rig))
            cases.add(rig, frequency=0.0, drag=2.0, settle=settle)
            found[settle] = cases.tails(rig, 1, cases.chain(rig)) - cases.place(rig, 1, "Tail 0 0")
            if not settle:
                np.testing.assert_allclose(found[settle], pose - cases.place(rig, 1, "Tail 0 0"), atol=1e-5)
        np.testing.assert_allclose(found[60.0], [(0.0, 0.0, -cases.LENGTH * (index + 1)) for index in range(4)], atol=2e-3)

    def test_baked_is_as_played(self):
        """(Wiggle 2, issue 14)."""
        rig = cases.rope(4)
        cases.add(rig, frequency=0.7, damping=0.1)
        played = seen(rig, PLAYED)
        self.bake(rig, LAST)
        for frame, one in seen(rig, PLAYED).items():
            np.testing.assert_allclose(one, played[frame], atol=1e-5, err_msg=f"{frame}")

    def test_frames_that_are_dropped_or_gone_through_backwards(self):
        """They are those of playback (Wiggle 2, issues 32 and 98)."""
        rig = cases.rope(4)
        cases.add(rig, frequency=0.7, damping=0.1)
        played = seen(rig, PLAYED)
        for forget in (lambda: None, support.addon().forget_all):
            forget()
            self.assertSame(seen(rig, PLAYED[::7]), played)
            forget()
            self.assertSame(seen(rig, PLAYED[::-1]), played)

    def test_a_file_without_chains_pays_nothing_for_them(self):
        """Nothing of chains runs on a frame or after an edit (Wiggle 2, issue 98)."""
        rig = cases.rope(4)
        dynamics_cases.add(rig, bones="Tail 0 1")
        folder = support.addon("chains").__path__[0]
        called = []

        def note(frame, event, _):
            if event == "call" and frame.f_code.co_filename.startswith(folder):
                called.append(frame.f_code.co_name)

        def act():
            for frame in PLAYED:
                bpy.context.scene.frame_set(frame)
            rig.location.x = 1.0
            bpy.context.view_layer.update()

        sys.setprofile(note)
        try:
            self.assertEqual(cases.made(act), [])
        finally:
            sys.setprofile(None)
        self.assertEqual(called, [])
        lists = [getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)]
        handlers = [one for functions in lists if isinstance(functions, list) for one in functions]
        self.assertEqual([one for one in handlers if getattr(one, "__module__", "").startswith(support.addon("chains").__name__)], [])

    def test_a_single_bone_bounces_in_place_and_keeps_its_volume(self):
        """A belly that its parent throws up and down: it is never turned, and swings in length until it is at rest (Wiggle 2, issue 15)."""
        rig = cases.rope(1, tilt=0.0)
        rig.animation_data_clear()
        cases.key(
            rig.pose.bones["Root"], "location", {1: (0.0, 0.0, 0.0), 10: (0.0, 0.0, 0.0), 14: (0.0, 0.3, 0.0)}, interpolation='LINEAR'
        )
        preset = next(one for one in support.addon("chains.presets").BROUGHT if one.identifier == 'JELLY')
        cases.add(rig, **preset.values | {"gravity": 0.0})
        seen_axes = np.array([one[:3, :3] for one in seen(rig, range(1, 250), "Tail 0 0").values()])
        sizes = np.linalg.norm(seen_axes, axis=1)
        np.testing.assert_allclose(sizes.prod(axis=1), 1.0, atol=1e-6)
        np.testing.assert_allclose(seen_axes[:, :2, 1], 0.0, atol=1e-5, err_msg="it points up")
        self.assertLess(sizes[:, 1].min(), 0.8)
        self.assertGreater(sizes[14:, 1].max(), 1.15, "it overshoots")
        crossings = np.count_nonzero(np.diff(sizes[14:80, 1] > 1.0))
        self.assertGreater(crossings, 4)
        np.testing.assert_allclose(sizes[-1], 1.0, atol=1e-3)

    def test_hair_is_solved_once(self):
        """A motion for each chain, whatever frames are shown, rather than each frame anew (Wiggle 2, issue 68)."""
        rig = cases.rope(8, chains=20)
        bpy.context.scene.frame_end = 250
        names = ", ".join(f"Tail {number} 0" for number in range(20))
        self.assertEqual(len(cases.made(lambda: cases.add(rig, names, frequency=1.0))), 20)

        def play():
            for frame in range(1, 251):
                bpy.context.scene.frame_set(frame)

        self.assertEqual(cases.made(play), [])
