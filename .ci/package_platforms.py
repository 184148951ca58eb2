"""Makes wheels and zips of the add-on for several platforms from the native modules that are built for them.

package_platforms.py --stage DIR --dist DIR PLATFORM=MODULES... -- BLENDER COMMAND...

MODULES is the folder with a platform's native modules. DIST gets, and loses what it had before:
motus_native-VERSION-*.whl            the native module for a Python, for pip as well
motus-VERSION-PLATFORM.zip            extension, Blender 4.2 on: the add-on with the wheels, made by `extension build` of the Blender given
motus-VERSION-PLATFORM-legacy.zip     add-on, Blender 3.4-4.1: a folder motus/ with the native modules, without wheels

Run by the programs of the group `package` of pyproject.toml.
"""

import argparse
import re
import shutil
import subprocess
import sys
from pathlib import Path

import package
import wheels
from platforms import PLATFORMS, PYTHONS

LARGEST = 5_000_000
"""Bytes of a zip."""


def pair(text):
    """(the platform, the folder with its modules) of PLATFORM=MODULES."""
    name, _, folder = text.partition("=")
    return PLATFORMS[name], Path(folder)


def modules_of(platform, folder):
    """{Python: its module} of a platform; exits where one is not there."""
    found = {python: folder / platform.module(python) for python in PYTHONS}
    if missing := [str(path) for path in found.values() if not path.is_file()]:
        sys.exit(f"motus: not built: {', '.join(missing)}")
    return found


def make(chosen, stage, dist, blender):
    """Makes the wheels and the zips of {platform: {Python: module}}."""
    shutil.rmtree(dist, ignore_errors=True)
    dist.mkdir(parents=True)
    for platform, modules in chosen.items():
        for python, module in modules.items():
            wheels.make(module, platform, python, dist)
        name = platform.name.replace("-", "_")  # as Blender names the zips of an extension
        package.stage_legacy(stage / "legacy", modules.values(), [platform.name])
        package.write_zip(dist / f"motus-{package.version()}-{name}-legacy.zip", stage / "legacy", "motus/")
    package.stage(stage / "extension", (), [platform.name for platform in chosen], sorted(dist.glob("*.whl")))
    package.extension_build(blender, "--split-platforms", "--source-dir", stage / "extension", "--output-dir", dist)


def second_opinion(wheel):
    """What auditwheel or delvewheel has against a wheel; nothing for macOS, whose delocate runs there alone."""
    platform = wheel.stem.rpartition("-")[2]
    program = {"manylinux_2_28_x86_64": "auditwheel", "win_amd64": "delvewheel"}.get(platform)
    if not program:
        return ""
    done = subprocess.run([Path(sys.executable).with_name(program), "show", wheel], check=False, text=True, capture_output=True)
    said = " ".join(done.stdout.split())
    if program == "auditwheel":
        tag = re.search(r'following platform tag: "manylinux_(\d+)_(\d+)_x86_64"', said)
        is_well = bool(tag) and tuple(map(int, tag.groups())) <= (2, 28)
    else:
        is_well = "will be copied into the wheel. None" in said
    return "" if is_well and not done.returncode else f"{program}: {said or done.stderr}"


def main(arguments):
    """Returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("--stage", "--dist"):
        parser.add_argument(name, type=Path, required=True)
    parser.add_argument("platforms", type=pair, nargs="+", metavar="PLATFORM=MODULES")
    cut = arguments.index("--")
    options = parser.parse_args(arguments[:cut])
    make(
        {platform: modules_of(platform, folder) for platform, folder in options.platforms},
        options.stage,
        options.dist,
        arguments[cut + 1 :],
    )
    failed = 0
    for path in sorted(options.dist.iterdir()):
        found = f"larger than {LARGEST:,} bytes" if path.stat().st_size > LARGEST else second_opinion(path) if path.suffix == ".whl" else ""
        failed += bool(found)
        print(f"{f'FAILED {found}: ' if found else ''}{path} ({path.stat().st_size / 1e6:.2f} MB)")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
