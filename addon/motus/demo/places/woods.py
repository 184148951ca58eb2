"""The woods: two kinds of trees, each one object that is instanced on the faces of a mesh."""

import math

import numpy as np

from ..stage import materials, shapes
from . import landscape

# Base, top and width of each cone of branches of a fir of height 1.
FIR_SKIRTS = ((0.10, 0.48, 0.24), (0.30, 0.66, 0.195), (0.49, 0.83, 0.145), (0.67, 1.0, 0.095))
# x, y, z and radius of each sphere of leaves of a round tree of height 1.
CROWNS = ((0.0, 0.0, 0.62, 0.30), (0.17, 0.05, 0.5, 0.21), (-0.14, 0.12, 0.52, 0.2), (-0.03, -0.17, 0.55, 0.2))


def build(collection, haze, is_clear=None):
    """Add firs everywhere and round trees near the lake.

    haze: node group of the haze. is_clear: a function of arrays x and y that says where trees may stand; by default everywhere.
    """
    seed = landscape.SEED + 200
    firs = wanted_trees(26000, 1000.0, seed, is_clear)
    add_forest(collection, "Firs", add_conifer(collection, haze), firs, (6.0, 11.5), seed + 1)
    round_trees = wanted_trees(9000, 700.0, seed + 10, is_clear)
    add_forest(collection, "Round Trees", add_broadleaf(collection, haze), round_trees, (4.5, 8.0), seed + 11)


def random_places(count, radius, seed):
    """Return repeatable random points in a square around the origin, as arrays x and y. radius: half the side of the square."""
    index = np.arange(count)
    zero = np.zeros_like(index)
    return ((landscape.lattice(index, zero + axis, seed) * 2.0 - 1.0) * radius for axis in (0, 1))


def wanted_trees(count, radius, seed, is_clear=None):
    """Return places (m, 3) for trees: dense in the woods, a few on the meadows, none in water or on rock, nor where is_clear(x, y) is False."""
    x, y = random_places(count, radius, seed)
    z, steepness = landscape.height(x, y), landscape.steepness_at(x, y)
    chance = np.maximum(landscape.wood_share(x, y, z, steepness), 0.035 * (z > 3.0) * (z < 150.0) * (steepness < 0.6))
    luck = landscape.lattice(np.arange(count), np.full(count, 2), seed)
    keep = luck < chance
    places = np.column_stack((x, y, z - 0.3))[keep]
    return places if is_clear is None else places[is_clear(places[:, 0], places[:, 1])]


def add_forest(collection, name, tree, places, sizes, seed):
    """Instance a tree object on a mesh of small squares: one tree for each face, scaled by the face's size."""
    turn = 2.0 * math.pi * landscape.lattice(np.arange(len(places)), np.full(len(places), 3), seed)
    luck = landscape.lattice(np.arange(len(places)), np.full(len(places), 4), seed)
    size = sizes[0] + (sizes[1] - sizes[0]) * luck**1.5
    corner = turn[:, None] + np.pi * np.array((0.25, 0.75, 1.25, 1.75))
    half = size[:, None] * math.sqrt(0.5)
    squares = np.stack((half * np.cos(corner), half * np.sin(corner), np.zeros_like(corner)), axis=-1)
    builder = shapes.MeshBuilder()
    builder.add(((squares + places[:, None, :]).reshape(-1, 3), np.arange(4 * len(places)).reshape(-1, 4)))
    forest = shapes.link_object(collection, name, builder.build(name, []))
    forest.instance_type = "FACES"
    forest.use_instance_faces_scale = True
    forest.show_instancer_for_render = False
    forest.show_instancer_for_viewport = False
    tree.parent = forest
    return forest


def add_conifer(collection, haze):
    """Add a fir of height 1: a trunk and four cones of branches."""
    builder = shapes.MeshBuilder()
    builder.add(_upright(((0.035, 0.2), (0.035, 0.0))), 1)
    for base, top, width in FIR_SKIRTS:
        middle = base + 0.45 * (top - base)
        builder.add(_upright(((0.001, top), (width * 0.45, middle), (width, base), (0.02, base + 0.05))))
    mesh = builder.build("Conifer", [_leaf_material("Needles", (0.028, 0.085, 0.034), haze), _bark_material(haze)])
    return shapes.link_object(collection, "Conifer", mesh)


def add_broadleaf(collection, haze):
    """Add a round tree of height 1: a trunk and a few overlapping spheres of leaves."""
    builder = shapes.MeshBuilder()
    builder.add(_upright(((0.03, 0.4), (0.045, 0.0))), 1)
    for x, y, z, radius in CROWNS:
        builder.add(shapes.sphere(radius, (x, y, z), (1.0, 1.0, 1.12), segments=9, rings=7))
    mesh = builder.build("Broadleaf", [_leaf_material("Leaves", (0.115, 0.155, 0.028), haze), _bark_material(haze)])
    return shapes.link_object(collection, "Broadleaf", mesh)


def _upright(profile):
    """Turn a profile of (radius, height) rows about Z."""
    vertices, faces = shapes.lathe(profile, segments=9)
    return vertices[:, (0, 2, 1)] * (1.0, -1.0, 1.0), faces


def _bark_material(haze):
    return materials.principled("Bark", haze, color=(0.11, 0.07, 0.045), roughness=0.9)


def _leaf_material(name, color, haze):
    """Make a material of leaves whose tint varies from tree to tree."""
    material, shader, output = materials.new_material(name)
    luck = shader.add("ShaderNodeObjectInfo").outputs["Random"]
    dark, warm = tuple(0.7 * c for c in color), (color[0] * 2.0, color[1] * 1.35, color[2])
    tint = shader.ramp(luck, ((0.0, dark), (0.6, color), (1.0, warm)))
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=tint, roughness=0.85, specular=0.15)
    materials.finish(material, shader, output, node.outputs[0], haze)
    material.diffuse_color = (*color, 1.0)
    return material
