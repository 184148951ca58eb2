"""The outbox: one float array property of a solver's carrier that holds all it computed.

    [status, weight, outputs..., x, y, z, rx, ry, rz of member 0, of member 1, ..., sx, sy, sz of member 0, ...]

Scales are there where a member of the group has the channel. The solver driver sits on the first slot, status: to
Blender's dependency graph the array is one property, so whoever reads any slot of it waits for the solver. status is 0 or
the index + 1 of the system's problem (INTERNAL for an error of our own, SILENT before the first evaluation); weight is the
influence of the sinks, and 0 where they may not act. On the original the weight stays zero and the scales one for ever:
without the add-on nothing acts.

A system with several groups has an outbox a group. Beside it lies, for such a system, what the group needs to know: the
names of its outputs and of its members, and Group.data; as text, with a digest by which it is parsed only once.
"""

import functools
import hashlib
import json
import re
from collections import OrderedDict
from dataclasses import dataclass
from typing import NamedTuple

import bpy

from ..system import Problem, of_owner

STATUS, WEIGHT, FIRST_OUTPUT = 0, 1, 2
POSE_SIZE = 6
SCALE_SIZE = 3

OWNER_KEY = "motus_owner"
"""Custom property of a hub's mesh: the object whose settings it computes."""
MEMBER_DATA_KEY = "motus_member_data"
"""Custom property of a hub's mesh: what System.member_data said when the settings last changed."""
INTERNAL, SILENT = -1, -2
LARGEST_CACHE = 256  # groups whose Info is known at a time

_infos = OrderedDict()
"""Info by digest: what is the same content is the same Info, in whatever file it lies."""


@dataclass(frozen=True)
class Info:
    """What is known of a group since it was wired. uses_attribute: the poses are not in the outbox. data: of the Group."""

    outputs: tuple
    members: tuple  # names
    has_scales: bool
    is_relative: bool
    uses_attribute: bool
    data: dict
    reads: tuple = ()  # names of the bones in Group.reads

    @functools.cached_property
    def layout(self):
        """What lies where in the outbox."""
        return Layout(FIRST_OUTPUT + len(self.outputs), len(self.members), self.has_scales, self.is_relative,
                      self.uses_attribute)


class Layout(NamedTuple):
    """What lies where in an outbox. base: where the poses begin."""

    base: int
    members: int
    has_scales: bool
    is_relative: bool
    has_attribute: bool


_INTERNAL_PROBLEM = Problem("Motus could not compute this: see the system console")
_MIRRORED_PROBLEM = Problem(
    "Mirrored by a negative scale, which constraints on the rotation do not keep: apply the scale", blocking=False)
_SILENT_PROBLEM = Problem("Not evaluated: the add-on's driver functions are not available in this file yet")


def out_key(system, group=""):
    """Name of a group's outbox property."""
    return f"motus_{system.name}_out_{group}" if group else f"motus_{system.name}_out"


def info_key(system, group=""):
    """Name of the property beside it."""
    return f"motus_{system.name}_info_{group}" if group else f"motus_{system.name}_info"


def out_path(system, index=None, group=""):
    """Data path of the outbox on its carrier, or of one slot of it."""
    path = f'["{out_key(system, group)}"]'
    return path if index is None else f"{path}[{index}]"


def slot_pattern(system):
    """Matches data paths of slots of any of the system's outboxes: group "key" is the group's, "slot" the index."""
    return re.compile(rf'\["motus_{system.name}_out(?:_(?P<key>\w+))?"\]\[(?P<slot>\d+)\]$')


def pose_base(group):
    """First slot of the poses."""
    return FIRST_OUTPUT + len(group.outputs)


def pose_slot(group, member):
    """First slot of a member's location and rotation."""
    return pose_base(group) + POSE_SIZE * member


def scale_slot(group, member):
    """First slot of a member's scale."""
    return pose_slot(group, len(group.members)) + SCALE_SIZE * member


def has_scales(group):
    """Whether the outbox holds scales."""
    return any("scale" in member.channels for member in group.members)


def create(system, carrier, group, uses_attribute):
    """Give `carrier` an empty outbox with room for the group's members, whose poses may go to an attribute instead."""
    members = 0 if uses_attribute else len(group.members)
    slots = [float(SILENT)] + [0.0] * (pose_slot(group, members) - 1)
    if members and has_scales(group):
        slots += [1.0] * (SCALE_SIZE * members)
    carrier[out_key(system, group.key)] = slots
    if system.groups is not None:
        noted = Info(
            group.outputs, tuple(member.thing.name for member in group.members), has_scales(group),
            any(member.is_relative for member in group.members), uses_attribute, group.data,
            tuple(bone for _, bone in group.reads))
        text = json.dumps(list(vars(noted).values()))
        digest = hashlib.sha1(text.encode()).hexdigest()
        carrier[info_key(system, group.key)] = {"digest": digest, "text": text}


def remove(system, carrier):
    """Take the outboxes of all groups away."""
    for key in [key for key in carrier.keys() if _is_ours(system, key)]:
        del carrier[key]


