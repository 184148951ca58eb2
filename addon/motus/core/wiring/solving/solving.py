"""Run a system's solve function at each frame, for the driver on an evaluated hub's mesh.

A Solver, or a RowsSolver for a hub that several owners share, is prepared once and kept for as long as Blender keeps the evaluated
copies for which it was prepared (core/evaluated/copies.py). The data of the hub is checked during preparation, so that each frame only
solves. A solver keeps references to evaluated datablocks. They stay valid as long as Blender keeps these at the same memory addresses,
and raise ReferenceError afterwards.

A hub is a hidden object; its mesh, also called carrier, has the driver and the outbox, an array of the results. Sinks are the
constraints, drivers and modifiers that bring results to members, the objects and bones that are driven. The result of a relative member
is applied on top of its own transform. The owner is the object whose settings are solved.
"""

import logging

import mathutils

from ... import keeping, native
from ...declare import Context, Matrix, Setting, System, groups_of, of_owner, registered
from ...evaluated import copies, read_keys
from ...file import stored
from ...file.stored import Damaged, Newer
from ...lazy import numpy as np
from ...measures import finite
from ..healing.watch import noticed
from ..hubs import outbox, outputs, sharing
from ..sinks import attribute_sink, attributes, geometry_sink, property_sink

log = logging.getLogger(__name__)

_SOLVERS = keeping.OfEvaluation(
    "prepared solvers of a hub's evaluated mesh (Solver, RowsSolver)",
    "names of the system and group in the driver's expression",
    "one for each solver driver",
)
_MEMOS = keeping.OfEvaluation(
    "values that systems derive from settings without animation (Context.kept)",
    "name of the system, key of the group; name and key that Context.kept was called with",
    "one for each name that the system passes to Context.kept",
)

_ORDINARY = 1e30
"""If the sum of the squares of numbers is below, all of them are finite. Sums of larger or unusual numbers are looked at more closely."""


def called(name):
    """Return (system, key of the group) for the name in a driver's expression. Raises Damaged if there is no such system."""
    name, _, key = name.partition(".") if isinstance(name, str) else ("", "", "")
    system = registered.get(name)
    if not isinstance(system, System):
        raise Damaged("no system")
    return system, key


def solver_of(carrier, name):
    """Return the Solver or RowsSolver for an evaluated hub's mesh (carrier) and the name in its driver's expression.

    Raises Damaged if there is no such system, or if the mesh has no valid outbox.
    """
    try:
        found = _SOLVERS.on(copies.of(carrier))[name]
        # The outbox is looked for in the original each time, for the reason that outbox.is_in_place() states.
        if found.is_current() and carrier.original.get(found.place).typecode:
            return found
    except (AttributeError, KeyError, TypeError):  # there is no solver yet, or the file has something else in a place
        pass
    return _new_solver(carrier, name)


def _new_solver(carrier, name):
    system, key = called(name)
    if not outbox.is_in_place(system, carrier, key):
        raise Damaged("no outbox")
    kind = RowsSolver if sharing.has_rows(carrier) else Solver
    found = _SOLVERS.on(copies.of(carrier))[name] = kind(system, key, carrier)
    return found


