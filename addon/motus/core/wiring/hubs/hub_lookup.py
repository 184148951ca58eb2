"""Find the hubs of an owner.

A hub is a hidden object whose mesh carries a solver's driver and results. Each group of members that an owner declares has one hub; a
system without groups has one hub under the key "". The owner is the object whose settings are solved. sharing.py says which part of a
hub is the owner's.
"""

import bpy

from ...blender import helpers
from ...declare import of_owner
from ...file.pointers import pointed
from . import outbox


def hub_of(system, owner, group=""):
    """Return the hub object of one of an owner's groups; None if the hub is gone."""
    return dict(hubs(system, owner)).get(group)


def hubs(system, owner):
    """Return (key of the group, hub object) for each group of an owner that has a hub.

    If the owner is a copy, the hubs of the object from which it was copied are included as long as the owner points to them.
    """
    settings = of_owner(system, owner)
    pointers = [("", pointed(settings, "hub")), *((entry.name, pointed(entry, "object")) for entry in settings.more_hubs)]
    return [(key, hub) for key, hub in pointers if hub and hub.type == 'MESH']


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


def new_hub(*names):
    """Create a hub: a hidden object that is in no collection, with an empty mesh. names: parts of the object's name, joined by spaces."""
    hub = helpers.make(" ".join(filter(None, ("Motus", *names))), bpy.data.meshes.new("Hub"))
    protect(hub.data)
    return hub


def remove(mesh):
    """Remove a hub from the file: mesh and object. mesh: the hub's mesh.

    Blender removes each object whose mesh is removed. If an object that is no helper has got the mesh, by a script or by its list of meshes,
    that object keeps it as an ordinary mesh.
    """
    users = [obj for obj in bpy.data.objects if obj.data == mesh]
    if all(map(helpers.is_helper, users)):
        bpy.data.meshes.remove(mesh)
        return
    for obj in users:
        if helpers.is_helper(obj):
            bpy.data.objects.remove(obj)
    mesh.animation_data_clear()
    for key in [key for key in mesh.keys() if key.startswith(helpers.PREFIX)]:
        del mesh[key]
    unprotect(mesh)


def is_protected(mesh):
    """Whether the recursive purge of unused data (File > Clean Up) leaves a hub alone. mesh: the hub's mesh."""
    return mesh.use_fake_user


def protect(mesh):
    """Have the recursive purge of unused data leave a hub alone. mesh: the hub's mesh.

    A hub and its owner use each other. Blender before 5.0 takes such a loop for unused, also if the owner is in the scene, and deletes the
    hub. The purge follows no users of a datablock that has a fake user, so the loop ends at the mesh.
    """
    mesh.use_fake_user = True


def unprotect(mesh):
    """Have Blender delete a hub that nothing uses, when the file is saved. mesh: the hub's mesh."""
    mesh.use_fake_user = False
