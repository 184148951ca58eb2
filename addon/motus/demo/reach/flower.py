"""A daisy in a pot that stretches its stem toward the butterfly, by inverse kinematics that lengthens bones and keeps their volume."""

import bpy
import numpy as np

from ..stage import bones, materials, shapes

PLACE, POT_SIZE = (0.88, 0.56), 0.62  # x, y of the pot on the lookout, and its size
STEM = ((0.0, 0.0, 0.10), (0.03, -0.02, 0.30), (-0.02, -0.04, 0.52), (0.02, -0.06, 0.74))  # from the pot's middle, m
BONES, RADIUS = 6, 0.013
BLOSSOM, HEART, PETALS = 0.115, 0.036, 17  # radii of the blossom and its middle, m, and number of its petals
LEAVES = ((1.3, 0.7), (2.4, 3.6), (3.3, 2.0))  # place on the stem, in bones, and angle around it, rad
STRETCH, SOFTNESS = 0.42, 0.25


def build(context, collection, stage, target):
    """Add the daisy, without its pot. stage: empty that everything on the lookout is parented to. target: what it stretches toward."""
    places = bones.along(STEM, BONES + 1)
    with bones.Armature(context, collection, "Daisy") as armature:
        row = armature.add_row("Stem", "", places)
        armature.add("Blossom", row[-1], places[-1], places[-1] + 0.4 * (places[-1] - places[-2]))
        # The stem gets longer and thinner; the blossom keeps its size.
        armature.object.data.edit_bones["Blossom"].inherit_scale = "NONE"
    rig = armature.object
    rig.parent, rig.location = stage, (*PLACE, 0.0)
    bones.carry(_skin(collection, places, row), rig)
    context.view_layer.update()
    result = bpy.ops.motus.ik_add(
        object=rig.name, bone=row[-1], target=target.name, chain_length=BONES, softness=SOFTNESS, stretch=STRETCH, volume=1.0
    )
    if result != {"FINISHED"}:
        raise RuntimeError("The daisy could not be wired")
    return rig


def _skin(collection, places, row):
    """Make the mesh of stem, leaves and blossom, carried by the bones of the row."""
    skin = bones.Skin()
    part, at = bones.tube(places, RADIUS)
    skin.add(part, 0, bones.shares_along(row, at))
    for where, angle in LEAVES:
        below = int(where)
        base = places[below] + (where - below) * (places[below + 1] - places[below])
        skin.add(_leaf(base, angle), 0, {row[below]: 1.0})
    ahead = places[-1] - places[-2]
    ahead /= np.linalg.norm(ahead)
    aside = np.cross(ahead, (0.0, 1.0, 0.0))
    aside /= np.linalg.norm(aside)
    axes = np.array((aside, np.cross(ahead, aside), ahead))
    for (vertices, faces), slot in _blossom():
        skin.add((vertices @ axes + places[-1], faces), slot, {"Blossom": 1.0})
    return skin.finish(
        collection,
        "Daisy Skin",
        [
            materials.principled("Daisy Stem", color=(0.085, 0.20, 0.035), roughness=0.6),
            materials.principled("Daisy Petals", color=(0.86, 0.84, 0.78), roughness=0.5),
            materials.principled("Daisy Heart", color=(0.80, 0.42, 0.02), roughness=0.7),
        ],
    )


def _leaf(base, angle):
    """Return (vertices, faces) of a leaf that leaves the stem at a place, in a direction of the horizon."""
    vertices, faces = shapes.sphere(0.075, (0.075, 0.0, 0.0), (1.0, 0.42, 0.09), 16, 10)
    vertices[:, 2] += 0.35 * vertices[:, 0]
    turn = np.array(((np.cos(angle), np.sin(angle), 0.0), (-np.sin(angle), np.cos(angle), 0.0), (0.0, 0.0, 1.0)))
    return vertices @ turn + base, faces


def _blossom():
    """Yield (part, slot of its material) of a blossom that opens along +Z."""
    for index in range(PETALS):
        angle = 2.0 * np.pi * index / PETALS
        length = 0.5 * (BLOSSOM - 0.5 * HEART)
        vertices, faces = shapes.sphere(length, (0.5 * HEART + length, 0.0, 0.0), (1.0, 0.27, 0.08), 12, 8)
        vertices[:, 2] += 0.18 * vertices[:, 0] + (0.003 if index % 2 else 0.0)
        turn = np.array(((np.cos(angle), np.sin(angle), 0.0), (-np.sin(angle), np.cos(angle), 0.0), (0.0, 0.0, 1.0)))
        yield (vertices @ turn, faces), 1
    yield shapes.sphere(HEART, (0.0, 0.0, 0.006), (1.0, 1.0, 0.55), 20, 12), 2
