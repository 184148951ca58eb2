"""Masks of layers: the bones on which a layer acts, and the layer's weight on each of them."""

from ..core.blender import capabilities
from ..core.lazy import numpy as np


def collections(rig):
    """Return {name: names of its bones} for the bone collections of a rig, or for its bone groups before Blender 4.0."""
    if capabilities.has_bone_collections():
        every = getattr(rig.data, "collections_all", rig.data.collections)
        return {one.name: [bone.name for bone in one.bones] for one in every}
    found = {group.name: [] for group in rig.pose.bone_groups}
    for bone in rig.pose.bones:
        if bone.bone_group:
            found[bone.bone_group.name].append(bone.name)
    return found


def collection_names(rig):
    """Return (datablock or pose, name of its property) with the rig's bone collections, or bone groups before Blender 4.0.

    Panels pass both to UILayout.prop_search().
    """
    return (rig.data, "collections") if capabilities.has_bone_collections() else (rig.pose, "bone_groups")


def is_there(rig, item):
    """Whether the bone or bone collection that an item of a mask names exists in the rig."""
    return item.name in (rig.data.bones if item.kind == 'BONE' else collections(rig))


def bones_of(rig, item):
    """List the names of the rig's bones that an item of a mask includes: of a bone, or of a bone collection, and their children if set."""
    bones = rig.data.bones
    if item.kind == 'BONE':
        found = [item.name] if item.name in bones else []
    else:
        found = [name for name in collections(rig).get(item.name, ()) if name in bones]
    if not item.with_children:
        return found
    return list(dict.fromkeys(below for name in found for below in (name, *(child.name for child in bones[name].children_recursive))))


def names(rig, entry):
    """List the names of all bones in the mask of a layer; an empty mask includes all bones of the rig. entry: settings of the layer."""
    if not entry.mask:
        return rig.data.bones.keys()
    return list(dict.fromkeys(name for item in entry.mask for name in bones_of(rig, item)))


def chosen(rig, entry, rows):
    """Return the weight of each bone in a layer's mask, (B,) in [0, 1], before the mask's edge is blurred. rows: {bone name: row}."""
    found = np.zeros(len(rows))
    if not entry.mask:
        found[:] = 1.0
    for item in entry.mask:
        for name in bones_of(rig, item):
            if name in rows:
                found[rows[name]] = item.weight
    return np.clip(found, 0.0, 1.0)
