"""Sinks for many members where the Geometry Attribute constraint exists (Blender 5): one constraint a member.

The solver writes one 4x4 matrix a member into an attribute of the evaluated hub mesh; each constraint samples its own. A
driver on each constraint's influence would cost more than the constraint. So two kinds of members have none. A relative
member's row is the identity where nothing is to happen. For a member that *stands still* by itself (no parent, keys,
drivers or constraints of its own) the solver blends its row with the member's own transform, which it may read at any time
because nothing moves it; the owner itself has a driver all the same. The original mesh holds the own transforms and
identities too, for Blenders without the add-on.
"""

from contextlib import suppress

import bpy
from bpy.app.handlers import persistent

from ... import native
from ...blender import capabilities, drivers
from ...declare import Variable, groups_of, systems
from ...evaluated.per_thread import scratch
from ...file import stored
from ...file.stored import Damaged
from ...lazy import numpy as np
from ..hubs import hub_lookup, marks, outbox
from . import attributes

ATTRIBUTE = "motus_transform"
STILL_KEY = "motus_still"
"""Custom property of a hub's mesh: for each member whether it MOVES by itself, is STILL, or is driven RELATIVE to that."""
MOVES, STILL, RELATIVE = 0, 1, 2


def serves(system):
    """Whether the members of a system sample an attribute of the hub, and no drivers bring them the result."""
    return capabilities.has_geometry_attribute_constraint() and not (system.has_modifier or system.same_bits)


def prepare(system, mesh, owner, group):
    """Give the helper mesh of a hub one vertex and one 4x4 matrix attribute value for each member of a group.

    It has to be called before the members get their Geometry Attribute constraints.
    """
    mesh.vertices.add(len(group.members))
    mesh.attributes.new(ATTRIBUTE, 'FLOAT4X4', 'POINT')
    mesh[STILL_KEY] = [_kind(system, member, owner) for member in group.members]
    _store(mesh, *own_poses(group.members))


def prepare_row(mesh):
    """Give the mesh of a shared hub one point and matrix more, or its first."""
    if ATTRIBUTE not in mesh.attributes:
        mesh.attributes.new(ATTRIBUTE, 'FLOAT4X4', 'POINT')
    mesh.vertices.add(1)
    mesh[STILL_KEY] = [MOVES] * len(mesh.vertices)


def add(system, group, index, hub, row=None):
    """Drive member `index` of the group by its row of the hub's attribute; row: where that is another, as the hub is shared."""
    member = group.members[index]
    first = 0 if row is None else hub_lookup.first_slot(system, member.thing)
    place = index if row is None else row
    constraint = member.thing.constraints.new('GEOMETRY_ATTRIBUTE')
    constraint.name = marks.name(system)
    marks.put(constraint, hub, place)
    constraint.target = hub
    constraint.attribute_name = ATTRIBUTE
    constraint.data_type = 'FLOAT4X4'
    constraint.sample_index = place
    constraint.owner_space = member.owner_space
    constraint.apply_target_transform = False
    constraint.mix_loc = "location" in member.channels
    constraint.mix_rot = "rotation" in member.channels
    constraint.mix_scl = "scale" in member.channels
    if member.is_relative:
        constraint.mix_mode = 'AFTER_SPLIT'
    elif (_kinds(hub.data) or {place: MOVES})[place] == MOVES:
        weight = Variable('MESH', hub.data, outbox.out_path(system, first + outbox.WEIGHT, group.key))
        drivers.copy_value(constraint, "influence", weight)


def _kinds(mesh):
    """For each member what STILL_KEY says; None where that is missing or damaged."""
    try:
        return stored.whole_numbers(mesh.get(STILL_KEY), len(mesh.vertices))
    except Damaged:
        return None


def write(mesh, members, locations, rotations, scales, weight):
    """Fill the attribute of the evaluated mesh; `members()` are the evaluated members."""
    if weight < 1.0:
        still = np.array(stored.whole_numbers(mesh.get(STILL_KEY), len(mesh.vertices))) == STILL
        if still.any():
            shares = np.where(still, weight, 1.0)[:, None]
            own_locations, own_rotations, _ = _own_poses_of(mesh, members())
            locations = own_locations + shares * (locations - own_locations)
            rotations = _slerp(own_rotations, rotations, shares)
    _store(mesh, locations, rotations, scales)


def write_rest(mesh, members):
    """Let the evaluated mesh's members be where they are by themselves, but those that move: their influence is 0."""
    kinds = _kinds(mesh)
    if kinds is not None and STILL in kinds:
        _store(mesh, *_own_poses_of(mesh, members()))
        return
    count = len(mesh.vertices)
    rotations = np.zeros((count, 4))
    rotations[:, 0] = 1.0
    _store(mesh, np.zeros((count, 3)), rotations, None)


def _own_poses_of(mesh, members):
    if len(members) != len(mesh.vertices):
        raise Damaged("another number of members")
    return own_poses(members)


def own_poses(members):
    """Locations (n, 3), quaternions (n, 4) and scales (n, 3) of rows that do nothing.

    Relative members' are neutral; others have their own transforms, which counts where they stand still.
    """
    count = len(members)
    locations, rotations, scales = np.zeros((count, 3)), np.zeros((count, 4)), np.ones((count, 3))
    rotations[:, 0] = 1.0
    for index, member in enumerate(members):
        if not member.is_relative:
            locations[index] = member.thing.matrix_basis.translation
            rotations[index] = member.thing.matrix_basis.to_quaternion()
    return locations, rotations, scales


def _kind(system, member, owner):
    if member.is_relative:
        return RELATIVE
    thing = member.thing
    # Which members a group has is too dear to find out in a solver.
    stands = (
        system.groups is None
        and isinstance(thing, bpy.types.Object)
        and thing != owner
        and not (thing.parent or thing.constraints or thing.animation_data)
    )
    return STILL if stands else MOVES


def _slerp(start, end, shares):
    """Spherical interpolation of quaternions, row by row, the shorter way."""
    dots = (start * end).sum(axis=1, keepdims=True)
    end = np.where(dots < 0.0, -end, end)
    angles = np.arccos(np.minimum(np.abs(dots), 1.0))
    scale = np.sin(angles)
    near = scale < 1e-7
    divisor = np.where(near, 1.0, scale)
    mixed = np.where(near, 1.0 - shares, np.sin((1.0 - shares) * angles) / divisor) * start
    mixed += np.where(near, shares, np.sin(shares * angles) / divisor) * end
    return mixed / np.linalg.norm(mixed, axis=1, keepdims=True)


def _store(mesh, locations, rotations, scales):
    matrices = scratch("matrices", (len(locations), 16), np.float32)
    native.module.pack_matrices(locations, rotations, out=matrices, scales=scales)
    attributes.write(mesh, ATTRIBUTE, 'FLOAT4X4', matrices)


@persistent
def store_own_poses(*_):
    """Before a file is saved: let the original meshes hold where the members stand by themselves now."""
    if native.module is None:
        return
    for mesh in bpy.data.meshes:
        if mesh.library or STILL not in (_kinds(mesh) or ()):
            continue
        for system in systems():
            with suppress(Damaged):
                _store_own_poses(system, outbox.owner_of(system, mesh), mesh)


def _store_own_poses(system, owner, mesh):
    wired = [key for key, hub in hub_lookup.hubs(system, owner) if hub.data == mesh]
    for group in groups_of(system, owner) if wired else ():
        if group.key == wired[0]:
            _store(mesh, *_own_poses_of(mesh, group.members))
