"""Official Blenders as modules of Python, installed by pip into a folder that clones share: official.py FOLDER NAME prints where one is.

What is installed, and the checksum of each file, stands in official/NAME.txt. A folder is named by the content of that file, so a
new version is installed beside the old one. Where pip cannot get the files, the last line that it says is printed, with exit status 1.
"""

import hashlib
import sys
from pathlib import Path

import blenders
import once

PLATFORMS = {
    "module": ("manylinux_2_28_x86_64", "manylinux_2_27_x86_64", "manylinux2014_x86_64", "any"),
    "windows": ("win_amd64", "any"),
}
"""Tags of the wheels that a kind of Blender is installed from."""


def pip_arguments(blender):
    """What pip is told to install a module with: for another Python, and another system, than that which runs pip, too."""
    platforms = [argument for platform in PLATFORMS[blender.kind] for argument in ("--platform", platform)]
    python = ("--implementation", "cp", "--python-version", blender.python, "--ignore-requires-python")  # pip asks that of its own Python
    return (*platforms, *python, "--requirement", blender.requirements)


def _fill(blender, folder):
    return once.pip_install(folder, *pip_arguments(blender))


def installed(blender, folder, fill=_fill):
    """(the folder below `folder` in which a module is, ""), or (None, why it cannot be had). `fill` puts it there."""
    digest = hashlib.sha256(blender.requirements.read_bytes()).hexdigest()[:8]
    said = f"installing the official Blender {blender.version} by pip (400 MB, 1 GB unpacked)"
    return once.fetched(folder / f"{blender.version}-{digest}", said, lambda place: fill(blender, place))


def main(folder, name):
    """Returns the exit status."""
    place, why_not = installed(blenders.named(name), Path(folder).resolve())
    print(place or why_not)
    return 0 if place else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
