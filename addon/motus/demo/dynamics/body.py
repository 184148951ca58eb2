"""The mesh of the hopping creature, deformed by its bones."""

import numpy as np

from ..stage import materials, shapes
from . import skeleton

SKIN, BELLY, DARK, WHITE, GLOW = range(5)
BODY_CENTRE, BODY_SIZE = (0.0, 0.02, 0.55), (0.47, 0.44, 0.52)
TUBES = {  # chain -> radius at its root and at its tip, m
    skeleton.TAIL: (0.115, 0.030),
    **dict.fromkeys(skeleton.ANTENNAE, (0.030, 0.014)),
}
BALLS = {skeleton.TAIL: (0.105, (0.8, 0.8, 1.25)), **dict.fromkeys(skeleton.ANTENNAE, (0.075, (1.0, 1.0, 1.0)))}
RINGS_A_BONE = 5


def build(collection, rig):
    """Make the creature's mesh object, deformed by the rig."""
    builder, groups = shapes.MeshBuilder(), []
    _add_body(builder, groups)
    for chain in skeleton.JOINTS:
        _add_tube(builder, groups, chain)
    mesh = builder.build("Hopper", _materials())
    thing = shapes.link_object(collection, "Hopper Skin", mesh, rig)
    _weigh(thing, groups)
    thing.modifiers.new("Armature", "ARMATURE").object = rig
    return thing


def _materials():
    return [
        materials.principled("Hopper Skin", color=(0.82, 0.23, 0.055), roughness=0.55),
        materials.principled("Hopper Belly", color=(0.90, 0.62, 0.30), roughness=0.6),
        materials.principled("Hopper Pupils", color=(0.012, 0.010, 0.012), roughness=0.12),
        materials.principled("Hopper Eyes", color=(0.90, 0.88, 0.84), roughness=0.18),
        materials.principled("Hopper Tips", color=(0.95, 0.66, 0.06), roughness=0.35),
    ]


def _add(builder, groups, part, slot, weights):
    """Add a part to the builder and its weights to `groups`. weights: {bone name: one weight, or one for each vertex}."""
    count = len(part[0])
    builder.add(part, slot)
    groups.append((count, {bone: np.broadcast_to(weight, count) for bone, weight in weights.items()}))


def _add_body(builder, groups):
    body = {skeleton.BODY: 1.0}
    vertices, faces = shapes.sphere(1.0, BODY_CENTRE, BODY_SIZE, 64, 44)
    below = np.clip((0.60 - vertices[:, 2]) / 0.6, 0.0, 1.0)[:, None]
    vertices = vertices + (vertices - np.array(BODY_CENTRE)) * below * (0.16, 0.16, 0.0)  # makes the body pear-shaped
    _add(builder, groups, (vertices, faces), SKIN, body)
    _add(builder, groups, shapes.sphere(1.0, (0.0, -0.155, 0.395), (0.31, 0.335, 0.305), 48, 32), BELLY, body)
    for side in (-1.0, 1.0):
        _add(builder, groups, shapes.sphere(0.125, (side * 0.155, -0.330, 0.755), (1.0, 0.62, 1.12), 28, 20), WHITE, body)
        _add(builder, groups, shapes.sphere(0.066, (side * 0.142, -0.388, 0.750), (1.0, 0.5, 1.15), 24, 16), DARK, body)
        _add(builder, groups, shapes.sphere(0.020, (side * 0.142 - 0.024, -0.420, 0.784), (1.0, 0.5, 1.0), 16, 10), WHITE, body)
        _add(builder, groups, shapes.sphere(0.13, (side * 0.20, -0.16, 0.075), (0.9, 1.35, 0.55), 28, 18), GLOW, {skeleton.ROOT: 1.0})
        _add(builder, groups, shapes.sphere(0.085, (side * 0.47, -0.13, 0.47), (0.55, 0.9, 1.5), 24, 16), SKIN, body)
    _add(builder, groups, shapes.sphere(0.052, (0.0, -0.445, 0.655), (1.25, 0.55, 0.75), 24, 16), DARK, body)


def _add_tube(builder, groups, chain):
    """Add a tube that narrows along a chain of bones, with a ball on its tip."""
    count = skeleton.JOINTS[chain]
    rings = RINGS_A_BONE * count + 1
    places = skeleton.way(chain, rings)
    ahead = np.gradient(places, axis=0)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    across = np.cross(ahead, (1.0, 0.0, 0.0))
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    third = np.cross(ahead, across)
    angle, share = shapes.ring(20), np.linspace(0.0, 1.0, rings)
    first, last = TUBES[chain]
    radius = (first + (last - first) * share)[:, None, None]
    sections = places[:, None] + radius * (np.cos(angle)[None, :, None] * across[:, None] + np.sin(angle)[None, :, None] * third[:, None])
    vertices, faces = shapes.loft(sections[:, ::-1])
    _add(builder, groups, (vertices, faces), SKIN, _along(chain, np.repeat(share * count, len(angle))))
    size, scale = BALLS[chain]
    vertices, faces = shapes.sphere(size, (0.0, 0.0, 0.0), scale, 28, 20)
    axes = np.stack((third[-1], across[-1], ahead[-1]))
    _add(builder, groups, (vertices @ axes + places[-1], faces), GLOW, {skeleton.names(chain)[-1]: 1.0})


def _along(chain, at):
    """Return the weights of vertices for the bones of a chain: each bone fades into its neighbours.

    at: places of the vertices along the chain, (n,), in bones from its start. Returns {bone name: weights}.
    """
    middles = np.arange(skeleton.JOINTS[chain]) + 0.5
    shares = np.clip(1.0 - np.abs(at[None, :] - middles[:, None]), 0.0, 1.0)
    shares[0, at < 0.5] = 1.0
    shares[-1, at > middles[-1]] = 1.0
    return dict(zip(skeleton.names(chain), shares))


def _weigh(thing, groups):
    first = 0
    for count, weights in groups:
        for bone, shares in weights.items():
            group = thing.vertex_groups.get(bone) or thing.vertex_groups.new(name=bone)
            for share in np.unique(shares[shares > 0.0]):
                group.add((first + np.flatnonzero(shares == share)).tolist(), float(share), 'REPLACE')
        first += count
