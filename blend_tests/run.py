"""Tests of the installed add-on, inside Blender; `./motus test` calls it in every Blender.

The folders are those of addon/motus. The one without an __init__.py, window/, has a run of its own.

By hand: ./motus blender -b --factory-startup --python-exit-code 1 --python blend_tests/run.py -- [PATTERN...]
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / ".ci")]

import suite  # noqa: E402  (found by the line above)
import support  # noqa: E402

support.enable()
status = suite.run_folder(HERE, sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else (), support.about())
sys.exit(status)
