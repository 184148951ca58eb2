"""Tests in Blender's window, on an X server without a screen.

python3 blend_tests/window/run.py VERSION [PATTERN...]
One Blender (driver.py) runs all test_*.py beside and below this file, and a further one what is left where a test crashes or hangs. Pictures of the
window are left in out/window/VERSION/, of tests that are run: files of tests that passed before, just as they are, are not (.ci/kept_tests.py).
"""

import contextlib
import os
import subprocess
import sys
import threading
from pathlib import Path

HERE = Path(__file__).resolve().parent
CLONE = HERE.parents[1]
HANGS_AFTER = 700  # seconds without a line from the driver, which gives every test less
SKIPPED = 77
SIZE = 800, 560
"""Of the screen, which the window fills; drawn in software, pixels are what most of the processor's time goes into."""


@contextlib.contextmanager
def x_server(folder, size):
    """A display of its own with a screen of (width, height), which keeps its pixels in a file in `folder`; gives its name."""
    read, write = os.pipe()
    command = [
        "Xvfb",
        "-displayfd",
        str(write),
        "-screen",
        "0",
        "{}x{}x24".format(*size),
        "-fbdir",
        str(folder),
        "-nocursor",
        "-nolisten",
        "tcp",
    ]
    with subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL) as server:
        os.close(write)
        try:
            with os.fdopen(read) as answer:
                yield f":{answer.readline().strip()}"
        finally:
            server.terminate()


def window_of(size):
    """The arguments by which Blender's window fills a screen of (width, height)."""
    return "--window-geometry", "0", "0", *map(str, size)


class Run:
    """What the tests of all Blenders have come to: (file, test) -> whether it passed."""

    def __init__(self, version, folder, display, patterns):
        backend = () if version == "3.4" else ("--gpu-backend", "opengl")
        self._command = [
            str(CLONE / "motus"),
            "blender",
            "--version",
            version,
            "--factory-startup",
            "--enable-event-simulate",
            *backend,
            *window_of(SIZE),
            "--python-exit-code",
            "1",
            "--python",
            str(HERE / "driver.py"),
            "--",
            str(folder),
            *patterns,
        ]
        # Software rendering, whatever the machine has: the pictures are the same everywhere. Threads of its own cost a third more of the
        # processor's time, for windows of this size.
        self._environment = dict(os.environ, DISPLAY=display, LIBGL_ALWAYS_SOFTWARE="1", LP_NUM_THREADS="0")
        self._environment.pop("WAYLAND_DISPLAY", None)
        self.tests = None
        self.ended = {}
        self.kept = 0  # how many passed before, just as they are, and were not run

    def left(self):
        return [name for name in self.tests or () if name not in self.ended]

    def blender(self):
        """Runs the tests that are left in one Blender; returns whether it got anywhere."""
        skip = dict(self._environment, MOTUS_ENDED=" ".join(self.ended))
        known, begun = len(self.ended), None
        with subprocess.Popen(
            self._command, env=skip, text=True, errors="replace", stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        ) as blender:
            alarm = self._alarm(blender)
            for line in blender.stdout:
                print(line, end="", flush=True)
                word, _, name = line.strip().partition(" ")
                if word in {"TESTS", "BEGUN", "PASSED", "FAILED", "KEPT"}:
                    alarm.cancel()
                    alarm = self._alarm(blender)
                if word == "TESTS":
                    self.tests = self.tests or name.split()
                elif word == "BEGUN":
                    begun = name
                elif word in {"PASSED", "FAILED"} and name == begun:
                    self.ended[name] = word == "PASSED"
                elif word == "KEPT":
                    self.ended[name] = True
                    self.kept += 1
            alarm.cancel()
        if begun is not None and begun not in self.ended:
            print(f"FAILED {begun}: Blender ended in it, with status {blender.returncode}", flush=True)
            self.ended[begun] = False
        return len(self.ended) > known

    @staticmethod
    def _alarm(blender):
        def ring():
            print(f"no word from Blender for {HANGS_AFTER} s", flush=True)
            blender.kill()

        alarm = threading.Timer(HANGS_AFTER, ring)
        alarm.start()
        return alarm


def main(version, *patterns):
    if subprocess.run([str(CLONE / "motus"), "has_blender", version], check=False).returncode:
        return SKIPPED
    folder = CLONE / "out" / "window" / version
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.iterdir():
        old.unlink()
    with x_server(folder, SIZE) as display:
        run = Run(version, folder, display, patterns)
        while run.blender() and run.left():
            pass
    if run.tests is None:
        print("FAILED: Blender did not come to the tests", flush=True)
        return 1
    for name in run.left():
        print(f"FAILED {name}: not run", flush=True)
    if run.kept:
        print(f"kept: {run.kept} tests have passed before, just as they are", flush=True)
    passed = sum(run.ended.values())
    print(f"summary: {passed} passed, {len(run.tests) - passed} failed, 0 skipped", flush=True)
    return 1 if passed < len(run.tests) else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
