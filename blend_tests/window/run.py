"""Tests in Blender's window, on an X server without a screen: python3 blend_tests/window/run.py VERSION [PATTERN...]

Each test_*.py beside this file runs in a Blender of its own (driver.py), which asks for pictures by leaving a file
NAME.request in out/window/VERSION/; they are taken here, from the X server, and written as NAME.png.
"""

import contextlib
import os
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
CLONE = HERE.parents[1]
TIMEOUT = 300  # seconds for one test file
SKIPPED = 77


@contextlib.contextmanager
def x_server():
    """A display of its own; gives its name."""
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-nolisten", "tcp"]
    with subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL) as server:
        os.close(write)
        try:
            with os.fdopen(read) as answer:
                yield f":{answer.readline().strip()}"
        finally:
            server.terminate()


def take_pictures(folder, display):
    for request in folder.glob("*.request"):
        picture = request.with_suffix(".png")
        subprocess.run(["import", "-display", display, "-window", "root", f"png:{picture}.part"], check=True)
        Path(f"{picture}.part").rename(picture)
        request.unlink()


def run_file(test, version, patterns, folder, display):
    """Runs one test file; returns its exit status."""
    backend = () if version == "3.4" else ("--gpu-backend", "opengl")
    command = [str(CLONE / "motus"), "blender", "--version", version, "--factory-startup", "--enable-event-simulate",
               *backend, "--window-geometry", "0", "0", "1280", "800", "--python-exit-code", "1",
               "--python", str(HERE / "driver.py"), "--", str(test), str(folder), *patterns]
    # Software rendering, whatever the machine has: the pictures are the same everywhere.
    environment = dict(os.environ, DISPLAY=display, LIBGL_ALWAYS_SOFTWARE="1")
    environment.pop("WAYLAND_DISPLAY", None)
    started = time.monotonic()
    with subprocess.Popen(command, env=environment) as blender:
        while blender.poll() is None:
            take_pictures(folder, display)
            if time.monotonic() - started > TIMEOUT:
                blender.kill()
                print(f"FAILED {test.name}: no end after {TIMEOUT} s", flush=True)
            time.sleep(0.05)
    return blender.returncode


def main(version, *patterns):
    if subprocess.run([str(CLONE / "motus"), "has_blender", version], check=False).returncode:
        return SKIPPED
    folder = CLONE / "out" / "window" / version
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.iterdir():
        old.unlink()
    with x_server() as display:
        statuses = [run_file(test, version, patterns, folder, display) for test in sorted(HERE.glob("test_*.py"))]
    return 1 if any(statuses) else 0


sys.exit(main(*sys.argv[1:]))