class Solver:
    """Solver of one group of a system, which computes in each evaluation. carrier: evaluated mesh with the solver's driver and results.

    place: name of the custom property that is the outbox.
    """

    def __init__(self, system, key, carrier):
        self.place = outbox.out_key(system, key)
        found = outbox.opened(system, carrier, key)
        owner = outbox.owner_of(system, carrier)
        settings, layout = of_owner(system, owner), found.layout
        self._system, self._carrier, self._owner = system, carrier, owner
        self._copy = copies.of(owner)
        # Values that are derived from the settings, kept as long as the settings are not animated.
        self._memo = None if self._copy is None else _MEMOS.on(self._copy).setdefault((system.name, key), {})
        self._slots, self._box, self._layout = found.slots, np.frombuffer(found.slots), layout
        self._outputs = self._box[outbox.FIRST_OUTPUT : layout.base]
        self._outlet = outputs.outlet(system, owner)
        self._poses = _Poses(layout.members)
        self._drives_properties = property_sink.KEY in carrier
        self._reading = read_keys.reading_of(carrier, system.name) if system.reads_keys or self._drives_properties else None
        # Whether settings are animated matters only for outlets and driven properties.
        self._counts = bool(system.outputs) or self._drives_properties
        self._place = None if owner.library else (system.name, owner.name)
        self._has_modifier = system.has_modifier
        self._reads_mesh, self._reads_several = system.reads_mesh, system.reads_several
        self._settings = [one for one in system.inputs if isinstance(one, Setting)]
        self._inputs = _inputs(system)
        self._context = Context(
            settings=settings,
            owner=owner,
            locations=self._poses.locations,
            rotations=self._poses.rotations,
            scales=self._poses.scales,
            outputs=self._outputs,
            member_data=_member_data(system, carrier, layout.members),
            group=key,
            data={} if found.info is None else found.info.data,
        )

    def is_current(self):
        """Whether the owner still has the evaluated copy for which this solver was prepared."""
        try:
            return self._copy is not None and copies.of(self._owner) is self._copy and registered[self._system.name] is self._system
        except (KeyError, ReferenceError):  # the system was unregistered, or the owner was removed
            return False

    def solve(self, frame, depsgraph, values):
        """Solve, and write the results into the outbox on the hub's mesh; returns the status.

        values: values of the driver's variables for the inputs.
        """
        if self._reading is None or not self._reading.is_edit(frame):
            return self._solve(frame, depsgraph, values)
        with self._reading:
            return self._solve(frame, depsgraph, values)

    def _solve(self, frame, depsgraph, values):
        system, carrier, owner, box = self._system, self._carrier, self._owner, self._slots
        noticed.in_use = True
        if native.module is None:
            self._do_nothing(frame)
            return box[outbox.STATUS]
        moves = self._copy.has_animated_settings if self._copy else copies.has_moving_settings(owner)
        context = self._context
        context.begin(frame, depsgraph, None if moves else self._memo)
        poses = self._poses
        poses.block[:] = poses.neutral
        inputs = self._read(values)
        room = geometry_sink.room(system, carrier, inputs, context) if self._has_modifier else None
        if self._drives_properties:
            property_sink.clear(carrier, self._box)
        problem = system.solve(context, **inputs)
        is_finite = room is None and poses.block.dot(poses.block) < _ORDINARY and self._outputs.dot(self._outputs) < _ORDINARY
        if not is_finite:
            is_finite = self._is_finite(room)
        is_blocked = not is_finite or (problem is not None and problem.blocking)
        box[outbox.STATUS] = outbox.NOT_FINITE if not is_finite else 0.0 if problem is None else system.problems.index(problem) + 1.0
        influence = context.settings.influence
        if not 0.0 <= influence <= 1.0:
            influence = finite.share(influence)
        if self._drives_properties:
            property_sink.blend(carrier, owner, self._box, frame, 0.0 if is_blocked else influence)
        # If any member is relative, solve() applies the influence itself, to the absolute members of the group too.
        weight = 0.0 if is_blocked else 1.0 if self._layout.is_relative else influence
        box[outbox.WEIGHT] = weight
        if is_blocked:
            poses.block[:] = poses.neutral
        if room is None and weight == 1.0 and self._layout.has_attribute:
            poses.store(carrier, self._layout.has_scales)
        elif room is None:
            self._store(weight)
        else:
            room.write(weight)
            if room.is_full and problem is None:
                box[outbox.STATUS] = outbox.FULL
            if context.wants_to_settle:
                noticed.note_unsettled(system, owner)
        if self._outlet is not None:
            self._outlet[:] = box[: len(self._outlet)]
        self._tell_healing(moves)
        return box[outbox.STATUS]

    def _is_finite(self, room):
        """Whether all results are finite numbers that may reach the sinks; outputs that are not finite are set to 0.

        Outputs that set properties are not checked: NaN there means that the property is left alone.
        """
        outputs = self._context.outputs
        if len(outputs) and not self._drives_properties and not finite.is_finite(outputs):
            outputs[~(np.abs(outputs) < finite.INFINITE)] = 0.0
            return False
        return finite.is_finite(self._poses.block) if room is None else room.is_finite()

    def _read(self, values):
        """Return {name: value} of the arguments of System.solve."""
        context = self._context
        found = context.kept("settings", None, self._read_settings) if self._settings else {}
        return found | _arguments(self._inputs, values, context.settings) if self._inputs else found

    def _read_settings(self):
        return {declared.name: declared.read(0.0, self._context.settings) for declared in self._settings}

    def _store(self, weight):
        """Write the poses to the attribute or the outbox that the members' sinks read. weight: influence of the sinks."""
        context, layout = self._context, self._layout
        if layout.has_attribute:
            attribute_sink.write(
                self._carrier,
                lambda: groups_of(self._system, self._owner)[0].members,
                context.locations,
                context.rotations,
                context.scales if layout.has_scales else None,
                weight,
            )
        elif weight > 0.0 or layout.is_relative:
            end = layout.base + outbox.POSE_SIZE * layout.members
            poses = self._box[layout.base : end].reshape(layout.members, outbox.POSE_SIZE)
            poses[:, :3] = context.locations
            poses[:, 3:] = native.module.euler_xyz(context.rotations)
            if layout.has_scales:
                self._box[end:] = context.scales.ravel()

    def _tell_healing(self, moves):
        if self._drives_properties:
            noticed.note_properties(self._carrier)
        if self._place is None:
            return
        if self._reads_mesh:
            noticed.moved_points.add(self._place)
        if self._reads_several:
            noticed.gathering.add(self._place)
        if not self._system.moves_points:
            drivers = copies.drivers_on(self._owner) if self._copy is None else self._copy.drivers
            state = drivers, self._counts and moves
            if noticed.states.get(self._place) != state:
                noticed.note_state(self._place, state)

    def _do_nothing(self, frame):
        do_nothing(self._box, self._layout)
        property_sink.blend(self._carrier, self._owner, self._box, frame, 0.0)
        if self._system.has_modifier:
            geometry_sink.write_nothing(self._system, self._carrier)


