"""Declare what dynamics drive on an object: the object itself, its bones and its properties, in groups that are solved together.

An object with dynamics is the owner of a list of entries; each entry makes the object, one bone or one property follow its animation
like a mass on a spring.
"""

import json
import operator
from typing import NamedTuple

import bpy

from ..core import rigs, wiring
from ..core.declare import BonesOwn, Entry, Group, Member, Property, Transform
from ..core.evaluated.question import answered
from ..core.settings.entries import unwired
from ..core.tracks import in_world
from . import inputs

PLAN = "plan"
"""Key of a group's data: JSON text with the units and properties of the group, which solve._make() parses."""
LOOPED = "looped"
"""Key of a group's data: number of units that are left out, because their parent depends on the bones that they drive."""
MISSING = "missing"
"""Key of a group's data: number of entries whose bones do not exist in the rig."""
OBJECT = "object"
"""Name of the unit of the object itself.

Units of bones are named "bone " and the name of the topmost bone, units of properties by data path and index.
"""
PROPERTIES = "properties"
TURN = frozenset({"rotation"})


class Unit(NamedTuple):
    """What the solver handles in one step: the object, one bone, a chain of bones, or one property.

    kind: 'OBJECT', 'OWN' (a bone that follows its own animation), 'TAILS' (parent and child bones whose tails follow their motion in
    the world) or 'PROPERTY'.
    things: the Object or PoseBones; of a property, its owner. entries: one for each thing, the topmost bone's first.
    """

    name: str
    kind: str
    entries: tuple
    things: tuple

    def reads(self, owner):
        """List the evaluated transforms that the unit needs, as [(object, bone name or "")]."""
        if self.kind == 'OBJECT':
            parent = in_world.parent_of(owner)
            if parent == owner.parent and not inputs.follows_parent(owner, self.entries[0]):
                return []
            return [(owner.parent, parent.name if parent != owner.parent else "")]
        if self.kind != 'TAILS':
            return []
        return unit_reads(owner, self.things[0].name)

    def input(self, scene):
        """Make the input of the unit: the animation over time that the dynamics filter."""
        entry = self.entries[0]
        if self.kind == 'TAILS':
            return inputs.TailInput(self.things, entry, scene)
        if self.kind == 'OBJECT':
            return inputs.of_object(self.things[0], entry, scene)
        if self.kind == 'PROPERTY':
            return inputs.ValueInput(self.things[0], entry, scene)
        return inputs.OwnInput(self.things[0], entry, scene)

    @property
    def drives(self):
        """Tuple of what the unit drives: names of bones, or the object."""
        return tuple(thing.name if isinstance(thing, bpy.types.PoseBone) else thing for thing in self.things)


def unit_reads(owner, bone):
    """List the transforms that a chain of bones needs: [(owner, name of the parent of its topmost bone)].

    bone: name of the topmost bone. The name of the parent is "" if the topmost bone has no parent.
    """
    parent = owner.pose.bones[bone].parent
    return [(owner, parent.name if parent else "")]


def units(owner):
    """List the Units of an owner. Entries of missing bones, and further entries of one object or bone, are skipped."""
    return answered((hash(owner), "dynamics", "units"), lambda: _units(owner))


def _units(owner):
    found, tails, taken = [], {}, set()
    for entry in owner.motus.dynamics.entries:
        if entry.data_path:
            found.append(Unit(f"{entry.data_path}[{entry.index}]", 'PROPERTY', (entry,), (owner,)))
            continue
        if entry.name in taken:
            continue
        taken.add(entry.name)
        if not entry.name:
            found.append(Unit(OBJECT, 'OBJECT', (entry,), (owner,)))
        elif owner.pose is None or entry.name not in owner.pose.bones:
            continue
        elif entry.follow == 'WORLD':
            tails[entry.name] = entry
        else:
            found.append(Unit(f"bone {entry.name}", 'OWN', (entry,), (owner.pose.bones[entry.name],)))
    return [*found, *_tail_units(owner, tails, taken - set(tails))]


def _tail_units(owner, tails, others):
    """Yield a 'TAILS' Unit for each chain of bones whose tails follow.

    tails: {bone name: entry}. others: names of bones with a different kind of entry, at which chains end.
    """
    tops, depths, by_top = {"": ""}, {"": 0}, {}
    for name in tails:
        way, bone = [], owner.pose.bones[name]
        while bone is not None and bone.name not in depths:
            way.append(bone)
            bone = bone.parent
        above = bone.name if bone is not None else ""
        for one in map(operator.attrgetter("name"), reversed(way)):
            depths[one] = depths[above] + 1
            tops[one] = ("" if above in others else tops[above]) or (one if one in tails else "")
            above = one
        by_top.setdefault(tops[name], []).append(name)
    for top, names in by_top.items():
        names.sort(key=depths.__getitem__)
        yield Unit(f"bone {top}", 'TAILS', tuple(tails[name] for name in names), tuple(owner.pose.bones[name] for name in names))


