"""Files that the docs and the add-on name are there."""

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NAME = re.compile(r"(?<![\w/.<-])(?:\.?[\w]+/)*\w+\.(?:py|hpp|cpp)\b")
EXAMPLES = {"my_script.py"}
"""Files that a page tells its reader to write."""


def texts():
    """Files whose text names other files."""
    yield from (ROOT / "docs").glob("*.md")
    yield from (ROOT / name for name in ("README.md", "CONTRIBUTING.md") if (ROOT / name).exists())
    yield from (ROOT / "addon").rglob("*.py")


class References(unittest.TestCase):
    def test_named_files_are_there(self):
        every = [
            "/" + path.relative_to(ROOT).as_posix().removesuffix(".in")
            for folder in ("addon", "blend_tests", "docs", ".ci", "native")
            for kind in ("py", "hpp", "cpp", "hpp.in")
            for path in (ROOT / folder).rglob(f"*.{kind}")
        ]
        for path in texts():
            for name in {one[0] for one in NAME.finditer(path.read_text(encoding="utf-8"))} - EXAMPLES:
                with self.subTest(file=path.relative_to(ROOT), name=name):
                    self.assertTrue(any(one.endswith("/" + name) for one in every), f"{path.name} names {name}")


if __name__ == "__main__":
    unittest.main()
