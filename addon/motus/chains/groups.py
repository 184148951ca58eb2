"""Declare what chains drive on a rig: bones, in groups that are solved together.

A chain is a bone with all bones below it. Each entry in the rig's list of chains names the topmost bone.
"""

import json
from typing import NamedTuple

from ..core import rigs, wiring
from ..core.declare import BonesOwn, Entry, Group, Member, Transform
from ..core.evaluated.question import answered
from ..core.file.pointers import pointed
from ..core.settings.entries import unwired
from . import colliders, pins

PLAN = "plan"
"""Key of a group's data: JSON text with the names of the bones of each of the group's chains."""
LOOPED = "looped"
"""Key of a group's data: number of chains that are left out, because what they hang on or touch depends on them."""
MISSING = "missing"
"""Key of a group's data: number of entries whose bones do not exist in the rig."""
BELOW = "below"
"""Key of a group's data: number of entries whose bones belong to a different entry's chain."""
TURN = frozenset({"rotation"})


class Chain(NamedTuple):
    """A chain of bones. entry: its settings. bones: its PoseBones, each after its parent, the topmost one first."""

    entry: object
    bones: tuple

    @property
    def parent(self):
        """Name of the bone on which the chain hangs; "" if there is none."""
        parent = self.bones[0].parent
        return parent.name if parent else ""

    @property
    def names(self):
        """Names of the bones, as a tuple."""
        return tuple(bone.name for bone in self.bones)


def bones_of(rig, top):
    """List a pose bone of a rig and all below it, parents first. top: name of the bone."""
    found = [rig.pose.bones[top]]
    for bone in found:
        found += [rig.pose.bones[child.name] for child in bone.bone.children]
    return found


def chains(owner):
    """List the Chains of an owner. Entries of missing bones, and of bones that belong to a different chain, are skipped."""
    return answered((hash(owner), "chains"), lambda: _chains(owner))


def _chains(owner):
    settings = owner.motus.chains
    present = {entry.name: entry for entry in settings.entries if not is_missing(owner, entry) and not is_below(owner, entry)}
    return [Chain(entry, tuple(bones_of(owner, name))) for name, entry in present.items()]


def is_missing(owner, entry):
    """Whether an entry names a bone that does not exist in the rig."""
    return owner.pose is None or entry.name not in owner.pose.bones


def is_below(owner, entry):
    """Whether the bone of an entry belongs to the chain of a different entry."""
    entries = owner.motus.chains.entries
    return not is_missing(owner, entry) and any(bone.name in entries for bone in owner.data.bones[entry.name].parent_recursive)


def entries(owner):
    """List an Entry with what it reads and drives for each chain; the order of evaluation is found from them."""
    touched = colliders.reads(owner.motus.chains)
    return [Entry(chain.entry.name, ((owner, chain.parent), *touched, *held_by(owner, chain)), chain.names) for chain in chains(owner)]


def held_by(owner, chain):
    """List the (object, bone or "") that bones of an owner's chain are pinned to."""
    return pins.goals(owner.motus.chains, chain.names)


def groups(owner):
    """Return the Groups of an owner: one for the chains of each level, which do not depend on each other's results."""
    return answered((hash(owner), "chains", "groups"), lambda: _groups(owner))


def _groups(owner):
    levels = wiring.levels(owner)
    placed = [(levels.get(("chains", chain.entry.name)), chain) for chain in chains(owner)]
    by_level = {}
    for level, chain in placed:
        if level is not None:
            by_level.setdefault(level, []).append(chain)
    wrong = {
        LOOPED: sum(level is None for level, _ in placed),
        MISSING: sum(is_missing(owner, entry) for entry in owner.motus.chains.entries),
        BELOW: sum(is_below(owner, entry) for entry in owner.motus.chains.entries),
    }
    parts = [by_level[level] for level in sorted(by_level)] or [[]]  # an empty group still reports problems
    return tuple(_group(owner, str(index) if index else "", found, wrong) for index, found in enumerate(parts))


def _group(owner, key, found, wrong):
    bones = [bone for chain in found for bone in chain.bones]
    plan = {"fingerprint": rigs.fingerprint(owner) if bones else 0, "chains": [chain.names for chain in found]}
    read = [pair for pair in colliders.reads(owner.motus.chains) if pair[1]] if found else []
    read += [(owner, chain.parent) for chain in found] + [pair for chain in found for pair in held_by(owner, chain)]
    return Group(
        key=key,
        members=tuple(Member(bone, TURN, 'LOCAL', is_relative=True) for bone in bones),
        inputs=(*(Transform(*pair) for pair in dict.fromkeys(read)), *(BonesOwn(owner, bone.name) for bone in bones)),
        data={PLAN: json.dumps(plan), **wrong},
    )


def bone_renamed(owner, rig, old, new):
    """Rename a bone in the owner's entries and pins after the user has renamed the bone. The wiring is renewed separately.

    rig: armature object of the bone. old, new: names of the bone.
    """
    with unwired(owner.motus.chains) as settings:
        for one in (*settings.entries, *settings.pins):
            if rig == owner and one.name == old:
                one.name = new
        for pin in settings.pins:
            if pointed(pin, "target") == rig and pin.target_bone == old:
                pin.target_bone = new
