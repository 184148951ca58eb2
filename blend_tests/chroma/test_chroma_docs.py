"""The examples of docs/chroma.md run, and do what the page says."""

import re
import sys

import bpy
import numpy as np

import support

PAGE = support.CLONE / "docs" / "chroma.md"


class ChromaPageTest(support.SceneTestCase):
    def examples(self):
        return re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)

    def test_the_scripted_examples(self):
        seen = []
        for scripted in [code for code in self.examples() if "bpy.ops.motus" in code]:
            exec(compile(scripted, "chroma.md", "exec"), {"print": lambda *values: seen.append(values)})
        (width, share), (active,) = seen
        self.assertEqual(active, 1)
        self.assertEqual(width, 64)
        self.assertAlmostEqual(share, 1.0 - 23 * 25 / (64 * 36), delta=0.04)
        self.assertIsNone(support.addon("chroma.compositor").key_of(bpy.context.scene))

    def test_the_native_example(self):
        (native_example,) = [code for code in self.examples() if "import motus_native" in code]
        sys.modules["motus_native"] = support.addon("core.native").module
        self.addCleanup(sys.modules.pop, "motus_native")
        scope = {}
        exec(compile(native_example, "chroma.md", "exec"), scope)
        np.testing.assert_allclose(scope["color"], (0.05, 0.42, 0.08), atol=1e-6)
        self.assertEqual((scope["matte"].min(), scope["matte"].max()), (0.0, 1.0))
        self.assertAlmostEqual(scope["report"]["share"], 1.0 - 24 * 25 / (36 * 64), delta=0.04)