def entries(owner):
    """List an Entry with what it reads and drives for each unit but the properties; the order of evaluation is found from them."""
    return [Entry(unit.name, tuple(unit.reads(owner)), unit.drives) for unit in units(owner) if unit.kind != 'PROPERTY']


def is_missing(owner, entry):
    """Whether an entry names a bone that does not exist in the rig."""
    return bool(entry.name and not entry.data_path) and (owner.pose is None or entry.name not in owner.pose.bones)


def groups(owner):
    """Return the Groups of an owner: one for the object, one for the bones of each level, one for properties.

    Each group is solved by one call. A level holds bones that do not depend on each other's results.
    """
    # One question, so that the units are found once: the levels ask for the entries too.
    return answered((hash(owner), "dynamics", "groups"), lambda: _groups(owner))


def _groups(owner):
    present = units(owner)
    levels = wiring.levels(owner)
    placed = [(levels.get(("dynamics", unit.name)), unit) for unit in present if unit.kind != 'PROPERTY']
    by_key = {}
    for level, unit in placed:
        if level is not None:
            by_key.setdefault(OBJECT if unit.kind == 'OBJECT' else f"bones{level}", []).append(unit)
    parts = [(key, by_key[key], ()) for key in sorted(by_key, key=lambda key: (key != OBJECT, key))]
    properties = [unit.entries[0] for unit in present if unit.kind == 'PROPERTY']
    if properties or not parts:  # if nothing is driven, an empty group still reports problems
        parts.append((PROPERTIES, (), properties))
    wrong = {
        LOOPED: sum(level is None for level, _ in placed),
        MISSING: sum(is_missing(owner, entry) for entry in owner.motus.dynamics.entries),
    }
    return tuple(_group(owner, key if index else "", *found, wrong) for index, (key, *found) in enumerate(parts))  # type: ignore[call-arg]


def channels(entry, thing):
    """Return the channels of an object or bone that its entry drives: a subset of "location", "rotation" and "scale"."""
    is_bone = isinstance(thing, bpy.types.PoseBone)
    if is_bone and entry.follow == 'WORLD':
        return TURN
    names = {name.lower() for name in entry.channels}
    return frozenset(names - {"location"} if is_bone and thing.bone.use_connect else names)


def bone_renamed(owner, rig, old, new):
    """Rename a bone in the owner's entries after the user has renamed the bone. The wiring is renewed separately.

    rig: armature object of the bone. old, new: names of the bone.
    """
    if rig != owner:
        return
    with unwired(owner.motus.dynamics) as settings:
        for entry in settings.entries:
            if entry.name == old and not entry.data_path:
                entry.name = new
            if entry.chain == old:
                entry.chain = new
            before, after = (f'pose.bones["{bpy.utils.escape_identifier(name)}"]' for name in (old, new))
            if entry.data_path.startswith(before):
                entry.data_path = after + entry.data_path[len(before) :]


def _group(owner, key, found, properties, wrong):
    things = [(thing, entry, unit.kind) for unit in found for thing, entry in zip(unit.things, unit.entries)]
    reads = dict.fromkeys(pair for unit in found for pair in unit.reads(owner))
    bones = [thing.name for thing, _, kind in things if kind != 'OBJECT']
    plan = {
        "fingerprint": rigs.fingerprint(owner) if bones else 0,
        "units": [[unit.kind, [entry.name for entry in unit.entries]] for unit in found],
    }
    driven = []
    if properties:
        indices = [inputs.indices_of(owner, entry.data_path, entry.index) or [entry.index] for entry in properties]
        plan[PROPERTIES] = [[entry.data_path, entry.index, len(one)] for entry, one in zip(properties, indices)]
        driven = [
            Property(f"{entry.data_path}[{index}]", owner, entry.data_path, index)
            for entry, one in zip(properties, indices)
            for index in one
        ]
    return Group(
        key=key,
        members=tuple(Member(thing, channels(entry, thing), 'LOCAL', is_relative=True) for thing, entry, _ in things),
        inputs=(*(Transform(*pair) for pair in reads), *(BonesOwn(owner, name) for name in dict.fromkeys(bones))),
        outputs=tuple(one.output for one in driven),
        properties=tuple(driven),
        data={PLAN: json.dumps(plan), **wrong},
    )