class RowsSolver:
    """Solver for a hub that several owners share, with one row of the outbox for each owner. mesh: evaluated mesh of the hub."""

    def __init__(self, system, _key, mesh):
        self.place = outbox.out_key(system)
        self._system, self._mesh = system, mesh
        self._layout = layout = outbox.row_layout(system, mesh)
        slots = np.frombuffer(stored.doubles(mesh.get(outbox.out_key(system))))
        count = len(slots) // layout.size
        if count == 0 or count * layout.size != len(slots) or (layout.has_attribute and count != len(mesh.vertices)):
            raise Damaged("another number of rows")
        self._slots, self._table, self._poses = slots, slots.reshape(count, layout.size), _Poses(count)
        self._pointers = sharing.pointer_names(system)
        self._inputs = _inputs(system)
        self._rows = [sharing.row(system, mesh, index) for index in range(count)]
        self._contexts = [self._context(index, row) for index, row in enumerate(self._rows)]
        self._name = mesh.name if not mesh.library else None

    def _context(self, index, row):
        """Return the Context for one row; None if no owner has the row, or if the row is damaged."""
        slots, here = self._table[index], slice(index, index + 1)
        if isinstance(row, sharing.Row):
            return Context(
                settings=row.settings,
                owner=None,
                locations=self._poses.locations[here],
                rotations=self._poses.rotations[here],
                outputs=slots[outbox.FIRST_OUTPUT : self._layout.base],
                member_data=row.member_data,
            )
        return None

    def is_current(self):
        """Whether the system is registered; the solver reads only the hub's mesh, for whose evaluated copy it was prepared."""
        return registered.get(self._system.name) is self._system

    def solve(self, frame, depsgraph, values):
        """Solve all rows, and write the results into the outbox on the hub's mesh; returns the status of row 0, on which the driver is."""
        table, layout, poses = self._table, self._layout, self._poses
        noticed.in_use = True
        table[:, outbox.WEIGHT] = 0.0
        if native.module is None:
            return table[0, outbox.STATUS]
        poses.block[:] = poses.neutral
        inputs = _arguments(self._inputs, values, None)
        common, targets = {}, sharing.targets(self._pointers, self._mesh)
        if self._name is not None:
            noticed.note_rows(self._system, self._name, self._rows)
        for row, context, slots in zip(self._rows, self._contexts, table):
            if context is not None:
                context.begin(frame, depsgraph, row.memo, common, targets)
                self._solve_row(context, inputs | row.inputs, slots)
            elif row is Damaged:
                slots[outbox.STATUS] = outbox.DAMAGED
        if not (poses.block.dot(poses.block) < _ORDINARY and self._slots.dot(self._slots) < _ORDINARY):
            self._look_at_numbers()
        if layout.has_attribute:
            poses.store(self._mesh, has_scales=False)
        else:
            table[:, layout.base : layout.base + 3] = poses.locations
            table[:, layout.base + 3 :] = native.module.euler_xyz(poses.rotations)
        return table[0, outbox.STATUS]

    def _solve_row(self, context, inputs, slots):
        system = self._system
        try:
            problem = system.solve(context, **inputs)
        except Exception as error:
            slots[outbox.STATUS] = status_of(error, self._mesh, system.name, None)
        else:
            slots[outbox.STATUS] = 0.0 if problem is None else system.problems.index(problem) + 1.0
            if problem is None or not problem.blocking:
                influence = context.settings.influence
                slots[outbox.WEIGHT] = influence if 0.0 <= influence <= 1.0 else finite.share(influence)
                return
        _make_neutral(context)

    def _look_at_numbers(self):
        """Check the results: a row with a number that sinks must not get, such as NaN or infinity, is made neutral, and its status says so."""
        for context, slots in zip(self._contexts, self._table):
            if context is None or all(map(finite.is_finite, (context.locations, context.rotations, context.outputs))):
                continue
            if slots[outbox.STATUS] >= 0.0:
                slots[outbox.STATUS] = outbox.NOT_FINITE
            slots[outbox.WEIGHT] = 0.0
            context.outputs[:] = 0.0
            _make_neutral(context)


