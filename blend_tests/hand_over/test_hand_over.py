"""motus.hand_over: a file of which everything plays the same in a Blender without the add-on."""

import re

import bpy
import numpy as np

import live_scenes
import support
from chains import test_chains_squash
from hand_over import hand_over_cases, plain_state, test_hand_over_refusals


class TestHandOver(support.SceneTestCase):
    def test_everything_plays_the_same_without_the_add_on(self):
        live_scenes.opened()
        bpy.ops.motus.snow_add(
            preset='GENTLE', rate=10.0, lifetime=1.0, look='POINTS', location=(0.0, 12.0, 5.0)
        )  # shares nodes with the first
        support.link("Sun", bpy.data.lights.new("Sun", 'SUN'), (0.0, 0.0, 9.0))
        camera = support.link("Camera", bpy.data.cameras.new("Camera"), (3.0, -26.0, 6.0))
        camera.rotation_euler.x, bpy.context.scene.camera = 1.4, camera
        expected = plain_state.states(hand_over_cases.FRAMES)
        before = self.all_there_is()
        path = hand_over_cases.handed_over(self)
        self.assertEqual(self.all_there_is(), before)
        rendered = [str(self.folder / f"{name}.exr") for name in ("live", "plain")]
        found, left = hand_over_cases.states_without(self.folder, path, rendered[1])
        self.assertEqual(hand_over_cases.differences(expected, found), [])
        self.assertEqual(left, [])
        plain_state.picture(rendered[0], hand_over_cases.SHOWN)
        live, plain = (plain_state.pixels(one) for one in rendered)
        self.assertLess(np.abs(live - plain).mean(), 0.005 * np.abs(live).mean())
        # The add-on finds nothing in it that it would do something about.
        bpy.ops.wm.open_mainfile(filepath=str(path))
        self.assertEqual(hand_over_cases.differences(expected, plain_state.states(hand_over_cases.FRAMES)), [])
        self.assertEqual(plain_state.leftovers(), [])

    def test_bones_that_are_scaled_by_their_chain(self):
        rig = test_chains_squash.bouncing(3, tilt=2.5)
        test_chains_squash.cases.add(rig, **test_chains_squash.SOFT | {"frequency": 0.7}, tip_mass=2.0, use_curve=True)
        expected = plain_state.states(hand_over_cases.FRAMES)
        path = hand_over_cases.handed_over(self)
        found, left = hand_over_cases.states_without(self.folder, path)
        self.assertEqual((hand_over_cases.differences(expected, found), left), ([], []))
        bpy.ops.wm.open_mainfile(filepath=str(path))
        self.assertEqual(len(bpy.data.node_groups), 0)

    def test_stretched_time(self):
        test_hand_over_refusals.follower()
        bpy.ops.motus.snow_add(preset='GENTLE', rate=10.0, lifetime=1.0)
        render = bpy.context.scene.render
        render.frame_map_old, render.frame_map_new = 100, 150
        expected = plain_state.states(hand_over_cases.FRAMES)
        found, left = hand_over_cases.states_without(self.folder, hand_over_cases.handed_over(self))
        self.assertEqual((hand_over_cases.differences(expected, found), left), ([], []))

    @staticmethod
    def all_there_is():
        """What an operator could have changed in the open file: its frame, its datablocks, their constraints and drivers."""
        scene = bpy.context.scene
        kept = [scene.frame_current, scene.frame_subframe, scene.frame_start, scene.frame_end, bpy.data.filepath]
        kept += [one.name for listed in (bpy.data.objects, bpy.data.meshes, bpy.data.actions, bpy.data.node_groups) for one in listed]
        return kept + [(one.name, len(one.constraints), len(one.modifiers), one.hide_viewport) for one in bpy.data.objects]

    def test_the_example_of_the_page(self):
        (example,) = re.findall(r"```python\n(.*?)```", (support.CLONE / "docs" / "hand_over.md").read_text(encoding="utf-8"), re.DOTALL)
        seen = []
        exec(compile(example, "hand_over.md", "exec"), {"print": lambda *values: seen.append(values)})
        self.assertEqual(seen, [("Car.001", 0, "Car")])
        self.assertTrue(bpy.data.objects["Car"].motus.path.is_active)
        self.assertTrue(bpy.data.objects["Car"].constraints)
