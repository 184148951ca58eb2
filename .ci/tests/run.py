"""Tests of the ./motus command itself.

python3 .ci/tests/run.py [PATTERN...]
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import suite  # noqa: E402  (found by the line above)

sys.exit(suite.run_folder(HERE, sys.argv[1:]))
