"""What the viewport shows of the active layer: the bones of its mask in outline, the brighter the more of it they take."""

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
"""Of a bone's length: half of the width of the outline, just around Blender's octahedron, and where it is widest."""


def _batches_of(context, owner):
    """Batches for a rig with layers; none for other objects."""
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
    """Edges of an octahedron along Y, one long: (24, 3), in pairs."""
    head, tail = (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    ring = [(x, AT, z) for x, z in ((GIRTH, GIRTH), (-GIRTH, GIRTH), (-GIRTH, -GIRTH), (GIRTH, -GIRTH))]
    edges = [edge for one, following in zip(ring, (*ring[1:], ring[0])) for edge in ((head, one), (one, following), (one, tail))]
    return np.array([point for edge in edges for point in edge])


def _placed(outline, world, bone):
    matrix = np.array(world @ bone.matrix)
    return (bone.bone.length * outline @ matrix[:3, :3].T + matrix[:3, 3]).astype(np.float32)


overlay = Overlay(_batches_of)
