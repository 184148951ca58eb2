"""Runs tests to their end: to_the_end.py COMMAND..., a command that runs the tests of a folder by suite.py.

Where a test ends the process it has failed, and the command runs again, for the tests that are left.
"""

import collections
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import journal


def run(command, kept):
    """Runs the command, once more for each test that ends it; returns the exit status."""
    broken = False
    while True:
        known = kept.outcomes().keys()
        status = subprocess.run(command, check=False).returncode
        ended = {test: outcome for test, outcome in kept.outcomes().items() if test not in known}
        culprits = [test for test, outcome in ended.items() if outcome == journal.BEGUN]
        if not culprits:
            return 1 if broken else status
        broken = True
        for test in culprits:
            kept.note(test, "failed")
            print(f"FAILED {test}: the process ended in it, with status {status}")
        counts = collections.Counter("failed" if test in culprits else outcome for test, outcome in ended.items())
        print(f"summary: {counts['passed']} passed, {counts['failed']} failed, {counts['skipped']} skipped", flush=True)


def main(*command):
    """Returns the exit status."""
    with tempfile.TemporaryDirectory(prefix="motus-test-") as folder:
        path = Path(folder, "journal")
        os.environ[journal.VARIABLE] = str(path)
        return run(command, journal.Journal(path))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
