"""Geometry Attribute constraints (Blender 5) as sinks: one constraint for each member, an object or bone that the owner drives.

The solver writes one 4x4 matrix for each member into an attribute of the evaluated hub's mesh, and each constraint samples the matrix of
its member. A driver on a constraint's influence would cost more time than the constraint. So two kinds of members have no such driver. The
matrix of a relative member (result applied on top of its own transform) is the identity if the solver has no influence. A member of kind
STILL is an object without parent, keys, drivers and constraints of its own: the solver blends the matrix with the member's own transform,
which the solver may read at any time because nothing changes that transform. If the owner itself is a member that is not relative, its
constraint always has the driver. The original mesh also holds these own transforms and identities, for a Blender without the add-on.
"""

from contextlib import suppress

import bpy
from bpy.app.handlers import persistent

from ... import native
from ...blender import drivers
from ...declare import Variable, groups_of, systems
from ...evaluated.per_thread import scratch
from ...file import stored
from ...file.stored import Damaged
from ...lazy import numpy as np
from ..hubs import hub_lookup, marks, outbox
from . import attributes

ATTRIBUTE = "motus_transform"
STILL_KEY = "motus_still"
"""Custom property of a hub's mesh: the kind of each member, a number.

MOVES: the member's own transform may change. STILL: the own transform does not change in time. RELATIVE: the result is applied on top
of the own transform.
"""
MOVES, STILL, RELATIVE = 0, 1, 2


def prepare(system, group, part):
    """Give a hub's mesh the vertices that the members of a group need: one each, with a 4x4 matrix in the matrix attribute.

    Also stores on the mesh whether each member moves or keeps its place (STILL_KEY). Call this function before add(). part: Part of the
    owner in the hub.
    """
    mesh, first = part.mesh, part.row
    if ATTRIBUTE not in mesh.attributes:
        mesh.attributes.new(ATTRIBUTE, 'FLOAT4X4', 'POINT')
    before, end = list(_kinds(mesh) or [MOVES] * len(mesh.vertices)), first + len(group.members)
    mesh.vertices.add(max(0, end - len(mesh.vertices)))
    kinds = [_kind(system, member, part.maker) for member in group.members]
    mesh[STILL_KEY] = before[:first] + kinds + before[end:]
    if any(kind != MOVES for kind in kinds):
        # Without the add-on, matrices of the kinds STILL and RELATIVE act: the constraints have no driver on their influence.
        _store(mesh, *own_poses(group.members))


def add(system, group, index, part):
    """Add the Geometry Attribute constraint of a member, which samples the member's matrix on the hub's mesh.

    index: index of the member in the group. part: Part of the owner in the hub.
    """
    member, hub, place = group.members[index], part.hub, part.row + index
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
        weight = Variable('MESH', hub.data, outbox.out_path(system, part.first + outbox.WEIGHT, group.key))
        drivers.copy_value(constraint, "influence", weight)


def _kinds(mesh):
    """Return the list of MOVES, STILL or RELATIVE of each member, from a hub's mesh; None if the list is missing or damaged.

    RELATIVE: the member's result is applied on top of its own transform.
    """
    try:
        return stored.whole_numbers(mesh.get(STILL_KEY), len(mesh.vertices))
    except Damaged:
        return None


def write(mesh, members, locations, rotations, scales, weight):
    """Fill the matrix attribute of an evaluated hub's mesh with the members' poses.

    members: function that returns the evaluated members. locations: (n, 3). rotations: (n, 4) quaternions. scales: (n, 3) or None. weight:
    influence, by which members of kind STILL are blended with their own transforms, since their constraints have no driver on the
    influence. Raises Damaged if the number of members is not that of the mesh.
    """
    if weight < 1.0:
        still = np.array(stored.whole_numbers(mesh.get(STILL_KEY), len(mesh.vertices))) == STILL
        if still.any():
            shares = np.where(still, weight, 1.0)[:, None]
            own_locations, own_rotations, _ = _own_poses_of(mesh, members())
            locations = own_locations + shares * (locations - own_locations)
            rotations = _slerp(own_rotations, rotations, shares)
    _store(mesh, locations, rotations, scales)


def write_rest(mesh, members):
    """Fill the matrix attribute of an evaluated hub's mesh with matrices that leave the members at their own transforms.

    A member of kind STILL gets its own transform as matrix, since its constraint acts with full influence. A member of kind RELATIVE gets
    the identity, since its result is applied on top of its own transform. The matrix of a member of kind MOVES does not matter, because a
    driver sets the influence of its constraint to 0. members: function that returns the evaluated members.
    """
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
    """Return locations (n, 3), quaternions (n, 4) and scales (n, 3) for matrices that leave members at their own transforms.

    A relative member gets a neutral pose, since a result is applied on top of its own transform. Any other member gets its own transform,
    since a result replaces it.
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
    # If the system declares groups, finding the members of a group takes too long for a solver.
    stands = (
        system.groups is None
        and isinstance(thing, bpy.types.Object)
        and thing != owner
        and not (thing.parent or thing.constraints or thing.animation_data)
    )
    return STILL if stands else MOVES


def _slerp(start, end, shares):
    """Return the spherical linear interpolation between two arrays of quaternions (n, 4), along the shorter arc.

    shares: (n, 1), 0 for `start` to 1 for `end`.
    """
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
    """Handler of save_pre: store the present transforms of members without motion of their own (STILL) in the original hub meshes.

    A Blender without the add-on then shows these members at their own transforms.
    """
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
