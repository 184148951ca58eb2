"""Catalogues of assets, such as Motus/Chains: entries in the file that Blender keeps in the folder of an asset library."""

import uuid

FILE = "blender_assets.cats.txt"
_BEGINNING = "# This is an Asset Catalog Definition file for Blender.\n\nVERSION 1\n\n"
_NAMES = uuid.UUID("5b7d3f0a-9d3e-4b8c-8e0f-6f5d1c2a4e71")
_LARGEST = 1 << 22
"""Most bytes of a file of catalogues that is read."""


def path_of(system):
    """Path of the catalogue for settings of a system. It is the same in all languages, since libraries are shared."""
    return f"Motus/{system.label}"


def identifier(system):
    """Identifier of the catalogue for settings of a system, the same in all files and libraries in which Motus has made the catalogue."""
    return str(uuid.uuid5(_NAMES, path_of(system)))


def entered(system, folder):
    """Identifier of the catalogue for settings of a system in a library. The catalogue is entered if the library does not have it.

    A line is added to the library's file of catalogues; what is in the file stays. If the file cannot be read or written, the asset stands
    among the unassigned ones. folder: of the library.
    """
    path, file, own = path_of(system), folder / FILE, identifier(system)
    try:
        with file.open("a+b") as content:
            content.seek(0)
            before = content.read(_LARGEST).decode("utf-8")
            found = next(filter(None, (_identifier(line, path) for line in before.splitlines())), None)
            if found:
                return found
            beginning = "" if before.endswith("\n") else "\n" if before else _BEGINNING
            content.write(f"{beginning}{own}:{path}:{path.replace('/', '-')}\n".encode())
    except (OSError, ValueError):
        pass
    return own


def _identifier(line, path):
    """Identifier in a line of a file of catalogues; None if the line is not of the catalogue with this path."""
    parts = line.split(":")
    if len(parts) != 3 or parts[1].strip() != path:
        return None
    try:
        return str(uuid.UUID(parts[0].strip()))
    except ValueError:
        return None
