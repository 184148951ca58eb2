"""Mirror chains: bones of the other side, which Blender's naming finds, get chains with the same settings and pins."""

from typing import NamedTuple

import bpy

from ..core.refusals import Refused
from ..core.settings import entries
from ..core.translations import tr
from . import chosen, groups, pins, properties, setup

ENTRY = (*properties.KEYWORDS, "hold_end", "weight", "is_muted")
"""Settings of an entry that its other side is given."""


class Side(NamedTuple):
    """A chain of bones and the other side of it. name, other: of the topmost bones."""

    name: str
    other: str


def sides(rig, names):
    """List the Sides of the chains that bones of these names belong to, or of all chains if there are no names.

    Raises Refused if none of them has another side. Of two chains that are the other side of each other, and both meant, neither is listed.
    """
    settings = rig.motus.chains
    indices = sorted({properties.index_of(settings, name) for name in names} - {-1}) if names else range(len(settings.entries))
    if not indices:
        raise Refused(tr("{bone} belongs to no chain").format(bone=names[0]))
    meant = [entry.name for entry in (settings.entries[index] for index in indices) if groups.is_bone(entry)]
    found = [Side(name, _flipped(rig, name)) for name in meant]
    found = [side for side in found if side.name in rig.pose.bones and side.other != side.name]
    if not found:
        raise Refused(tr("No bone of {object} is the other side of these chains by its name, as Ear.R is of Ear.L").format(object=rig.name))
    found = [side for side in found if side.other not in meant]
    if not found:
        raise Refused(tr("Both sides have chains: select bones of the one that the other shall be as"))
    return found


def _flipped(rig, name):
    """Return the name of the bone on the other side of a bone; its own name if there is none."""
    other = bpy.utils.flip_name(name)
    return other if other in rig.pose.bones else name


def check(rig, found):
    """Raise Refused if Sides cannot be mirrored: bones are driven already, or move what would hold them."""
    chosen.Wanted(rig, [side.other for side in found], {}, {}).check_free()
    for side in found:
        names = [bone.name for bone in groups.bones_of(rig, side.other, groups.ends_of(rig))]
        for bone, changes in _pins(rig, side).items():
            pins.check_holds(rig, bone, names, changes["target"], changes["target_bone"])


def _pins(rig, side):
    """Return {bone of the other side: settings of its pin} for each pin of a Side's chain that has a target, and another side."""
    found, names = {}, {bone.name for bone in groups.bones_of(rig, side.name, groups.ends_of(rig))}
    for pin in rig.motus.chains.pins:
        goal, other = pins.goal(pin), _flipped(rig, pin.name)
        if goal and pin.name in names and other != pin.name:
            target, bone = goal
            held_by = _flipped(target, bone) if bone else ""
            found[other] = {"target": target, "target_bone": held_by, "weight": pin.weight, "is_muted": pin.is_muted}
    return found


def mirror(rig, found):
    """Give the other bones of Sides chains with the settings and pins of the ones that are there."""
    with entries.at_once(setup.system(), rig) as settings:
        for side in found:
            values = {name: getattr(settings.entries[side.name], name) for name in ENTRY}
            setup.entry_of_bone(settings, side.other, values)
            for bone, changes in _pins(rig, side).items():
                setup.pin(rig, bone, changes)
