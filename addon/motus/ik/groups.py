"""What is wired on a rig: its entries, the bones they drive, and which of them are solved together."""

import json
import re
from typing import Any, NamedTuple

import bpy

from ..core import rigs, wiring
from ..core.declare import BonesOwn, Entry, Group, Member, Transform
from ..core.file.pointers import pointed
from ..core.settings.entries import unwired
from . import chains

OUTPUTS = ("residual", "angle", "reason", "distance", "reach")
"""What is told of each entry: "<bone>.<output>"."""
RELATIVE = frozenset({"rotation"})
STRETCHED = frozenset({"rotation", "scale"})
PLAN = "plan"
"""Key of a group's data: a JSON object that wired.Wired is made of."""

_OF_BONE = re.compile(r'^pose\.bones\["((?:[^"\\]|\\.)*)"\]\.(?!constraints\[)')


class Found(NamedTuple):
    """An IK entry whose bones exist in the rig. stretches: whether its bones may change length.

    guards: children of a stretching chain's bones that must not inherit the stretch.
    """

    entry: Any
    chain: chains.Chain
    stretches: bool
    guards: list

    def reads(self, owner):
        """The (object, bone name or "") whose evaluated transforms the chain's solution depends on: its root's parent, targets and poles."""
        parent = owner.data.bones[self.chain.bones[0]].parent
        return [(owner, parent.name if parent else ""), *goals(self.entry)]


def entries(owner):
    """For the order of evaluation: what each entry reads and drives."""
    return [Entry(found.entry.name, tuple(found.reads(owner)), (*found.chain.driven, *found.guards)) for found in survey(owner)]


def groups(owner):
    """One group for the entries of each level: they are solved by one call."""
    levels = wiring.levels(owner)
    by_level = {}
    for found in survey(owner):
        level = levels.get(("ik", found.entry.name))
        if level is not None:
            by_level.setdefault(level, []).append(found)
    driven = _bones_with_drivers(owner)
    return tuple(_group(owner, str(level) if level else "", found, driven) for level, found in sorted(by_level.items()))


def bone_renamed(owner, rig, old, new):
    """Let the entries follow a bone that was given another name. The wiring wires the rig again by itself."""
    with unwired(owner.motus.ik) as settings:
        for entry in settings.entries:
            if rig == owner and entry.name == old:
                entry.name = new
            if pointed(entry, "target") == rig and entry.target_bone == old:
                entry.target_bone = new
            if pointed(entry, "pole") == rig and entry.pole_bone == old:
                entry.pole_bone = new
            for extra in entry.extra_targets:
                if pointed(extra, "object") == rig and extra.bone == old:
                    extra.bone = new


def survey(owner):
    """All entries whose bones the rig has, and no entry before them."""
    present = list(_unshared(owner))
    # A child that is driven by another entry takes its pose from that one.
    taken = {name for _, _, chain in present for name in chain.driven}
    animated = chains.animated_paths(owner, "stretch")
    result = []
    for index, entry, chain in present:
        stretches = entry.stretch > 0.0 or (bool(animated) and any(path + "stretch" in animated for path in chains.prefixes(owner, index)))
        result.append(Found(entry, chain, stretches, _children(owner, chain, taken) if stretches else []))
    return result


def _unshared(owner):
    used, animated = set(), chains.animated_paths(owner, "chain_length")
    for index, entry in enumerate(owner.motus.ik.entries):
        chain = chains.find_longest(owner, index, animated)
        if chain and used.isdisjoint(chain.driven):
            used.update(chain.driven)
            yield index, entry, chain


def goals(entry):
    """(object, bone or "") of all that an entry goes to or bends towards."""
    pairs = [(pointed(entry, "target"), entry.target_bone), (pointed(entry, "pole"), entry.pole_bone)]
    pairs += [(pointed(extra, "object"), extra.bone) for extra in entry.extra_targets]
    return [(goal, bone if goal.pose and bone in goal.pose.bones else "") for goal, bone in pairs if goal]


def _children(owner, chain, taken):
    return [child.name for name in chain.bones for child in owner.data.bones[name].children if child.name not in taken]


def _group(owner, key, entries_found, driven):
    bones = owner.pose.bones
    on_chains, effectors, guards = [], [], []
    for found in entries_found:
        chain = found.chain
        on_chains += [Member(bones[name], STRETCHED if found.stretches else RELATIVE, 'LOCAL', is_relative=True) for name in chain.bones]
        if not chain.use_tail:
            effector = bones[chain.effector]
            effectors.append(_kept(effector) if found.stretches else Member(effector, RELATIVE, 'LOCAL', is_relative=True))
        guards += [_kept(bones[name]) for name in found.guards]
    return Group(
        key=key,
        members=(*on_chains, *effectors, *guards),  # in the order of IkPlan.rows
        inputs=_inputs(owner, entries_found, driven),
        outputs=tuple(f"{found.entry.name}.{name}" for found in entries_found for name in OUTPUTS),
        data={PLAN: plan_of(owner, entries_found)},
    )


def plan_of(owner, entries_found):
    """What wired.Wired is made of, as text."""
    # An effector that must not be stretched counts as a guard in IkPlan; it has one row all the same.
    kept = [(found.chain.effector, index) for index, found in enumerate(entries_found) if found.stretches and not found.chain.use_tail]
    guards = [(name, index) for index, found in enumerate(entries_found) for name in found.guards]
    chains_found = [
        {
            "name": found.entry.name,
            "bones": found.chain.bones,
            "effector": found.chain.effector,
            "stretches": found.stretches,
            "all": len(chains.of_bone(owner, found.entry.name, 0, found.chain.use_tail).bones),
            "target": _where(owner, pointed(found.entry, "target")),
            "target_bone": found.entry.target_bone,
            "pole": _where(owner, pointed(found.entry, "pole")),
            "pole_bone": found.entry.pole_bone,
            "extras": len(found.entry.extra_targets),
            "settings": {name: float(getattr(found.entry, name)) for name in ("tolerance", "iterations")},
        }
        for found in entries_found
    ]
    return json.dumps({"fingerprint": rigs.fingerprint(owner), "chains": chains_found, "guards": kept + guards})


def _kept(bone):
    """A bone that keeps its rotation and scale in the armature while its parent is stretched."""
    return Member(bone, STRETCHED, 'POSE')


def _where(owner, goal):
    """Whether a target or pole is the rig itself ('OWN'), another object ('OTHER'), or none ("")."""
    return "" if goal is None else 'OWN' if goal == owner else 'OTHER'


def _inputs(owner, entries_found, driven):
    """What must stand before the group is solved: what its entries read, and those of their bones that are driven."""
    read = [(owner, ""), *(pair for found in entries_found for pair in found.reads(owner))]
    own = [name for found in entries_found for name in (*found.chain.driven, *found.guards)]
    return (*(Transform(*pair) for pair in dict.fromkeys(read)), *(BonesOwn(owner, name) for name in dict.fromkeys(own) if name in driven))


def _bones_with_drivers(owner):
    """Names of the bones whose own location, rotation or scale is driven."""
    animation = owner.animation_data
    matches = [_OF_BONE.match(curve.data_path) for curve in animation.drivers] if animation else []
    return {bpy.utils.unescape_identifier(match[1]) for match in matches if match}
