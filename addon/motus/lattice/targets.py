"""Find the objects and vertices that an operator works on: by the names that scripts give, or by selection.

Errors are raised as Refused.
"""

import math

import bpy

from ..core.lazy import numpy as np
from ..core.refusals import Refused, check_local, named
from ..core.translations import tr

KINDS = {'MESH', 'CURVE', 'SURFACE', 'FONT', 'LATTICE'}
"""Types of objects that Blender's Lattice modifier deforms."""


def objects_for(context, names):
    """Objects by comma-separated names, or of the collection of this name; without names the selected ones, the active one first."""
    if names:
        collection = bpy.data.collections.get(names)
        if collection and names not in bpy.data.objects:
            return [found for found in sorted(collection.objects, key=lambda one: one.name) if found.type in KINDS]
        found = [named(name.strip()) for name in names.split(",") if name.strip()]
        return list(dict.fromkeys(found))
    selected = sorted(context.selected_objects, key=lambda found: (found != context.object, found.name))
    return [found for found in selected if found.type in KINDS]


def named_or_active(context, name):
    """Return the object of this name; the active object if the name is empty."""
    obj = named(name) if name else context.object
    if obj is None:
        raise Refused(tr("Select an object that a lattice deforms"))
    return obj


def check_fittable(obj):
    """Refuse an object that no lattice can deform."""
    if obj.type not in KINDS:
        raise Refused(
            tr("{object} has no shape that a lattice deforms: meshes, curves, surfaces, texts and lattices have").format(object=obj.name)
        )
    check_local(obj)
    check_scale(obj)


def check_scale(obj):
    """Refuse an object without extent along some axis of the world."""
    values = [value for row in obj.matrix_world for value in row]
    lengths = math.prod(column.length for column in obj.matrix_world.to_3x3().col)
    if not all(map(math.isfinite, values)) or abs(obj.matrix_world.to_3x3().determinant()) <= 1e-9 * lengths:
        raise Refused(tr("{object} is scaled to nothing along one of its axes").format(object=obj.name))


def check_grouped(obj):
    """Refuse an object to which no vertex group can be added."""
    if obj.type != 'MESH':
        raise Refused(tr("{object} has no vertices to choose from: only meshes have vertex groups").format(object=obj.name))
    if obj.data.library:
        raise Refused(tr("The mesh of {object} is linked from another file: make it local first").format(object=obj.name))


def selected_vertices(context):
    """Vertices that are selected in Edit Mode, {object: indices}, the active object first."""
    found = {}
    for obj in sorted(context.objects_in_mode, key=lambda one: (one != context.object, one.name)):
        obj.update_from_editmode()
        chosen = np.empty(len(obj.data.vertices), bool)
        obj.data.vertices.foreach_get("select", chosen)
        if chosen.any():
            found[obj] = np.flatnonzero(chosen)
    if not found:
        raise Refused(tr("Select the vertices that the lattice shall deform"))
    return found


def group_vertices(objects, name):
    """Vertices in the vertex group of this name, {object: indices}."""
    found = {}
    for obj in objects:
        check_grouped(obj)
        group = obj.vertex_groups.get(name)
        if group is None:
            raise Refused(tr("{object} has no vertex group {group}").format(object=obj.name, group=name))
        indices = [
            vertex.index
            for vertex in obj.data.vertices
            if any(entry.group == group.index and entry.weight > 0.0 for entry in vertex.groups)
        ]
        if not indices:
            raise Refused(tr("The vertex group {group} of {object} is empty").format(object=obj.name, group=name))
        found[obj] = np.array(indices)
    return found
