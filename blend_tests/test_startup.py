"""What enabling the add-on costs every Blender that starts with it."""

import unittest

import support

NUMPY = """
print("BEFORE", "numpy" in sys.modules)
import support
support.enable()
print("AFTER", "numpy" in sys.modules)
"""


class StartUp(unittest.TestCase):
    def test_numpy_waits_until_it_is_needed(self):
        """Importing it takes tens of milliseconds."""
        status, output = support.run_blender(NUMPY, enabled=False)
        self.assertEqual(status, 0, output)
        if "BEFORE True" in output:
            self.skipTest("this Blender imports NumPy itself")
        self.assertIn("AFTER False", output)
