"""Makes a lattice around points, and the modifiers by which it deforms."""

import math

import bpy
from mathutils import Matrix

from ..core import native
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.translations import tr
from . import shapes

FLAT = 1e-6
"""Share of the largest side below which a side counts as nothing."""
THICKNESS = 0.1
"""Share of the largest side that a lattice has across what is flat, so that it can be pulled out of the plane."""
ALONE = 1.0
"""Side, in metres, of a lattice around a single point."""


def fit(context, objects, vertices, keywords):
    """A lattice around objects, or around the vertices {object: indices} of theirs, that deforms them; returns it.

    keywords: those of FitKeywords. Refuses, before anything is changed, where there is nothing to go around.
    """
    points = _points(context, objects, vertices)
    matrix = _frame(points, objects[0], keywords)
    lattice = _new_lattice(context, objects, matrix, keywords)
    settings = lattice.motus.lattice
    if vertices:
        settings.vertex_group = _free_name(lattice.name, objects)
    for obj in objects:
        _deform(obj, lattice, vertices.get(obj), settings.vertex_group)
    context.view_layer.update()
    return lattice


def _points(context, objects, vertices):
    context.view_layer.update()
    depsgraph = context.evaluated_depsgraph_get()
    found = []
    for obj in objects:
        if obj in vertices:
            # As modelled: the lattice comes before the modifiers that the object has.
            points = shapes.in_world(shapes.positions(obj.data)[vertices[obj]], obj.matrix_world)
        else:
            points = shapes.world_points(obj, depsgraph)
        if not len(points):
            raise Refused(tr("{object} has no geometry").format(object=obj.name))
        if not np.isfinite(points).all():
            raise Refused(tr("{object} has vertices at infinity").format(object=obj.name))
        found.append(points)
    return np.concatenate(found)


def _frame(points, leader, keywords):
    """World matrix of a lattice whose points at rest span -0.5 to 0.5."""
    local = np.array(leader.matrix_world.to_quaternion().to_matrix(), np.float64).T
    axes = {'LOCAL': local, 'GLOBAL': np.eye(3), 'FIT': local}[keywords["orientation"]]
    center, axes, size = native.module.box_around(points, axes, turn=keywords["orientation"] == 'FIT')
    largest = size.max()
    size[size <= FLAT * largest] = THICKNESS * largest if largest > 0.0 else ALONE
    size += 2.0 * keywords["margin"] * size.max()
    matrix = Matrix((axes * size[:, None]).T.tolist()).to_4x4()
    matrix.translation = center.tolist()
    # Blender squares the sides, in single precision, to tell them from the rotation.
    if not all(0.0 < side < math.inf for side in matrix.to_scale()):
        raise Refused(tr("The lattice would be too large or too small for Blender"))
    return matrix


def _new_lattice(context, objects, matrix, keywords):
    name = f"{objects[0].name} Lattice"
    lattice = bpy.data.objects.new(name, bpy.data.lattices.new(name))
    # Of a lattice in an object Blender keeps the extent when the resolution changes.
    for axis, points in zip("uvw", keywords["resolution"]):
        setattr(lattice.data, f"points_{axis}", points)
        setattr(lattice.data, f"interpolation_type_{axis}", f"KEY_{keywords['interpolation']}")
    _collection_of(context, objects[0]).objects.link(lattice)
    # A lattice's children wait for its shape: a lattice that deforms its parent would wait for itself.
    if keywords["use_parent"] and len(objects) == 1 and objects[0].type != 'LATTICE':
        lattice.parent = objects[0]
        lattice.matrix_parent_inverse = objects[0].matrix_world.inverted()
    lattice.matrix_basis = matrix
    lattice.motus.lattice.is_fitted = True
    return lattice


def _collection_of(context, obj):
    """A collection of the object that shows, and that can be changed; else the scene's own."""
    shown = set(context.view_layer.layer_collection.collection.children_recursive)
    for collection in obj.users_collection:
        if collection in shown and not collection.library and not collection.override_library:
            return collection
    return context.scene.collection


def _free_name(name, objects):
    """A name that no vertex group of the objects has: so the lattice's own is known by it."""
    tried, number = name, 0
    while any(tried in obj.vertex_groups for obj in objects):
        number += 1
        tried = f"{name}.{number:03}"
    return tried


def _deform(obj, lattice, indices, group_name):
    modifier = obj.modifiers.new(lattice.name, 'LATTICE')
    modifier.object = lattice
    modifier.show_expanded = False
    if indices is None:
        return
    active = obj.vertex_groups.active_index
    group = obj.vertex_groups.new(name=group_name)
    group.add(indices.tolist(), 1.0, 'REPLACE')
    if len(obj.vertex_groups) > 1:
        obj.vertex_groups.active_index = active
    modifier.vertex_group = group.name
    move_first(obj, modifier)


def move_first(obj, modifier):
    """Put a modifier before the others, as far as Blender lets it go."""
    index = obj.modifiers.find(modifier.name)
    if index == 0:
        return
    if hasattr(obj.modifiers, "move"):
        obj.modifiers.move(index, 0)
        return
    with bpy.context.temp_override(object=obj, active_object=obj):  # before 3.5
        bpy.ops.object.modifier_move_to_index(modifier=modifier.name, index=0)
