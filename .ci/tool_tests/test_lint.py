"""`./motus lint` finds a fault of every kind, mends what its tools can mend, and says which tools are not there."""

import contextlib
import io
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import lint
import pinned

CLONE = Path(__file__).resolve().parents[2]
PROGRAMS = Path(os.environ.get("MOTUS_CACHE") or Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache", "motus"), "programs")
FAULTS = {  # tool: the file in which it finds one, and the file's text
    "ruff": ("addon/motus/fault.py", '"""Imports what is not used."""\n\nimport os\n'),
    "ruff-format": ("addon/motus/fault.py", '"""Has no space where one belongs."""\n\nVALUE=1\n'),
    "mypy": ("addon/motus/fault.py", '"""Gives back another type."""\n\n\ndef count() -> int:\n    return "two"\n'),
    "codespell": ("docs/fault.md", "Teh page.\n"),
    "shellcheck": ("tool", "#!/usr/bin/env bash\nrm $1\n"),
    "actionlint": (".github/workflows/fault.yml", "on: push\njobs:\n  test:\n    runs-on: ubuntu-latest\n    steps: [{ruin: something}]\n"),
    "clang-format": ("native/fault.cpp", "int  value;\n"),
}
NOWHERE = """
[dependency-groups]
lint = ["/no such folder/motus-linter.whl"]
go = ["/no such folder/motus-go.whl"]
[tool.motus]
actionlint = "no such module"
"""
"""Of pyproject.toml: what neither pip nor Go can have."""
MENDED = {"ruff", "ruff-format", "codespell", "clang-format"}


class Lint(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.places = lint.Places(Path(temporary.name), PROGRAMS)
        for name in ("pyproject.toml", ".clang-format"):
            shutil.copy(CLONE / name, self.places.clone)
        self.write("addon/motus/__init__.py", '"""A package."""\n')
        subprocess.run(["git", "init", "--quiet", self.places.clone], check=True)

    def write(self, name, text):
        path = self.places.clone / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        self.addCleanup(path.unlink, missing_ok=True)
        return path

    def lint(self, *names, fix=False):
        """(exit status, what is printed)."""
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            status = lint.lint(self.places, names, fix)
        return status, printed.getvalue()

    def test_each_tool_finds_a_fault_and_passes_without(self):
        status, printed = self.lint(*FAULTS)
        self.assertEqual(status, 0, printed)
        go, why_not = pinned.built("actionlint", PROGRAMS)
        self.assertIn(f"summary: {len(FAULTS) - bool(why_not)} passed, 0 failed, {int(bool(why_not))} skipped", printed)
        for name, (file, text) in FAULTS.items():
            with self.subTest(name):
                if name == "actionlint" and not go:
                    self.skipTest(f"it cannot be built: {why_not}")
                path = self.write(file, text)
                status, printed = self.lint(name)
                self.assertEqual(status, 1, printed)
                self.assertIn(Path(file).name, printed)
                self.assertIn("summary: 0 passed, 1 failed, 0 skipped", printed)
                status, printed = self.lint(name, fix=True)
                self.assertEqual(status, 0 if name in MENDED else 1, printed)
                self.assertEqual(path.read_text(encoding="utf-8") != text, name in MENDED)
                self.assertEqual(self.lint(name)[0], 0 if name in MENDED else 1)
                path.unlink()

    def test_ignored_files_are_not_checked(self):
        self.write(".gitignore", "/out/\n")
        self.write("out/fault.md", "Teh page.\n")
        self.assertEqual(lint.files_of(self.places.clone), [".clang-format", ".gitignore", "addon/motus/__init__.py", "pyproject.toml"])

    def test_a_tool_that_is_not_there_is_skipped_and_counted(self):
        self.write(*FAULTS["shellcheck"])
        with mock.patch.object(shutil, "which", return_value=None):
            status, printed = self.lint("shellcheck", "codespell")
        self.assertEqual(status, 0, printed)
        self.assertIn("SKIPPED shellcheck: ", printed)
        self.assertIn("summary: 1 passed, 0 failed, 1 skipped", printed)

    def test_what_pip_cannot_install_is_skipped_with_the_reason(self):
        settings = self.places.clone / "pyproject.toml"
        settings.write_text(NOWHERE, encoding="utf-8")
        self.places = self.places._replace(programs=self.places.clone / "programs")
        with contextlib.redirect_stderr(io.StringIO()):
            status, printed = self.lint("ruff", "shellcheck", "actionlint")
        self.assertEqual(status, 0, printed)
        self.assertRegex(printed, r"SKIPPED ruff: it could not be installed by pip: .*motus-linter")
        self.assertRegex(printed, r"SKIPPED actionlint: it could not be installed by go: .*motus-go")
        self.assertIn("summary: 1 passed, 0 failed, 2 skipped", printed)
