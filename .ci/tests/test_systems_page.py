"""What an author of a system must read stays short, and the page's steps are the sections of its toy."""

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "systems.md"
TOY = ROOT / "blend_tests" / "toy_wobble_system.py"
LISTED = re.compile(r"^- `([\w/]+\.py)`(?:, up to `(\w+)\(\)`)?:", re.MULTILINE)
MOST = 1500
MOST_OF_TOY = 120


def lines_to_read(path, end):
    """How many lines a file has, or has above its function `end`."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return next(index for index, line in enumerate(lines) if line.startswith(f"def {end}(")) if end else len(lines)


class SystemsPage(unittest.TestCase):
    def setUp(self):
        self.page = PAGE.read_text(encoding="utf-8")

    def test_an_author_reads_few_lines(self):
        chapter = self.page.partition("\n## What to read\n")[2].partition("\n## ")[0]
        listed = LISTED.findall(chapter)
        self.assertEqual(len(listed), chapter.count("\n- "), "a line of the list names no module")
        counts = {name: lines_to_read(ROOT / name, end) for name, end in listed} | {"page": len(self.page.splitlines())}
        self.assertIn(TOY.relative_to(ROOT).as_posix(), counts)
        self.assertLessEqual(sum(counts.values()), MOST, counts)
        self.assertLessEqual(len(TOY.read_text(encoding="utf-8").splitlines()), MOST_OF_TOY)

    def test_the_steps_are_the_sections_of_the_toy(self):
        steps = re.findall(r"^### (\d\. .*)$", self.page, re.MULTILINE)
        self.assertEqual(re.findall(r"^# (\d\. .*)$", TOY.read_text(encoding="utf-8"), re.MULTILINE), steps[:-1])
        self.assertEqual(steps[-1], "7. Test")


if __name__ == "__main__":
    unittest.main()
