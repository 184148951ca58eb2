"""The objects of a pendulum (pivot, rods, bobs and trail): find them from each other, and fit them to the settings' lengths."""

import bpy
from mathutils import Matrix

from ..core import wiring
from ..core.declare import registered
from ..core.file import libraries, stored
from ..core.file.pointers import pointed
from ..core.refusals import INFINITE

MADE_KEY = "motus_pendulum"
"""Name of a custom property of meshes that Motus has made: the length of a rod's mesh, 0 for a bob's mesh."""

LARGEST_FAN = 500


def rods_each(settings):
    """Return the number of rods of one pendulum: 1 or 2."""
    return 1 if settings.kind in {'SINGLE', 'SPHERICAL'} else 2


def members(owner):
    """List the rod objects of a pivot's pendulums, without deleted rods and rods of the pivot from which this one was duplicated."""
    return [pointed(entry, "object") for entry in own_rods(owner)]


def numbers(owner):
    """List the number of each rod of members(): index of its pendulum in the fan, times rods per pendulum, plus index in its pendulum."""
    return [entry.number for entry in own_rods(owner)]


def own_rods(owner):
    """List the entries in the pivot's settings of the rods that members() returns."""
    return [entry for entry in owner.motus.pendulum.rods if _is_own(pointed(entry, "object"), owner)]


def _is_own(rod, owner):
    return rod is not None and libraries.is_free_or_of(rod, pointed(rod.motus.pendulum, "leader"), owner)


def own_trail(owner):
    """Return the trail object of a pendulum; None if it has none.

    A duplicated pivot points to the trail of the original pivot, which does not count.
    """
    trail = pointed(owner.motus.pendulum, "trail")
    is_own = trail and libraries.is_free_or_of(trail, pointed(trail.motus.pendulum_trail, "pivot"), owner)
    return trail if is_own else None


def pivot_of(obj):
    """Return the pivot of the pendulum to which an object belongs as pivot, rod, bob or trail; None if there is none."""
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
    """Whether an object is a rod that no pivot lists: a duplicated rod, or a rod whose pivot was deleted."""
    if pivot_of(obj) is not None or not obj.is_property_set("motus"):
        return False
    return _leader(obj) is not None or wiring.has_sinks(registered["pendulum"], obj)


def is_trail(obj):
    """Whether an object is the trail of a pendulum, even if the pendulum does not exist any more."""
    # Reading obj.motus creates the settings, so first check that they exist.
    return obj.is_property_set("motus") and obj.motus.pendulum_trail.is_active


def is_stray_trail(obj):
    """Whether an object is a trail whose pivot was deleted."""
    return is_trail(obj) and pointed(obj.motus.pendulum_trail, "pivot") is None


def stray_rod_of(obj):
    """Return the rod without a pendulum to which an object belongs as the rod itself, its bob or its trail; None if there is none.

    All stray rods of one pendulum are represented by the rod whose name sorts first.
    """
    rod = pointed(obj.motus.pendulum_trail, "rod") if is_stray_trail(obj) else obj.parent if _is_made_bob(obj) else obj
    if rod is None or not is_stray(rod):
        return None
    return min(wiring.abandoned(registered["pendulum"], rod), key=lambda one: one.name, default=rod)


def left_with(rods):
    """Return ([bobs made by Motus], [trails]) that are left of a pendulum whose pivot was deleted. rods: its rods."""
    bobs = [child for rod in rods for child in rod.children if _is_made_bob(child) and not child.library]
    trails = [
        obj for obj in bpy.data.objects if is_stray_trail(obj) and pointed(obj.motus.pendulum_trail, "rod") in rods and not obj.library
    ]
    return bobs, trails


def _is_made_bob(obj):
    return isinstance(obj.data, bpy.types.Mesh) and obj.data.get(MADE_KEY) == 0.0


def has_pendulum(obj):
    """Whether an object is the pivot of a pendulum."""
    # Reading obj.motus creates the settings, so first check that they exist.
    return obj.is_property_set("motus") and obj.motus.pendulum.is_active


def _leader(obj):
    return pointed(obj.motus.pendulum, "leader") if obj.is_property_set("motus") else None


def lengths(settings):
    """Return the lengths of the rods of one pendulum, upper rod first."""
    return (settings.length1, settings.length2)[: rods_each(settings)]


def fit(owner):
    """Adapt the rods' meshes and the places of lower rods and bobs to the lengths in the settings; linked objects are left unchanged."""
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
    # The artist may have given the rod a different mesh, which has no such property.
    try:
        made = stored.number(mesh.get(MADE_KEY) if mesh else None)
    except stored.Damaged:
        return
    if not made > 0.0 or made == length or mesh.library:
        return
    for vertex in mesh.vertices:
        vertex.co.z *= length / made
    mesh[MADE_KEY] = length
    mesh.update_tag()


def matrix(values):
    """Make a matrix from its 16 values, row after row; the identity if a value is not finite, as a file may have it."""
    if not all(abs(value) < INFINITE for value in values):
        return Matrix()
    return Matrix([values[row : row + 4] for row in range(0, 16, 4)])


def values(of_matrix):
    """List the 16 values of a matrix, row after row."""
    return [value for row in of_matrix for value in row]
