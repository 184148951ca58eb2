"""Colliders, which chains do not enter: objects of a collection.

Of the empties a sphere is a ball, or a capsule where it is scaled unevenly, and each other one a plane. Each deforming bone of an armature
is a capsule. Meshes are surfaces, if nothing deforms them.
"""

from typing import Any, NamedTuple

import bpy

from ..core import keeping, native, tracks
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.scenery import meshes, stillness
from ..core.tracks import rotations
from .pins import MADE_KEY

MOST_TRIANGLES = 1 << 18
"""Meshes with more triangles than this are left out."""
ROUND = 1e-6
"""Part of its radius by which a ball's segment may be long, and it is still a ball, not a capsule."""
LARGEST_MEMORY = 1 << 28  # bytes

_SURFACES = keeping.OfFile(
    "surfaces of meshes that chains touch (StrandSurface)",
    "hash of the mesh's triangles, and the scale and turn of the object on the scene's first frame",
    most_size=LARGEST_MEMORY,
    size=lambda _, surface: surface.nbytes,
    unit="bytes",
)


class Solid(NamedTuple):
    """What a chain touches. thing: Object, or PoseBone of an armature. track: of its world matrix."""

    thing: Any
    track: Any

    @property
    def bone(self):
        """The Bone of a PoseBone; None for an object."""
        return self.thing.bone if isinstance(self.thing, bpy.types.PoseBone) else None

    @property
    def is_mesh(self):
        """Whether this is a surface; else it is a capsule or plane."""
        return self.bone is None and self.thing.type == 'MESH'

    @property
    def form(self):
        """Hashable value that says, with the track, what shape it is."""
        if self.bone:
            return self.bone.head_radius, self.bone.tail_radius, self.bone.length
        if self.is_mesh:
            found = meshes.faces(self.thing)
            return found and found.stamp
        return self.thing.empty_display_type == 'SPHERE', self.thing.empty_display_size


class Surface(NamedTuple):
    """A mesh that is touched. stamp: bytes, equal for equal surfaces. native: StrandSurface."""

    stamp: bytes
    native: Any


class Obstacles(NamedTuple):
    """Colliders at m times, as the native module takes them.

    shapes: names of k shapes. places: (m, k, 2, 3), two places for each. radii: (k,). surfaces: s Surfaces. matrices: (m, s, 4, 4).
    """

    shapes: list
    places: Any
    radii: Any
    surfaces: list
    matrices: Any

    def keywords(self, friction):
        """Return the keywords of the native StrandMotion, with a Surface in place of each StrandSurface. friction: of all colliders."""
        found = {}
        if self.shapes:
            found |= {"obstacles": self.shapes, "obstacle_places": self.places, "radii": self.radii, "friction": friction}
        if self.surfaces:
            found |= {"surfaces": self.surfaces, "surface_matrices": self.matrices, "surface_friction": friction}
        return found


def members(settings):
    """List all objects of the collection that the settings of a rig name."""
    collection = pointed(settings, "colliders")
    return [] if collection is None else [obj for obj in collection.all_objects if obj is not None]


def objects(settings):
    """List the objects that the settings of a rig name as colliders: empties, armatures, and meshes that no armature deforms."""
    return touching(members(settings))


def touching(found):
    """List the colliders among objects. Empties that were made for pins are none."""
    return [
        obj
        for obj in found
        if obj.type == 'ARMATURE' or (obj.type == 'EMPTY' and MADE_KEY not in obj) or (obj.type == 'MESH' and not is_skinned(obj))
    ]


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
    tops = {entry.name for entry in settings.entries} if obj.original == settings.id_data.original else ()
    return [
        bone
        for bone in obj.pose.bones
        if bone.bone.use_deform and (not tops or tops.isdisjoint((bone.name, *(one.name for one in bone.parent_recursive))))
    ]


