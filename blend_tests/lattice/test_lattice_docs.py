"""The examples of docs/lattice.md run, and do what the page says."""

import re
import sys

import bpy
import numpy as np

import support

PAGE = support.CLONE / "docs" / "lattice.md"


class LatticePageTest(support.SceneTestCase):
    def examples(self):
        return re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)

    def test_the_scripted_example(self):
        (scripted,) = [code for code in self.examples() if "bpy.ops.motus" in code]
        seen = []
        exec(compile(scripted, "lattice.md", "exec"), {"print": lambda *values: seen.append(values)})
        (top, side), (value,) = seen
        self.assertAlmostEqual(top, 1.5, delta=0.1)
        self.assertAlmostEqual(side, 1.4, delta=0.05)
        self.assertEqual(value, 1.0)
        (ball,) = bpy.data.objects
        self.assertFalse(ball.modifiers)

    def test_the_native_example(self):
        (native_example,) = [code for code in self.examples() if "import motus_native" in code]
        sys.modules["motus_native"] = support.addon("core.native").module
        self.addCleanup(sys.modules.pop, "motus_native")
        scope = {}
        exec(compile(native_example, "lattice.md", "exec"), scope)
        np.testing.assert_allclose(scope["left"], 0.0, atol=1e-12)
        np.testing.assert_allclose(scope["moved"], [(0.5, 0.5, 1.3), (0.1, 0.1, 0.0)], atol=1e-6)
