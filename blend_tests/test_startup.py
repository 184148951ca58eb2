"""What enabling the add-on costs every Blender that starts with it."""

import unittest

import support

ENABLES = """
slow = {"numpy", "subprocess", "ctypes"} - set(sys.modules)
import addon_utils
assert addon_utils.enable(MODULE, default_set=True)
print("IMPORTED", sorted(slow & set(sys.modules)))
"""


class StartUp(unittest.TestCase):
    def test_what_waits_until_it_is_needed(self):
        """Importing NumPy takes tens of milliseconds, the others some. A Blender that has imported one of them itself is no matter."""
        status, output = support.run_blender(ENABLES.replace("MODULE", repr(support.module_name())), enabled=False)
        self.assertEqual(status, 0, output)
        self.assertIn("IMPORTED []", output)
