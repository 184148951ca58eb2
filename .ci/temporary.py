"""A folder of its own for each test outside Blender."""

import tempfile
import unittest
from pathlib import Path


class Temporary(unittest.TestCase):
    """Has `folder`, which is gone after the test. Its name has a space, so that a path that is not quoted fails."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
