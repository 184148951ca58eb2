"""Viewport overlay of chains: links, limits, colliders, pins, and where the chains touch."""

import math

import bpy
from mathutils import Vector

from ..core.interface.overlay import Batch, Overlay, Switch
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.settings import entries
from . import colliders, groups, motion, pins, steps, wires
from .of_bones import Bones

LINK_COLOR = (0.35, 0.80, 0.75, 0.9)
UNFINISHED_COLOR = (0.5, 0.5, 0.5, 0.6)
"""Of links whose motion is being solved, and which still lie where their former motion has them."""
LIMIT_COLOR = (0.80, 0.80, 0.90, 0.45)
COLLIDER_COLOR = (0.45, 0.60, 0.95, 0.6)
PIN_COLOR = (0.98, 0.80, 0.25, 0.9)
CONTACT_COLOR = (1.0, 0.35, 0.15, 1.0)
LINK_WIDTH, PIN_SIZE, CONTACT_SIZE = 2.0, 7.0, 9.0  # pixels
CONE = 0.5
"""Length of a cone that shows a bend limit, in lengths of its bone."""
NEAR, TOUCHING = 1.1, 1e-3
"""A bone touches what is nearer than this many thicknesses of the chain, and this part of its length."""
MOST_COMPARED = 100_000
"""Places along chains times capsules of a collider, above which it is not looked where they touch: some ten milliseconds a redraw."""
PARTS = 4
"""At the ends of so many equal parts of each bone it is looked whether it touches."""

LIMITS = Switch("show_chains_limits", "Limits", "Draw the bend limits of the shown chain as cones")
COLLIDERS = Switch("show_chains_colliders", "Colliders", "Draw the balls, capsules and planes that the chains touch, and where they touch")
PINS = Switch("show_chains_pins", "Pins", "Draw what holds the pinned bones")


def _batches_of(context, owner):
    """List of Batches to draw for an armature object with chains; empty for any different object."""
    if not owner.motus.chains.is_active:
        return []
    rig = owner.evaluated_get(context.evaluated_depsgraph_get())
    chains = [chain for chain in groups.chains(rig) if not chain.entry.is_muted]
    color, found = LINK_COLOR if steps.done(owner) is None else UNFINISHED_COLOR, []
    for chain in chains:
        found += _lines(chain.ends, color, LINK_WIDTH)
    of_bones = [chain for chain in chains if isinstance(chain, Bones)]
    if context.scene.motus.show_chains_limits:
        shown = entries.active(owner, "chains")
        found += [batch for chain in of_bones if shown and chain.entry.name == shown.name for batch in _limits(rig, chain)]
    if context.scene.motus.show_chains_pins:
        found += _pins(rig, of_bones)
    if context.scene.motus.show_chains_colliders:
        found += _colliders(context, rig, chains)
    return found


def _lines(points, color, width=1.0):
    return [Batch('LINES', np.array(points, np.float32).reshape(-1, 3), color, width)] if len(points) else []


def _points(points, color, size):
    return [Batch('POINTS', np.array(points, np.float32).reshape(-1, 3), color, size)] if len(points) else []


def _limits(rig, chain):
    """Cones within which the bones of a chain may point; [] if they have no limit."""
    angle = chain.entry.bend_limit
    side_angle = min(angle, chain.entry.side_limit)
    if side_angle >= math.pi:
        return []
    world = rig.matrix_world
    cones = []
    for bone in chain.things[1:]:
        # Where the bone would be if it followed its parent.
        rest = bone.parent.bone.matrix_local.inverted_safe() @ bone.bone.matrix_local
        side, along, _ = (world.to_3x3() @ (bone.parent.matrix @ rest @ bone.matrix_basis).to_3x3()).col
        size = CONE * (world @ bone.tail - world @ bone.head).length
        cones.append(wires.cone(np.array(world @ bone.head), np.array(along), np.array(side), size, angle, side_angle))
    return _lines(np.concatenate(cones), LIMIT_COLOR) if cones else []


def _pins(rig, chains):
    """Points where pins hold, with lines from the tails of their bones."""
    names = {name for chain in chains for name in chain.names}
    ends = []
    for name, (_, (target, bone)) in pins.acting(rig.motus.chains, names).items():
        place = target.matrix_world @ target.pose.bones[bone].head if bone else target.matrix_world.translation
        ends += [rig.matrix_world @ rig.pose.bones[name].tail, place]
    return _lines(ends, PIN_COLOR) + _points(ends[1::2], PIN_COLOR, PIN_SIZE)


def _colliders(context, rig, chains):
    """Wires of what chains touch, and points where bones touch it."""
    along, reach, size = _along(chains)
    if not len(along):
        return []
    settings, scene = rig.motus.chains, context.scene
    frames = np.array([scene_time.first(scene), scene_time.present(scene)])
    depsgraph = context.evaluated_depsgraph_get()
    touched = [obj.evaluated_get(depsgraph) for obj in colliders.objects(rig.original.motus.chains)]
    lines, apart = [], np.full(len(along), np.inf)
    for solid in colliders.over_time(settings, [obj for obj in touched if obj.is_evaluated], scene):
        if solid.is_mesh:
            apart = np.minimum(apart, _from_mesh(solid.thing, along))
        elif solid.is_known:
            shapes = solid.shapes(frames)
            is_plane = np.array([name == "plane" for name in shapes.names])
            places, radii = shapes.places[1], np.array(shapes.radii)
            capsules = places[~is_plane], radii[~is_plane]
            lines += [wires.capsules(*capsules), wires.planes(places[is_plane], along[0], 0.5 * size)]
            if len(along) * len(capsules[1]) <= MOST_COMPARED:
                apart = np.minimum(apart, wires.distances(along, *capsules))
            apart = np.minimum(apart, wires.heights(along, places[is_plane]))
    near = along[apart <= reach]
    return (_lines(np.concatenate(lines), COLLIDER_COLOR) if lines else []) + _points(near, CONTACT_COLOR, CONTACT_SIZE)


def _along(chains):
    """(places along the links of chains (n, 3), how near to them something touches (n,), length of all links), in the world."""
    ends = np.array([end for chain in chains for end in chain.ends], float).reshape(-1, 1, 2, 3)
    strands = [motion.Strand(list(chain.parents), None, b"", None, chain.entry, {}) for chain in chains]
    thicknesses = [thickness for strand in strands for thickness in strand.keywords()["thickness"][1:]]
    shares = np.arange(1, PARTS + 1)[:, None] / PARTS
    sizes = np.linalg.norm(ends[:, 0, 1] - ends[:, 0, 0], axis=1)
    reach = NEAR * np.array(thicknesses) + TOUCHING * sizes
    return ((1.0 - shares) * ends[:, :, 0] + shares * ends[:, :, 1]).reshape(-1, 3), np.repeat(reach, PARTS), sizes.sum()


def _from_mesh(obj, places):
    """Distances (n,) of places in the world from the faces of an evaluated mesh object, roughly where it is scaled unevenly."""
    if not isinstance(obj.data, bpy.types.Mesh) or not len(obj.data.polygons):
        return np.full(len(places), np.inf)
    back = obj.matrix_world.inverted_safe()
    found = []
    for place in map(tuple, places):
        is_found, nearest, _, _ = obj.closest_point_on_mesh(back @ Vector(place))
        found.append((obj.matrix_world @ nearest - Vector(place)).length if is_found else math.inf)
    return np.array(found)


overlay = Overlay(_batches_of, (LIMITS, COLLIDERS, PINS))