def _make_neutral(context):
    context.locations[:] = 0.0
    context.rotations[:] = (1.0, 0.0, 0.0, 0.0)


def _inputs(system):
    """Return (position among the driver's arguments, name, class, read) for each input of a system that is not read from the settings.

    A value of this class is the input's value as it is; read(value, settings) returns the input's value for any other one.
    """
    declared = [(index, one) for index, one in enumerate(system.inputs) if not isinstance(one, Setting)]
    return [(index, one.name, mathutils.Matrix if one.read is Matrix.read else None, one.read) for index, one in declared]


def _arguments(inputs, values, settings):
    """Return {name: value} for these inputs, read from the values of the driver's variables. Raises Damaged if there are too few values."""
    if inputs and len(values) <= inputs[-1][0]:
        raise Damaged("too few arguments")
    return {name: value if (value := values[index]).__class__ is plain else read(value, settings) for index, name, plain, read in inputs}


class _Poses:
    """Memory for the poses that a solver computes, in one array `block`; `neutral` has the numbers of poses that do nothing.

    locations (n, 3), rotations (n, 4), quaternions, and scales (n, 3) are views of the array.
    """

    def __init__(self, count):
        self.block, self.neutral = np.empty(10 * count), np.zeros(10 * count)
        self._matrices = np.empty((count, 16), np.float32)
        self._numbers = self._matrices.reshape(-1)
        self._is_checked = False
        self.locations, self.rotations, self.scales = self._parts(self.block)
        _, rotations, scales = self._parts(self.neutral)
        rotations[:, 0] = 1.0
        scales.fill(1.0)

    @staticmethod
    def _parts(block):
        locations, rotations, scales = np.split(block, [3 * len(block) // 10, 7 * len(block) // 10])
        return locations.reshape(-1, 3), rotations.reshape(-1, 4), scales.reshape(-1, 3)

    def store(self, carrier, has_scales):
        """Write the poses as matrices to the attribute of an evaluated hub's mesh (carrier) that the members' constraints sample."""
        scales = self.scales if has_scales else None
        native.module.pack_matrices(self.locations, self.rotations, out=self._matrices, scales=scales)
        if self._is_checked:  # the evaluated copy for which the solver was prepared has the attribute as it was
            carrier.attributes[attribute_sink.ATTRIBUTE].data.foreach_set("value", self._numbers)
        else:
            attributes.write(carrier, attribute_sink.ATTRIBUTE, 'FLOAT4X4', self._matrices)
            self._is_checked = carrier.original.library is None


def do_nothing(box, layout):
    """Fill an outbox with values that leave the members at their own transforms: weight 0, and neutral poses for relative members."""
    box[outbox.WEIGHT] = 0.0
    if layout.is_relative and not layout.has_attribute:
        end = layout.base + outbox.POSE_SIZE * layout.members
        box[layout.base : end] = 0.0
        box[end:] = 1.0


def _member_data(system, carrier, count):
    if system.member_data is None:
        return None
    if count == 0 and not carrier.get(outbox.MEMBER_DATA_KEY):  # a custom property cannot hold an empty list of floats
        return np.empty(0)
    return np.frombuffer(stored.doubles(carrier.get(outbox.MEMBER_DATA_KEY), count))


def status_of(error, carrier, name, settings):
    """Return the status for an error that a solver raised; the error is logged unless the file is damaged or a setting is not finite.

    settings: settings of the owner, or None if they cannot be read.
    """
    # The panel reports damaged data; a log entry would be repeated at every frame.
    if isinstance(error, Damaged):
        return float(outbox.NEWER if isinstance(error, Newer) else outbox.DAMAGED)
    if settings is not None and finite.has_bad_settings(settings):
        return float(outbox.NOT_FINITE)
    log.error("Motus: %s could not be computed on %s", name, getattr(carrier, "name", carrier), exc_info=error)
    return float(outbox.INTERNAL)