def _is_ours(system, key):
    return any(key == own or key.startswith(f"{own}_") for own in (out_key(system), info_key(system)))


def hub_of(system, owner, group=""):
    """The hub object of a group; None where the owner carries it itself."""
    settings = of_owner(system, owner)
    if not group:
        return settings.hub
    entry = settings.more_hubs.get(group)
    return entry.object if entry else None


def hubs(system, owner):
    """(group's key, hub object) of all groups that have one, whether it is the owner's own or not."""
    settings = of_owner(system, owner)
    found = [("", settings.hub)] if settings.hub else []
    return found + [(entry.name, entry.object) for entry in settings.more_hubs if entry.object]


def lost_hubs(system, owner):
    """Meshes of hubs of the owner whose object somebody has deleted: drivers keep them alive."""
    known = {hub.data for _, hub in hubs(system, owner)}
    return [mesh for mesh in bpy.data.meshes
            if mesh.get(OWNER_KEY) == owner and mesh not in known and key_on_hub(system, mesh) is not None]


def carriers(system, owner):
    """(group's key, carrier) of everything that is wired: the owner itself or a hub's mesh."""
    return [(key, hub.data) for key, hub in hubs(system, owner)] + _on(system, owner)


def _on(system, carrier):
    prefix = out_key(system)
    return [(key[len(prefix) + 1:], carrier) for key in carrier.keys()
            if key == prefix or key.startswith(prefix + "_")]


def carrier_of(system, owner, group=""):
    """The datablock that carries a group's solver and outbox: the owner, or its hub's mesh."""
    hub = hub_of(system, owner, group)
    return hub.data if hub else owner


def is_own_hub(hub, owner):
    """Whether a hub computes for this owner; a copy shares the hubs of the object it was copied from."""
    return hub.data.get(OWNER_KEY) == owner


def has_strange_hubs(system, owner):
    """Whether the owner was copied from another one and still hangs on its hubs."""
    return any(not is_own_hub(hub, owner) for _, hub in hubs(system, owner))


def key_on_hub(system, mesh):
    """Key of the system's group that a hub's mesh serves; None where it serves none."""
    return next((key for key, _ in _on(system, mesh)), None)


def info(system, carrier, group=""):
    """The Info that create() noted beside the outbox; None where the system declares no groups, or another version of the
    add-on has noted something else."""
    noted = carrier.get(info_key(system, group))
    digest = noted.get("digest") if noted is not None else None
    if digest is None:
        return None
    found = _infos.get(digest)
    if found is None:
        found = _infos[digest] = Info(*json.loads(noted["text"]))
        if len(_infos) > LARGEST_CACHE:
            _infos.popitem(last=False)
    return found


def output_names(system, carrier, group=""):
    """Names of a group's outputs."""
    known = info(system, carrier, group)
    return system.outputs if known is None else tuple(known.outputs)


def output_path(system, name, owner=None, group=""):
    """Data path, on the carrier, of an output for users' own drivers. owner: needed where the system declares groups."""
    names = system.outputs if owner is None else output_names(system, carrier_of(system, owner, group), group)
    return out_path(system, FIRST_OUTPUT + names.index(name), group)


def output(system, owner, name, depsgraph, group=""):
    """Value of an output as last evaluated; None where nothing was."""
    carrier = carrier_of(system, owner, group).evaluated_get(depsgraph)
    out, names = carrier.get(out_key(system, group)), output_names(system, carrier, group)
    return None if out is None or name not in names else out[FIRST_OUTPUT + names.index(name)]


def outputs_of(system, owner, entry, names, depsgraph):
    """Values of the outputs "<entry>.<name>" as last evaluated, in whichever group the entry is; None where nothing was.

    Of a system whose members are relative: its weight is never 0 where it was solved.
    """
    wanted = [f"{entry}.{name}" for name in names]
    for key, carrier in carriers(system, owner):
        evaluated = carrier.evaluated_get(depsgraph)
        out, known = evaluated.get(out_key(system, key)), output_names(system, evaluated, key)
        # Blender 5 may copy the owner anew without solving again (a change of mode): all is 0 for a while.
        if out is not None and out[WEIGHT] != 0.0 and wanted[0] in known:
            return [out[FIRST_OUTPUT + known.index(name)] for name in wanted]
    return None


def problem(system, owner, depsgraph):
    """The Problem that the solvers of the owner reported, a blocking one first; or None."""
    outs = [carrier.evaluated_get(depsgraph).get(out_key(system, key)) for key, carrier in carriers(system, owner)]
    found = sorted(filter(None, (_problem_of(system, out) for out in outs)), key=lambda one: not one.blocking)
    if found or not outs:
        return found[0] if found else None
    if system.groups is not None or not owner.matrix_basis.is_negative:
        return None
    return _MIRRORED_PROBLEM if "rotation" in system.channels(of_owner(system, owner)) else None


def _problem_of(system, out):
    if out is None:
        return None
    code = int(out[STATUS])
    if code < 0:
        return _INTERNAL_PROBLEM if code == INTERNAL else _SILENT_PROBLEM
    return system.problems[code - 1] if code else None
