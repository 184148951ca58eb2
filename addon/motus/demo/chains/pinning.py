"""Chains that hang between two places: they are added and pinned by the public operators."""

import bpy

from ..stage import shapes


def hang(rig, rows, ends, wind, **settings):
    """Let rows of bones of a rig hang, with the last bone of each pinned to an empty of its own at its place in rest pose.

    rows: lists of bone names. ends: collection of the empties. wind: {setting: value} of the rig's surroundings. settings: keywords of
    motus.chains_add.
    """
    add(rig, [row[0] for row in rows], wind, **{"frequency": 0.0, **settings})
    for row in rows:
        end = shapes.link_object(ends, f"{row[-1]} End", None)
        end.location, end.empty_display_size = rig.data.bones[row[-1]].tail_local, 0.1
        pin(rig, row[-1], end)


def add(rig, tops, wind, settle=4.0, **settings):
    """Add chains from bones of a rig. tops: names of the topmost bones."""
    check(bpy.ops.motus.chains_add(object=rig.name, bones=",".join(tops), **settings))
    chains = rig.motus.chains
    chains.settle = settle
    for name, value in wind.items():
        setattr(chains, name, value)


def pin(rig, bone, target):
    """Pin a bone's tail to an object."""
    check(bpy.ops.motus.chains_pin(object=rig.name, bones=bone, target=target.name))


def check(result):
    """Raise RuntimeError if an operator did not finish."""
    if result != {"FINISHED"}:
        raise RuntimeError("The dog and the bridge could not be set up")
