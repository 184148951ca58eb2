"""Sinks for many members where the Geometry Attribute constraint exists (Blender 5): one constraint a member.

The solver writes one 4x4 matrix a member into an attribute of the evaluated hub mesh; each constraint samples its own.
"""

import ctypes

from .. import native
from ..system import Variable
from . import drivers, outbox

ATTRIBUTE = "motus_transform"


def prepare(mesh, count):
    """Give a hub's mesh one point and one matrix a member."""
    mesh.vertices.add(count)
    mesh.attributes.new(ATTRIBUTE, 'FLOAT4X4', 'POINT')


def add(system, target, hub, settings_source, member, channels):
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
    drivers.minimum(constraint, "influence", {
        "ok": Variable('MESH', hub.data, outbox.out_path(system, outbox.OK_SLOT)),
        "i": Variable('OBJECT', *settings_source),
    })


def write_transforms(mesh, locations, rotations):
    """Fill the attribute of the evaluated mesh."""
    matrices = native.module.pack_matrices(locations, rotations)
    data = mesh.attributes[ATTRIBUTE].data
    if mesh.original.library is None:
        data.foreach_set("value", matrices.ravel())
        return
    # On linked data foreach_set writes nothing (5.2). Assigning an item un-shares the array from the original.
    data[0].value = data[0].value
    ctypes.memmove(data[0].as_pointer(), matrices.ctypes.data, matrices.nbytes)
