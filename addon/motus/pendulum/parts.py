"""What a pendulum is made of: the pivot, rods and bobs, found from any of them, and fitted to the lengths."""

import bpy
from mathutils import Matrix

from ..core import wiring
from ..core.declare import registered
from ..core.file import libraries
from ..core.file.pointers import pointed

MADE_KEY = "motus_pendulum"
"""Custom property of a mesh that was made for rods: their length; 0 for one that was made for bobs."""

LARGEST_FAN = 500


def rods_each(settings):
    """How many rods a pendulum has."""
    return 1 if settings.kind == 'SINGLE' else 2


def members(owner):
    """Rod objects of a pendulum. Deleted rods, and rods that belong to the pivot from which this one was duplicated, are left out."""
    return [pointed(entry, "object") for entry in own_rods(owner)]


def numbers(owner):
    """Number of each member: of its pendulum in the fan times the rods each, and of the rod in it."""
    return [entry.number for entry in own_rods(owner)]


def own_rods(owner):
    """The entries of the rods that are members."""
    return [entry for entry in owner.motus.pendulum.rods if _is_own(pointed(entry, "object"), owner)]


def _is_own(rod, owner):
    return rod is not None and libraries.is_free_or_of(rod, pointed(rod.motus.pendulum, "leader"), owner)


def own_trail(owner):
    """Trail object of a pendulum; None if it has none. A duplicated pivot points to the original's trail, which does not count."""
    trail = pointed(owner.motus.pendulum, "trail")
    is_own = trail and libraries.is_free_or_of(trail, pointed(trail.motus.pendulum_trail, "pivot"), owner)
    return trail if is_own else None


def pivot_of(obj):
    """The pivot of the pendulum that an object is part of, whether that is active or not; None without."""
    if has_pendulum(obj):
        return obj
    of_trail = pointed(obj.motus.pendulum_trail, "pivot") if obj.is_property_set("motus") else None
    rod = obj if _leader(obj) else obj.parent
    leader = of_trail or (_leader(rod) if rod else None)
    if leader is None or not has_pendulum(leader):
        return None
    listed = obj == own_trail(leader) or any(
        obj in (pointed(entry, "object"), pointed(entry, "bob")) for entry in leader.motus.pendulum.rods
    )
    return leader if listed else None


def is_stray(obj):
    """Whether an object is a rod of no pendulum that lists it: the copy of a rod, or one whose pivot is gone."""
    if pivot_of(obj) is not None or not obj.is_property_set("motus"):
        return False
    return _leader(obj) is not None or wiring.has_sinks(registered["pendulum"], obj)


def is_trail(obj):
    """Whether an object is a trail."""
    # To ask an object for its settings gives it some.
    return obj.is_property_set("motus") and obj.motus.pendulum_trail.is_active


def is_stray_trail(obj):
    """Whether an object is a trail whose pivot is gone."""
    return is_trail(obj) and pointed(obj.motus.pendulum_trail, "pivot") is None


def stray_rod_of(obj):
    """Rod without a pendulum to which an object belongs as the rod itself, its bob or its trail; None if there is none.

    All stray rods of one pendulum are represented by the rod whose name sorts first.
    """
    rod = pointed(obj.motus.pendulum_trail, "rod") if is_stray_trail(obj) else obj.parent if _is_made_bob(obj) else obj
    if rod is None or not is_stray(rod):
        return None
    return min(wiring.abandoned(registered["pendulum"], rod), key=lambda one: one.name, default=rod)


def left_with(rods):
    """(made bobs, trails) that are left of a pendulum whose pivot is gone."""
    bobs = [child for rod in rods for child in rod.children if _is_made_bob(child) and not child.library]
    trails = [
        obj for obj in bpy.data.objects if is_stray_trail(obj) and pointed(obj.motus.pendulum_trail, "rod") in rods and not obj.library
    ]
    return bobs, trails


def _is_made_bob(obj):
    return isinstance(obj.data, bpy.types.Mesh) and obj.data.get(MADE_KEY) == 0.0


def has_pendulum(obj):
    """Whether an object is the pivot of a pendulum."""
    # To ask an object for its settings gives it some.
    return obj.is_property_set("motus") and obj.motus.pendulum.is_active


def _leader(obj):
    return pointed(obj.motus.pendulum, "leader") if obj.is_property_set("motus") else None


def lengths(settings):
    """Lengths of the rods of one pendulum."""
    return (settings.length1, settings.length2)[: rods_each(settings)]


def fit(owner):
    """Let rods and bobs have the settings' lengths; what is another file's stays."""
    settings = owner.motus.pendulum
    each = rods_each(settings)
    for entry in own_rods(owner):
        length = lengths(settings)[entry.number % each]
        if not length > 0.0:
            continue
        rod = pointed(entry, "object")
        if not rod.library:
            _fit_mesh(rod.data, length)
            if entry.number % each:
                rod.matrix_parent_inverse = Matrix.Translation((0.0, 0.0, -settings.length1))
        bob = pointed(entry, "bob")
        if bob and bob.parent == rod and not bob.library:
            bob.matrix_parent_inverse = Matrix.Translation((0.0, 0.0, -length)) @ matrix(entry.rest)


def _fit_mesh(mesh, length):
    # None where the artist has given the rod another shape.
    made = mesh.get(MADE_KEY) if mesh else None
    if not isinstance(made, float) or not made > 0.0 or made == length or mesh.library:
        return
    for vertex in mesh.vertices:
        vertex.co.z *= length / made
    mesh[MADE_KEY] = length
    mesh.update_tag()


def matrix(values):
    """A matrix from its 16 values, row after row."""
    return Matrix([values[row : row + 4] for row in range(0, 16, 4)])


def values(of_matrix):
    """The 16 values of a matrix."""
    return [value for row in of_matrix for value in row]
