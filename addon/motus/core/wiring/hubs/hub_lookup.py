"""Find the hubs of an owner, the owner of a hub, and the slots of an owner in the hub's array of results (the outbox).

A hub is a hidden object whose mesh carries a solver's driver and results. Each group of members that an owner declares has one hub; a
system without groups has one hub under the key "".

The owner is the object whose settings are solved. Several owners can share a hub; each then has one row, a part of the outbox.
"""

import bpy

from ...blender import helpers
from ...declare import of_owner
from ...file.pointers import pointed
from ...file.stored import Damaged
from . import outbox


def hub_of(system, owner, group=""):
    """Return the hub object of one of an owner's groups; None if the hub is gone."""
    return dict(hubs(system, owner)).get(group)


def hubs(system, owner):
    """Return (key of the group, hub object) for each group of an owner that has a hub.

    Hubs that compute for another owner, which this one was copied from, are included.
    """
    settings = of_owner(system, owner)
    pointers = [("", pointed(settings, "hub")), *((entry.name, pointed(entry, "object")) for entry in settings.more_hubs)]
    return [(key, hub) for key, hub in pointers if hub and hub.type == 'MESH']


def hub_meshes(system, owner):
    """Return the meshes of all hubs of an owner, including the meshes of hubs whose object was deleted."""
    return [hub.data for _, hub in hubs(system, owner)] + lost_hubs(system, owner)


def lost_hubs(system, owner):
    """Return the meshes of an owner's hubs whose hub object was deleted.

    Such a mesh stays in the file because drivers read it.
    """
    known = {hub.data for _, hub in hubs(system, owner)}
    return [
        mesh
        for mesh in bpy.data.meshes
        if mesh.get(outbox.OWNER_KEY) == owner and mesh not in known and outbox.key_on_hub(system, mesh) is not None
    ]


def carriers_of(system, owner):
    """Return (key of the group, mesh of the hub) for each group of an owner that has a hub."""
    return [(key, hub.data) for key, hub in hubs(system, owner)]


def carrier_of(system, owner, group=""):
    """Return the mesh that carries the solver's driver and results of one of an owner's groups; None if the hub is gone."""
    hub = hub_of(system, owner, group)
    return hub.data if hub else None


def is_own_hub(hub, owner):
    """Whether a hub object computes for this owner alone.

    An object's copy points to the hubs of the object that it was copied from, so the result for the copy is False. The result is also
    False for a hub that is a library override: Blender may override a hub together with its owner, but on saving keeps only the
    library's owner in the hub.
    """
    return hub.data.get(outbox.OWNER_KEY) == owner and not hub.data.override_library


def has_outlet(system, owner):
    """Whether an owner, original or evaluated, has an outlet: the custom property that repeats status, weight and outputs of its hub."""
    found = owner.get(outbox.out_key(system)) if system.outputs else None
    return hasattr(found, "typecode") and len(found) == outbox.FIRST_OUTPUT + len(system.outputs)


def row_of(system, owner):
    """Return the index of the row that an owner has in a hub shared by several owners; None if the owner shares no hub."""
    settings = of_owner(system, owner)
    hub = hub_of(system, owner)
    return settings.row if hub and outbox.is_shared(system, hub.data) else None


def first_slot(system, owner):
    """Return the index of an owner's first slot in the array of results of its hub.

    The index is 0 if the owner shares no hub with others, or if the hub is damaged.
    """
    hub, row = hub_of(system, owner), row_of(system, owner)
    try:
        return 0 if row is None else row * outbox.row_layout(system, hub.data).size
    except Damaged:
        return 0


def new_hub(*names):
    """Create a hub: a hidden object that is in no collection, with an empty mesh. names: parts of the object's name."""
    return helpers.make(" ".join(filter(None, ("Motus", *names))), bpy.data.meshes.new("Hub"))


def make_hub(system, owner, group):
    """Create a hub that computes one group of one owner, and store it in the owner's settings; returns the hub object."""
    hub = new_hub(system.label, owner.name, group.key)
    hub.data[outbox.OWNER_KEY] = owner
    settings = of_owner(system, owner)
    if group.key:
        entry = settings.more_hubs.add()
        entry.name, entry.object = group.key, hub
    else:
        settings.hub = hub
    return hub
