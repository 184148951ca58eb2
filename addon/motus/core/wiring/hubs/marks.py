"""How a sink is known again, whatever the user calls it: by the hub that it names, and by which member of it it drives.

Both stand in the constraint's custom space, which Blender keeps with it, copies with it and reads for no other space. What
a file holds there is checked: a sink is a constraint of one of our kinds that names a mesh with an outbox of the system.
Where the hub is gone the name and the kind are all that is left.
"""

import re

from . import outbox

KINDS = {'LIMIT_LOCATION', 'TRANSFORM', 'GEOMETRY_ATTRIBUTE', 'COPY_TRANSFORMS'}
CHANNELS = ("location", "rotation", "scale")
PROXY_KEY = "motus_proxy"
"""Custom property of a proxy: the object that copies it, or a bone of which does."""


def name(system, channel=""):
    """What the sinks of a system are called."""
    return " ".join(filter(None, ("Motus", system.label, channel.title())))


def put(constraint, hub, index):
    """Note on a sink which member of which hub it drives.

    A constraint that is open in the interface has a dashed line in the viewport to its target: to the hub, at the origin.
    """
    constraint.show_expanded = False
    constraint.space_object = hub
    constraint.space_subtarget = str(index)


def read(system, constraint):
    """(the original of its hub's mesh, key of its group) of a sink of the system, itself original or evaluated.

    None for any other constraint.
    """
    if constraint.type not in KINDS:
        return None
    hub = constraint.space_object
    # Of an evaluated hub nobody here waits for the geometry, until which its data is memory that Blender has freed.
    mesh = hub.original.data if hub and hub.type == 'MESH' else None
    key = outbox.key_on_hub(system, mesh) if mesh else None
    return None if key is None else (mesh, key)


def index_of(constraint):
    """Which member a sink drives; None where that is not noted."""
    if constraint.type == 'GEOMETRY_ATTRIBUTE':
        return constraint.sample_index
    noted = constraint.space_subtarget
    return int(noted) if re.fullmatch(r"\d{1,9}", noted) else None


def is_bereft(system, constraint):
    """Whether a constraint is called and made like a sink of the system, but names no hub."""
    if constraint.type not in KINDS or read(system, constraint) is not None:
        return False
    if constraint.type == 'COPY_TRANSFORMS' and constraint.target and PROXY_KEY not in constraint.target:
        return False
    names = (name(system), *(name(system, channel) for channel in CHANNELS))
    return re.sub(r"\.\d{3,}$", "", constraint.name) in names
