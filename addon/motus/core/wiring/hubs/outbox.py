"""The outbox: a custom property, an array of float64 numbers on a hub's mesh, that holds all results of a solver.

    [status, weight, outputs..., x, y, z, rx, ry, rz of member 0, of member 1, ..., sx, sy, sz of member 0, ...]

A hub is a hidden object whose mesh carries a solver's driver and its results; a member is an object or bone that the owner of the
settings drives. Scales are present if any member of the group has the channel "scale". The driver that calls the solver is on slot 0,
the status: Blender's dependency graph treats the array as one property, so that everything that reads any slot is evaluated after the
solver.

The status is 0.0 if all is well, the index + 1 of one of the system's problems, or a negative constant of this module, such as INTERNAL
for an error in Motus or SILENT before the first evaluation. The weight is the influence of the sinks (the constraints that apply the
results), and 0 if they must not act. On the original mesh, the weight stays 0 and the scales stay 1: nothing acts if the add-on is
missing.

A system that declares groups has one outbox for each group. A second custom property beside each outbox, a text that is parsed only
once, holds the names of the group's outputs and members, and Group.data.

All of this data may have been changed by anybody who had the file: opened() and owner_of() check it, and raise Damaged.

The docstrings call the hub's mesh, original or evaluated, the carrier. Several owners can share a hub; its outbox then consists of
rows, one for each owner. The result of a relative member is applied on top of its own transform.
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
from . import traits

STATUS, WEIGHT, FIRST_OUTPUT = 0, 1, 2
POSE_SIZE = 6
SCALE_SIZE = 3

OWNER_KEY = "motus_owner"
"""Custom property of a hub's mesh: the object whose settings the hub's solver computes."""
SHARED_KEY = "motus_shared"
"""Custom property of a hub's mesh that several owners share, one row each: [1] if the members sample an attribute of the mesh, else [0]."""
MEMBER_DATA_KEY = "motus_member_data"
"""Custom property of a hub's mesh: the numbers that System.member_data returned when the settings were last edited."""
INTERNAL, SILENT, DAMAGED, NEWER, FULL, NOT_FINITE = -1, -2, -3, -4, -5, -6
VERSION = 1
"""Version of the data in and beside an outbox. It has to be raised when an existing release of the add-on could not read the data."""
OTHER = "\n"
"""Placeholder in Info.members for the name of a member that is an object different from the owner."""
LARGEST_CACHE = 256  # number of groups whose parsed Info is cached at a time

_infos = keeping.OfProcess(
    "parsed descriptions of groups, stored on hubs' meshes (Info), or Damaged or Newer",
    "text and version of the description",
    LARGEST_CACHE,
)


@dataclass(frozen=True)
class Info:
    """Description of a group, stored on the hub's mesh when the owner was wired.

    outputs: names of the outputs. members: for each member the name of its bone, "" for the owner itself, OTHER for a different object.
    has_scales: whether the outbox holds scales. is_relative: whether any member is relative (its result is applied on top of its own
    transform, not in place of it). uses_attribute: whether the poses are in an attribute of the mesh instead of the outbox. data: the
    dictionary Group.data. reads: names of the bones in Group.reads, "" for objects.
    """

    outputs: tuple
    members: tuple
    has_scales: bool
    is_relative: bool
    uses_attribute: bool
    data: dict
    reads: tuple

    @functools.cached_property
    def layout(self):
        """Layout of the outbox of the group that this Info describes."""
        return Layout(FIRST_OUTPUT + len(self.outputs), len(self.members), self.has_scales, self.is_relative, self.uses_attribute)

    @functools.cached_property
    def places(self):
        """Dictionary {name of an output: its slot in the outbox}."""
        return places_of(self.outputs)


class Layout(NamedTuple):
    """Arrangement of the values in an outbox, the float array with a solver's results, or in one row of a shared outbox.

    base: index of the first pose, behind status, weight and outputs. members: number of members. has_scales: whether scales follow the
    poses. is_relative: whether any member is relative (its result is applied on top of its own transform); it does not change the size, but
    such members ignore the weight, so that their poses must be neutral if nothing was solved. has_attribute: whether the poses are in an
    attribute of the hub's mesh instead of the array.
    """

    base: int
    members: int
    has_scales: bool
    is_relative: bool
    has_attribute: bool

    @property
    def size(self):
        """Number of slots of the outbox, or of the row."""
        in_slots = 0 if self.has_attribute else self.members
        return self.base + in_slots * (POSE_SIZE + SCALE_SIZE * self.has_scales)


class Outbox(NamedTuple):
    """An outbox, or one row of a shared outbox, whose data was checked.

    slots: memory of the float array. info: description of the group; None for a row, and if the system declares no groups and drives no
    scales.
    """

    slots: memoryview
    layout: Layout
    info: Info | None


