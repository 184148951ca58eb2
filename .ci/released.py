"""Which groups of tests try what is released, and for which platforms it is packaged before."""

import blenders
from platforms import PLATFORMS

BY_PIP = ("linux-x64", "windows-x64")
"""Platforms whose wheels are installed and tested: here, and by wine."""
BLENDERS = tuple(one for one in blenders.BLENDERS if "packages" in one.tests)


def _groups():
    """{name of a group: platforms whose packages it needs}."""
    named = {"packages": tuple(PLATFORMS)}
    named |= {f"packages by pip, {platform}": (platform,) for platform in BY_PIP}
    return named | {f"packages in {one.name}": ("windows-x64" if one.kind == "windows" else "linux-x64",) for one in BLENDERS}


def planned(only, everything=False):
    """{list of CMakeLists.txt: names}. only: parts of groups' names, as --only has them; everything: whether all groups run.

    A part of the name of a Blender alone, such as 5.2, does not mean these: packaging takes a quarter of an hour a platform.
    """
    parts = [part for part in only if not any(part in name for name in blenders.NAMES)]
    chosen = {group: needed for group, needed in _groups().items() if everything or any(part in group for part in parts)}
    return {
        "PLATFORMS": [platform for platform in PLATFORMS if any(platform in needed for needed in chosen.values())],
        "RELEASED": [one.name for one in BLENDERS if f"packages in {one.name}" in chosen],
    }
