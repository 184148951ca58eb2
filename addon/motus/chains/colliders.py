"""Colliders, which chains do not enter: objects of a collection.

Of the empties a sphere is a ball, or a capsule where it is scaled unevenly, and each other one a plane. Each deforming bone of an armature
is a capsule. Meshes are surfaces, if nothing deforms them.
"""

from typing import Any, NamedTuple

from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.scenery import meshes, stillness
from . import solids
from .pins import MADE_KEY

MOST_TRIANGLES = 1 << 18
"""Meshes with more triangles than this are left out."""


def members(settings):
    """List all objects of the collection that the settings of a rig name."""
    collection = pointed(settings, "colliders")
    return [] if collection is None else [obj for obj in collection.all_objects if obj is not None]


def objects(settings):
    """List the objects that the settings of an owner name as colliders: empties, armatures, and meshes that no armature deforms.

    What hangs on the owner itself is left out.
    """
    links = [pointed(link, "object") for entry in settings.entries for link in entry.links]
    own = {obj.original for obj in links if obj is not None}
    return touching([obj for obj in members(settings) if obj.original not in own])


class Kind(NamedTuple):
    """What of a collider says how much work it makes: whether it is a mesh, and how many capsules or planes it is else."""

    is_mesh: bool
    count: int  # type: ignore[assignment]  # a tuple has a method of this name


def kinds(settings):
    """List the Kind of each collider that the settings of a rig name."""
    return [Kind(obj.type == 'MESH', len(obj.data.bones) if obj.type == 'ARMATURE' else 1) for obj in objects(settings)]


def touching(found):
    """List the colliders among objects. Empties that were made for pins are none."""
    return [obj for obj in found if _is_touched(obj)]


def _is_touched(obj):
    if obj.type == 'EMPTY':
        return MADE_KEY not in obj
    return obj.type == 'ARMATURE' or (obj.type == 'MESH' and not is_skinned(obj))


def is_skinned(obj):
    """Whether an armature or a lattice deforms a mesh, so that its shape could depend on the chain itself."""
    return obj.parent_type in {'ARMATURE', 'LATTICE'} or any(one.type in {'ARMATURE', 'LATTICE'} for one in obj.modifiers)


def reads(settings):
    """List the (object, name of a bone or "") whose transforms the colliders that the settings of a rig name depend on."""
    return [(obj, bone) for obj in objects(settings) for bone in ("", *(one.name for one in bones(settings, obj)))]


def bones(settings, obj):
    """List the pose bones of an object that are colliders: the deforming ones, and of the rig itself those that no chain drives."""
    if obj.type != 'ARMATURE':
        return []
    found = [bone for bone in obj.pose.bones if bone.bone.use_deform]
    if obj.original != settings.id_data.original:
        return found
    tops = {entry.name for entry in settings.entries}
    return [bone for bone in found if tops.isdisjoint((bone.name, *(one.name for one in bone.parent_recursive)))]


def over_time(settings, touched, scene):
    """List what chains touch (solids.py) of objects, evaluated or original. settings: of the rig whose chains touch them."""
    found = []
    for obj in touched:
        found += solids.of_bones(bones(settings, obj), scene) if obj.type == 'ARMATURE' else [solids.Solid(obj, scene)]
    return found


def is_too_large(solid):
    """Whether this is a mesh with too many triangles. solid: as those of over_time()."""
    found = meshes.faces(solid.thing) if solid.is_mesh else None
    return found is not None and len(found.triangles) > MOST_TRIANGLES


def deforms(solid, scene):
    """Whether this is a mesh whose shape may be a different one on another frame. solid: as those of over_time()."""
    return solid.is_mesh and stillness.deforms(solid.thing, scene)


def at(touched, frames, friction):
    """Return the keywords of the native StrandMotion for colliders at frames (n,), with a solids.Surface in place of each StrandSurface.

    touched: as over_time() lists them; they are known. friction: of all of them.
    """
    shapes = [solid.shapes(frames) for solid in touched if not solid.is_mesh]
    surfaces = [found for found in (solid.surface(frames) for solid in touched if solid.is_mesh) if found]
    keywords: dict[str, Any] = {}
    if shapes:
        keywords["obstacles"] = [name for one in shapes for name in one.names]
        keywords["obstacle_places"] = np.concatenate([one.places for one in shapes], axis=1)
        keywords["radii"] = np.array([radius for one in shapes for radius in one.radii])
        keywords["friction"] = friction
    if surfaces:
        keywords["surfaces"] = [surface for surface, _ in surfaces]
        keywords["surface_matrices"] = np.stack([moved for _, moved in surfaces], axis=1)
        keywords["surface_friction"] = friction
    return keywords
