"""Identify sinks among an object's constraints, however an artist renames them: by the hub and the member stored in each sink.

A sink is a constraint that brings a solver's result to a member, an object or bone that an owner drives. The hub is stored as the
constraint's custom space (space_object), and the index of the member as that object's subtarget. Blender saves and copies both with the
constraint, and reads them only for the custom space, which sinks do not use.

A file may hold anything there. The data is therefore checked: a constraint counts as a sink only if its type is in KINDS and its
space_object is a mesh object with an outbox (array of results) of the system. If the hub is gone, only the constraint's name and type
identify a sink.
"""

import re

from ...evaluated.question import answered
from . import outbox

KINDS = {'LIMIT_LOCATION', 'TRANSFORM', 'GEOMETRY_ATTRIBUTE', 'COPY_TRANSFORMS'}
CHANNELS = ("location", "rotation", "scale")
PROXY_KEY = "motus_proxy"
"""Custom property of a proxy, a hidden empty that brings a result to a member: the member's object, which copies the proxy's transform."""


def name(system, channel=""):
    """Return the name that new sinks of a system get.

    channel: "location", "rotation" or "scale" if a sink brings only that channel; "" otherwise.
    """
    return " ".join(filter(None, ("Motus", system.label, channel.title())))


def put(constraint, hub, index):
    """Store in a sink, a constraint, which member of which hub it drives.

    index: index of the member, or row of a shared hub. The constraint is collapsed in the interface, because for an expanded one Blender
    draws a dashed line from the object to the hub, which is at the origin.
    """
    constraint.show_expanded = False
    constraint.space_object = hub
    constraint.space_subtarget = str(index)


def read(system, constraint):
    """Return (original mesh of the hub, key of the group) if a constraint is a sink of the system; else None.

    The constraint may be on an original or an evaluated object.
    """
    if constraint.type not in KINDS:
        return None
    hub = constraint.space_object
    # The original is taken because the caller need not have declared a dependency on the hub's evaluated geometry. Until Blender has
    # evaluated the hub, the data of its evaluated copy can be memory that was freed.
    mesh = hub.original.data if hub and hub.type == 'MESH' else None
    key = answered((hash(mesh), system.name, "key on hub"), lambda: outbox.key_on_hub(system, mesh)) if mesh else None
    return None if key is None else (mesh, key)


def index_of(constraint):
    """Return the index of the member, or the row of a shared hub, that is stored in a sink; None if the sink holds no valid index."""
    if constraint.type == 'GEOMETRY_ATTRIBUTE':
        return constraint.sample_index
    noted = constraint.space_subtarget
    return int(noted) if re.fullmatch(r"\d{1,9}", noted) else None


def is_bereft(system, constraint):
    """Whether a constraint has the type and name of one of the system's sinks, but its hub is gone."""
    if constraint.type not in KINDS or read(system, constraint) is not None:
        return False
    if constraint.type == 'COPY_TRANSFORMS' and constraint.target and PROXY_KEY not in constraint.target:
        return False
    names = (name(system), *(name(system, channel) for channel in CHANNELS))
    return re.sub(r"\.\d{3,}$", "", constraint.name) in names
