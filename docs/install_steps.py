"""The pictures of docs/install.md: Blender's own dialogues while Motus is installed and uninstalled, on an X server without a screen.

python3 docs/install_steps.py EXTENSION_ZIP LEGACY_ZIP
Writes docs/pictures/install_*.png. Called by `./motus docs install`.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

CLONE = Path(__file__).resolve().parents[1]
SCREEN = 2400, 1600
PLACE = 800, 400
"""Of the main window, from the lower left: dialogues, which open around the mouse, stay on the screen."""
SIZE = 1280, 800
SKIPPED = 77

sys.path.insert(0, str(CLONE / "blend_tests" / "window"))

import run  # noqa: E402  (found by the line above)


def downloaded(path, folder, ending):
    """A copy of a zip under the name that it is released by."""
    folder.mkdir(exist_ok=True)
    version = path.name.split("-")[1]
    return Path(shutil.copy(path, folder / f"motus-{version}-linux_x64{ending}.zip"))


def in_window(version, folder, display, path):
    """Does the steps in a Blender that has no Motus yet; the exit status."""
    backend = () if version == "3.4" else ("--gpu-backend", "opengl")
    environment = dict(os.environ, DISPLAY=display, LIBGL_ALWAYS_SOFTWARE="1", LP_NUM_THREADS="0")
    environment.pop("WAYLAND_DISPLAY", None)
    command = [
        str(CLONE / "motus"),
        "without_motus",
        version,
        "--factory-startup",
        "--enable-event-simulate",
        *backend,
        "--window-geometry",
        *map(str, (*PLACE, *SIZE)),
        "--python",
        str(CLONE / "docs" / "scripts" / "steps" / "install_driver.py"),
        "--",
        str(folder),
        str(path),
    ]
    return subprocess.run(command, env=environment, check=False).returncode


def main(extension, legacy):
    """Makes the pictures; the exit status."""
    downloads = Path(tempfile.gettempdir(), "Downloads")  # seen in the pictures
    for version, path, ending in (("5.2", extension, ""), ("3.4", legacy, "-legacy")):
        with tempfile.TemporaryDirectory(prefix="motus-steps-") as folder, run.x_server(folder, SCREEN) as display:
            found = downloaded(Path(path), downloads, ending)
            status = in_window(version, folder, display, found)
            found.unlink()
        if status:
            return status
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
