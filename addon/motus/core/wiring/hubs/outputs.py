"""Outputs of solvers for scripts and users' own drivers: numbers in the hub's outbox, repeated in the owner's outlet.

The outbox is an array of results on the mesh of a hidden object, the hub. The outlet is a custom property of the owner itself.

The owner is the object whose settings are solved; an entry is an item in its list of settings. The weight, a slot of the outbox, is the
influence of the constraints that apply the results.
"""

import math

from ...blender import drivers
from ...declare import Variable
from ...file import stored
from ...file.stored import Damaged
from . import hub_lookup, outbox


def create_outlet(system, owner, mesh):
    """Create the outlet of an owner: a custom property whose drivers copy status, weight and System.outputs from the hub's mesh.

    Scripts and users' own drivers read the outputs there. The caller must not create an outlet if any setting is animated: the solver
    would have to wait for the settings, which Blender's dependency graph does not distinguish from the outlet.
    """
    owner[outbox.out_key(system)] = [float(outbox.SILENT)] + [0.0] * (outbox.FIRST_OUTPUT + len(system.outputs) - 1)
    if not outbox.is_shared(system, mesh):
        # A driver for the first slot is enough: the solver reads the owner and writes the remaining slots itself.
        _copy_slot(system, owner, mesh, outbox.STATUS)
        return
    first = hub_lookup.first_slot(system, owner)  # drivers that copy all of the slots take less time than one call into Python
    for slot in range(outbox.FIRST_OUTPUT + len(system.outputs)):
        _copy_slot(system, owner, mesh, slot, first)


def _copy_slot(system, owner, mesh, slot, first=0):
    source = Variable('MESH', mesh, outbox.out_path(system, first + slot))
    drivers.copy_value(owner, outbox.out_path(system), source, index=slot)


def outlet(system, owner):
    """Return the memory of an evaluated owner's outlet, into which the solver copies the first slots of the hub's outbox.

    Returns None if the owner has no outlet.
    """
    return stored.doubles(owner[outbox.out_key(system)]) if hub_lookup.has_outlet(system, owner) else None


def output_names(system, carrier, group=""):
    """Return the names of the outputs of a group, read from the hub's mesh (carrier) if the system declares groups.

    Returns System.outputs if the carrier is None or damaged.
    """
    known = outbox.info(system, carrier, group) if carrier and system.groups is not None else None
    return system.outputs if known is None else tuple(known.outputs)


def output_path(system, name, owner=None, group=""):
    """Return the data path of an output on the hub's mesh, for users' own drivers.

    owner: object whose hub is meant; required if the system declares groups, or if owners share a hub.
    """
    if owner is None:
        return outbox.out_path(system, outbox.FIRST_OUTPUT + system.outputs.index(name), group)
    names = output_names(system, hub_lookup.carrier_of(system, owner, group), group)
    return outbox.out_path(system, hub_lookup.first_slot(system, owner) + outbox.FIRST_OUTPUT + names.index(name), group)


def output(system, owner, name, depsgraph, group=""):
    """Return the value of an output at the last evaluation; None if the output was not evaluated or is not finite."""
    carrier = hub_lookup.carrier_of(system, owner, group)
    if carrier is None:
        return None
    _, values = _told(system, carrier.evaluated_get(depsgraph), group, [name], hub_lookup.row_of(system, owner))
    return values[0] if values else None


def outputs_of(system, owner, entry, names, depsgraph):
    """Return the values of the outputs "<entry>.<name>" at the last evaluation, from the group that contains the entry.

    Returns None if no group of the owner has all of these outputs evaluated. It is meant for systems whose members are relative: their
    weight is 0 only if nothing was solved.
    """
    wanted = [f"{entry}.{name}" for name in names]
    for key, carrier in hub_lookup.carriers_of(system, owner):
        weight, values = _told(system, carrier.evaluated_get(depsgraph), key, wanted)
        # After a change of mode, Blender 5 may make a new evaluated copy of the owner without solving again: all values, including the
        # weight, are 0 for a while.
        if values and weight != 0.0:
            return values
    return None


def _told(system, evaluated, group, names, row=None):
    """Return (weight, values of the named outputs) of an evaluated hub's mesh; values is None if an output is missing or not finite."""
    try:
        box = outbox.opened(system, evaluated, group, row)
    except Damaged:
        return 0.0, None
    known = outbox.places_of(system.outputs) if box.info is None else box.info.places
    values = [box.slots[known[name]] for name in names] if known.keys() >= set(names) else [math.nan]
    return box.slots[outbox.WEIGHT], values if all(map(math.isfinite, values)) else None
