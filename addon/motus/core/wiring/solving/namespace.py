"""Define motus_solve, the function that every driver of a solver calls, and register it in Blender's driver namespace.

The driver is on the outbox, an array of results on the mesh of a hidden object, the hub. Members are the objects and bones that the
results drive.
"""

from contextlib import suppress

import bpy
from bpy.app.handlers import persistent

from ...blender import handlers
from ...declare import groups_of, of_owner
from ...evaluated import copies
from ...evaluated.per_thread import keep_state
from ...file.stored import Damaged
from ...lazy import numpy as np
from ...refusals import INFINITE
from ..healing import heal, revival
from ..healing.watch import noticed
from ..hubs import outbox, sharing
from ..sinks import attribute_sink, geometry_sink, property_sink
from . import results, solving


def motus_solve(*arguments):
    """Solve one group of a system, and write the results into the outbox on an evaluated hub's mesh; returns the status, never raises.

    arguments: the evaluated mesh, which the driver passes as `self`; the system's name, followed by a dot and the group's key if the group
    has one; the frame; the depsgraph; the values of the driver's variables. The arguments are checked, because anybody may have edited the
    driver's expression.
    """
    # An exception would make Blender mark the driver as invalid until it is edited; the panel shows the status instead.
    try:
        keep_state()
        try:
            carrier, name, frame, depsgraph, *values = arguments
        except ValueError:
            raise Damaged("other arguments") from None
        if frame.__class__ is not float and not isinstance(frame, (int, float)):
            raise Damaged("another frame")
        return solving.solver_of(carrier, name).solve(frame, depsgraph, values)
    except Exception as error:
        return _fail(error, *arguments[:3])


class _Points:
    """Object that lets drivers call motus_solve by a subscript, for systems that read neither the frame nor the depsgraph.

    Blender assumes that an expression with a call, or with `frame`, changes with time, and evaluates it on every frame. A subscript is
    evaluated only if something that the driver reads has changed.
    """

    def __getitem__(self, arguments):
        carrier, name, *values = arguments if isinstance(arguments, tuple) and len(arguments) > 1 else (None, None)
        return motus_solve(carrier, name, 0.0, None, *values)


def _fail(error, carrier=None, name="", frame=0.0):
    """Return the status for an error that a solver raised, and set the results on its hub's mesh to neutral values if possible.

    Neutral results leave the members at their own transforms. carrier, name, frame: first arguments of motus_solve.
    """
    settings = None
    with suppress(Exception):
        system, key = solving.called(name)
        with suppress(Damaged):
            settings = of_owner(system, outbox.owner_of(system, carrier))
        if outbox.is_in_place(system, carrier, key):
            solving.forget_solver(carrier, name)
            _rest(system, key, carrier, frame)
    return results.status_of(error, carrier, name, settings)


def _rest(system, key, carrier, frame):
    if sharing.is_abandoned(carrier):
        noticed.note_orphan(carrier)
    for rest in (_rest_slots, _rest_attribute):
        with suppress(Exception):
            rest(system, key, carrier)
    with suppress(Exception):
        property_sink.blend_none(system, key, carrier, frame)


def _rest_slots(system, key, carrier):
    memory = memoryview(carrier[outbox.out_key(system, key)])
    box = np.frombuffer(memory, memory.format)
    if property_sink.KEY not in carrier:  # if the hub drives properties, zeros would be set as their values
        # Neutral values even if the meaning of the slots is unknown: in a file as it was saved, all slots are 0, except scales, which
        # are 1.
        box[box != 1] = 0
    box[~(np.abs(box) < INFINITE)] = 0
    box[outbox.STATUS : outbox.FIRST_OUTPUT] = 0
    layout = outbox.layout_of(system, carrier, key, len(box))
    if property_sink.KEY not in carrier:
        box[outbox.FIRST_OUTPUT : layout.base] = 0
    results.do_nothing(box, layout)


def _rest_attribute(system, key, carrier):
    if system.has_modifier:
        geometry_sink.write_nothing(system, carrier)
    else:
        attribute_sink.write_rest(carrier, lambda: groups_of(system, outbox.owner_of(system, carrier))[0].members)


_FUNCTIONS = {"motus_solve": motus_solve, "motus_points": _Points()}


@persistent
def _fill_namespace(*_):
    # Blender clears the driver namespace on every file load; load_post handlers run before the first evaluation.
    bpy.app.driver_namespace.update(_FUNCTIONS)


def _watched():
    found = bpy.app.handlers
    return (found.load_pre, copies.forget), (found.load_post, _fill_namespace), (found.save_pre, attribute_sink.store_own_poses)


def register():
    """Add the driver functions to Blender's driver namespace now and after every file load, and start the repairs of the wiring."""
    _fill_namespace()
    handlers.add(_watched())
    heal.register()
    revival.register()


def unregister():
    """Remove the driver functions from Blender's driver namespace, and stop the repairs of the wiring."""
    revival.unregister()
    heal.unregister()
    handlers.remove(_watched())
    for name in _FUNCTIONS:
        bpy.app.driver_namespace.pop(name, None)
    copies.forget()
