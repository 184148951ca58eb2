"""Solver of a hub that several owners share: it computes a row of the outbox for each of them (hubs/rows.py)."""

from ... import native
from ...declare import Context, registered
from ...file import stored
from ...file.stored import Damaged
from ...lazy import numpy as np
from ...measures import finite
from ..healing.watch import noticed
from ..hubs import outbox, rows
from . import arguments
from .results import MatrixSink, status_of


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
        self._table = slots.reshape(count, layout.size)
        self._pointers = rows.pointer_names(system)
        self._inputs = arguments.read_from_driver(system)
        self._name = mesh.name if not mesh.library else None
        self._memo = {}
        self._rows = [rows.row(system, mesh, index) for index in range(count)]
        self._sound = [row if isinstance(row, rows.Row) else None for row in self._rows]
        self._influences = np.array([0.0 if row is None else finite.share(row.settings.influence) for row in self._sound])
        outputs = np.zeros((count, len(system.outputs)))
        self._poses = poses = native.module and native.module.PoseBuffer(count, outputs)
        self._matrices = MatrixSink(poses, mesh, has_scales=False) if layout.has_attribute else None
        self._pose_slots = None if layout.has_attribute else np.empty(outbox.POSE_SIZE * count)
        self._context = Context(settings=None, owner=None, outputs=outputs, poses=poses)
        self._told = self._states = self._weights = None

    def is_current(self):
        """Whether the solver can be used again: the system for which it was prepared is still registered.

        No evaluated copy has to be compared. The solver reads only the evaluated mesh of the hub, together with which it is kept.
        """
        return registered.get(self._system.name) is self._system

    def solve(self, frame, depsgraph, values):
        """Solve all rows, and write the results into the outbox on the hub's mesh.

        values: values of the inputs that the driver passes on. Returns the status of row 0, because the solver's driver is on row 0's
        status slot and Blender stores the driver's value there.
        """
        table, layout, poses, context = self._table, self._layout, self._poses, self._context
        noticed.in_use = True
        table[:, outbox.WEIGHT] = 0.0
        if native.module is None:
            return table[0, outbox.STATUS]
        poses.reset()
        inputs = {}
        arguments.read(self._inputs, values, None, into=inputs)
        if self._name is not None:
            noticed.note_rows(self._system, self._name, self._rows)
        context.begin(frame, depsgraph, self._memo, rows.targets(self._pointers, self._mesh))
        told = self._system.solve_rows(context, self._sound, **inputs)
        if told is not self._told:
            self._tell(told)
        table[:, outbox.STATUS], table[:, outbox.WEIGHT] = self._states, self._weights
        table[:, outbox.FIRST_OUTPUT : layout.base] = context.outputs
        if not poses.is_ordinary():
            self._check_numbers()
        if self._matrices is not None:
            self._matrices.write()
        elif poses.write_slots(self._pose_slots, has_scales=False):
            table[:, layout.base :] = self._pose_slots.reshape(len(table), outbox.POSE_SIZE)
        return table[0, outbox.STATUS]

    def _tell(self, told):
        """Compute the status and the weight of each row from what System.solve_rows has returned."""
        self._told = told
        self._states, self._weights = self._table[:, outbox.STATUS].copy(), self._influences.copy()
        for index, (row, one) in enumerate(zip(self._rows, told)):
            if row is Damaged:
                self._states[index] = outbox.DAMAGED
            elif isinstance(one, Exception):
                self._states[index] = status_of(one, self._mesh, self._system.name, None)
            elif row is not None:
                self._states[index] = 0.0 if one is None else self._system.problems.index(one) + 1.0
            if isinstance(one, Exception) or (one is not None and one.blocking):
                self._weights[index] = self._context.outputs[index] = 0.0

    def _check_numbers(self):
        """Make a row neutral, and its status outbox.NOT_FINITE, if it has a number that sinks must not get, such as NaN or infinity."""
        context = self._context
        for row, slots, *found in zip(self._rows, self._table, context.locations, context.rotations, context.outputs):
            if row is None or finite.is_finite(*found):
                continue
            if slots[outbox.STATUS] >= 0.0:
                slots[outbox.STATUS] = outbox.NOT_FINITE
            slots[outbox.WEIGHT : self._layout.base] = 0.0
            found[0][:], found[1][:] = 0.0, (1.0, 0.0, 0.0, 0.0)
