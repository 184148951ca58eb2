"""The same pose in every Blender and on every system: a table that was written by Blender 3.4 on Linux."""

import numpy as np

import support
from poses import pose_cases as cases

NEAR = 1e-9
"""Of numbers up to 1, and else of the number."""


class SamePoses(support.SceneTestCase):
    def assert_row(self, found, wanted):
        self.assertEqual(list(found["numbers"]), list(wanted["numbers"]))
        for what, numbers in wanted["numbers"].items():
            self.assertEqual(len(found["numbers"][what]), len(numbers), what)
            off = np.abs(np.subtract(found["numbers"][what], numbers)) / np.maximum(np.abs(numbers), 1.0)
            self.assertLessEqual(float(off.max()), NEAR, what)
        self.assertEqual(found["bits"], wanted["bits"])

    def compare(self, name):
        found, wanted = cases.poses(name), cases.table()[name]
        self.assertEqual(list(found), list(wanted))
        for frame in wanted:
            with self.subTest(f"{name} {frame}"):
                self.assert_row(found[frame], wanted[frame])

    def test_there_are_forty(self):
        table = cases.table()
        self.assertEqual(list(table), list(cases.SCENES))
        self.assertEqual(sum(map(len, table.values())), 40)
        for name, parts in cases.SAME_BITS.items():
            for row in table[name].values():
                for part in parts:
                    self.assertTrue(any(part in what for what in row["numbers"]), (name, part))

    def test_another_pose_is_found(self):
        """A number that is off by 1e-8, or one bit of what is the same everywhere, fails."""
        cases.build("pendulum")
        found = cases.arrays("pendulum", 37)
        wanted = cases.row("pendulum", found)
        angles = found["Hook outputs"]
        for changed, part in ((angles + 1e-8, "not less than or equal to"), (np.nextafter(angles, 9.0), wanted["bits"])):
            with self.assertRaisesRegex(AssertionError, part):
                self.assert_row(cases.row("pendulum", found | {"Hook outputs": changed}), wanted)


def _test(name):
    return lambda self: self.compare(name)


for name in cases.SCENES:
    setattr(SamePoses, f"test_{name}", _test(name))
