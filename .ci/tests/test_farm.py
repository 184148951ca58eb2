"""`./motus farm`: what it refuses, with a sentence each, before anything is rendered; and what it reads and writes."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CLONE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(CLONE / ".ci" / "farm"))

import engines  # noqa: E402  (found by the line above)

import farm  # noqa: E402

BLENDER = """#!/bin/sh
case "$*" in
    --version) echo "Blender 4.9.0" ;;
    *) echo "Error: this is no blend file"; exit 1 ;;
esac
"""
"""A Blender that opens no file."""


class Frames(unittest.TestCase):
    def test_what_is_read(self):
        for text, frames in {
            "7": [7],
            "1-3": [1, 2, 3],
            "5,1-2": [1, 2, 5],
            "1-3,2-4": [1, 2, 3, 4],
            "-2-1": [-2, -1, 0, 1],
            "-3--2": [-3, -2],
        }.items():
            with self.subTest(text=text):
                self.assertEqual(farm.frames_of(text), frames)

    def test_what_is_refused(self):
        for text, part in {
            "": "wants numbers such as",
            "1-": "wants numbers such as",
            "one": "wants numbers such as",
            "1..5": "wants numbers such as",
            "9-1": "ends before it begins",
            "1-9999999": "Blender's last",
        }.items():
            with self.subTest(text=text), self.assertRaisesRegex(engines.Refused, part):
                farm.frames_of(text)

    def test_ranges_are_read_as_they_are_written(self):
        for frames in ([1], [1, 2, 3], [1, 3, 4, 9], [-2, -1, 0, 5]):
            self.assertEqual(farm.frames_of(engines.ranges(frames)), frames)

    def test_logs_have_the_names_that_tasks_give_them(self):
        for frame in (1, 12345, -7):
            number = subprocess.run(("bash", "-c", f"printf %.4d {frame}"), check=True, capture_output=True, text=True).stdout
            self.assertEqual(engines.log_of(Path("logs"), frame), Path("logs", f"frame_{number}.log"))


class Refusals(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.shot = self.folder / "shot.blend"
        self.shot.write_text("nothing")
        self.blender = self.folder / "blender"
        self.blender.write_text(BLENDER)
        self.blender.chmod(0o755)

    def refused(self, part, status=2, environment=None, **given):
        options = {"frames": "1-2", "out": self.folder / "out", "with": "local", "blender": f"'{self.blender}'"} | given
        words = [str(options.pop("shot", self.shot)), *(word for name, value in options.items() for word in (f"--{name}", str(value)))]
        done = subprocess.run(
            (str(CLONE / "motus"), "farm", *words),
            env=environment,
            check=False,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        self.assertEqual(done.returncode, status, done.stdout)
        sentence = done.stdout.splitlines()[-1]
        self.assertTrue(sentence.startswith("motus: "), done.stdout)
        self.assertIn(part, sentence)

    def test_a_file_that_is_not_there(self):
        self.refused("there is no file", shot=self.folder / "other.blend")

    def test_a_wrong_range(self):
        self.refused("ends before it begins", frames="9-1")

    def test_a_folder_that_cannot_be_written(self):
        self.refused("nothing can be written into", out=self.shot / "below a file")
        self.refused("nothing can be written into", out="/proc/motus")

    def test_an_unknown_engine(self):
        self.refused("invalid choice: 'clouds'", **{"with": "clouds"})

    def test_what_has_to_be_given(self):
        done = subprocess.run((str(CLONE / "motus"), "farm", self.shot), check=False, text=True, capture_output=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--frames, --out, --with", done.stderr)

    def test_no_tries(self):
        self.refused("at least 1", tries=0)

    def test_slurm_that_is_not_here_or_does_not_answer(self):
        programs = self.folder / "programs"
        programs.mkdir()
        path = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}"}
        if not engines.shutil.which("sbatch"):
            self.refused("there is no program sbatch", **{"with": "slurm"})
        for name in ("sbatch", "squeue", "scancel", "scontrol"):
            (programs / name).write_text("#!/bin/sh\necho nobody is there >&2\nexit 1\n")
            (programs / name).chmod(0o755)
        engine = engines.Slurm()
        before, os.environ["PATH"] = os.environ["PATH"], path["PATH"]
        self.addCleanup(os.environ.__setitem__, "PATH", before)
        with self.assertRaisesRegex(engines.Refused, "Slurm does not answer: scontrol failed: nobody is there"):
            engine.check()
        os.environ["PATH"] = str(self.folder)
        with self.assertRaisesRegex(engines.Refused, "there is no program sbatch"):
            engine.check()

    def test_a_blender_that_is_none(self):
        self.refused("is no Blender", status=1, blender="true")

    def test_a_file_that_blender_cannot_open(self):
        self.refused("cannot open", status=1)


if __name__ == "__main__":
    unittest.main()
