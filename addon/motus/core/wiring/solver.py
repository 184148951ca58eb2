"""The function every solver driver calls, and its place in the driver namespace."""

import logging
from array import array

import bpy
from bpy.app.handlers import persistent

from .. import handlers, native
from ..lazy import numpy as np
from ..per_thread import keep_state, kept
from ..system import Context, Vertices, groups_of, of_owner, registered
from . import geometry_sink, healing, outbox, revival
from .attribute_sink import ATTRIBUTE, store_own_poses, write, write_neutral

LARGEST_CACHE = 64  # numbers of members that there is room for at a time

log = logging.getLogger(__name__)

_Mesh, _Object = bpy.types.Mesh, bpy.types.Object  # to look them up there costs more than the question


def motus_solve(self, name, frame, depsgraph, *values):
    """Solve one group of a system into the outbox of the evaluated carrier `self`. Never raises. Returns status.

    name: of the system, with the group's key after a dot where it has one.
    """
    name, _, key = name.partition(".")
    try:
        keep_state()
        healing.note_use()
        system = registered[name]
        out = self[outbox.out_key(system, key)]
        _solve(system, key, self, memoryview(out), frame, depsgraph, values)
        if system.moves_points:
            healing.watch(system, self.get(outbox.OWNER_KEY))
        elif system.groups is not None or isinstance(self, _Object):
            healing.check(system, self.get(outbox.OWNER_KEY) or self)
    except Exception:
        # An exception would leave the driver invalid until somebody edits it; the panel shows the status instead.
        log.exception("Motus: %s could not be computed on %s", name, self.name)
        return _fail(self, name, key)
    return out[outbox.STATUS]


class _Points:
    """Lets drivers call motus_solve by a subscript, for systems that read neither the frame nor the depsgraph."""

    def __getitem__(self, arguments):
        carrier, name, *values = arguments
        return motus_solve(carrier, name, 0.0, None, *values)


def motus_direct(self, name, slot, frame, depsgraph, *values):
    """Value of one outbox slot, for sinks that are driven without an outbox. Never raises."""
    name, _, key = name.partition(".")
    out = None
    try:
        keep_state()
        healing.note_use()
        system = registered[name]
        carrier = self.id_data
        out = array('d', carrier[outbox.out_key(system, key)])
        _solve(system, key, carrier, memoryview(out), frame, depsgraph, values)
        return out[slot]
    except Exception:
        log.exception("Motus: %s could not be computed on %s", name, self.id_data.name)
        return _neutral(system, carrier, key, slot) if out else 0.0


def _layout(system, info, carrier, size):
    if info is not None:
        return info.layout
    has_attribute = isinstance(carrier, _Mesh) and ATTRIBUTE in carrier.attributes
    base = outbox.FIRST_OUTPUT + len(system.outputs)
    members = len(carrier.vertices) if has_attribute else (size - base) // outbox.POSE_SIZE
    return outbox.Layout(base, members, False, False, has_attribute)


def _solve(system, key, carrier, out, frame, depsgraph, values):
    info = outbox.info(system, carrier, key)
    layout = _layout(system, info, carrier, len(out))
    box = np.frombuffer(out)
    owner = carrier.get(outbox.OWNER_KEY) if isinstance(carrier, _Mesh) else carrier
    if native.module is None or owner is None:  # owner: of a hub, removed from the file
        _do_nothing(box, layout)
        if system.moves_points:
            geometry_sink.write_nothing(carrier)
        return
    count = layout.members
    settings = of_owner(system, owner)
    poses = _poses(count)
    poses.reset()
    context = Context(
        settings=settings, owner=owner, frame=frame, depsgraph=depsgraph, locations=poses.locations,
        rotations=poses.rotations, scales=poses.scales, outputs=box[outbox.FIRST_OUTPUT:layout.base],
        member_data=_member_data(system, carrier, owner), group=key, data={} if info is None else info.data)
    inputs = {declared.name: declared.read(value, settings) for declared, value in zip(system.inputs, values)}
    offsets = _room(system, carrier, inputs, context) if system.moves_points else None
    problem = system.solve(context, **inputs)
    box[outbox.STATUS] = 0.0 if problem is None else system.problems.index(problem) + 1.0
    is_blocked = problem is not None and problem.blocking
    # Where members are relative the solver applies the influence, and then to the absolute ones among them too.
    weight = 0.0 if is_blocked else 1.0 if layout.is_relative else settings.influence
    box[outbox.WEIGHT] = weight
    if is_blocked:
        poses.reset()
    if offsets is not None:
        if weight != 1.0:
            offsets *= np.float32(weight)
        geometry_sink.write(carrier, offsets)
        if context.wants_to_settle:
            healing.ask_to_settle(system, owner)
    elif layout.has_attribute:
        write(carrier, lambda: groups_of(system, owner)[0].members, context.locations, context.rotations,
              context.scales if layout.has_scales else None, weight)
    elif weight > 0.0 or layout.is_relative:
        _pack(box, layout, context)


