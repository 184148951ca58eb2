"""Declare what Motus wires on a rig for inverse kinematics: groups of chains that are solved together, their bones, inputs and outputs.

The owner is the armature object. An entry holds the settings of one chain.
"""

import json
import re
from typing import Any, NamedTuple

from ..core import rigs, wiring
from ..core.blender.poses import TO_BONE, bone_named
from ..core.declare import BonesOwn, Entry, Group, Member, Transform
from ..core.file.pointers import pointed
from ..core.settings.entries import unwired
from . import chains

OUTPUTS = ("residual", "angle", "reason", "distance", "reach")
"""Numbers that the solver reports for each entry; as an output of its group, each is named "<bone>.<name>"."""
RELATIVE = frozenset({"rotation"})
STRETCHED = frozenset({"rotation", "scale"})
PLAN = "plan"
"""Key in a group's data of the JSON text from which wired.Wired is made."""

_OF_BONE = re.compile(TO_BONE + r"\.(?!constraints\[)")


class Found(NamedTuple):
    """An IK entry that is solved, and the bones that it drives.

    stretches: whether the chain's bones may change length. guards: names of the children of a stretching chain's bones that must
    not inherit the stretch.
    """

    entry: Any
    chain: chains.Chain
    stretches: bool
    guards: list

    def reads(self, owner):
        """(object, bone or "") whose evaluated transforms the chain's solution depends on: the root's parent, targets and poles."""
        parent = owner.data.bones[self.chain.bones[0]].parent
        return [(owner, parent.name if parent else ""), *goals(self.entry)]


def entries(owner):
    """List of an Entry (core/declare) for each chain of an owner: what it reads and drives, from which the order of evaluation follows."""
    return [Entry(found.entry.name, tuple(found.reads(owner)), (*found.chain.driven, *found.guards)) for found in survey(owner)]


def groups(owner):
    """Groups of the owner's entries, one for each level of wiring.levels(); the chains of a group are solved by one native call.

    Of what Motus drives on rigs, a chain reads only what entries of lower levels drive. Chains whose targets move with them are left out.
    """
    levels = wiring.levels(owner)
    by_level = {}
    for found in survey(owner):
        level = levels.get(("ik", found.entry.name))
        if level is not None:
            by_level.setdefault(level, []).append(found)
    driven = _bones_with_drivers(owner)
    return tuple(_group(owner, str(level) if level else "", found, driven) for level, found in sorted(by_level.items()))


def bone_renamed(owner, rig, old, new):
    """Replace the old name of a renamed bone by the new name in the owner's entries. rig: the armature object that has the bone.

    The wiring itself wires the rig again afterwards.
    """
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
    """List of Found for all entries of an owner that are solved.

    An entry is left out if the rig does not have its bones, or if an earlier entry drives one of them.
    """
    present = list(_unshared(owner))
    # A child that a different entry drives takes its pose from that entry, and is no guard.
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
    """(object, bone or "") of an entry's target, pole, further targets and floor, without those that are not chosen."""
    pairs = [(pointed(entry, "target"), entry.target_bone), (pointed(entry, "pole"), entry.pole_bone)]
    pairs += [(pointed(extra, "object"), extra.bone) for extra in entry.extra_targets]
    pairs.append((pointed(entry, "floor"), ""))
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
    """JSON text that describes a group of chains, from which wired.Wired is made. entries_found: list of Found."""
    # In IkPlan, an effector that must not be stretched is also a guard. It still has only one row.
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
            **({"floor": True} if pointed(found.entry, "floor") else {}),
            "settings": {name: float(getattr(found.entry, name)) for name in ("tolerance", "iterations")},
        }
        for found in entries_found
    ]
    return json.dumps({"fingerprint": rigs.fingerprint(owner), "chains": chains_found, "guards": kept + guards})


def _kept(bone):
    """Member for a pose bone that keeps its rotation and scale in the armature's space while its parent is stretched."""
    return Member(bone, STRETCHED, 'POSE')


def _where(owner, goal):
    """Where a target or pole is: 'OWN' for the rig itself or its bone, 'OTHER' for a different object, "" if there is none."""
    return "" if goal is None else 'OWN' if goal == owner else 'OTHER'


def _inputs(owner, entries_found, driven):
    """Inputs that Blender evaluates before the group's solver: transforms that its entries read, and bones with drivers of their own.

    driven: names of the bones of the rig that have such drivers.
    """
    read = [(owner, ""), *(pair for found in entries_found for pair in found.reads(owner))]
    own = [name for found in entries_found for name in (*found.chain.driven, *found.guards)]
    return (*(Transform(*pair) for pair in dict.fromkeys(read)), *(BonesOwn(owner, name) for name in dict.fromkeys(own) if name in driven))


def _bones_with_drivers(owner):
    """Names of the owner's bones that have a driver on a property of their own, such as location, rotation or scale."""
    animation = owner.animation_data
    matches = [_OF_BONE.match(curve.data_path) for curve in animation.drivers] if animation else []
    return {bone_named(owner, match) for match in matches} - {""}