def over_time(settings, touched, scene):
    """List a Solid for each collider among objects, evaluated or original. settings: of the rig whose chains touch them."""
    return [
        Solid(thing, tracks.world_track(thing, scene))
        for obj in touched
        for thing in (bones(settings, obj) if obj.type == 'ARMATURE' else (obj,))
    ]


def is_too_large(solid):
    """Whether a Solid is a mesh with too many triangles."""
    found = meshes.faces(solid.thing) if solid.is_mesh else None
    return found is not None and len(found.triangles) > MOST_TRIANGLES


def deforms(solid, scene):
    """Whether a Solid is a mesh whose shape may be a different one on another frame."""
    return solid.is_mesh and stillness.deforms(solid.thing, scene)


def at(solids, frames):
    """Return the Obstacles at frames (n,). solids: whose tracks are known. All are as large as on the first frame."""
    shapes, radii, places = [], [], [np.zeros((len(frames), 0, 2, 3))]
    surfaces, matrices = [], [np.zeros((len(frames), 0, 4, 4))]
    for solid in solids:
        name = solid.form, frames.tobytes()
        if solid.is_mesh:
            surface = _surface(solid, frames[:1])
            if surface:
                surfaces.append(surface)
                matrices.append(
                    tracks.kept(
                        solid.track, ("chains surface", *name), lambda solid=solid: rotations.rigid(solid.track.values(frames))[:, None]
                    )
                )
        else:
            shape, radius, ends = tracks.kept(solid.track, ("chains collider", *name), lambda solid=solid: _shape(solid, frames))
            shapes.append(shape)
            radii.append(radius)
            places.append(ends)
    return Obstacles(shapes, np.concatenate(places, axis=1), np.array(radii), surfaces, np.concatenate(matrices, axis=1))


def _shape(solid, frames):
    """Return (name of the shape, its radius, its places (n, 1, 2, 3)) of a Solid that is no mesh."""
    matrices = solid.track.values(frames)
    origins, axes = matrices[:, :3, 3], matrices[:, :3, :3]
    sizes = _lengths(axes)[0]
    if solid.bone:
        tails = origins + solid.bone.length * axes[:, :, 1]
        radius = max(solid.bone.head_radius, solid.bone.tail_radius) * max(sizes[0], sizes[2])
        return "capsule", radius, np.stack([origins, tails], axis=1)[:, None]
    is_ball, size = solid.form
    if not is_ball:
        return "plane", 0.0, np.stack([origins, origins + axes[:, :, 2]], axis=1)[:, None]
    *_, across, along = np.sort(sizes)
    half = size * (along - across)
    if half <= ROUND * size * along:
        return "capsule", size * along, np.stack([origins, origins], axis=1)[:, None]
    longest = int(np.argmax(sizes))
    way = half * axes[:, :, longest] / np.maximum(_lengths(axes)[:, longest, None], np.finfo(float).tiny)
    return "capsule", size * across, np.stack([origins - way, origins + way], axis=1)[:, None]


def _lengths(axes):
    """Return the lengths (n, 3) of the columns of matrices (n, 3, 3)."""
    return np.sqrt((axes**2).sum(axis=1))


def _surface(solid, first):
    """Return the Surface of a mesh, scaled and sheared as on its first frame; None if it has no faces. first: (1,), that frame."""
    found = meshes.faces(solid.thing)
    if found is None:
        return None
    matrix = solid.track.values(first)
    # What is left of the matrix without its turn: the surface is turned by the matrices of rotations.rigid().
    shape = rotations.chained(np.swapaxes(rotations.rigid(matrix)[:, :3, :3], 1, 2), matrix[:, :3, :3])[0]
    stamp = found.stamp + shape.tobytes()

    def make():
        x, y, z = (found.positions[:, axis, None].astype(float) * shape[:, axis] for axis in range(3))
        points = (x + y + z).astype(np.float32)
        return native.module.StrandSurface(points, found.triangles)

    return Surface(stamp, _SURFACES.made(stamp, make))