def _room(system, carrier, inputs, context):
    """Zero vectors for the points of the evaluated mesh that the system moves, in the context too; all of the hub's."""
    mesh = next((inputs[declared.name] for declared in system.inputs if isinstance(declared, Vertices)), None)
    count = len(mesh.vertices) if mesh else 0
    offsets = geometry_sink.room(carrier, count)
    context.offsets = offsets[:count]
    return offsets


class _Poses:
    """Room for what a solver finds: locations (n, 3), rotations (n, 4), scales (n, 3) in one block of memory."""

    def __init__(self, count):
        self._block, self._neutral = np.empty(10 * count), np.zeros(10 * count)
        self.locations, self.rotations, self.scales = self._parts(self._block)
        _, rotations, scales = self._parts(self._neutral)
        rotations[:, 0] = 1.0
        scales.fill(1.0)

    @staticmethod
    def _parts(block):
        locations, rotations, scales = np.split(block, [3 * len(block) // 10, 7 * len(block) // 10])
        return locations.reshape(-1, 3), rotations.reshape(-1, 4), scales.reshape(-1, 3)

    def reset(self):
        """Let nothing turn or move."""
        np.copyto(self._block, self._neutral)


def _poses(count):
    """Room for so many members; valid until the thread solves for as many again."""
    known = kept("poses", dict)
    found = known.get(count)
    if found is None:
        if len(known) >= LARGEST_CACHE:
            known.clear()
        found = known[count] = _Poses(count)
    return found


def _pack(box, layout, context):
    end = layout.base + outbox.POSE_SIZE * layout.members
    poses = box[layout.base:end].reshape(layout.members, outbox.POSE_SIZE)
    poses[:, :3] = context.locations
    poses[:, 3:] = native.module.euler_xyz(context.rotations)
    if layout.has_scales:
        box[end:] = context.scales.ravel()


def _do_nothing(box, layout):
    """Values that leave the members where they stand by themselves."""
    box[outbox.WEIGHT] = 0.0
    if layout.is_relative and not layout.has_attribute:
        end = layout.base + outbox.POSE_SIZE * layout.members
        box[layout.base:end] = 0.0
        box[end:] = 1.0


def _member_data(system, carrier, owner):
    if system.member_data is None:
        return None
    if carrier == owner:
        return system.member_data(owner)
    return np.frombuffer(memoryview(carrier[outbox.MEMBER_DATA_KEY]))


def _neutral(system, carrier, key, slot):
    layout = _layout(system, outbox.info(system, carrier, key), carrier, len(carrier[outbox.out_key(system, key)]))
    return 1.0 if slot >= layout.base + outbox.POSE_SIZE * layout.members else 0.0


def _fail(carrier, name, key):
    out = carrier.get(outbox.out_key(registered[name], key)) if name in registered else None
    if out is not None:
        system = registered[name]
        layout = _layout(system, outbox.info(system, carrier, key), carrier, len(out))
        _do_nothing(np.frombuffer(memoryview(out)), layout)
        if layout.has_attribute and layout.is_relative:
            write_neutral(carrier)
        elif system.moves_points:
            geometry_sink.write_nothing(carrier)
    return float(outbox.INTERNAL)


_FUNCTIONS = {"motus_solve": motus_solve, "motus_direct": motus_direct, "motus_points": _Points()}


@persistent
def _fill_namespace(*_):
    # Blender clears the namespace on every file load; load_post comes before the first evaluation.
    bpy.app.driver_namespace.update(_FUNCTIONS)


def _watched():
    found = bpy.app.handlers
    return (found.load_post, _fill_namespace), (found.save_pre, store_own_poses)


def register():
    """Make the driver functions known, now and after every file load."""
    _fill_namespace()
    handlers.add(_watched())
    healing.register()
    revival.register()


def unregister():
    """Take the driver functions back."""
    revival.unregister()
    healing.unregister()
    handlers.remove(_watched())
    for name in _FUNCTIONS:
        bpy.app.driver_namespace.pop(name, None)
