"""What the processes that tests start compile of Python's sources is kept until the tests have ended, and not beside the sources.

What one process has compiled serves the next: half of a start of Blender is compiling.
"""

import contextlib
import os
import tempfile


@contextlib.contextmanager
def kept_for_children():
    """Processes that are started in the block share a temporary folder of compiled sources."""
    with tempfile.TemporaryDirectory(prefix="motus-test-") as compiled:
        os.environ["PYTHONPYCACHEPREFIX"] = compiled
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        yield
