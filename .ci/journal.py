"""What has become of each test, in a file: it outlives a process that breaks in the midst of a test."""

import os
from pathlib import Path

VARIABLE = "MOTUS_JOURNAL"
"""The environment variable that names the file; without it nothing is kept."""
BEGUN = "begun"


class Journal:
    """A line when a test begins, and one when it has ended: its outcome and its id."""

    def __init__(self, path):
        self._path = Path(path) if path else None

    @classmethod
    def named(cls):
        """The journal that the environment names."""
        return cls(os.environ.get(VARIABLE))

    def note(self, test, outcome):
        """Writes a line, which is in the file at once."""
        if self._path:
            with self._path.open("a", encoding="utf-8") as file:
                file.write(f"{outcome} {test}\n")

    def outcomes(self):
        """The last word on each test that has begun: BEGUN, "passed", "failed" or "skipped"."""
        if not self._path or not self._path.exists():
            return {}
        lines = (line.partition(" ") for line in self._path.read_text(encoding="utf-8").splitlines())
        return {test: outcome for outcome, _, test in lines}
