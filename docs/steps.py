"""The manual's steps, in a Blender with a window, on an X server without a screen.

python3 docs/steps.py [NAME...]
NAME: of a page whose steps are done, such as pendulum. Writes docs/pictures/NAME_steps.png. The name inset stands for the overlays in the
corners of the demo scenes' pictures.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
CLONE = HERE.parent
VERSION = "5.2"
SIZE = 1280, 800
SKIPPED = 77

sys.path.insert(0, str(CLONE / "blend_tests" / "window"))

import run  # noqa: E402  (found by the line above)


def main(*names):
    """Do the steps of these pages, or of all; the exit status."""
    known = sorted(path.name.removesuffix("_steps.py") for path in (HERE / "scripts" / "steps").glob("*_steps.py"))
    if unknown := [name for name in names if name not in known]:
        print(f"motus: no page has the steps {', '.join(unknown)}; there are: {', '.join(known)}", file=sys.stderr)
        return 2
    motus = str(CLONE / "motus")
    if subprocess.run([motus, "has_blender", VERSION], check=False).returncode:
        return SKIPPED
    with tempfile.TemporaryDirectory(prefix="motus-steps-") as folder, run.x_server(folder, SIZE) as display:
        environment = dict(os.environ, DISPLAY=display, LIBGL_ALWAYS_SOFTWARE="1", LP_NUM_THREADS="0")
        environment.pop("WAYLAND_DISPLAY", None)
        command = [
            motus,
            "blender",
            "--version",
            VERSION,
            "--factory-startup",
            "--enable-event-simulate",
            "--gpu-backend",
            "opengl",
            *run.window_of(SIZE),
            "--python-exit-code",
            "1",
            "--python",
            str(HERE / "scripts" / "steps" / "driver.py"),
            "--",
            folder,
            *names,
        ]
        return subprocess.run(command, env=environment, check=False).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
