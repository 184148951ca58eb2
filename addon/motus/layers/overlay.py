"""What the viewport shows of the active layer: the bones of its mask, the brighter the more of it they take."""

from ..core import native, rigs
from ..core.lazy import numpy as np
from ..core.overlay import Batch, Overlay
from . import mask, panel

FULL_COLOR = np.array((1.0, 0.62, 0.12, 0.95), np.float32)
FAINT_COLOR = np.array((0.35, 0.45, 0.75, 0.35), np.float32)
WIDTH = 4.0  # pixels


def _batches_of(context, owner):
    """Batches for a rig with layers; none for other objects."""
    if owner.type != 'ARMATURE' or not owner.motus.layers.is_active:
        return []
    entry = panel.active_entry(owner)
    if entry is None or entry.is_muted or not entry.mask:
        return []
    rig = owner.evaluated_get(context.evaluated_depsgraph_get())
    names = rigs.names_of(rig)
    chosen = mask.chosen(owner, entry, {name: row for row, name in enumerate(names)})
    weights = native.module.layer_mask(rigs.parents(rig, names), chosen, entry.feather)
    rows = np.flatnonzero(weights)
    if len(rows) == 0:
        return []
    shares = weights[rows].astype(np.float32)[:, None]
    world = rig.matrix_world
    points = [tuple(world @ end) for row in rows for end in (rig.pose.bones[row].head, rig.pose.bones[row].tail)]
    colors = FAINT_COLOR + shares * (FULL_COLOR - FAINT_COLOR)
    return [Batch('LINES', np.array(points, np.float32), np.repeat(colors, 2, axis=0), WIDTH)]


overlay = Overlay(_batches_of)
