"""The function every solver driver calls, and its place in the driver namespace."""

import logging
from array import array

import bpy
from bpy.app.handlers import persistent

from .. import native
from ..lazy import numpy as np
from ..system import Context, of_owner, registered
from . import healing, outbox
from .attribute_sink import ATTRIBUTE, store_own_poses, write
from .scratch import scratch

log = logging.getLogger(__name__)


def motus_solve(self, name, frame, depsgraph, *values):
    """Solve one system into the outbox of the evaluated carrier `self`. Never raises. Returns the first slot, status."""
    try:
        system = registered[name]
        out = self[outbox.out_key(system)]
        _solve(system, self, memoryview(out), frame, depsgraph, values)
        if isinstance(self, bpy.types.Object):
            healing.check(system, self)
    except Exception:
        # An exception would leave the driver invalid until somebody edits it; the panel shows the status instead.
        log.exception("Motus: %s could not be computed on %s", name, self.name)
        return _fail(self, name)
    return out[outbox.STATUS]


def motus_direct(self, name, slot, frame, depsgraph, *values):
    """Value of one outbox slot, for sinks that are driven without an outbox. Never raises."""
    try:
        system = registered[name]
        carrier = self.id_data
        out = array('d', carrier[outbox.out_key(system)])
        _solve(system, carrier, memoryview(out), frame, depsgraph, values)
        return out[slot]
    except Exception:
        log.exception("Motus: %s could not be computed on %s", name, self.id_data.name)
        return 0.0


def _solve(system, carrier, out, frame, depsgraph, values):
    if native.module is None:
        out[outbox.WEIGHT] = 0.0
        return
    is_hub = isinstance(carrier, bpy.types.Mesh)
    owner = carrier.get(outbox.OWNER_KEY) if is_hub else carrier
    if owner is None:  # the owner of a hub was removed from the file
        out[outbox.WEIGHT] = 0.0
        return
    base = outbox.pose_base(system, 0)
    has_attribute = is_hub and ATTRIBUTE in carrier.attributes
    count = len(carrier.vertices) if has_attribute else (len(out) - base) // outbox.POSE_SIZE
    box = np.frombuffer(out)
    settings = of_owner(system, owner)
    context = Context(
        settings=settings, owner=owner, frame=frame, depsgraph=depsgraph,
        locations=scratch("locations", (count, 3), float), rotations=scratch("rotations", (count, 4), float),
        outputs=box[outbox.FIRST_OUTPUT:base], member_data=_member_data(system, carrier, owner))
    context.locations[:] = 0.0
    context.rotations[:] = (1.0, 0.0, 0.0, 0.0)
    inputs = {declared.name: declared.read(value, settings) for declared, value in zip(system.inputs, values)}
    problem = system.solve(context, **inputs)
    box[outbox.STATUS] = 0.0 if problem is None else system.problems.index(problem) + 1.0
    weight = 0.0 if problem is not None and problem.blocking else settings.influence
    box[outbox.WEIGHT] = weight
    if has_attribute:
        write(carrier, lambda: system.members(owner), context.locations, context.rotations, weight)
    elif weight > 0.0:
        poses = box[base:].reshape(count, outbox.POSE_SIZE)
        poses[:, :3] = context.locations
        poses[:, 3:] = native.module.euler_xyz(context.rotations)


def _member_data(system, carrier, owner):
    if system.member_data is None:
        return None
    if carrier == owner:
        return system.member_data(owner)
    return np.frombuffer(memoryview(carrier[outbox.MEMBER_DATA_KEY]))


def _fail(carrier, name):
    out = carrier.get(outbox.out_key(registered[name])) if name in registered else None
    if out is not None:
        out[outbox.WEIGHT] = 0.0
    return float(outbox.INTERNAL)


_FUNCTIONS = {"motus_solve": motus_solve, "motus_direct": motus_direct}


@persistent
def _fill_namespace(*_):
    # Blender clears the namespace on every file load; load_post comes before the first evaluation.
    bpy.app.driver_namespace.update(_FUNCTIONS)


def register():
    """Make the driver functions known, now and after every file load."""
    _fill_namespace()
    bpy.app.handlers.load_post.append(_fill_namespace)
    bpy.app.handlers.save_pre.append(store_own_poses)
    healing.register()


def unregister():
    """Take the driver functions back."""
    healing.unregister()
    bpy.app.handlers.save_pre.remove(store_own_poses)
    bpy.app.handlers.load_post.remove(_fill_namespace)
    for name in _FUNCTIONS:
        bpy.app.driver_namespace.pop(name, None)
