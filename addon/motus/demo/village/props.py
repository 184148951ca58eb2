"""Props between the houses: lanterns beside the path, fences, and a pile of wood."""

import itertools
import math

import bpy
import numpy as np

from ..stage import materials, shapes
from . import terrain

WARM = (1.0, 0.52, 0.17)
LANTERNS = ((-1.35, 3.6), (2.6, 16.4))
FENCES = (
    ((-2.6, 1.4), (-4.4, 2.3), (-6.2, 2.9), (-8.1, 3.1), (-10.0, 2.9)),
    ((2.6, 5.6), (4.3, 6.2), (6.1, 6.3), (7.9, 5.9), (9.6, 5.0)),
)
PILE = (7.7, 10.3)  # x and y of the pile of wood, m
LOG = 0.11  # radius of a log, m


def build(collection, covered, lanterns=LANTERNS, fences=FENCES):
    """Add lanterns, fences and the pile of wood. All except the lights is in the collection `covered`, on which snow lies."""
    _add_lanterns(collection, covered, lanterns)
    wood = terrain.mottled("Fence Wood", (0.045, 0.034, 0.028), (0.11, 0.085, 0.068), 7.0)
    builder = shapes.MeshBuilder()
    for places in fences:
        _add_fence(builder, np.array([(x, y, terrain.ground_at(x, y)) for x, y in places]))
    _add_pile(builder)
    shapes.link_object(covered, "Fences", builder.build("Fences", [wood]))


def glow(name, strength):
    """Make a material that emits warm light."""
    material, shader, output = materials.new_material(name)
    light = shader.add("ShaderNodeEmission", {"Color": (*WARM, 1.0), "Strength": strength})
    materials.finish(material, shader, output, light.outputs[0])
    material.diffuse_color = (*WARM, 1.0)
    return material


def _add_lanterns(collection, covered, places):
    iron = materials.principled("Iron", color=(0.012, 0.012, 0.014), roughness=0.4)
    light = glow("Lantern Light", 9.0)
    builder = shapes.MeshBuilder()
    builder.add(shapes.upright(shapes.lathe(((0.035, 2.3), (0.045, 0.35), (0.10, 0.25), (0.12, -0.3)), segments=16)))
    builder.add(shapes.upright(shapes.lathe(((0.001, 2.92), (0.05, 2.84), (0.24, 2.68), (0.20, 2.66)), segments=12)), 0, smooth=False)
    builder.add(shapes.upright(shapes.lathe(((0.13, 2.64), (0.10, 2.34)), segments=6)), 1, smooth=False)
    builder.add(shapes.upright(shapes.lathe(((0.12, 2.34), (0.05, 2.26)), segments=6)), 0, smooth=False)
    mesh = builder.build("Lantern", [iron, light])
    for place in places:
        lantern = shapes.link_object(covered, "Lantern", mesh)
        lantern.location = (*place, terrain.ground_at(*place))
        data = bpy.data.lights.new("Lantern Light", "POINT")
        data.energy, data.color, data.shadow_soft_size = 320.0, WARM, 0.16
        shapes.link_object(collection, "Lantern Light", data, parent=lantern).location.z = 2.5


def _add_fence(builder, places):
    """Add the posts of a fence, and rails between the posts. places: (x, y, z) of the posts."""
    for place in places:
        builder.add(shapes.box((0.15, 0.15, 1.15), place + (0.0, 0.0, 0.45)), smooth=False)
    for start, end in itertools.pairwise(places):
        for z in (0.42, 0.80):
            builder.add(_rail(start, end, z, 0.07, 0.10), smooth=False)


def _rail(start, end, z, width, high):
    """Make a bar from one post to the next. z: height above the ground at the posts."""
    along = end - start
    vertices, faces = shapes.box((float(np.hypot(along[0], along[1])), width, high))
    vertices = terrain.turned(vertices, math.atan2(along[1], along[0]))
    share = (vertices - vertices.mean(axis=0)) @ along / (along @ along)
    vertices[:, 2] += share * along[2]
    return vertices + 0.5 * (start + end) + (0.0, 0.0, z), faces


def _add_pile(builder):
    """Add a pile of logs beside a house."""
    ground = np.array((*PILE, terrain.ground_at(*PILE)))
    for row in range(4):
        for number in range(7 - row):
            across, up = (number - 3.0 + 0.5 * row) * 2.0 * LOG, LOG * (1.0 + 1.7 * row)
            vertices, faces = shapes.lathe(((0.001, 0.45), (LOG, 0.45), (LOG, -0.45), (0.001, -0.45)), segments=9)
            turned = terrain.turned(vertices + (across, 0.0, up), 0.9)
            builder.add((turned + ground, faces), smooth=False)
