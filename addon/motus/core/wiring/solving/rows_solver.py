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
from .results import ORDINARY, Poses, status_of


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
        self._slots, self._table, self._poses = slots, slots.reshape(count, layout.size), Poses(count)
        self._pointers = rows.pointer_names(system)
        self._inputs = arguments.read_from_driver(system)
        self._rows = [rows.row(system, mesh, index) for index in range(count)]
        self._contexts = [self._context(index, row) for index, row in enumerate(self._rows)]
        self._name = mesh.name if not mesh.library else None

    def _context(self, index, row):
        """Return the Context with which System.solve is called for a row; None if no owner has the row, or if the row is damaged.

        index: index of the row. row: its Row, None or Damaged.
        """
        slots, here = self._table[index], slice(index, index + 1)
        if isinstance(row, rows.Row):
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
        """Whether the solver can be used again: the system for which it was prepared is still registered.

        No evaluated copy has to be compared. The solver reads only the evaluated mesh of the hub, together with which it is kept.
        """
        return registered.get(self._system.name) is self._system

    def solve(self, frame, depsgraph, values):
        """Solve all rows, and write the results into the outbox on the hub's mesh.

        values: values of the inputs that the driver passes on. Returns the status of row 0, whose status slot has the driver.
        """
        table, layout, poses = self._table, self._layout, self._poses
        noticed.in_use = True
        table[:, outbox.WEIGHT] = 0.0
        if native.module is None:
            return table[0, outbox.STATUS]
        poses.block[:] = poses.neutral
        inputs = arguments.values(self._inputs, values, None)
        common, targets = {}, rows.targets(self._pointers, self._mesh)
        if self._name is not None:
            noticed.note_rows(self._system, self._name, self._rows)
        for row, context, slots in zip(self._rows, self._contexts, table):
            if context is not None:
                context.begin(frame, depsgraph, row.memo, common, targets)
                self._solve_row(context, inputs | row.inputs, slots)
            elif row is Damaged:
                slots[outbox.STATUS] = outbox.DAMAGED
        if not (poses.block.dot(poses.block) < ORDINARY and self._slots.dot(self._slots) < ORDINARY):
            self._check_numbers()
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

    def _check_numbers(self):
        """Make each row neutral that contains a number which sinks must not get, such as NaN or infinity, and set the row's status."""
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
