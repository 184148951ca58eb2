"""Overlay of the active layer in the viewport: outlines of the bones in its mask, brighter for a greater weight."""

from ..core import native, rigs
from ..core.declare import is_owner
from ..core.interface.overlay import Batch, Overlay
from ..core.lazy import numpy as np
from . import mask, panel
from .setup import system

FULL_COLOR = (1.0, 0.62, 0.12, 0.95)
FAINT_COLOR = (0.35, 0.45, 0.85, 0.45)
WIDTH = 2.0  # pixels
GIRTH, AT = 0.115, 0.1
"""Half of the outline's width, just around Blender's octahedral bone, and the place where it is widest: as shares of the bone's length."""


def _batches_of(context, owner):
    """List the Batches to draw for a rig with layers; [] for any different object."""
    if owner.type != 'ARMATURE' or not is_owner(system(), owner):
        return []
    entry = panel.active_entry(owner)
    if entry is None or entry.is_muted or not entry.mask:
        return []
    rig = owner.evaluated_get(context.evaluated_depsgraph_get())
    names = rigs.names_of(rig)
    chosen = mask.chosen(owner, entry, {name: row for row, name in enumerate(names)})
    weights = native.module.layer_mask(rigs.parents(rig, names), chosen, entry.feather)
    rows = [row for row in np.flatnonzero(weights) if not rig.data.bones[names[row]].hide]
    if not rows:
        return []
    outline = _outline()
    points = np.concatenate([_placed(outline, rig.matrix_world, rig.pose.bones[names[row]]) for row in rows])
    faint, full = np.array(FAINT_COLOR, np.float32), np.array(FULL_COLOR, np.float32)
    colors = faint + weights[rows].astype(np.float32)[:, None] * (full - faint)
    return [Batch('LINES', points, np.repeat(colors, len(outline), axis=0), WIDTH)]


def _outline():
    """Return the 12 edges of an octahedron along Y with length 1, as (24, 3): pairs of end points."""
    head, tail = (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    ring = [(x, AT, z) for x, z in ((GIRTH, GIRTH), (-GIRTH, GIRTH), (-GIRTH, -GIRTH), (GIRTH, -GIRTH))]
    edges = [edge for one, following in zip(ring, (*ring[1:], ring[0])) for edge in ((head, one), (one, following), (one, tail))]
    return np.array([point for edge in edges for point in edge])


def _placed(outline, world, bone):
    matrix = np.array(world @ bone.matrix)
    return (bone.bone.length * outline @ matrix[:3, :3].T + matrix[:3, 3]).astype(np.float32)


overlay = Overlay(_batches_of)
