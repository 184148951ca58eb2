"""The platforms that Motus is packaged for, and what is fetched to build for them: platforms.py CACHE PLATFORM prints CMake's options, a line each.

platforms.py CACHE wasm32 prints those of the module for browsers, which has the compiler and no Python.
platforms.py CACHE windows-x64 PYTHON prints where the program of a Python such as 3.11 is, for wine to run.

Compiler and Pythons come into folders of CACHE, which clones share. What they are, exactly, stands in platforms/*.txt with checksums; a folder is
named by that. Where something cannot be had, the reason is printed, with exit status 1; with 2 where there is no such platform.
"""

import hashlib
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import NamedTuple

import once

PINS = Path(__file__).resolve().parent / "platforms"
PYTHONS = ("3.11", "3.13")
"""Those of the official Blenders since 4.1."""
BROWSERS = "wasm32"
"""What the module for browsers is built for, which is not packaged."""


class Platform(NamedTuple):
    """A system and its processor, as Blender names the two, and what a module for them is."""

    name: str
    wheel: str  # the tag of its wheels
    suffix: str  # of its modules, with {python}, two numbers in one
    machine: str  # as LIEF names it
    oldest: tuple  # version of the system, or of glibc, that it runs on
    libraries: frozenset  # what it may ask the system for

    @property
    def system(self):
        """The first half of the name."""
        return self.name.partition("-")[0]

    def module(self, python):
        """File name of the module for a Python such as 3.11."""
        return f"motus_native.{self.suffix.format(python=python.replace('.', ''))}"


# A part of what auditwheel's manylinux_2_28, and delvewheel, take for the system's; Python's own library on Windows alone, where modules are linked to it.
_LINUX = frozenset({"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "librt.so.1", "ld-linux-x86-64.so.2"})
_WINDOWS = frozenset({"kernel32.dll", "ntdll.dll", "advapi32.dll", "ucrtbase.dll", "api-ms-win-crt-*.dll", "python3{minor}.dll"})
_MACOS = frozenset({"/usr/lib/libSystem.B.dylib"})
PLATFORMS = {
    one.name: one
    for one in (
        Platform("linux-x64", "manylinux_2_28_x86_64", "cpython-{python}-x86_64-linux-gnu.so", "X86_64", (2, 28), _LINUX),
        Platform("windows-x64", "win_amd64", "cp{python}-win_amd64.pyd", "AMD64", (10, 0), _WINDOWS),
        Platform("macos-arm64", "macosx_11_0_arm64", "cpython-{python}-darwin.so", "ARM64", (11, 0), _MACOS),
        Platform("macos-x64", "macosx_11_0_x86_64", "cpython-{python}-darwin.so", "X86_64", (11, 0), _MACOS),
    )
}


class Artifact(NamedTuple):
    """A Python for a system, as Maven Central has it."""

    system: str
    python: str
    coordinates: str
    checksum: str

    @property
    def file(self):
        """Name of the file that Maven copies."""
        _, name, version, kind, classifier = self.coordinates.split(":")
        return f"{name}-{version}-{classifier}.{kind}"


def artifacts(system):
    """Those of a system, in the order of platforms/pythons.txt."""
    lines = (PINS / "pythons.txt").read_text(encoding="utf-8").splitlines()
    return [one for one in (Artifact(*line.split()) for line in lines if line and not line.startswith("#")) if one.system == system]


def unpacked(jar, checksum, folder):
    """Unpacks the Python that is in a jar, folders of which lie deep in it; returns why it cannot be trusted, or nothing."""
    found = hashlib.sha256(jar.read_bytes()).hexdigest()
    if f"sha256:{found}" != checksum:
        return f"{jar.name} has the checksum sha256:{found}, not {checksum}"
    with zipfile.ZipFile(jar) as archive:
        for name in archive.namelist():
            _, _, below = name.partition("org/bytedeco/cpython/")
            _, _, path = below.partition("/")
            if path and not name.endswith("/"):
                target = folder / path
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(archive.read(name))
    return ""


def _copied(artifact, folder):
    with tempfile.TemporaryDirectory(dir=folder.parent, prefix="maven-") as jars:
        copy = ("mvn", "--quiet", "--batch-mode", "dependency:copy", f"-Dartifact={artifact.coordinates}", f"-DoutputDirectory={jars}")
        return once.run(*copy) or unpacked(Path(jars, artifact.file), artifact.checksum, folder)


def pythons(system, cache, copied=_copied):
    """([folders], ""), or (None, why one cannot be had). `copied` puts one there."""
    return _fetched(artifacts(system), cache, copied)


def _fetched(wanted, cache, copied):
    folders = []
    for artifact in wanted:
        system = artifact.system
        place = cache / "pythons" / f"{system}-{artifact.python}-{artifact.checksum[-8:]}"
        found, why_not = once.fetched(
            place, f"fetching Python {artifact.python} for {system} by Maven (25 MB)", lambda to, it=artifact: copied(it, to)
        )
        if not found:
            return None, why_not
        folders.append(found)
    return folders, ""


def tools(cache):
    """(the folder of zig's and pybind11's packages, ""), or (None, why it cannot be had)."""
    pins = PINS / "tools.txt"
    place = cache / "compilers" / hashlib.sha256(pins.read_bytes()).hexdigest()[:8]
    return once.fetched(
        place, "installing the compiler for all platforms by pip (90 MB)", lambda to: once.pip_install(to, "--requirement", pins)
    )


def program(python, cache, copied=_copied):
    """(the program of a Python for Windows, ""), or (None, why it cannot be had). `copied` puts its folder there."""
    folders, why_not = _fetched([one for one in artifacts("windows") if one.python == python], cache, copied)
    return (folders[0] / "python.exe", "") if folders else (None, why_not)


def main(cache, name, python=""):
    """Returns the exit status."""
    if name != BROWSERS and name not in PLATFORMS:
        print(f"there is no platform {name}: there are {', '.join(PLATFORMS)}")
        return 2
    cache = Path(cache).resolve()
    if python:
        found, why_not = program(python, cache)
        print(found or why_not)
        return 0 if found else 1
    compiler, why_not = tools(cache)
    folders = []
    if compiler and name != BROWSERS:
        folders, why_not = pythons(PLATFORMS[name].system, cache)
    if why_not:
        print(why_not)
        return 1
    print(f"-DMOTUS_ZIG={compiler}/ziglang/zig")
    if name == BROWSERS:
        return 0
    print(f"-DMOTUS_PYBIND11_INCLUDE={compiler}/pybind11/include")
    print(f"-DMOTUS_PYTHON_FOLDERS={';'.join(map(str, folders))}")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
