"""What is compiled of Python's sources while tests run is kept until they have ended, and not beside the sources: half of a start of Blender is compiling."""

import contextlib
import os
import sys
import tempfile

VARIABLE = "PYTHONPYCACHEPREFIX"


@contextlib.contextmanager
def kept_for_children():
    """Processes that are started in the block share a folder of compiled sources, with those around the block if they have one."""
    sys.dont_write_bytecode = sys.pycache_prefix is None
    with tempfile.TemporaryDirectory(prefix="motus-test-") as compiled:
        os.environ.setdefault(VARIABLE, compiled)
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        yield
