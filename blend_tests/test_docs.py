"""The manual: its examples run, its generated page is up to date, and its links lead somewhere."""

import re
import sys
from pathlib import Path

import bpy

import support

DOCS = Path(__file__).resolve().parent.parent / "docs"
sys.path.insert(0, str(DOCS / "scripts"))


def examples(page):
    """The Python blocks of a page."""
    return re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


class ExamplesTest(support.SceneTestCase):
    def test_the_scripted_example_follows_the_path(self):
        scripted, = [code for code in examples(DOCS / "path.md") if "bpy.ops.motus" in code]
        seen = []
        # A copy: Blender's vector would change with the object.
        scope = {"print": lambda place: seen.append(tuple(place))}
        exec(compile(scripted, "path.md", "exec"), scope)
        # The course is symmetric about its middle, which an eased motion reaches at half of the time.
        place, = seen
        for value, expected in zip(place, (4.0, 4.0, 1.0)):
            self.assertAlmostEqual(value, expected, places=5)
        self.assertFalse(scope["glider"].constraints)
        self.assertEqual(tuple(scope["glider"].location), (0.0, 0.0, 0.0))

    def test_the_native_example_runs(self):
        native_example, = [code for code in examples(DOCS / "path.md") if "import motus_native" in code]
        module = support.addon("core.native").module
        sys.modules["motus_native"] = module
        self.addCleanup(sys.modules.pop, "motus_native")
        scope = {}
        exec(compile(native_example, "path.md", "exec"), scope)
        self.assertEqual(scope["attitude"].shape, (1, 4))
        self.assertAlmostEqual(scope["halfway"][0], 4.0, places=9)


class PagesTest(support.SceneTestCase):
    def test_the_operator_page_names_every_operator_and_keyword(self):
        import operator_page
        page = (DOCS / "operators.md").read_text(encoding="utf-8")
        for identifier in operator_page.identifiers():
            self.assertIn(f"## `{identifier}`", page)
            rna = getattr(bpy.ops.motus, identifier.partition(".")[2]).get_rna_type()
            section = page.partition(f"## `{identifier}`")[2].partition("\n## ")[0]
            for prop in rna.properties:
                if prop.identifier != "rna_type" and not prop.is_hidden:
                    self.assertIn(f"| `{prop.identifier}` |", section, f"run ./motus docs: {identifier}")

    def test_links_and_pictures_exist(self):
        for page in [*DOCS.glob("*.md"), DOCS.parent / "README.md"]:
            for link in re.findall(r"\]\(([^)#]+)", page.read_text(encoding="utf-8")):
                if "://" not in link:
                    self.assertTrue((page.parent / link).exists(), f"{page.name}: {link}")
