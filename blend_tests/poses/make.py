"""Writes the table of poses, with the Blender and the native module that run this.

./motus blender --version 3.4 -b --factory-startup --python-exit-code 1 --python blend_tests/poses/make.py

The table is not made anew to have a test pass: a pose that has changed is another pose in artists' files.
"""

import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import support
from poses import pose_cases as cases

support.enable()
made = {name: cases.poses(name) for name in cases.SCENES}
rows = re.sub(r"\[[^]]*\]", lambda row: " ".join(row[0].split()), json.dumps(made, indent=1))
cases.TABLE.write_text(f"{rows}\n", encoding="utf-8")
