"""Fit a lattice around points, and add the Lattice modifiers that deform the objects."""

import math

import bpy
from mathutils import Matrix

from ..core import native
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.translations import tr
from . import shapes

FLAT = 1e-6
"""Share of the largest side below which a side counts as flat."""
THICKNESS = 0.1
"""Extent of a lattice across a flat side, as a share of the largest side, so that its points can be pulled out of the plane."""
ALONE = 1.0
"""Side of a lattice around a single point, in metres."""


def fit(context, objects, vertices, keywords):
    """Fit a lattice around objects, or around vertices {object: indices} of the objects, and let it deform them; returns the lattice.

    keywords: those of FitKeywords. Raises Refused before anything is changed if there are no points.
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
            # The points as modelled: the new modifier comes before the modifiers that the object has.
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
    """World matrix of a lattice whose points at rest span -0.5 to 0.5 on each axis."""
    local = np.array(leader.matrix_world.to_quaternion().to_matrix(), np.float64).T
    axes = {'LOCAL': local, 'GLOBAL': np.eye(3), 'FIT': local}[keywords["orientation"]]
    center, axes, size = native.module.box_around(points, axes, turn=keywords["orientation"] == 'FIT')
    largest = size.max()
    size[size <= FLAT * largest] = THICKNESS * largest if largest > 0.0 else ALONE
    size += 2.0 * keywords["margin"] * size.max()
    matrix = Matrix((axes * size[:, None]).T.tolist()).to_4x4()
    matrix.translation = center.tolist()
    # Blender squares the sides in single precision when it separates scale from rotation.
    if not all(0.0 < side < math.inf for side in matrix.to_scale()):
        raise Refused(tr("The lattice would be too large or too small for Blender"))
    return matrix


def _new_lattice(context, objects, matrix, keywords):
    name = f"{objects[0].name} Lattice"
    lattice = bpy.data.objects.new(name, bpy.data.lattices.new(name))
    # While the lattice object exists, Blender keeps the lattice's extent if the resolution changes.
    for axis, points in zip("uvw", keywords["resolution"]):
        setattr(lattice.data, f"points_{axis}", points)
        setattr(lattice.data, f"interpolation_type_{axis}", f"KEY_{keywords['interpolation']}")
    _collection_of(context, objects[0]).objects.link(lattice)
    # Children of a lattice depend on its shape: as the child of a lattice that it deforms, the new lattice would depend on itself.
    if keywords["use_parent"] and len(objects) == 1 and objects[0].type != 'LATTICE':
        lattice.parent = objects[0]
        lattice.matrix_parent_inverse = objects[0].matrix_world.inverted()
    lattice.matrix_basis = matrix
    lattice.motus.lattice.is_fitted = True
    return lattice


def _collection_of(context, obj):
    """A collection for the lattice: one of the object's that is visible and editable; otherwise the scene's own collection."""
    shown = set(context.view_layer.layer_collection.collection.children_recursive)
    for collection in obj.users_collection:
        if collection in shown and not collection.library and not collection.override_library:
            return collection
    return context.scene.collection


def _free_name(name, objects):
    """A name for the lattice that no vertex group of the objects has, so that the lattice's vertex group can have that name."""
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
    """Move a modifier before the object's other modifiers, as far as Blender allows."""
    index = obj.modifiers.find(modifier.name)
    if index == 0:
        return
    if hasattr(obj.modifiers, "move"):
        obj.modifiers.move(index, 0)
        return
    with bpy.context.temp_override(object=obj, active_object=obj):  # the attribute exists from Blender 3.5 on
        bpy.ops.object.modifier_move_to_index(modifier=modifier.name, index=0)
