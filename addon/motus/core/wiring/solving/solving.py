"""Run a system's solve function at each frame, for the driver on an evaluated hub's mesh.

A Solver, or a RowsSolver for a hub that several owners share, is prepared once and kept for as long as Blender keeps the evaluated
copies for which it was prepared (core/evaluated/copies.py). The data of the hub is checked during preparation, so that each frame only
solves. A solver keeps references to evaluated datablocks. They stay valid as long as Blender keeps these at the same memory addresses,
and raise ReferenceError afterwards.

A hub is a hidden object; its mesh, also called carrier, has the driver and the outbox, an array of the results. Sinks are the
constraints, drivers and modifiers that bring results to members, the objects and bones that are driven. The result of a relative member
is applied on top of its own transform. The owner is the object whose settings are solved.
"""

from ... import keeping, native
from ...declare import Context, Setting, System, groups_of, of_owner, registered
from ...evaluated import copies, read_keys
from ...file.stored import Damaged
from ...lazy import numpy as np
from ...measures import finite
from ..healing.watch import noticed
from ..hubs import outbox, outputs, sharing, traits
from ..sinks import attribute_sink, geometry_sink, property_sink
from . import arguments
from .results import MatrixSink, do_nothing
from .rows_solver import RowsSolver

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


def called(name):
    """Return (system, key of the group) for the text "<system>" or "<system>.<key>" in a driver's expression.

    Raises Damaged if there is no such system.
    """
    name, _, key = name.partition(".") if isinstance(name, str) else ("", "", "")
    system = registered.get(name)
    if not isinstance(system, System):
        raise Damaged("no system")
    return system, key


def solver_of(carrier, name):
    """Return the Solver or RowsSolver that computes for a driver; a new one is prepared if there is none yet.

    carrier: evaluated mesh of the hub. name: text "<system>" or "<system>.<key of the group>" in the driver's expression. Raises Damaged if
    there is no such system, or if the mesh has no valid outbox.
    """
    try:
        found = _SOLVERS.on(copies.of(carrier))[name]
        # A script may have removed the outbox from the original mesh since the last call (see outbox.is_in_place).
        if found.is_current() and carrier.original.get(found.place).typecode:
            return found
    except (AttributeError, KeyError, TypeError):  # there is no solver yet, or the file has something else in a place
        pass
    return _new_solver(carrier, name)


def forget_solver(carrier, name):
    """Have a driver's solver prepared anew at the next call, because its results on the evaluated mesh were replaced. See solver_of()."""
    _SOLVERS.on(copies.of(carrier)).pop(name, None)


def _new_solver(carrier, name):
    system, key = called(name)
    if not outbox.is_in_place(system, carrier, key):
        raise Damaged("no outbox")
    found = (RowsSolver if sharing.has_rows(carrier) else Solver)(system, key, carrier)
    if native.module is not None:  # without it, what is prepared is of no use later
        _SOLVERS.on(copies.of(carrier))[name] = found
    return found


