"""What is told at the end of a run that broke."""

import tempfile
import unittest
from pathlib import Path

from broken import what_broke

OUTPUT = """Read blend: "/tmp/one.blend"
FAILED core.test_one.One.test_that_fails
Traceback (most recent call last):
AssertionError: 1 != 2
Fatal Python error: Segmentation fault

Thread 0x00007f14240ff680 (most recent call first):
  <no Python frame>

Current thread 0x00007f142d6b0c80 (most recent call first):
  File "/clone/addon/motus/pull/operators.py", line 92 in _root
  File "/clone/blend_tests/pull/test_pull.py", line 98 in test_a_stroke
  File "/usr/lib/python3.13/unittest/case.py", line 606 in _callTestMethod
  File "/clone/.ci/suite.py", line 81 in run_folder
  File "/clone/blend_tests/run.py", line 18 in <module>

Extension modules: bpy.props, mathutils (total: 2)
Blender 4.3.2
"""
CRASH = """# Blender 4.3.2, Unknown revision

# backtrace
blender(+0x10da402) [0x555619d5a402]
/lib/x86_64-linux-gnu/libc.so.6(gsignal+0x12) [0x7efe9ba4bc42]
/lib/x86_64-linux-gnu/libc.so.6(+0x175a98) [0x7efe9bb81a98]
blender(+0x189d986) [0x55561a51d986]

# Python backtrace
  File "/clone/addon/motus/pull/operators.py", line 92 in _root
"""


class WhatBroke(unittest.TestCase):
    def test_failed_tests_and_where_python_stood(self):
        self.assertEqual(
            what_broke(OUTPUT),
            ["FAILED core.test_one.One.test_that_fails", "Segmentation fault", "operators.py:92 _root < test_pull.py:98 test_a_stroke"],
        )

    def test_a_thread_without_python(self):
        """Blender's own threads evaluate a scene while Python waits for them."""
        output = OUTPUT.replace("Current thread", "Thread").replace("Thread 0x00007f14240ff680", "Current thread 0x00007f14240ff680")
        told = ["operators.py:92 _root < test_pull.py:98 test_a_stroke", "in a thread that runs no Python"]
        self.assertEqual(what_broke(output)[2:], told)

    def test_where_blender_stood(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "blender.crash.txt")
            path.write_text(CRASH, encoding="utf-8")
            self.assertEqual(what_broke(f"{OUTPUT}Writing: {path}\n")[3:], ["libc +0x175a98 < blender +0x189d986"])
        self.assertEqual(what_broke(f"Writing: {path}\n"), [], "the file is gone")

    def test_nothing(self):
        self.assertEqual(what_broke("summary: 3 passed, 0 failed, 0 skipped\n"), [])
