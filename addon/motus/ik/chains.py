"""Which bones an entry drives, by the rig as it is now."""

import itertools
from typing import NamedTuple

from ..core.blender import actions
from ..core.declare import entries_on
from ..core.settings import entry_keys


class Chain(NamedTuple):
    """Names of bones. bones: from the root to the last one. effector: the bone that the entry is named after."""

    bones: tuple
    effector: str
    use_tail: bool

    @property
    def driven(self):
        """The bones that the solver turns: the chain's, and the effector if it is not one of these."""
        return self.bones if self.use_tail else (*self.bones, self.effector)


def find(rig, entry):
    """The chain of an entry; None where the rig has no such bones."""
    return of_bone(rig, entry.name, entry.chain_length, entry.use_tail)


def find_longest(rig, index, animated):
    """The chain of the entry at `index` with as many bones as keys or a driver of its length may ever give it, which is what is wired.

    animated: animated_paths() of chain_length.
    """
    entry = rig.motus.ik.entries[index]
    paths = animated.intersection(prefix + "chain_length" for prefix in prefixes(rig, index)) if animated else ()
    return of_bone(rig, entry.name, _longest(rig, paths) if paths else entry.chain_length, entry.use_tail)


def _longest(rig, paths):
    """The chain length to wire for where keys or drivers at these paths set it; 0, all bones, where they cannot be looked through."""
    animation, *strips = actions.players(rig)
    others = [animation.drivers, *map(actions.curves_of, strips)]
    if any(curve.data_path in paths for curve in itertools.chain.from_iterable(others)):
        return 0
    curve = next(curve for curve in actions.curves_of(animation) if curve.data_path in paths)
    lengths = [round(point.co.y) for point in curve.keyframe_points]
    return max(lengths) if lengths and min(lengths) > 0 and not curve.modifiers else 0


def of_bone(rig, name, chain_length, use_tail):
    """The chain of `chain_length` bones, as far as there are so many, that ends with a bone or with its parent."""
    effector = rig.data.bones.get(name)
    bone = effector if use_tail or effector is None else effector.parent
    if bone is None:
        return None
    bones = [bone, *bone.parent_recursive]
    if chain_length > 0:
        bones = bones[:chain_length]
    return Chain(tuple(found.name for found in reversed(bones)), name, use_tail)


def entry_with(rig, name):
    """Index of the entry that drives a bone, its own first; -1 where none does."""
    entries = rig.motus.ik.entries
    if name in entries:
        return entries.find(name)
    bone = rig.data.bones[name]
    for below in bone.children_recursive if entries else ():
        entry = entries.get(below.name)
        chain = find(rig, entry) if entry else None
        if chain and name in chain.bones:
            return entries.find(below.name)
    return -1


def animated_paths(rig, name):
    """Data paths of keys, in NLA strips too, and drivers of a setting of any entry."""
    players = actions.players(rig)
    drivers = rig.animation_data.drivers if players else ()
    paths = {curve.data_path for curves in (drivers, *map(actions.curves_of, players)) for curve in curves}
    return {path for path in paths if path.startswith("motus.ik.entries[") and path.endswith("." + name)}


def prefixes(rig, index):
    """How data paths of an entry's settings begin: Blender's own have the index, scripts may use the name."""
    return entry_keys.prefixes("motus.ik.entries", rig.motus.ik.entries, index)


def driven_elsewhere(rig, name):
    """bone -> (label of the system, entry) of all bones that Motus drives, but for those of the IK entry `name`."""
    return {
        bone: (system.label, entry.name)
        for system, entry in entries_on(rig)
        if (system.name, entry.name) != ("ik", name)
        for bone in entry.drives
    }
