"""The native module as a wheel, which pip installs into any Python, and which Blender installs with an extension."""

import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import package

METADATA = """Metadata-Version: 2.4
Name: motus_native
Version: {version}
Summary: Procedural animation: the same at any frame, in any order
License-Expression: GPL-3.0-or-later
License-File: LICENSE
Requires-Python: =={python}.*
Requires-Dist: numpy
"""
WHEEL = """Wheel-Version: 1.0
Generator: motus
Root-Is-Purelib: false
Tag: {tag}-{tag}-{platform}
"""


def fill(folder, module, platform, python):
    """What the wheel consists of. A module that is one file has its signatures in a package beside it, by PEP 561."""
    shutil.copy2(module, folder)
    stubs = folder / "motus_native-stubs"
    stubs.mkdir()
    shutil.copyfile(package.stub(), stubs / "__init__.pyi")
    info = folder / f"motus_native-{package.version()}.dist-info"
    (info / "licenses").mkdir(parents=True)
    shutil.copyfile(package.CLONE / "LICENSE", info / "licenses" / "LICENSE")
    tag = f"cp{python.replace('.', '')}"
    (info / "METADATA").write_text(METADATA.format(version=package.version(), python=python), encoding="utf-8")
    (info / "WHEEL").write_text(WHEEL.format(tag=tag, platform=platform.wheel), encoding="utf-8")


def make(module, platform, python, target):
    """Writes the wheel of a module into the folder `target`; returns its path. The same content gives the same wheel."""
    target.mkdir(parents=True, exist_ok=True)
    before = set(target.iterdir())
    with tempfile.TemporaryDirectory(prefix="motus-wheel-") as folder:
        fill(Path(folder), module, platform, python)
        subprocess.run(
            [sys.executable, "-m", "wheel", "pack", folder, "--dest-dir", target],
            check=True,
            stdout=subprocess.DEVNULL,
            env=os.environ | {"SOURCE_DATE_EPOCH": "315532800"},
        )
    (wheel,) = set(target.iterdir()) - before
    press(wheel)
    return wheel


def press(wheel):
    """Compresses the files of a wheel as far as deflate can: 4 % less of a module, in eight seconds. A zip for Blender has two of them."""
    import zopfli  # only programs that make wheels have it

    with zipfile.ZipFile(wheel) as archive:
        files = [(entry, archive.read(entry)) for entry in archive.infolist()]
    with zopfli.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED, iterations=5) as archive:
        for entry, content in files:
            archive.writestr(entry, content)
