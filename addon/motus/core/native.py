"""The only module that imports the native C++ module.

`module`: the native module; None if it cannot be used. `status`: the Status of the import, with the reason as a sentence for the user.
"""

from __future__ import annotations

import re
import sys
import sysconfig
from pathlib import Path
from typing import Any, NamedTuple

import bpy

from . import keeping
from .translations import tr

OK = 'OK'
MISSING = 'MISSING'
WRONG_ABI = 'WRONG_ABI'
WRONG_PLATFORM = 'WRONG_PLATFORM'
LOAD_ERROR = 'LOAD_ERROR'
VERSION_MISMATCH = 'VERSION_MISMATCH'

PACKAGE_FOLDER = Path(__file__).resolve().parent.parent
PLATFORMS = ("linux-x64", "windows-x64", "macos-arm64", "macos-x64")
"""What there are zips of Motus for, as Blender names it."""


class Status(NamedTuple):
    """Result of importing the native module, and a sentence about what the user should do.

    code: OK, or the kind of failure. template: the English sentence, with {placeholders}. values: {placeholder: text}.
    """

    code: str
    template: str
    values: dict[str, str] = {}

    @property
    def sentence(self) -> str:
        """The template with its values filled in, as one sentence in the user's language."""
        return tr(self.template).format(**self.values)


def _manifest() -> str:
    """The text of blender_manifest.toml, which the extension's zip and the legacy zip both contain."""
    return (PACKAGE_FOLDER / "blender_manifest.toml").read_text(encoding="utf-8")


def addon_version() -> str:
    """Version of the add-on."""
    return re.findall(r'^version\s*=\s*"([^"]+)"', _manifest(), re.MULTILINE)[0]


def _platforms() -> list[str]:
    """The platforms that this copy of the add-on is for. Of several lists the last counts, which Blender writes into the zip of one platform."""
    lists = re.findall(r"^platforms\s*=\s*\[([^\]]*)\]", _manifest(), re.MULTILINE)
    return re.findall(r'"([^"]+)"', lists[-1]) if lists else []


def this_platform() -> str:
    """The system and the processor that this Blender is built for, as Blender names it: linux-x64, macos-arm64."""
    parts = sysconfig.get_platform().split("-")  # linux-x86_64, win-amd64, macosx-11.00-arm64
    system = {"win": "windows", "macosx": "macos"}.get(parts[0], parts[0])
    machine = {"x86_64": "x64", "amd64": "x64", "aarch64": "arm64"}.get(parts[-1], parts[-1])
    return f"{system}-{machine}"


def _modules() -> list[str]:
    """Names of the files with a native module in the add-on's folder."""
    return sorted(path.name for path in PACKAGE_FOLDER.glob("motus_native.*") if path.suffix in {".so", ".pyd"})


def _wheels() -> list[str]:
    """Names of the wheels with the native module, from which Blender has installed one."""
    return sorted(path.name for path in PACKAGE_FOLDER.glob("wheels/motus_native-*.whl"))


def _wrong_platform() -> Status | None:
    """Status of a copy that is for other platforms than this one."""
    platforms, here = _platforms(), this_platform()
    if not platforms or here in platforms:
        return None
    if here not in PLATFORMS:
        return Status(
            WRONG_PLATFORM,
            "This copy of Motus is for {platforms}, and there is none for {platform}, which this Blender runs on",
            {"platforms": ", ".join(platforms), "platform": here},
        )
    ending = "" if bpy.app.version >= (4, 2) else "-legacy"
    return Status(
        WRONG_PLATFORM,
        "This copy of Motus is for {platforms}, but this Blender runs on {platform}: remove the add-on and install {zip}",
        {"platforms": ", ".join(platforms), "platform": here, "zip": f"motus-{addon_version()}-{here.replace('-', '_')}{ending}.zip"},
    )


def _import_failure(error: str) -> Status:
    """Status of a failed import of the native module: made for another platform, file missing, built for a different Python, or failed to load.

    The cause is found from the manifest and the module's files in the add-on's folder. error: text of the ImportError.
    """
    this_python = f"{sys.version_info.major}.{sys.version_info.minor}"
    files = _modules() + _wheels()
    if wrong := _wrong_platform():
        return wrong
    if not files:
        return Status(MISSING, "The native module is missing from this copy of Motus: remove the add-on and install it from a release zip")
    # motus_native.cpython-311-x86_64-linux-gnu.so, motus_native.cp311-win_amd64.pyd, motus_native-0.1.0-cp311-cp311-win_amd64.whl
    found = {(int(major), int(minor)) for major, minor in re.findall(r"[.-]cp(?:ython-)?(\d)(\d+)-", " ".join(files))}
    if sys.version_info[:2] not in found:
        return Status(
            WRONG_ABI,
            "This copy of Motus is built for Python {pythons}, but this Blender runs Python {python}: "
            "install a Motus release that contains it",
            {"pythons": ", ".join(f"{major}.{minor}" for major, minor in sorted(found)) or "?", "python": this_python},
        )
    return Status(
        LOAD_ERROR,
        "The native module could not be loaded ({error}): reinstall Motus, and report this line if that does not help",
        {"error": error},
    )


def _imported() -> Any:
    """The native module: of the add-on's own folder, or from the wheel of an extension, which Blender installs where all modules are found."""
    if not _modules() and _wheels():
        import motus_native as installed

        return installed
    from .. import motus_native  # type: ignore[attr-defined]

    return motus_native


def _load() -> tuple[Any, Status]:
    try:
        motus_native = _imported()
    except (ImportError, OSError) as error:
        return None, _import_failure(str(error))
    found, wanted = motus_native.__version__, addon_version()
    if found != wanted:
        return None, Status(
            VERSION_MISMATCH,
            "The native module is version {found} but the add-on is {wanted}: restart Blender, and reinstall Motus if that does not help",
            {"found": found, "wanted": wanted},
        )
    return motus_native, Status(OK, "Native module {found}", {"found": found})


module, status = _load()

tables = keeping.OfLibrary(
    "arc length tables, frames along curves, motions of pendulums, landing places of flakes",
    "the whole input of the table",
    f"{module.cache_budget() >> 20:,} MiB" if module is not None else "nothing",
    module.clear_caches if module is not None else None,
)
