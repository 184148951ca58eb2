"""Declare what chains drive: bones of a rig, or objects in a row, in groups that are solved together.

Each entry in the owner's list of chains is a chain. Its links name objects: a row, whose root is the owner, or the anchors of a spline's
points, the root's first. Without links it is the bone of the entry's name, with all bones below it that neither another chain nor a different
system takes over.
"""

import json

from ..core import rigs, wiring
from ..core.declare import Entry, Group, Transform, entries_on, registered
from ..core.evaluated.question import answered
from ..core.file import deleted, libraries
from ..core.file.pointers import pointed
from . import colliders, curves, motion, pins
from .of_bones import Bones
from .of_objects import Row
from .properties import is_bone

PLAN = "plan"
"""Key of a group's data: JSON text with the name of the entry and the names of the things of each of the group's chains."""
LOOPED = "looped"
"""Key of a group's data: number of chains that are left out, because what they hang on or touch depends on them."""
MISSING = "missing"
"""Key of a group's data: number of entries whose bones or objects do not exist."""
PARTED = "parted"
"""Key of a group's data: whether chains that are to touch each other are in different groups."""


def bones_of(rig, top, ends):
    """List a pose bone of a rig and those below it, parents first. top: name of the bone.

    ends: names of the bones that are left out, with all below them.
    """
    found = [rig.pose.bones[top]]
    for bone in found:
        found += [rig.pose.bones[child.name] for child in bone.bone.children if child.name not in ends]
    return found


def ends_of(rig):
    """Names of the bones at which chains of a rig end, as a set: where another chain begins, and what a different system drives."""
    return answered((hash(rig), "chains", "ends"), lambda: _tops(rig) | _taken(rig))


def _tops(rig):
    return {entry.name for entry in rig.motus.chains.entries if is_bone(entry)}


def _taken(rig):
    return {name for _, entry in entries_on(rig, registered["chains"]) for name in entry.drives if isinstance(name, str)}


def objects_of(owner, entry):
    """List the objects of an entry's row that are there, behind its root: without those that a different owner drives, as of a copied owner."""
    found = [pointed(link, "object") for link in entry.links]
    return [obj for obj in found if obj is not None and libraries.is_free_or_of(obj, pointed(obj.motus.chains, "leader"), owner)]


def is_stray(obj):
    """Whether an object is moved by a chain that no owner lists: its root is gone, or it is a copy of an object that hangs."""
    if not any(True for _ in wiring.on_object(registered["chains"], obj, has_bones=False)):
        return False
    leader = pointed(obj.motus.chains, "leader")
    meant = obj, obj.override_library and obj.override_library.reference
    return leader is None or not any(pointed(link, "object") in meant for entry in leader.motus.chains.entries for link in entry.links)


def is_left(obj):
    """Whether a chain moves an object and has no owner in a collection: it is stray, or its root was deleted and is still in the file."""
    leader = pointed(obj.motus.chains, "leader")
    return is_stray(obj) or (leader is not None and deleted.is_deleted(leader))


def chain_of(owner, entry, names=None):
    """Return the chain of an entry, a Bones or Row; None if something of it does not exist. owner: original or evaluated, as the chain is then.

    names: of the bones that the chain had when it was wired; None for those that it has now.
    """
    if is_missing(owner, entry):
        return None
    if is_bone(entry):
        ends = ends_of(owner) if names is None else set(owner.pose.bones.keys()).difference(names)
        return Bones(entry, tuple(bones_of(owner, entry.name, ends)))
    if entry.spline >= 0:
        root, *things = curves.anchors(owner, entry)
        return Row(entry, root, tuple(things))
    return Row(entry, owner, tuple(objects_of(owner, entry)))


def chains(owner):
    """List the chains of an owner. Entries of missing things are skipped."""
    return answered((hash(owner), "chains"), lambda: _chains(owner))


def _chains(owner):
    present = {entry.name: entry for entry in owner.motus.chains.entries}
    return [chain for chain in (chain_of(owner, entry) for entry in present.values()) if chain is not None]


def is_missing(owner, entry):
    """Whether an entry names a bone that does not exist in the rig, or objects that are gone."""
    if entry.spline >= 0:
        return not curves.anchors(owner, entry)
    if entry.links:
        return len(objects_of(owner, entry)) < len(entry.links)
    return owner.pose is None or entry.name not in owner.pose.bones


def entries(owner):
    """List an Entry with what it reads and drives for each chain; the order of evaluation is found from them."""
    touched = colliders.reads(owner.motus.chains)
    return [
        Entry(chain.entry.name, (*chain.reads, *touched, *held_by(owner, chain)), chain.drives, chain.yields) for chain in chains(owner)
    ]


def held_by(owner, chain):
    """List the (object, bone or "") that bones of an owner's chain are pinned to."""
    return pins.goals(owner.motus.chains, chain.pinnable)


def load(settings):
    """Return the price of a step of all chains of an owner, about. settings: of an original owner, or of an evaluated one."""
    counts = [(_count(settings.id_data, entry), entry) for entry in settings.entries]
    return motion.step_price(counts, colliders.kinds(settings), None)


def _count(owner, entry):
    if is_bone(entry):
        return 0 if is_missing(owner, entry) else len(bones_of(owner, entry.name, _tops(owner)))
    return len(entry.links)


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
        PARTED: int(owner.motus.chains.use_touch and len(by_level) > 1),
    }
    parts = [by_level[level] for level in sorted(by_level)] or [[]]  # an empty group still reports problems
    return tuple(_group(owner, str(index) if index else "", found, wrong) for index, found in enumerate(parts))


def beside(owner, chain):
    """List the chains of an owner that are solved in the same group as a chain, and it itself. owner, chain: evaluated or original."""
    levels = answered((hash(owner), "chains", "levels"), lambda: wiring.levels(owner.original))
    level = levels.get(("chains", chain.entry.name))
    return [
        chain if one.entry.name == chain.entry.name else one for one in chains(owner) if levels.get(("chains", one.entry.name)) == level
    ]


def _group(owner, key, found, wrong):
    has_bones = any(isinstance(chain, Bones) for chain in found)
    plan = {
        "fingerprint": rigs.fingerprint(owner) if has_bones else 0,
        "chains": [[chain.entry.name, chain.names] for chain in found],
    }
    read = [pair for pair in colliders.reads(owner.motus.chains) if pair[1]] if found else []
    read += [pair for chain in found for pair in held_by(owner, chain)]
    return Group(
        key=key,
        members=tuple(member for chain in found for member in chain.members),
        inputs=tuple(dict.fromkeys([*(Transform(*pair) for pair in read), *(one for chain in found for one in chain.inputs)])),
        data={PLAN: json.dumps(plan), **wrong},
    )