def _is_data(value):
    """Whether a parsed value has the form of Group.data: a dictionary whose values are texts, numbers or lists of numbers."""
    return isinstance(value, dict) and all(
        isinstance(one, str) or stored.fits(one, float) or stored.fits(one, [float]) for one in value.values()
    )


_INFO_FORM = ([str], [str], bool, bool, bool, _is_data, [str])

_Mesh, _Object = bpy.types.Mesh, bpy.types.Object  # looking them up in bpy.types takes longer than the isinstance() calls that use them


def out_key(system, group=""):
    """Return the name of the custom property of a hub's mesh that holds the outbox of a group. group: key of the group."""
    return f"motus_{system.name}_out_{group}" if group else f"motus_{system.name}_out"


def info_key(system, group=""):
    """Return the name of the custom property of a hub's mesh that holds the description (Info) of a group. group: key of the group."""
    return f"motus_{system.name}_info_{group}" if group else f"motus_{system.name}_info"


def out_path(system, index=None, group=""):
    """Return the data path of a group's outbox on the hub's mesh, or of one slot of the outbox. index: index of the slot, or None."""
    path = f'["{out_key(system, group)}"]'
    return path if index is None else f"{path}[{index}]"


def slot_pattern(system):
    """Return a regular expression that matches the data path of any slot of any outbox of a system.

    The match has the groups "key", the key of the system's group (None if the key is ""), and "slot", the index of the slot.
    """
    return re.compile(rf'\["motus_{system.name}_out(?:_(?P<key>\w+))?"\]\[(?P<slot>\d{{1,9}})\]$')


def pose_base(group):
    """Return the index of the slot at which the members' poses begin in the outbox of a group."""
    return FIRST_OUTPUT + len(group.outputs)


def pose_slot(group, member):
    """Return the index of the first of the six slots for the location and rotation of a member. member: index of the member."""
    return pose_base(group) + POSE_SIZE * member


def scale_slot(group, member):
    """Return the index of the first of the three slots for the scale of a member. member: index of the member."""
    return pose_slot(group, len(group.members)) + SCALE_SIZE * member


def has_scales(group):
    """Whether the outbox of a group holds scales: whether any member has the channel "scale"."""
    return any("scale" in member.channels for member in group.members)


def create(system, carrier, group):
    """Give a hub's mesh (carrier) a new outbox with neutral values and slots for the members of a group.

    The outbox has no slots for members if their poses go to an attribute of the mesh. If the system declares groups or drives scales, a
    description (Info) is stored beside the outbox.
    """
    members = 0 if traits.uses_attribute(system) else len(group.members)
    slots = [float(SILENT)] + [0.0] * (pose_slot(group, members) - 1)
    if members and has_scales(group):
        slots += [1.0] * (SCALE_SIZE * members)
    carrier[out_key(system, group.key)] = slots
    if system.groups is not None or has_scales(group):
        noted = Info(
            group.outputs,
            tuple(_noted(member.thing, carrier) for member in group.members),
            has_scales(group),
            any(member.is_relative for member in group.members),
            traits.uses_attribute(system),
            group.data,
            tuple(bone for _, bone in group.reads),
        )
        carrier[info_key(system, group.key)] = {"version": VERSION, "text": json.dumps(list(vars(noted).values()))}


def _noted(thing, hub):
    if isinstance(thing, bpy.types.PoseBone):
        return thing.name
    return "" if thing == hub.get(OWNER_KEY) else OTHER


def is_shared(system, mesh):
    """Whether a mesh belongs to a hub that several owners of the system share."""
    return SHARED_KEY in mesh and key_on_hub(system, mesh) is not None


def has_attribute(mesh):
    """Whether members of a shared hub get their poses from the matrix attribute of its mesh, in place of its outbox, as the mesh records.

    Raises Damaged if the record is missing or invalid.
    """
    return stored.whole_numbers(mesh.get(SHARED_KEY), 1)[0] != 0


def row_layout(system, mesh):
    """Return the Layout of a row: the part of a shared hub's outbox that belongs to one owner. Raises Damaged if the mesh has none."""
    return Layout(FIRST_OUTPUT + len(system.outputs), 1, False, False, has_attribute(mesh))


def row_count(system, mesh):
    """Return the number of rows that the outbox of a shared hub has; 0 if the hub is damaged."""
    try:
        return len(stored.doubles(mesh.get(out_key(system)))) // row_layout(system, mesh).size
    except Damaged:
        return 0


def is_whole(system, mesh):
    """Whether the data of a shared hub is undamaged, with the right number of vertices of its mesh.

    The mesh has one vertex for each row if the members sample an attribute of the mesh, and none if they do not.
    """
    try:
        count = row_count(system, mesh)
        opened(system, mesh, row=count - 1)
    except Damaged:
        return False
    return len(mesh.vertices) == (count if has_attribute(mesh) else 0)


