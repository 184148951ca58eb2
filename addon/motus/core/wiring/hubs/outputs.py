"""What others read of a solver: its outputs, and the owner's outlet, where scripts and users' own drivers find them."""

import math

from ...blender import drivers
from ...declare import Variable
from ...file import stored
from ...file.stored import Damaged
from . import hub_lookup, outbox


def create_outlet(system, owner, mesh):
    """Let scripts and users' own drivers read the outputs, as far as System.outputs names them, from the owner itself.

    Only where no setting is animated: the solver would have to wait for the settings, which to Blender are one with this.
    """
    owner[outbox.out_key(system)] = [float(outbox.SILENT)] + [0.0] * (outbox.FIRST_OUTPUT + len(system.outputs) - 1)
    if not outbox.is_shared(system, mesh):
        # The solver, which knows the owner, fills in the rest.
        _copy_slot(system, owner, mesh, outbox.STATUS)
        return
    first = hub_lookup.first_slot(system, owner)  # to copy all of them takes less than one call of Python's
    for slot in range(outbox.FIRST_OUTPUT + len(system.outputs)):
        _copy_slot(system, owner, mesh, slot, first)


def _copy_slot(system, owner, mesh, slot, first=0):
    source = Variable('MESH', mesh, outbox.out_path(system, first + slot))
    drivers.copy_value(owner, outbox.out_path(system), source, index=slot)


def outlet(system, owner):
    """Memory of an evaluated owner's outlet, which is to hold what its own hub's outbox begins with; None where it has none."""
    return stored.doubles(owner[outbox.out_key(system)]) if hub_lookup.has_outlet(system, owner) else None


def output_names(system, carrier, group=""):
    """Names of a group's outputs."""
    known = outbox.info(system, carrier, group) if carrier and system.groups is not None else None
    return system.outputs if known is None else tuple(known.outputs)


def output_path(system, name, owner=None, group=""):
    """Data path, on the carrier, of an output for users' own drivers. owner: needed where the system declares groups."""
    if owner is None:
        return outbox.out_path(system, outbox.FIRST_OUTPUT + system.outputs.index(name), group)
    names = output_names(system, hub_lookup.carrier_of(system, owner, group), group)
    return outbox.out_path(system, hub_lookup.first_slot(system, owner) + outbox.FIRST_OUTPUT + names.index(name), group)


def output(system, owner, name, depsgraph, group=""):
    """Value of an output as last evaluated; None where nothing was."""
    carrier = hub_lookup.carrier_of(system, owner, group)
    if carrier is None:
        return None
    _, values = _told(system, carrier.evaluated_get(depsgraph), group, [name], hub_lookup.row_of(system, owner))
    return values[0] if values else None


def outputs_of(system, owner, entry, names, depsgraph):
    """Values of the outputs "<entry>.<name>" as last evaluated, in whichever group the entry is; None where nothing was.

    Of a system whose members are relative: its weight is never 0 where it was solved.
    """
    wanted = [f"{entry}.{name}" for name in names]
    for key, carrier in hub_lookup.carriers_of(system, owner):
        weight, values = _told(system, carrier.evaluated_get(depsgraph), key, wanted)
        # Blender 5 may copy the owner anew without solving again (a change of mode): all is 0 for a while.
        if values and weight != 0.0:
            return values
    return None


def _told(system, evaluated, group, names, row=None):
    """(weight, values of the outputs) on an evaluated carrier; values: None where not all of them are there."""
    try:
        box = outbox.opened(system, evaluated, group, row)
    except Damaged:
        return 0.0, None
    known = outbox.places_of(system.outputs) if box.info is None else box.info.places
    values = [box.slots[known[name]] for name in names] if known.keys() >= set(names) else [math.nan]
    return box.slots[outbox.WEIGHT], values if all(map(math.isfinite, values)) else None
