"""The function every solver driver calls, and its place in the driver namespace."""

import logging
from contextlib import suppress

import bpy
from bpy.app.handlers import persistent

from .. import copies, handlers, native, stored
from ..lazy import numpy as np
from ..per_thread import keep_state, kept
from ..stored import Damaged, Newer
from ..system import Context, Setting, groups_of, of_owner, registered
from . import attribute_sink, geometry_sink, healing, outbox, property_sink, revival, rows

LARGEST_CACHE = 64  # numbers of members that there is room for at a time

log = logging.getLogger(__name__)


def motus_solve(self, name, frame, depsgraph, *values):
    """Solve one group of a system into the outbox of the evaluated carrier `self`. Never raises. Returns status.

    name: of the system, with the group's key after a dot where it has one.
    """
    # An exception would leave the driver invalid until somebody edits it; the panel shows the status instead.
    try:
        keep_state()
        healing.note_use()
        system, key = _called(name)
        if outbox.SHARED_KEY in self:
            return _solve_rows(system, self, name, frame, depsgraph, values)
        box = outbox.opened(system, self, key)
        owner = outbox.owner_of(system, self)
        _solve(system, key, self, owner, box, frame, depsgraph, values)
        outbox.let_out(system, owner, box.slots)
        if system.reads_mesh:
            healing.watch(system, owner)
        if system.reads_several:
            healing.watch_collections(system, owner)
        if not system.moves_points:
            healing.check(system, owner, self)
    except Exception as error:
        return _fail(self, name, frame, error)
    return box.slots[outbox.STATUS]


def _called(name):
    """The system and the group's key that a driver names."""
    name, _, key = name.partition(".")
    return registered[name], key


class _Points:
    """Lets drivers call motus_solve by a subscript, for systems that read neither the frame nor the depsgraph."""

    def __getitem__(self, arguments):
        carrier, name, *values = arguments
        return motus_solve(carrier, name, 0.0, None, *values)


def _solve_rows(system, mesh, name, frame, depsgraph, values):
    """Solve every row of a shared hub; returns the status of the first one, on which the driver sits."""
    layout = outbox.row_layout(system, mesh)
    slots = np.frombuffer(stored.doubles(mesh.get(outbox.out_key(system))))
    count = len(slots) // layout.size
    if count == 0 or count * layout.size != len(slots) or layout.has_attribute and count != len(mesh.vertices):
        raise Damaged("another number of rows")
    table = slots.reshape(count, layout.size)
    table[:, outbox.WEIGHT] = 0.0
    if native.module is None:
        return table[0, outbox.STATUS]
    poses = _poses(count)
    poses.reset()
    inputs = {declared.name: declared.read(value, None)
              for declared, value in zip(system.inputs, values) if not isinstance(declared, Setting)}
    context = Context(
        settings=None, owner=None, frame=frame, depsgraph=depsgraph, locations=None, rotations=None,
        targets=rows.targets(system, mesh))
    found = rows.read(system, mesh)
    healing.watch_rows(system, mesh, found)
    for index, row in enumerate(found):
        if row is None:
            continue
        if row is Damaged:
            table[index, outbox.STATUS] = outbox.DAMAGED
            continue
        context.settings, context.member_data, context.memo = row.settings, row.member_data, row.memo
        context.locations, context.rotations = poses.locations[index:index + 1], poses.rotations[index:index + 1]
        context.outputs = table[index, outbox.FIRST_OUTPUT:layout.base]
        _solve_row(system, name, mesh, context, inputs | row.inputs, table[index])
    if layout.has_attribute:
        attribute_sink.write(mesh, None, poses.locations, poses.rotations, None, 1.0)
    else:
        table[:, layout.base:layout.base + 3] = poses.locations
        table[:, layout.base + 3:] = native.module.euler_xyz(poses.rotations)
    return table[0, outbox.STATUS]


def _solve_row(system, name, mesh, context, inputs, slots):
    try:
        problem = system.solve(context, **inputs)
    except Exception as error:
        _log(mesh, name, error)
        slots[outbox.STATUS] = outbox.DAMAGED if isinstance(error, Damaged) else outbox.INTERNAL
    else:
        slots[outbox.STATUS] = 0.0 if problem is None else system.problems.index(problem) + 1.0
        if problem is None or not problem.blocking:
            slots[outbox.WEIGHT] = context.settings.influence
            return
    context.locations[:] = 0.0
    context.rotations[:] = (1.0, 0.0, 0.0, 0.0)


