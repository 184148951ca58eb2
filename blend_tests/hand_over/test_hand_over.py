"""motus.hand_over: a file of which everything plays the same in a Blender without the add-on."""

import re

import bpy

import live_scenes
import support
from hand_over import hand_over_cases, plain_state


class TestHandOver(support.SceneTestCase):
    def test_everything_plays_the_same_without_the_add_on(self):
        live_scenes.build()
        expected = plain_state.states(hand_over_cases.FRAMES)
        path = hand_over_cases.handed_over(self)
        found, left = hand_over_cases.states_without(self.folder, path)
        self.assertEqual(hand_over_cases.differences(expected, found), [])
        self.assertEqual(left, [])

    def test_the_example_of_the_page(self):
        (example,) = re.findall(r"```python\n(.*?)```", (support.CLONE / "docs" / "hand_over.md").read_text(encoding="utf-8"), re.DOTALL)
        seen = []
        exec(compile(example, "hand_over.md", "exec"), {"print": lambda *values: seen.append(values)})
        self.assertEqual(seen, [("Car.001", 0, "Car")])
        self.assertTrue(bpy.data.objects["Car"].motus.path.is_active)
        self.assertTrue(bpy.data.objects["Car"].constraints)
