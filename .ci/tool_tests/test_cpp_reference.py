"""The pages of docs/cpp are what the public headers say."""

import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "docs" / "scripts"))

from clang.cindex import CursorKind  # noqa: E402  (the program's own)

import cpp_reference  # noqa: E402  (found by the line above)

WRONG = re.compile(r"^\s*(?:private|protected):|;;|NOLINT|\breturn\b.*;$", re.MULTILINE)
"""What a page shows if more or less of a header was left out than should be."""


class CppReference(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pages = cpp_reference.pages()

    def test_pages_are_what_the_headers_say(self):
        kept = {path.name: path.read_text(encoding="utf-8") for path in cpp_reference.PAGES.glob("*.md")}
        self.assertEqual(kept.keys(), self.pages.keys(), "run ./motus docs cpp")
        for name, text in self.pages.items():
            self.assertEqual(kept[name], text, f"run ./motus docs cpp: {name}")

    def test_every_public_header_has_a_purpose_and_a_place(self):
        for header in cpp_reference.INCLUDE.rglob("*.hpp"):
            name = cpp_reference.name_of(header)
            self.assertTrue(cpp_reference.purpose(header), name)
            self.assertEqual(sum(f"\n## {name}\n" in text for text in self.pages.values()), 1, name)

    def test_no_two_types_have_one_name(self):
        """Who uses two topics by `using namespace` can name every type of both."""
        places = {}
        for header, cursors in cpp_reference.declarations().items():
            for cursor in cursors:
                if cursor.kind in cpp_reference.TYPES or cursor.kind == CursorKind.TYPE_ALIAS_DECL:
                    places.setdefault(cursor.spelling, []).append(cpp_reference.name_of(header))
        self.assertGreater(len(places), 100)
        self.assertEqual({name: found for name, found in places.items() if len(found) > 1}, {})

    def test_bodies_and_private_parts_are_not_shown(self):
        for name, text in self.pages.items():
            for block in re.findall(r"```cpp\n(.*?)```", text, re.DOTALL):
                self.assertIsNone(WRONG.search(block), f"{name}:\n{block}")
                self.assertEqual(block.count("{"), block.count("}"), f"{name}:\n{block}")

    def test_markdown_reads_sentences_as_sentences(self):
        for name, text in self.pages.items():
            prose = re.sub(r"```.*?```|`[^`\n]*`", "", text, flags=re.DOTALL)
            self.assertEqual(re.findall(r"^(?:[>+] ?.*|.*<\w.*)$", prose, re.MULTILINE), [], name)

    def test_each_heading_of_a_page_has_an_anchor_of_its_own(self):
        for name, text in self.pages.items():
            headings = re.findall(r"^#+ (.*)$", re.sub(r"```.*?```", "", text, flags=re.DOTALL), re.MULTILINE)
            anchors = [re.sub(r"[^\w\- ]", "", heading.lower()) for heading in headings]
            self.assertEqual(sorted(anchors), sorted(set(anchors)), name)

    def test_what_a_page_shows_of_a_class(self):
        text = self.pages["curve.md"]
        (block,) = re.findall(r"### class Curve\n.*?```cpp\n(.*?)```", text, re.DOTALL)
        self.assertIn("A chain of Bézier segments of one degree.", text)
        self.assertIn("    [[nodiscard]] int degree() const noexcept;\n", block)
        self.assertIn("    ~Curve() = default;\n", block)
        self.assertIn("    Curve(Curve&& other) noexcept;\n", block)
        self.assertNotIn("degree_", block)


if __name__ == "__main__":
    unittest.main()
