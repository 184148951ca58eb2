"""The outbox: one float array property of a solver's carrier that holds all it computed.

    [status, weight, outputs..., x, y, z, rx, ry, rz of member 0, of member 1, ...]

The solver driver sits on the first slot, status: to Blender's dependency graph the array is one property, so whoever
reads any slot of it waits for the solver. status is 0 or the index + 1 of the system's problem (INTERNAL for an error of
our own, SILENT before the first evaluation); weight is the influence of the sinks, and 0 where they may not act. On the
original it stays zero for ever: without the add-on nothing acts.
"""

from ..system import Problem, of_owner

STATUS, WEIGHT, FIRST_OUTPUT = 0, 1, 2
POSE_SIZE = 6

OWNER_KEY = "motus_owner"
"""Custom property of a hub's mesh: the object whose settings it computes."""
MEMBER_DATA_KEY = "motus_member_data"
"""Custom property of a hub's mesh: what System.member_data said when the settings last changed."""
INTERNAL, SILENT = -1, -2

_INTERNAL_PROBLEM = Problem("Motus could not compute this: see the system console")
_MIRRORED_PROBLEM = Problem(
    "Mirrored by a negative scale, which constraints on the rotation do not keep: apply the scale", blocking=False)
_SILENT_PROBLEM = Problem("Not evaluated: the add-on's driver functions are not available in this file yet")


def out_key(system):
    """Name of the outbox property."""
    return f"motus_{system.name}_out"


def out_path(system, index=None):
    """Data path of the outbox on its carrier, or of one slot of it."""
    path = f'["{out_key(system)}"]'
    return path if index is None else f"{path}[{index}]"


def pose_base(system, member):
    """First slot of a member's location and rotation."""
    return FIRST_OUTPUT + len(system.outputs) + POSE_SIZE * member


def create(system, carrier, members):
    """Give `carrier` an empty outbox for so many members."""
    carrier[out_key(system)] = [float(SILENT)] + [0.0] * (pose_base(system, members) - 1)


def remove(system, carrier):
    """Take the outbox away."""
    if out_key(system) in carrier:
        del carrier[out_key(system)]


def carrier_of(system, owner):
    """The datablock that carries solver and outbox: the owner, or its hub's mesh."""
    hub = of_owner(system, owner).hub
    return hub.data if hub else owner


def owns_hub(system, owner):
    """Whether the owner has a hub of its own; a copy shares the hub of the object it was copied from."""
    hub = of_owner(system, owner).hub
    return hub is not None and hub.data.get(OWNER_KEY) == owner


def output_path(system, name):
    """Data path, on the carrier, of an output for users' own drivers."""
    return out_path(system, FIRST_OUTPUT + system.outputs.index(name))


def output(system, owner, name, depsgraph):
    """Value of an output as last evaluated; None where nothing was."""
    out = carrier_of(system, owner).evaluated_get(depsgraph).get(out_key(system))
    return None if out is None else out[FIRST_OUTPUT + system.outputs.index(name)]


def problem(system, owner, depsgraph):
    """The Problem the solver reported, or None."""
    out = carrier_of(system, owner).evaluated_get(depsgraph).get(out_key(system))
    if out is None:
        return None
    code = int(out[STATUS])
    if code < 0:
        return _INTERNAL_PROBLEM if code == INTERNAL else _SILENT_PROBLEM
    if code:
        return system.problems[code - 1]
    turns = "rotation" in system.channels(of_owner(system, owner))
    return _MIRRORED_PROBLEM if turns and owner.matrix_basis.is_negative else None