def create_shared(system, mesh):
    """Give the mesh of a new hub, which owners will share, an outbox without rows."""
    mesh[SHARED_KEY] = [int(traits.uses_attribute(system))]
    mesh[out_key(system)] = [0.0]


def add_row(system, mesh):
    """Extend the outbox of a shared hub by the slots of one more row, the part of one owner. mesh: mesh of the hub."""
    layout = row_layout(system, mesh)
    slots = list(mesh[out_key(system)]) if row_count(system, mesh) else []
    mesh[out_key(system)] = slots + [float(SILENT)] + [0.0] * (layout.size - 1)


def is_hub(mesh):
    """Whether a mesh belongs to a hub of any system."""
    return OWNER_KEY in mesh or SHARED_KEY in mesh


def key_on_hub(system, mesh):
    """Return the key of the system's group for which a hub's mesh has the outbox; None if the mesh has none of the system."""
    if out_key(system) in mesh:
        return ""
    prefixes = out_key(system), info_key(system)
    names = (name[len(prefix) :] for name in mesh.keys() for prefix in prefixes if name == prefix or name.startswith(f"{prefix}_"))
    return next((name[1:] for name in names), None)


def opened(system, carrier, group="", row=None):
    """Return the checked Outbox of a group on a hub's mesh (carrier), original or evaluated.

    row: index of a row of a shared hub, to get an Outbox of this row only; None for a whole hub. Raises Damaged if the data is not of the
    form that create() or add_row() makes.
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
    """Return the Layout for an outbox of `size` slots. The size of the Layout differs from `size` if the outbox is damaged.

    Raises Damaged if the description of the group, stored beside the outbox, cannot be read.
    """
    noted = _info(system, carrier, group)
    return _layout_without_info(system, carrier, size) if noted is None else noted.layout


def _layout_without_info(system, carrier, size):
    base = FIRST_OUTPUT + len(system.outputs)
    if system.has_modifier:
        return Layout(base, 0, False, False, False)
    if size == base and traits.may_use_attribute(system):
        return Layout(base, len(carrier.vertices), False, traits.has_relative_members(system), True)
    return Layout(base, max(0, size - base) // POSE_SIZE, False, traits.has_relative_members(system), False)


def is_in_place(system, carrier, group=""):
    """Whether the outbox of a group is still an array in a custom property of the original of a hub's mesh (carrier).

    A script may delete this property, or replace it by a group of properties. The property has the solver's driver: without the array,
    nothing in Blender's dependency graph waits for the driver any more. The solver would then write the results while other threads read
    them.
    """
    return isinstance(carrier, _Mesh) and hasattr(carrier.original.get(out_key(system, group)), "typecode")


def has_room(mesh, count):
    """Whether a hub's mesh can take `count` numbers as the members' data, which solve() reads.

    The custom property MEMBER_DATA_KEY of the mesh must either have this length already or not exist yet.
    """
    if MEMBER_DATA_KEY not in mesh:
        return True
    try:
        return len(stored.doubles(mesh[MEMBER_DATA_KEY], count)) == count
    except Damaged:
        return False


def owner_of(system, carrier):
    """Return the owner for which the solver on a hub's mesh (carrier) computes, from the owner's settings.

    Raises Damaged if the mesh names no object with settings of the system.
    """
    owner = carrier.get(OWNER_KEY)
    if not isinstance(owner, _Object) or not has_settings(system, owner):
        raise Damaged("no owner")
    return owner


def _info(system, carrier, group):
    name = info_key(system, group)
    if system.groups is None and name not in carrier:
        return None
    noted = carrier.get(name)
    read = getattr(noted, "get", None)
    said = (read("text"), read("version", VERSION)) if read else (None, VERSION)
    is_sound = isinstance(said[0], str) and isinstance(said[1], int)  # values from a damaged file may be unhashable
    found = _infos.made(said, lambda: _parsed(*said)) if is_sound else _parsed(*said)
    if not isinstance(found, Info):
        raise found("no info")
    return found


def _parsed(text, version):
    """Return the Info that the text of a group's description contains.

    Returns the class Damaged if the text is malformed, or the class Newer if a newer version of Motus wrote the text.
    """
    if isinstance(version, int) and version > VERSION:
        return Newer
    try:
        said = stored.parse(text, _INFO_FORM)
    except Damaged:
        return Damaged
    return Info(*said)


def info(system, carrier, group=""):
    """Return the Info of a group that create() has stored beside the outbox on a hub's mesh (carrier).

    Returns None if the outbox or the Info is damaged, or if no Info was stored because the system declares no groups and drives no scales.
    """
    try:
        return opened(system, carrier, group).info
    except Damaged:
        return None


def places_of(outputs):
    """Return {name: slot in the outbox} for the names of a group's outputs, which are in the order of their slots."""
    return {name: FIRST_OUTPUT + index for index, name in enumerate(outputs)}
