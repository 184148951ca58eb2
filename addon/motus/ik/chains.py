"""Find the chain of bones that an entry of inverse kinematics drives. An entry holds the settings of one chain."""

import itertools
from typing import NamedTuple

from ..core.blender import actions
from ..core.declare import entries_on
from ..core.settings import entry_keys


class Chain(NamedTuple):
    """Names of the bones of one chain of inverse kinematics.

    bones: the bones that reach for the target, from the root to the last. effector: the bone that the entry is named after.
    use_tail: whether the effector's tail reaches for the target; then the effector is the last of `bones`. Otherwise its head
    reaches for the target, and the last of `bones` is its parent.
    """

    bones: tuple
    effector: str
    use_tail: bool

    @property
    def driven(self):
        """Names of the bones that the solver turns: `bones`, and the effector if it is not one of them."""
        return self.bones if self.use_tail else (*self.bones, self.effector)


def find(rig, entry):
    """Chain of an entry at its present length; None if the rig does not have its bones."""
    return of_bone(rig, entry.name, entry.chain_length, entry.use_tail)


def find_longest(rig, index, animated):
    """Chain of the entry at an index with the most bones that keys or a driver of its length can ever give it; None without such bones.

    Motus adds its constraints to the bones of this chain. animated: result of animated_paths() for "chain_length".
    """
    entry = rig.motus.ik.entries[index]
    paths = animated.intersection(prefix + "chain_length" for prefix in prefixes(rig, index)) if animated else ()
    return of_bone(rig, entry.name, _longest(rig, paths) if paths else entry.chain_length, entry.use_tail)


def _longest(rig, paths):
    """Largest chain length that keys or drivers at these data paths can set; 0, which means all bones, if it cannot be told.

    It can be told only for keys of the active action without modifiers, all of them above 0.
    """
    animation, *strips = actions.players(rig)
    others = [animation.drivers, *map(actions.curves_of, strips)]
    if any(curve.data_path in paths for curve in itertools.chain.from_iterable(others)):
        return 0
    curve = next(curve for curve in actions.curves_of(animation) if curve.data_path in paths)
    lengths = [round(point.co.y) for point in curve.keyframe_points]
    return max(lengths) if lengths and min(lengths) > 0 and not curve.modifiers else 0


def of_bone(rig, name, chain_length, use_tail):
    """Chain of `chain_length` bones (0: all up to the root) that ends with the bone of a name, or with its parent if use_tail is off.

    It has fewer bones if there are fewer up to the root. None if the bone is missing, or lacks the parent.
    """
    effector = rig.data.bones.get(name)
    bone = effector if use_tail or effector is None else effector.parent
    if bone is None:
        return None
    bones = [bone, *bone.parent_recursive]
    if chain_length > 0:
        bones = bones[:chain_length]
    return Chain(tuple(found.name for found in reversed(bones)), name, use_tail)


def entry_with(rig, name):
    """Index of the entry that drives a bone; -1 if there is none. An entry that is named after the bone comes first."""
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
    """Set of the data paths by which keys, NLA strips included, or drivers animate a setting of any IK entry. name: of the setting."""
    players = actions.players(rig)
    drivers = rig.animation_data.drivers if players else ()
    paths = {curve.data_path for curves in (drivers, *map(actions.curves_of, players)) for curve in curves}
    return {path for path in paths if path.startswith("motus.ik.entries[") and path.endswith("." + name)}


def prefixes(rig, index):
    """Both prefixes of data paths to an entry's settings: with its index, as Blender writes them, and with its name, as scripts may."""
    return entry_keys.prefixes("motus.ik.entries", rig.motus.ik.entries, index)


def driven_elsewhere(rig, name):
    """{bone: (label of the system, name of the entry)} of all bones of a rig that Motus drives, except by the IK entry `name`."""
    return {
        bone: (system.label, entry.name)
        for system, entry in entries_on(rig)
        if (system.name, entry.name) != ("ik", name)
        for bone in (entry.drives if system.name == "ik" else entry.keeps)
    }
