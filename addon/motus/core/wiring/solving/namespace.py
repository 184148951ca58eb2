"""The function every solver driver calls, and its place in the driver namespace."""

from contextlib import suppress

import bpy
from bpy.app.handlers import persistent

from ...blender import handlers
from ...declare import groups_of, of_owner
from ...evaluated import copies
from ...evaluated.per_thread import keep_state
from ...file.stored import Damaged
from ...lazy import numpy as np
from ..healing import heal, revival
from ..healing.watch import noticed
from ..hubs import outbox
from ..sinks import attribute_sink, geometry_sink, property_sink
from . import solving


def motus_solve(*arguments):
    """Solve one group of a system into the outbox of an evaluated carrier. Never raises. Returns status.

    arguments: the carrier, as `self`; the system's name, with the group's key after a dot where it has one; the frame; the
    depsgraph; what the driver's variables say. Somebody else may have written other ones into the driver.
    """
    # An exception would leave the driver invalid until somebody edits it; the panel shows the status instead.
    try:
        keep_state()
        if len(arguments) < 4 or not isinstance(arguments[2], (int, float)):
            raise Damaged("other arguments")
        carrier, name, frame, depsgraph, *values = arguments
        return solving.solver_of(carrier, name).solve(frame, depsgraph, values)
    except Exception as error:
        return _fail(error, *arguments[:3])


class _Points:
    """Lets drivers call motus_solve by a subscript, for systems that read neither the frame nor the depsgraph."""

    def __getitem__(self, arguments):
        carrier, name, *values = arguments if isinstance(arguments, tuple) and len(arguments) > 1 else (None, None)
        return motus_solve(carrier, name, 0.0, None, *values)


def _fail(error, carrier=None, name="", frame=0.0):
    """The status of a carrier that was not solved, whose members are left at their own transforms, as far as can be."""
    settings = None
    with suppress(Exception):
        system, key = solving.called(name)
        with suppress(Damaged):
            settings = of_owner(system, outbox.owner_of(system, carrier))
        if outbox.is_in_place(system, carrier, key):
            _rest(system, key, carrier, frame)
    return solving.status_of(error, carrier, name, settings)


def _rest(system, key, carrier, frame):
    if outbox.SHARED_KEY not in carrier and carrier.get(outbox.OWNER_KEY) is None:
        noticed.note_orphan(carrier)
    for rest in (_rest_slots, _rest_attribute):
        with suppress(Exception):
            rest(system, key, carrier)
    with suppress(Exception):
        property_sink.blend_none(system, key, carrier, frame)


def _rest_slots(system, key, carrier):
    memory = memoryview(carrier[outbox.out_key(system, key)])
    box = np.frombuffer(memory, memory.format)
    if property_sink.KEY not in carrier:  # whose properties would be 0
        # Where nobody knows what the slots are: in a file that is as it was saved, all are 0, but for scales, which are 1.
        box[box != 1] = 0
    box[outbox.STATUS : outbox.FIRST_OUTPUT] = 0
    layout = outbox.layout_of(system, carrier, key, len(box))
    if property_sink.KEY not in carrier:
        box[outbox.FIRST_OUTPUT : layout.base] = 0
    solving.do_nothing(box, layout)


def _rest_attribute(system, key, carrier):
    if system.has_modifier:
        geometry_sink.write_nothing(system, carrier)
    else:
        attribute_sink.write_rest(carrier, lambda: groups_of(system, outbox.owner_of(system, carrier))[0].members)


_FUNCTIONS = {"motus_solve": motus_solve, "motus_points": _Points()}


@persistent
def _fill_namespace(*_):
    # Blender clears the namespace on every file load; load_post comes before the first evaluation.
    bpy.app.driver_namespace.update(_FUNCTIONS)


def _watched():
    found = bpy.app.handlers
    return (found.load_pre, copies.forget), (found.load_post, _fill_namespace), (found.save_pre, attribute_sink.store_own_poses)


def register():
    """Make the driver functions known, now and after every file load."""
    _fill_namespace()
    handlers.add(_watched())
    heal.register()
    revival.register()


def unregister():
    """Take the driver functions back."""
    revival.unregister()
    heal.unregister()
    handlers.remove(_watched())
    for name in _FUNCTIONS:
        bpy.app.driver_namespace.pop(name, None)
    copies.forget()
