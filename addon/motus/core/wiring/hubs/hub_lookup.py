"""Which hubs an owner has, whose they are, and where in them the owner's slots lie."""

import bpy

from ...blender import helpers
from ...declare import of_owner
from ...file.pointers import pointed
from ...file.stored import Damaged
from . import outbox


def hub_of(system, owner, group=""):
    """The hub object of a group; None where that is gone."""
    return dict(hubs(system, owner)).get(group)


def hubs(system, owner):
    """(group's key, hub object) of all groups that have one, whether it is the owner's own or not."""
    settings = of_owner(system, owner)
    pointers = [("", pointed(settings, "hub")), *((entry.name, pointed(entry, "object")) for entry in settings.more_hubs)]
    return [(key, hub) for key, hub in pointers if hub and hub.type == 'MESH']


def hub_meshes(system, owner):
    """Meshes of all hubs of the owner, those whose object is gone too."""
    return [hub.data for _, hub in hubs(system, owner)] + lost_hubs(system, owner)


def lost_hubs(system, owner):
    """Meshes of hubs of the owner whose object somebody has deleted: drivers keep them alive."""
    known = {hub.data for _, hub in hubs(system, owner)}
    return [
        mesh
        for mesh in bpy.data.meshes
        if mesh.get(outbox.OWNER_KEY) == owner and mesh not in known and outbox.key_on_hub(system, mesh) is not None
    ]


def carriers_of(system, owner):
    """(group's key, mesh of its hub) of everything that is wired."""
    return [(key, hub.data) for key, hub in hubs(system, owner)]


def carrier_of(system, owner, group=""):
    """The mesh that carries a group's solver and outbox; None where its hub is gone."""
    hub = hub_of(system, owner, group)
    return hub.data if hub else None


def is_own_hub(hub, owner):
    """Whether a hub computes for this owner alone; a copy shares the hubs of the object it was copied from.

    Blender may override the hub along with its owner, but saves only the library's owner with it.
    """
    return hub.data.get(outbox.OWNER_KEY) == owner and not hub.data.override_library


def has_outlet(system, owner):
    """Whether an owner, original or evaluated, has an outlet."""
    found = owner.get(outbox.out_key(system)) if system.outputs else None
    return hasattr(found, "typecode") and len(found) == outbox.FIRST_OUTPUT + len(system.outputs)


def row_of(system, owner):
    """Row of an owner in its hub; None where it shares none."""
    settings = of_owner(system, owner)
    hub = hub_of(system, owner)
    return settings.row if hub and outbox.is_shared(system, hub.data) else None


def first_slot(system, owner):
    """Where the slots of an owner begin in its hub's outbox; 0 where that is damaged."""
    hub, row = hub_of(system, owner), row_of(system, owner)
    try:
        return 0 if row is None else row * outbox.row_layout(system, hub.data).size
    except Damaged:
        return 0


def new_hub(*names):
    """A hidden object that stands in no collection, with an empty mesh."""
    return helpers.make(" ".join(filter(None, ("Motus", *names))), bpy.data.meshes.new("Hub"))


def make_hub(system, owner, group):
    """A new hub for one owner alone."""
    hub = new_hub(system.label, owner.name, group.key)
    hub.data[outbox.OWNER_KEY] = owner
    settings = of_owner(system, owner)
    if group.key:
        entry = settings.more_hubs.add()
        entry.name, entry.object = group.key, hub
    else:
        settings.hub = hub
    return hub
