"""Which groups of tests run inside which Blenders, by the table in blenders.py."""

import sys
from typing import NamedTuple

import blenders


class Groups(NamedTuple):
    """Names of Blenders, oldest first."""

    whole: list  # that run the whole suite without a window
    window: list  # that run the tests in a window
    smoke: list  # that run a minute of every system
    missing: list  # of all these, those that cannot be had: their groups are skipped

    def lists(self):
        """What CMakeLists.txt is told."""
        here = [name for name in self.whole if name not in self.missing]
        known = {*self.whole, *self.window, *self.smoke}
        lists = {
            "WHOLE": [f"{kind_of_whole(name)} {name}" for name in self.whole],
            "WINDOW": self.window,
            "SMOKE": self.smoke,
            "EXTENSIONS": [name for name in _sorted(known) if blenders.named(name).age >= [4, 2]],
            "NEWEST": here[-1:],
        }
        return {name: ";".join(items) for name, items in lists.items()}


def kind_of_whole(name):
    """The first word of the group that runs the whole suite in a Blender."""
    return "blender" if blenders.named(name).kind == "program" else "official"


def _sorted(names):
    return sorted(names, key=lambda name: blenders.named(name).age)


def planned(names, only, is_here):
    """The Groups to run. names: Blenders to run everything in; none for what the table says. only: parts of groups' names, as --only has them.

    is_here(name) says whether there is such a Blender; it is asked for those that are run. Where nothing is asked for, a Blender that cannot be had is
    stood in for, as the table says, so that no version of Blender goes untested.
    """
    is_asked_for = bool(names) or any(only)
    ours = [blenders.named(name) for name in names or blenders.NAMES]
    runs = {one.name: {"whole", "window", "smoke"} if is_asked_for else set(one.tests) for one in ours}
    for one in ours:
        if one.kind != "program":
            runs[one.name].discard("window")
        if names:
            runs[one.name].discard("smoke")  # which is in the whole
    chosen = {(name, kind) for name, kinds in runs.items() for kind in kinds if _is_chosen(name, kind, only)}
    missing = [name for name in _sorted({name for name, _ in chosen}) if not is_here(name)]
    for one in ours if not is_asked_for else ():
        if one.stands_in_for in missing:
            print(f"motus: Blender {one.name} runs the whole suite, in the stead of {one.stands_in_for}", file=sys.stderr, flush=True)
            chosen = chosen - {(one.name, "smoke")} | {(one.name, "whole")}
    return Groups(*(_sorted(name for name, kind in chosen if kind == wanted) for wanted in ("whole", "window", "smoke")), missing)


def _is_chosen(name, kind, only):
    word = kind_of_whole(name) if kind == "whole" else kind
    groups = [f"{word} {name}", *([f"validate {name}"] if word != "window" else [])]
    return any(part in group for part in only for group in groups)
