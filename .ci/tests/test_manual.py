"""The pages of docs/: links lead somewhere, the glossary's words are those of the code, and each system's page has its two parts."""

import functools
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
GLOSSARY = DOCS / "glossary.md"
FROM = (DOCS / "architecture.md", DOCS / "systems.md", ROOT / "CONTRIBUTING.md")
"""Pages that lead a newcomer to the glossary."""
LINK = re.compile(r"(?<!!)\[[^\]]*\]\(([^)\s]+)\)|!\[[^\]]*\]\(([^)\s]+)\)")
LONGEST = 360
"""Most characters of an entry in the glossary: one or two sentences."""
SYSTEMS = (
    "path",
    "layers",
    "ik",
    "look_at",
    "pull",
    "lattice",
    "drivers",
    "dynamics",
    "chains",
    "pendulums",
    "snow",
    "stereo",
    "chroma",
    "walker",
)


def spanish_pages():
    """Pages in Spanish, each named after the English one."""
    return sorted((DOCS / "es").glob("*.md"))


def pages():
    """Files of the manual."""
    return [
        *sorted(DOCS.glob("*.md")),
        *sorted((DOCS / "cpp").glob("*.md")),
        *spanish_pages(),
        ROOT / "README.md",
        ROOT / "CONTRIBUTING.md",
    ]


def without_code(text):
    return re.sub(r"```.*?```", "", text, flags=re.DOTALL)


@functools.cache
def anchors(path):
    """Names of a page's headings, as links have them."""
    headings = re.findall(r"^#+ (.*)$", without_code(path.read_text(encoding="utf-8")), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@functools.cache
def code(folder=""):
    """All code of the add-on and the library, or of a folder of these, as one text."""
    files = [*(ROOT / "addon").rglob("*.py"), *(ROOT / "native" / "include").rglob("*.hpp"), *(ROOT / "native" / "src").rglob("*.?pp")]
    chosen = (path for path in files if path.is_relative_to(ROOT / folder) and "translations" not in path.parts)
    return "\n".join(path.read_text(encoding="utf-8") for path in chosen)


def rows(count):
    """The rows of the glossary's tables with this many columns, without their heads."""
    found = [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in GLOSSARY.read_text(encoding="utf-8").splitlines()
        if line[:1] == "|"
    ]
    return [row for row in found if len(row) == count and row[0] not in {"word", "gone"} and not row[0].startswith("---")]


def is_place(name):
    """Whether a file or folder of the repository, or of the add-on, has this path."""
    return "/" in name and any((folder / name).exists() for folder in (ROOT, ROOT / "addon" / "motus"))


def _is_defined(name, text):
    return re.search(rf"^\s*(class|struct|def) {name}\b", text, re.MULTILINE) is not None


class Glossary(unittest.TestCase):
    def test_words_are_used_in_the_code(self):
        self.assertGreater(len(rows(4)), 30)
        for word, *_ in rows(4):
            with self.subTest(word):
                # The verb of "to lay a pose" is in names such as lay().
                stem = re.escape(word.split()[1] if word.startswith("to ") else word)
                self.assertTrue(re.search(rf"(?i)(?<![a-z]){stem}", code()), "the code has no such word")

    def test_places_are_there(self):
        for word, text, _, where in rows(4):
            names = re.findall(r"`([\w/.]+)`", where)
            with self.subTest(word):
                self.assertTrue(names)
                for name in names:
                    self.assertTrue(is_place(name) or re.search(rf"\b{name}\b", code()), name)
                for name in re.findall(r"`([\w/]+/[\w.]*)`", text):
                    self.assertTrue(is_place(name), name)

    def test_words_are_explained_once_and_shortly(self):
        words = [word for word, *_ in rows(4)]
        self.assertEqual(len(words), len(set(words)))
        for word, text, *_ in rows(4):
            with self.subTest(word):
                self.assertRegex(text, r"[.)]$")
                self.assertLessEqual(len(text), LONGEST)

    def test_words_that_are_gone_are_gone(self):
        self.assertTrue(rows(3))
        for gone, folder, now in rows(3):
            text = code(folder.strip("`"))
            with self.subTest(gone):
                self.assertFalse(_is_defined(gone.strip("`"), text))
                for name in re.findall(r"`(\w+)`", now):
                    self.assertTrue(_is_defined(name, text), name)

    def test_newcomers_are_led_to_it(self):
        for page in FROM:
            with self.subTest(page.name):
                self.assertRegex(page.read_text(encoding="utf-8"), r"\]\((docs/)?glossary\.md\)")


class Pages(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for page in pages():
            for groups in LINK.findall(without_code(page.read_text(encoding="utf-8"))):
                link = "".join(groups)
                if re.match(r"[a-z]+:", link):
                    continue
                name, _, anchor = link.partition("#")
                target = (page.parent / name).resolve() if name else page
                with self.subTest(page=page.name, link=link):
                    self.assertTrue(target.exists())
                    if anchor:
                        self.assertIn(anchor, anchors(target))

    def test_pages_of_systems_have_a_part_for_artists_and_one_for_reference(self):
        for name in SYSTEMS:
            text = (DOCS / f"{name}.md").read_text(encoding="utf-8")
            with self.subTest(name):
                self.assertEqual(re.findall(r"^## (.*)$", without_code(text), re.MULTILINE), ["Using", "Reference"])
                using, _, reference = text.partition("\n## Reference\n")
                self.assertNotIn("```python", using)
                self.assertIn("\n### In five steps\n", using)
                self.assertIn("\n### From a script\n\n```python", reference)


if __name__ == "__main__":
    unittest.main()
