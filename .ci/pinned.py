"""Programs from PyPI, with the versions that pyproject.toml pins: pinned.py --programs FOLDER GROUP prints the folder in which those of a group are.

They are installed below FOLDER, which clones share, when they are first asked for.
"""

import argparse
import hashlib
import sys
import tempfile
import tomllib
from pathlib import Path

import once

CLONE = Path(__file__).resolve().parents[1]


def groups(programs, clone=CLONE):
    """{name: (its folder below `programs`, what pip installs into it)} of the groups of pyproject.toml's dependencies."""
    wanted = tomllib.loads((clone / "pyproject.toml").read_text(encoding="utf-8"))["dependency-groups"]
    return {
        group: (programs / hashlib.sha256(" ".join((sys.version, group, *packages)).encode()).hexdigest()[:16], packages)
        for group, packages in wanted.items()
    }


def installed(group, programs, clone=CLONE):
    """(the folder with the programs of a group of pyproject.toml's dependencies, ""), or (None, why they cannot be had)."""
    folder, wanted = groups(programs, clone)[group]

    def fill(place):
        commands = ((sys.executable, "-m", "venv", place), (place / "bin" / "pip", "install", "--quiet", *wanted))
        return next(filter(None, (once.run(*command) for command in commands)), "")

    place, why_not = once.fetched(folder, f"installing by pip: {' '.join(wanted)}", fill)
    return place and place / "bin", why_not


def built(name, programs, clone=CLONE):
    """(the folder with a program that is a Go module, ""), or (None, why it cannot be had). pyproject.toml pins it, and the compiler.

    The compiler is 200 MB, so it is not kept: pip installs it for as long as the program is built.
    """
    settings = tomllib.loads((clone / "pyproject.toml").read_text(encoding="utf-8"))
    module, compiler = settings["tool"]["motus"][name], settings["dependency-groups"]["go"]

    def fill(folder):
        with tempfile.TemporaryDirectory(dir=folder.parent, prefix="go-") as work:
            own = (f"GOBIN={folder}", f"GOPATH={work}/path", f"GOCACHE={work}/cache", "GOFLAGS=-modcacherw", "GOTOOLCHAIN=local")
            return (
                once.run(sys.executable, "-m", "venv", f"{work}/venv")
                or once.run(f"{work}/venv/bin/pip", "install", "--quiet", *compiler)
                or once.run("env", *own, f"{work}/venv/bin/go", "install", module)
            )

    key = hashlib.sha256(" ".join((module, *compiler)).encode()).hexdigest()[:16]
    return once.fetched(programs / key, f"building {module}, with {' '.join(compiler)}", fill)


def main():
    """Reads the command line."""
    parser = argparse.ArgumentParser(prog="pinned.py")
    parser.add_argument("--programs", type=Path, required=True)
    parser.add_argument("group")
    options = parser.parse_args()
    folder, why_not = installed(options.group, options.programs.resolve())
    if not folder:
        sys.exit(f"motus: the programs of the group {options.group} could not be installed by pip: {why_not}")
    print(folder)


if __name__ == "__main__":
    main()
