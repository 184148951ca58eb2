"""What chains touch, over time: balls, capsules, planes and surfaces, made of empties, bones and meshes.

Solid is one object or bone, Skeleton all bones of an armature that nothing but keys moves, which are read together. Both have:

    is_mesh          whether it is a surface; else it is capsules or planes
    count            how many capsules or planes it is
    tracks           Tracks that it is read from
    is_known         whether it can be read at any time
    unknown          [(track, keywords of the operator motus.track_record)] of the tracks that have to be recorded, or have been recorded
    price            of reading it at one time, in units of core/measures/bounds.py
    stamp            hashable value that changes whenever it may; None if changes cannot be detected
    shapes(frames)   Shapes of the capsules and planes at frames (n,), as large as on the first one
"""

from typing import Any, NamedTuple

import bpy

from ..core import keeping, native, tracks, wiring
from ..core.animation import strips
from ..core.declare import laying_systems
from ..core.evaluated.question import answered
from ..core.lazy import numpy as np
from ..core.scenery import meshes
from ..core.tracks import in_world, inputs, rotations

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


class Shapes(NamedTuple):
    """k capsules and planes at n times. names: of their shapes. radii: k numbers. places: (n, k, 2, 3)."""

    names: list
    radii: list
    places: Any


class Surface(NamedTuple):
    """A mesh that is touched. stamp: bytes, equal for equal surfaces. native: StrandSurface."""

    stamp: bytes
    native: Any


class Solid:
    """An object, or a bone of an armature, evaluated or original, by its world matrix over time."""

    count = 1

    def __init__(self, thing, scene):
        self.thing = thing
        self._track = tracks.world_track(thing, scene)
        self._bone = thing.bone if isinstance(thing, bpy.types.PoseBone) else None
        self.is_mesh = self._bone is None and thing.type == 'MESH'
        self.tracks, self.price = (self._track,), self._track.price

    @property
    def is_known(self):
        return self._track.is_known

    @property
    def unknown(self):
        if self._track.reason is None:
            return []
        bone = {"bone": self.thing.name} if self._bone else {}
        return [(self._track, {"datablock": self.thing.id_data.name, "transform": 'WORLD', **bone})]

    @property
    def stamp(self):
        return strips.together((self._form, inputs.stamp_of_known(self._track)))

    @property
    def _form(self):
        if self._bone:
            return _radius(self._bone), self._bone.length
        if self.is_mesh:
            found = meshes.faces(self.thing)
            return found.stamp if found else ()
        return self.thing.empty_display_type == 'SPHERE', self.thing.empty_display_size

    def shapes(self, frames):
        name = "chains collider", self._form, frames.tobytes()
        return tracks.kept(self._track, name, lambda: self._shapes(self._track.values(frames)))

    def _shapes(self, matrices):
        if self._bone:
            return _capsules([self._bone], [matrices])
        origins, axes = matrices[:, :3, 3], matrices[:, :3, :3]
        sizes = _lengths(axes)[0]
        is_ball, size = self._form
        if not is_ball:
            return Shapes(["plane"], [0.0], _pairs(origins, origins + axes[:, :, 2]))
        *_, across, along = np.sort(sizes)
        half = size * (along - across)
        if half <= ROUND * size * along:
            return Shapes(["capsule"], [size * along], _pairs(origins, origins))
        longest = int(np.argmax(sizes))
        way = half * axes[:, :, longest] / np.maximum(_lengths(axes)[:, longest, None], np.finfo(float).tiny)
        return Shapes(["capsule"], [size * across], _pairs(origins - way, origins + way))

    def surface(self, frames):
        """Return (Surface, its matrices (n, 4, 4)) of a mesh at frames (n,), scaled and sheared as on the first; None if it has no faces."""
        found = meshes.faces(self.thing)
        if found is None:
            return None
        first = self._track.values(frames[:1])
        # What is left of the matrix without its turn: the surface is turned by the matrices of rotations.rigid().
        shape = rotations.chained(np.swapaxes(rotations.rigid(first)[:, :3, :3], 1, 2), first[:, :3, :3])[0]
        stamp = found.stamp + shape.tobytes()

        def make():
            x, y, z = (found.positions[:, axis, None].astype(float) * shape[:, axis] for axis in range(3))
            return native.module.StrandSurface((x + y + z).astype(np.float32), found.triangles)

        name = "chains surface", frames.tobytes()
        moved = tracks.kept(self._track, name, lambda: rotations.rigid(self._track.values(frames)))
        return Surface(stamp, _SURFACES.made(stamp, make)), moved


class Skeleton:
    """Bones of one armature that are moved by their keys, by layers, and by what moves the armature, alone."""

    is_mesh = False

    def __init__(self, bones, scene):
        self._bones = bones
        self._source = inputs.Tails(bones, scene, None)
        self.count = len(bones)

    @property
    def tracks(self):
        return self._source.tracks

    @property
    def is_known(self):
        return self._source.is_known

    @property
    def unknown(self):
        return self._source.unknown

    @property
    def price(self):
        return self._source.price

    @property
    def stamp(self):
        # One question, so that what the bones share is found once.
        found = answered(object(), lambda: self._source.stamp)
        return strips.together((tuple([_radius(one.bone) for one in self._bones]), found))

    def shapes(self, frames):
        bones = [one.bone for one in self._bones]
        name = "chains colliders", tuple(map(_radius, bones)), frames.tobytes()
        return self._source.kept(name, lambda: _capsules(bones, self._source.matrices(frames)))


def of_bones(bones, scene):
    """List the Solids and Skeletons that some pose bones of one armature make."""
    if not bones:
        return []
    moved = _moved(bones[0].id_data)
    plain = [bone for bone in bones if bone.name not in moved]
    together = [Skeleton(plain, scene)] if plain else []
    return together + [Solid(bone, scene) for bone in bones if bone.name in moved]


def _moved(rig):
    """Return the names of bones that more than keys and layers moves, as a set."""
    found = set()
    for bone in rig.pose.bones:
        for constraint in bone.constraints if len(bone.constraints) else ():
            if not _lays(constraint):
                turned = in_world.turned_by(bone, constraint) if constraint.type in {'IK', 'SPLINE_IK'} else ()
                for name in {bone.name, *turned} - found:
                    found.update((name, *(below.name for below in rig.data.bones[name].children_recursive)))
    return found


def _lays(constraint):
    """Whether a constraint only lays a pose over its bone, which counts as the bone's own."""
    return any(wiring.is_sink(system, constraint) for system in laying_systems())


def _capsules(bones, matrices):
    """Return the Shapes of Bones with these world matrices, (n, 4, 4) of each."""
    radii, places = [], []
    for bone, placed in zip(bones, matrices):
        sizes = _lengths(placed[:1, :3, :3])[0]
        heads = placed[:, :3, 3]
        radii.append(_radius(bone) * max(sizes[0], sizes[2]))
        places.append(_pairs(heads, heads + bone.length * placed[:, :3, 1]))
    return Shapes(["capsule"] * len(radii), radii, np.concatenate(places, axis=1))


def _radius(bone):
    return max(bone.head_radius, bone.tail_radius)


def _pairs(starts, ends):
    """Return two places (n, 3) at each time as one array (n, 1, 2, 3)."""
    return np.stack([starts, ends], axis=1)[:, None]


def _lengths(axes):
    """Return the lengths (n, 3) of the columns of matrices (n, 3, 3)."""
    return np.sqrt((axes**2).sum(axis=1))
