"""The only module that imports the native C++ module.

`module`: the native module; None if it cannot be used. `status`: the Status of the import, with the reason as a sentence for the user.
"""

from __future__ import annotations

import importlib.machinery
import re
import sys
from pathlib import Path
from typing import Any, NamedTuple

from . import keeping
from .translations import tr

OK = 'OK'
MISSING = 'MISSING'
WRONG_ABI = 'WRONG_ABI'
LOAD_ERROR = 'LOAD_ERROR'
VERSION_MISMATCH = 'VERSION_MISMATCH'

PACKAGE_FOLDER = Path(__file__).resolve().parent.parent


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


def addon_version() -> str:
    """Version of the add-on, read from blender_manifest.toml, which the extension's zip and the legacy zip both contain."""
    manifest = (PACKAGE_FOLDER / "blender_manifest.toml").read_text(encoding="utf-8")
    return re.findall(r'^version\s*=\s*"([^"]+)"', manifest, re.MULTILINE)[0]


def _import_failure(error: str) -> Status:
    """Status of a failed import of the native module: file missing, built for a different Python, or failed to load.

    The cause is found from the module's files in the add-on's folder. error: text of the ImportError.
    """
    this_python = f"{sys.version_info.major}.{sys.version_info.minor}"
    files = sorted(path.name for path in PACKAGE_FOLDER.glob("motus_native.*") if path.suffix in {".so", ".pyd"})
    if not files:
        return Status(MISSING, "The native module is missing from this copy of Motus: remove the add-on and install it from a release zip")
    if not any(f"motus_native{suffix}" in files for suffix in importlib.machinery.EXTENSION_SUFFIXES):
        pythons = ", ".join(".".join(found) for found in re.findall(r"cpython-(\d)(\d+)", " ".join(files)))
        return Status(
            WRONG_ABI,
            "This copy of Motus is built for Python {pythons}, but this Blender runs Python {python}: "
            "install a Motus release that contains it",
            {"pythons": pythons or "?", "python": this_python},
        )
    return Status(
        LOAD_ERROR,
        "The native module could not be loaded ({error}): reinstall Motus, and report this line if that does not help",
        {"error": error},
    )


def _load() -> tuple[Any, Status]:
    try:
        from .. import motus_native  # type: ignore[attr-defined]
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
