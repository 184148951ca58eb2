"""Outputs of solvers, for scripts and for drivers that artists add: numbers in the hub's outbox, repeated in the owner's outlet.

The outbox is an array of results on the mesh of a hidden object, the hub. The outlet is a custom property of the owner itself.

The owner is the object whose settings are solved; an entry is an item in its list of settings. The weight, a slot of the outbox, is the
influence of the constraints that apply the results.
"""

import math

from ...blender import drivers
from ...declare import OwnMatrix, Variable, input_variables
from ...evaluated import copies
from ...file import stored
from ...file.stored import Damaged
from . import outbox, sharing


def wants_outlet(system, owner):
    """Whether an owner is to have an outlet, the custom property that repeats the solver's outputs.

    An owner has no outlet if the system has no outputs, or if settings are animated: the solver would have to wait for the settings, which
    Blender's dependency graph does not distinguish from the outlet. An owner also has no outlet if the solver reads the owner's own world
    matrix, because the dependency graph would have a cycle: the owner's other solvers wait for the owner's properties, and the matrix waits
    for those solvers.
    """
    return bool(system.outputs) and not copies.has_animated_settings(owner) and not _waits_for_itself(system, owner)


def _waits_for_itself(system, owner):
    return any(variable for declared, variable in input_variables(system, owner) if isinstance(declared, OwnMatrix))


def create_outlet(system, owner, part):
    """Create the outlet of an owner: a custom property that repeats status, weight and System.outputs from the hub's mesh.

    Nothing happens if wants_outlet() is false. Drivers on the outlet copy the values; scripts, and drivers that artists add, read the
    values there. part: Part of the owner.
    """
    if not wants_outlet(system, owner):
        return
    size = outbox.FIRST_OUTPUT + len(system.outputs)
    owner[outbox.out_key(system)] = [float(outbox.SILENT)] + [0.0] * (size - 1)
    # If the solver reads the owner, the solver writes all slots of the outlet but the first. If not, drivers copy all slots, which takes
    # less time than one call into Python.
    for slot in (outbox.STATUS,) if part.reads_owner else range(size):
        source = Variable('MESH', part.mesh, outbox.out_path(system, part.first + slot))
        drivers.copy_value(owner, outbox.out_path(system), source, index=slot)


def has_outlet(system, owner):
    """Whether an owner, original or evaluated, has an outlet: the custom property that repeats its status, weight and outputs."""
    found = owner.get(outbox.out_key(system)) if system.outputs else None
    return hasattr(found, "typecode") and len(found) == outbox.FIRST_OUTPUT + len(system.outputs)


def outlet(system, owner):
    """Return the memory of an evaluated owner's outlet, into which the solver copies the first slots of the hub's outbox.

    Returns None if the owner has no outlet, the custom property that repeats the outputs.
    """
    return stored.doubles(owner[outbox.out_key(system)]) if has_outlet(system, owner) else None


def output_names(system, carrier, group=""):
    """Return the names of a group's outputs, in the order of their slots in the outbox.

    The names are read from the hub's mesh (carrier) if the system declares groups. If not, or if the carrier is None or damaged,
    System.outputs is returned.
    """
    known = outbox.info(system, carrier, group) if carrier and system.groups is not None else None
    return system.outputs if known is None else tuple(known.outputs)


def output_path(system, name, owner=None, group=""):
    """Return the data path of an output on the hub's mesh, for drivers that artists add. name: name of the output.

    owner: object whose hub has the mesh; required if the system declares groups, or if owners share a hub. group: key of the group.
    """
    if owner is None:
        return outbox.out_path(system, outbox.FIRST_OUTPUT + system.outputs.index(name), group)
    part = sharing.part_of(system, owner, group)
    names = output_names(system, part and part.mesh, group)
    return outbox.out_path(system, (part.first if part else 0) + outbox.FIRST_OUTPUT + names.index(name), group)


def output(system, owner, name, depsgraph, group=""):
    """Return the value of an owner's output at the last evaluation; None if the output was not evaluated or is not finite.

    name: name of the output. group: key of the group.
    """
    part = sharing.part_of(system, owner, group)
    if part is None:
        return None
    _, values = _told(system, part, depsgraph, [name])
    return values[0] if values else None


def outputs_of(system, owner, entry, names, depsgraph):
    """Return the values of an owner's outputs as last evaluated, in the order of `names`; None if no group has evaluated them all.

    The outputs are those with the names "<entry>.<name>". Only for systems with relative members (result applied on top of the member's own
    transform): the weight in a group's outbox is 1 for these, or 0 if nothing was solved. Outputs of a group with weight 0 count as not
    evaluated.
    """
    wanted = [f"{entry}.{name}" for name in names]
    for part in sharing.parts(system, owner):
        weight, values = _told(system, part, depsgraph, wanted)
        # After a change of mode, Blender 5 may make a new evaluated copy of the owner without solving again: all values, including the
        # weight, are 0 for a while.
        if values and weight != 0.0:
            return values
    return None


def _told(system, part, depsgraph, names):
    """Return (weight, values of the named outputs) of an owner's Part; values is None if an output is missing or not finite."""
    try:
        box = sharing.opened(system, part, part.mesh.evaluated_get(depsgraph))
    except Damaged:
        return 0.0, None
    known = outbox.places_of(system.outputs) if box.info is None else box.info.places
    values = [box.slots[known[name]] for name in names] if known.keys() >= set(names) else [math.nan]
    return box.slots[outbox.WEIGHT], values if all(map(math.isfinite, values)) else None
