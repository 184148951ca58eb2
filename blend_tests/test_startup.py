"""What enabling the add-on costs every Blender that starts with it."""

import unittest

import support


class StartUp(unittest.TestCase):
    def test_numpy_waits_until_it_is_needed(self):
        """Importing it takes tens of milliseconds."""
        bare, _ = _numpy_is_there(enabled=False)
        if bare:
            self.skipTest("this Blender imports NumPy itself")
        found, output = _numpy_is_there(enabled=True)
        self.assertFalse(found, output)


def _numpy_is_there(enabled):
    status, output = support.run_blender("print('NUMPY', 'numpy' in sys.modules)", enabled=enabled)
    assert status == 0, output
    return "NUMPY True" in output, output
