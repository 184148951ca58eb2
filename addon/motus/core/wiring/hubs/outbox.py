"""The outbox: one float array property of a solver's carrier that holds all it computed.

    [status, weight, outputs..., x, y, z, rx, ry, rz of member 0, of member 1, ..., sx, sy, sz of member 0, ...]

Scales are there where a member of the group has the channel. It lies on a hub's mesh. The solver driver sits on the first slot, status: to
Blender's dependency graph the array is one property, so whoever reads any slot of it waits for the solver. status is 0 or
the index + 1 of the system's problem (INTERNAL for an error of our own, SILENT before the first evaluation, and so on); weight is the
influence of the sinks, and 0 where they may not act. On the original the weight stays zero and the scales one for ever:
without the add-on nothing acts.

A system with several groups has an outbox a group. Beside it lies, for such a system, what the group needs to know: the
names of its outputs and of its members, and Group.data; as text, which is parsed only once.

All of that may have been changed by whoever had the file: opened() and owner_of() check it, and raise Damaged.
"""

import functools
import json
import re
from dataclasses import dataclass
from typing import NamedTuple

import bpy

from ... import keeping
from ...declare import has_settings
from ...file import stored
from ...file.stored import Damaged, Newer

STATUS, WEIGHT, FIRST_OUTPUT = 0, 1, 2
POSE_SIZE = 6
SCALE_SIZE = 3

OWNER_KEY = "motus_owner"
"""Custom property of a hub's mesh: the object whose settings it computes."""
SHARED_KEY = "motus_shared"
"""Custom property of the mesh of a hub that owners share (see rows): [1], or [0] where the members sample no attribute."""
MEMBER_DATA_KEY = "motus_member_data"
"""Custom property of a hub's mesh: what System.member_data said when the settings last changed."""
INTERNAL, SILENT, DAMAGED, NEWER, FULL, NOT_FINITE = -1, -2, -3, -4, -5, -6
VERSION = 1
"""Of what lies in an outbox and beside it; to be raised where an add-on of today could not read it."""
OTHER = "\n"
"""What Info.members has in place of a name for an object that is not the owner."""
LARGEST_CACHE = 256  # groups whose Info is known at a time

_infos = keeping.OfProcess(
    "what a hub's mesh notes of a group (Info), or the exception for why it says none", "its text and version", LARGEST_CACHE
)


@dataclass(frozen=True)
class Info:
    """What is known of a group since it was wired. uses_attribute: the poses are not in the outbox. data: of the Group."""

    outputs: tuple
    members: tuple  # names of bones; "" for the owner itself, OTHER for another object
    has_scales: bool
    is_relative: bool
    uses_attribute: bool
    data: dict
    reads: tuple  # names of the bones in Group.reads

    @functools.cached_property
    def layout(self):
        """What lies where in the outbox."""
        return Layout(FIRST_OUTPUT + len(self.outputs), len(self.members), self.has_scales, self.is_relative, self.uses_attribute)

    @functools.cached_property
    def places(self):
        """Slot of each output by its name."""
        return places_of(self.outputs)


class Layout(NamedTuple):
    """Arrangement of the values in an outbox, the float array with a solver's results. base: index of the first pose."""

    base: int
    members: int
    has_scales: bool
    is_relative: bool
    has_attribute: bool

    @property
    def size(self):
        """How many slots there are."""
        in_slots = 0 if self.has_attribute else self.members
        return self.base + in_slots * (POSE_SIZE + SCALE_SIZE * self.has_scales)


class Outbox(NamedTuple):
    """One that was found to be what it should be. slots: its memory. info: None where the system declares no groups."""

    slots: memoryview
    layout: Layout
    info: Info | None


def _is_data(value):
    """Whether a parsed value may be Group.data."""
    return isinstance(value, dict) and all(
        isinstance(one, str) or stored.fits(one, float) or stored.fits(one, [float]) for one in value.values()
    )


_INFO_FORM = ([str], [str], bool, bool, bool, _is_data, [str])

_Mesh, _Object = bpy.types.Mesh, bpy.types.Object  # to look them up there costs more than the question


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
    return re.compile(rf'\["motus_{system.name}_out(?:_(?P<key>\w+))?"\]\[(?P<slot>\d{{1,9}})\]$')


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
            group.outputs,
            tuple(_noted(member.thing, carrier) for member in group.members),
            has_scales(group),
            any(member.is_relative for member in group.members),
            uses_attribute,
            group.data,
            tuple(bone for _, bone in group.reads),
        )
        carrier[info_key(system, group.key)] = {"version": VERSION, "text": json.dumps(list(vars(noted).values()))}


def _noted(thing, hub):
    if isinstance(thing, bpy.types.PoseBone):
        return thing.name
    return "" if thing == hub.get(OWNER_KEY) else OTHER


def is_shared(system, mesh):
    """Whether owners of the system share a hub's mesh."""
    return SHARED_KEY in mesh and key_on_hub(system, mesh) is not None


def has_attribute(mesh):
    """Whether the members of a shared hub sample an attribute."""
    return stored.whole_numbers(mesh.get(SHARED_KEY), 1)[0] != 0