class Solver:
    """Solver of one group of a system, kept for all evaluations in which Blender keeps the evaluated copy of the owner.

    key: key of the group. carrier: evaluated mesh of the hub, with the solver's driver and results. place: name of the custom property that
    is the outbox.
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
        self._told = self._slots[: 0 if self._outlet is None else len(self._outlet)]  # the slots that the outlet repeats
        self._poses = poses = native.module and native.module.PoseBuffer(layout.members, self._outputs)
        self._matrices = MatrixSink(poses, carrier, layout.has_scales) if layout.has_attribute else None
        self._pose_slots = self._box[layout.base :]
        self._drives_properties = property_sink.KEY in carrier
        self._notes = property_sink.checked(carrier, self._slots)
        reads_keys = system.reads_keys(settings) if callable(system.reads_keys) else system.reads_keys
        self._reading = read_keys.reading_of(carrier, system.name) if reads_keys or self._drives_properties else None
        # Owners without outputs and driven properties need not be wired again if their settings become animated.
        self._counts = bool(system.outputs) or self._drives_properties
        self._watches_drivers = traits.watches_drivers(system)
        self._place = None if owner.library else (system.name, owner.name)
        self._has_modifier = system.has_modifier
        self._reads_mesh, self._reads_several = system.reads_mesh, system.reads_several
        self._settings = [one for one in system.inputs if isinstance(one, Setting)]
        self._inputs = arguments.read_from_driver(system)
        self._context = Context(
            settings=settings,
            owner=owner,
            copy=self._copy,
            poses=poses,
            outputs=self._outputs,
            member_data=arguments.member_data(system, carrier, layout.members),
            group=key,
            data={} if found.info is None else found.info.data,
        )

    def is_current(self):
        """Whether the solver can be used again: the owner still has the evaluated copy for which the solver was prepared."""
        try:
            return self._owner.get(copies.KEY)[0] == self._copy.number and registered[self._system.name] is self._system
        # The system was unregistered, the owner was removed, or its evaluated copies cannot be told apart.
        except (AttributeError, IndexError, KeyError, ReferenceError, TypeError):
            return False

    def solve(self, frame, depsgraph, values):
        """Solve the group, and write the results into the outbox on the hub's mesh; returns the status.

        values: values of the inputs that the driver passes on.
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
        poses.reset()
        inputs = self._read(values)
        room = geometry_sink.room(system, carrier, inputs, context) if self._has_modifier else None
        if self._drives_properties:
            property_sink.clear(self._notes, box)
        problem = system.solve(context, **inputs)
        is_finite = (room is None and poses.is_ordinary()) or self._is_finite(room)
        is_blocked = not is_finite or (problem is not None and problem.blocking)
        box[outbox.STATUS] = outbox.NOT_FINITE if not is_finite else 0.0 if problem is None else system.problems.index(problem) + 1.0
        influence = context.settings.influence
        if not 0.0 <= influence <= 1.0:
            influence = finite.share(influence)
        if self._drives_properties:
            property_sink.blend(self._notes, carrier, owner, box, frame, 0.0 if is_blocked else influence)
        # If any member is relative, solve() applies the influence itself, to the absolute members of the group too.
        weight = 0.0 if is_blocked else 1.0 if self._layout.is_relative else influence
        box[outbox.WEIGHT] = weight
        if is_blocked:
            poses.reset()
        if room is None and weight == 1.0 and self._matrices is not None:
            self._matrices.write()
        elif room is None:
            self._store(weight)
        else:
            room.write(weight)
            if room.is_full and problem is None:
                box[outbox.STATUS] = outbox.FULL
        if context.wants_to_settle:
            noticed.note_unsettled(system, owner)
        if self._outlet is not None:
            self._outlet[:] = self._told
        self._tell_healing(moves)
        return box[outbox.STATUS]

    def _is_finite(self, room):
        """Whether all results are finite numbers that may reach the sinks.

        If outputs are not finite, they are set to 0 and the result is False. Outputs that set properties are not checked: NaN there means
        that the property is left alone. room: object with the memory of a system that makes or moves points; None for other systems.
        """
        outputs = self._context.outputs
        if len(outputs) and not self._drives_properties and not finite.is_finite(outputs):
            outputs[~(np.abs(outputs) < finite.INFINITE)] = 0.0
            return False
        if room is not None:
            return room.is_finite()
        return finite.is_finite(self._context.locations, self._context.rotations, self._context.scales)

    def _read(self, values):
        """Return {name: value} of the arguments of System.solve. values: values of the inputs that the driver passes on."""
        context = self._context
        found = context.kept("settings", None, self._read_settings) if self._settings else {}
        arguments.read(self._inputs, values, context.settings, into=found)
        return found

    def _read_settings(self):
        return {declared.name: declared.read(0.0, self._context.settings) for declared in self._settings}

    def _store(self, weight):
        """Write the poses to the attribute of the hub's mesh, or to the outbox, whichever the members' sinks read.

        weight: 0 to 1. In the attribute, members of kind STILL (no driver sets the influence of their constraint) are blended with their
        own transforms by this weight. In the outbox, nothing is written if the weight is 0 and no member is relative (result applied on top
        of its own transform).
        """
        context, layout = self._context, self._layout
        if layout.has_attribute:
            self._poses.forget()
            attribute_sink.write(
                self._carrier,
                lambda: groups_of(self._system, self._owner)[0].members,
                context.locations,
                context.rotations,
                context.scales if layout.has_scales else None,
                weight,
            )
        elif weight > 0.0 or layout.is_relative:
            self._poses.write_slots(self._pose_slots, layout.has_scales)

    def _tell_healing(self, moves):
        if self._drives_properties:
            noticed.note_properties(self._carrier)
        if self._place is None:
            return
        if self._reads_mesh:
            noticed.moved_points.add(self._place)
        if self._reads_several:
            noticed.gathering.add(self._place)
        if self._watches_drivers:
            drivers = copies.drivers_on(self._owner) if self._copy is None else self._copy.drivers
            state = drivers, self._counts and moves
            if noticed.states.get(self._place) != state:
                noticed.note_state(self._place, state)

    def _do_nothing(self, frame):
        do_nothing(self._box, self._layout)
        property_sink.blend(self._notes, self._carrier, self._owner, self._slots, frame, 0.0)
        if self._system.has_modifier:
            geometry_sink.write_nothing(self._system, self._carrier)
