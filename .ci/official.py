"""Official Blenders as modules of Python, installed by pip into a folder that clones share: official.py FOLDER NAME prints where one is.

What is installed, and the checksum of each file, stands in official/NAME.txt. A folder is named by the content of that file, so a
new version is installed beside the old one. Where pip cannot get the files, the last line that it says is printed, with exit status 1.
"""

import fcntl
import hashlib
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import blenders

PLATFORMS = ("manylinux_2_28_x86_64", "manylinux_2_27_x86_64", "manylinux2014_x86_64", "any")


def pip_arguments(blender, folder):
    """What pip is told to install a module with: for another Python than that which runs pip, too."""
    platforms = [argument for platform in PLATFORMS for argument in ("--platform", platform)]
    python = ("--implementation", "cp", "--python-version", blender.python, "--ignore-requires-python")  # pip asks that of its own Python
    checked = ("--no-deps", "--only-binary=:all:", "--require-hashes", "--requirement", blender.requirements)
    return ("install", "--quiet", "--no-cache-dir", "--no-compile", *platforms, *python, *checked, "--target", folder)


def _run(*command):
    """The last line of what went wrong, or nothing."""
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    if not done.returncode:
        return ""
    said = (done.stderr.strip() or done.stdout.strip() or "no reason was given").splitlines()
    return next((line for line in reversed(said) if line.startswith("ERROR")), said[-1])


def _fill(blender, folder):
    with tempfile.TemporaryDirectory(dir=folder.parent, prefix="pip-") as programs:
        return _run(sys.executable, "-m", "venv", programs) or _run(f"{programs}/bin/pip", *pip_arguments(blender, folder))


def installed(blender, folder, fill=_fill):
    """(the folder below `folder` in which a module is, ""), or (None, why it cannot be had). `fill` puts it there."""
    digest = hashlib.sha256(blender.requirements.read_bytes()).hexdigest()[:8]
    place = folder / f"{blender.version}-{digest}"
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # another clone may be installing the same
        if not (place / "complete").exists():
            print(f"motus: installing the official Blender {blender.version} by pip (400 MB, 1 GB unpacked)", file=sys.stderr)
            shutil.rmtree(place, ignore_errors=True)
            if why_not := fill(blender, place):
                shutil.rmtree(place, ignore_errors=True)
                return None, why_not
            (place / "complete").touch()
    return place, ""


def main(folder, name):
    """Returns the exit status."""
    place, why_not = installed(blenders.named(name), Path(folder).resolve())
    print(place or why_not)
    return 0 if place else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