def row_layout(system, mesh):
    """The Layout of one row of a shared hub."""
    return Layout(FIRST_OUTPUT + len(system.outputs), 1, False, False, has_attribute(mesh))


def row_count(system, mesh):
    """How many rows a shared hub has room for; 0 where it is damaged."""
    try:
        return len(stored.doubles(mesh.get(out_key(system)))) // row_layout(system, mesh).size
    except Damaged:
        return 0


def is_whole(system, mesh):
    """Whether a shared hub is what create_shared() and add_row() make."""
    try:
        count = row_count(system, mesh)
        opened(system, mesh, row=count - 1)
    except Damaged:
        return False
    return len(mesh.vertices) == (count if has_attribute(mesh) else 0)


def create_shared(system, mesh, uses_attribute):
    """Give a hub's mesh an outbox without rows."""
    mesh[SHARED_KEY] = [int(uses_attribute)]
    mesh[out_key(system)] = [0.0]


def add_row(system, mesh):
    """Make room for one more row in the outbox of a shared hub."""
    layout = row_layout(system, mesh)
    slots = list(mesh[out_key(system)]) if row_count(system, mesh) else []
    mesh[out_key(system)] = slots + [float(SILENT)] + [0.0] * (layout.size - 1)


def is_hub(mesh):
    """Whether a mesh is that of a hub."""
    return OWNER_KEY in mesh or SHARED_KEY in mesh


def key_on_hub(system, mesh):
    """Key of the system's group that a hub's mesh serves; None where it serves none."""
    if out_key(system) in mesh:
        return ""
    prefixes = out_key(system), info_key(system)
    names = (name[len(prefix) :] for name in mesh.keys() for prefix in prefixes if name == prefix or name.startswith(f"{prefix}_"))
    return next((name[1:] for name in names), None)


def opened(system, carrier, group="", row=None):
    """A group's Outbox on a carrier, original or evaluated; one row's of a shared hub.

    Raises Damaged where it is not what create() makes.
    """
    slots = stored.doubles(carrier.get(out_key(system, group)))
    if row is not None:
        layout = row_layout(system, carrier)
        part = slots[row * layout.size : (row + 1) * layout.size]
        if row < 0 or len(part) != layout.size:
            raise Damaged("no such row")
        return Outbox(part, layout, None)
    noted = _info(system, carrier, group)
    layout = _layout_without_info(system, carrier, len(slots)) if noted is None else noted.layout
    if len(slots) != layout.size:
        raise Damaged("another number of slots")
    return Outbox(slots, layout, noted)


def layout_of(system, carrier, group, size):
    """The Layout that an outbox of so many slots should have, whatever its own is. Raises Damaged where nobody knows."""
    noted = _info(system, carrier, group)
    return _layout_without_info(system, carrier, size) if noted is None else noted.layout


def _layout_without_info(system, carrier, size):
    base = FIRST_OUTPUT + len(system.outputs)
    if system.has_modifier:
        return Layout(base, 0, False, False, False)
    if size == base and not system.same_bits:
        return Layout(base, len(carrier.vertices), False, system.is_relative, True)
    return Layout(base, max(0, size - base) // POSE_SIZE, False, system.is_relative, False)


def is_in_place(system, carrier, group=""):
    """Whether the original of a carrier still has a group's outbox.

    A script may delete the property below the driver, or put a group in its place. To Blender's dependency graph the driver then
    precedes nothing: it may run while other threads read what the solver writes.
    """
    return isinstance(carrier, _Mesh) and hasattr(carrier.original.get(out_key(system, group)), "typecode")


def has_room(mesh, count):
    """Whether a hub's mesh has data for so many members, or none as yet."""
    if MEMBER_DATA_KEY not in mesh:
        return True
    try:
        return len(stored.doubles(mesh[MEMBER_DATA_KEY], count)) == count
    except Damaged:
        return False


def owner_of(system, carrier):
    """The object whose settings a carrier's solver computes. Raises Damaged without one."""
    owner = carrier.get(OWNER_KEY)
    if not isinstance(owner, _Object) or not has_settings(system, owner):
        raise Damaged("no owner")
    return owner


def _info(system, carrier, group):
    if system.groups is None:
        return None
    name = info_key(system, group)
    noted = carrier.get(name)
    read = getattr(noted, "get", None)
    said = (read("text"), read("version", VERSION)) if read else (None, VERSION)
    is_sound = isinstance(said[0], str) and isinstance(said[1], int)  # what a damaged file has may have no hash
    found = _infos.made(said, lambda: _parsed(*said)) if is_sound else _parsed(*said)
    if not isinstance(found, Info):
        raise found("no info")
    return found


def _parsed(text, version):
    """The Info that a text says, or the exception that tells why it says none."""
    if isinstance(version, int) and version > VERSION:
        return Newer
    try:
        said = stored.parse(text, _INFO_FORM)
    except Damaged:
        return Damaged
    return Info(*said)


def info(system, carrier, group=""):
    """The Info that create() noted beside the outbox; None where the system declares no groups, or one of the two is damaged."""
    try:
        return opened(system, carrier, group).info
    except Damaged:
        return None


def places_of(outputs):
    """Slot of each output by its name."""
    return {name: FIRST_OUTPUT + index for index, name in enumerate(outputs)}