def _solve(system, key, carrier, owner, found, frame, depsgraph, values):
    layout, info = found.layout, found.info
    box = np.frombuffer(found.slots)
    if native.module is None:
        _do_nothing(box, layout)
        property_sink.blend(carrier, owner, box, frame, 0.0)
        if system.has_modifier:
            geometry_sink.write_nothing(system, carrier)
        return
    count = layout.members
    settings = of_owner(system, owner)
    poses = _poses(count)
    poses.reset()
    context = Context(
        settings=settings, owner=owner, frame=frame, depsgraph=depsgraph, locations=poses.locations,
        rotations=poses.rotations, scales=poses.scales, outputs=box[outbox.FIRST_OUTPUT:layout.base],
        member_data=_member_data(system, carrier, owner, count), group=key, data={} if info is None else info.data,
        memo=_memo(system, owner, key))
    inputs = _inputs(system, context, values)
    room = geometry_sink.room(system, carrier, inputs, context) if system.has_modifier else None
    drives_properties = property_sink.KEY in carrier
    if drives_properties:
        property_sink.clear(carrier, box)
    problem = system.solve(context, **inputs)
    box[outbox.STATUS] = 0.0 if problem is None else system.problems.index(problem) + 1.0
    is_blocked = problem is not None and problem.blocking
    if drives_properties:
        property_sink.blend(carrier, owner, box, frame, 0.0 if is_blocked else settings.influence)
    # Where members are relative the solver applies the influence, and then to the absolute ones among them too.
    weight = 0.0 if is_blocked else 1.0 if layout.is_relative else settings.influence
    box[outbox.WEIGHT] = weight
    if is_blocked:
        poses.reset()
    if room is not None:
        room.write(weight)
        if room.is_full and problem is None:
            box[outbox.STATUS] = outbox.FULL
        if context.wants_to_settle:
            healing.ask_to_settle(system, owner)
    elif layout.has_attribute:
        attribute_sink.write(
            carrier, lambda: groups_of(system, owner)[0].members, context.locations, context.rotations,
            context.scales if layout.has_scales else None, weight)
    elif weight > 0.0 or layout.is_relative:
        _pack(box, layout, context)


def _memo(system, owner, key):
    """What is kept of the settings for as long as Blender keeps this copy of the owner; None where they are animated."""
    if system.groups is not None:  # these keep what they read by themselves
        return None
    copy = copies.of(owner)
    if copy is None or copy.has_animated_settings(owner):
        return None
    return copy.found.setdefault((system.name, key), {})


def _inputs(system, context, values):
    """The arguments of solve by their names."""
    settings = context.settings
    found = context.kept("settings", None, lambda: {
        declared.name: declared.read(0.0, settings) for declared in system.inputs if isinstance(declared, Setting)}).copy()
    for declared, value in zip(system.inputs, values):
        if declared.name not in found:
            found[declared.name] = declared.read(value, settings)
    return found


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


def _member_data(system, carrier, owner, count):
    if system.member_data is None:
        return None
    if count == 0 and not carrier.get(outbox.MEMBER_DATA_KEY):  # no custom property holds an empty list of floats
        return np.empty(0)
    if carrier != owner:
        return np.frombuffer(stored.doubles(carrier.get(outbox.MEMBER_DATA_KEY), count))
    data = system.member_data(owner)
    if len(data) != count:
        raise Damaged("another number of members")
    return data


def _fail(carrier, name, frame, error):
    """The status of a carrier that was not solved, whose members are left at their own transforms, as far as can be."""
    _log(carrier, name, error)
    if isinstance(carrier, bpy.types.Mesh) and outbox.SHARED_KEY not in carrier and carrier.get(outbox.OWNER_KEY) is None:
        healing.note_orphan(carrier)
    for rest in (_rest_slots, _rest_attribute):
        with suppress(Exception):
            rest(*_called(name), carrier)
    with suppress(Exception):
        property_sink.blend_none(*_called(name), carrier, frame)
    if isinstance(error, Damaged):
        return float(outbox.NEWER if isinstance(error, Newer) else outbox.DAMAGED)
    return float(outbox.INTERNAL)


def _log(carrier, name, error):
    # What is damaged in a file is said in the panel; here it would be said at every frame.
    if not isinstance(error, Damaged):
        log.error("Motus: %s could not be computed on %s", name, getattr(carrier, "name", carrier), exc_info=error)


def _rest_slots(system, key, carrier):
    memory = memoryview(carrier[outbox.out_key(system, key)])
    box = np.frombuffer(memory, memory.format)
    if property_sink.KEY not in carrier:  # whose properties would be 0
        # Where nobody knows what the slots are: in a file that is as it was saved, all are 0, but for scales, which are 1.
        box[box != 1] = 0
    box[outbox.STATUS:outbox.FIRST_OUTPUT] = 0
    layout = outbox.layout_of(system, carrier, key, len(box))
    if property_sink.KEY not in carrier:
        box[outbox.FIRST_OUTPUT:layout.base] = 0
    _do_nothing(box, layout)


def _rest_attribute(system, key, carrier):
    if system.has_modifier:
        geometry_sink.write_nothing(system, carrier)
    elif isinstance(carrier, bpy.types.Mesh):
        attribute_sink.write_rest(carrier, lambda: groups_of(system, outbox.owner_of(system, carrier))[0].members)


_FUNCTIONS = {"motus_solve": motus_solve, "motus_points": _Points()}


@persistent
def _fill_namespace(*_):
    # Blender clears the namespace on every file load; load_post comes before the first evaluation.
    bpy.app.driver_namespace.update(_FUNCTIONS)


def _watched():
    found = bpy.app.handlers
    return (found.load_post, _fill_namespace), (found.save_pre, attribute_sink.store_own_poses)


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
