"""Sinks for many members where the Geometry Attribute constraint exists (Blender 5): one constraint a member.

The solver writes one 4x4 matrix a member into an attribute of the evaluated hub mesh; each constraint samples its own. A
driver on each constraint's influence would cost more than the constraint. So a member that *stands still* by itself (no
parent, keys, drivers or constraints of its own) has none: the solver blends its row with the member's own transform, which
it may read at any time because nothing moves it. The original mesh holds the own transforms too, for Blenders without the
add-on.
"""

import bpy
from bpy.app.handlers import persistent

from .. import native
from ..lazy import numpy as np
from ..system import Variable, of_owner, registered
from . import drivers, outbox
from .scratch import scratch

ATTRIBUTE = "motus_transform"
STILL_KEY = "motus_still"
"""Custom property of a hub's mesh: for each member whether it stands still by itself."""


def prepare(mesh, members):
    """Give a hub's mesh one point and one matrix a member. Called before the members have sinks."""
    mesh.vertices.add(len(members))
    mesh.attributes.new(ATTRIBUTE, 'FLOAT4X4', 'POINT')
    mesh[STILL_KEY] = [int(_stands_still(member)) for member in members]
    _store(mesh, *own_poses(members))


def add(system, target, hub, member, channels):
    """Drive `target` (Object or PoseBone) by row `member` of the hub's attribute."""
    constraint = target.constraints.new('GEOMETRY_ATTRIBUTE')
    constraint.name = f"Motus {system.label}"
    constraint.target = hub
    constraint.attribute_name = ATTRIBUTE
    constraint.data_type = 'FLOAT4X4'
    constraint.sample_index = member
    constraint.owner_space = system.space
    constraint.apply_target_transform = False
    constraint.mix_loc = "location" in channels
    constraint.mix_rot = "rotation" in channels
    constraint.mix_scl = False
    if not hub.data[STILL_KEY][member]:
        weight = Variable('MESH', hub.data, outbox.out_path(system, outbox.WEIGHT))
        drivers.copy_value(constraint, "influence", weight)


def is_undriven(system, constraint):
    """Whether this is the sink of a member that stands still; the others' are known by their drivers."""
    if constraint.type != 'GEOMETRY_ATTRIBUTE' or constraint.target is None:
        return False
    mesh = constraint.target.data
    return outbox.out_key(system) in mesh and bool(mesh[STILL_KEY][constraint.sample_index])


def write(mesh, members, locations, rotations, weight):
    """Fill the attribute of the evaluated mesh; `members()` are the evaluated members."""
    if weight < 1.0:
        still = np.array(mesh[STILL_KEY], dtype=bool)
        if still.any():
            shares = np.where(still, weight, 1.0)[:, None]
            own_locations, own_rotations = own_poses(members())
            locations = own_locations + shares * (locations - own_locations)
            rotations = _slerp(own_rotations, rotations, shares)
    _store(mesh, locations, rotations)


def own_poses(members):
    """Locations (n, 3) and quaternions (n, 4) that the members have without sinks, where they stand still."""
    matrices = [member.matrix_basis for member in members]
    return (np.array([matrix.translation for matrix in matrices], dtype=float),
            np.array([matrix.to_quaternion() for matrix in matrices], dtype=float))


def _stands_still(member):
    return (isinstance(member, bpy.types.Object)
            and not (member.parent or member.constraints or member.animation_data))


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


def _store(mesh, locations, rotations):
    matrices = scratch("matrices", (len(locations), 16), np.float32)
    native.module.pack_matrices(locations, rotations, out=matrices)
    data = mesh.attributes[ATTRIBUTE].data
    if not mesh.is_evaluated or mesh.original.library is None:
        data.foreach_set("value", matrices.ravel())
        return
    import ctypes
    # On linked data foreach_set writes nothing (5.2). Assigning an item un-shares the array from the original.
    data[0].value = data[0].value
    ctypes.memmove(data[0].as_pointer(), matrices.ctypes.data, matrices.nbytes)


@persistent
def store_own_poses(*_):
    """Before a file is saved: let the original meshes hold where the members stand by themselves now."""
    if native.module is None:
        return
    for mesh in bpy.data.meshes:
        owner = mesh.get(outbox.OWNER_KEY)
        if owner is None or mesh.library or ATTRIBUTE not in mesh.attributes:
            continue
        for system in registered.values():
            hub = of_owner(system, owner).hub
            members = system.members(owner)
            if hub and hub.data == mesh and len(members) == len(mesh.vertices):
                _store(mesh, *own_poses(members))
