"""Viewport overlay of chains: lines along the bones of each chain that is not muted."""

from ..core.interface.overlay import Batch, Overlay
from ..core.lazy import numpy as np
from . import groups, steps

LINK_COLOR = (0.35, 0.80, 0.75, 0.9)
UNFINISHED_COLOR = (0.5, 0.5, 0.5, 0.6)
"""Of links whose motion is being solved, and which still lie where their former motion has them."""
LINK_WIDTH = 2.0  # pixels


def _batches_of(context, owner):
    """List of Batches to draw for an armature object with chains; empty for any different object."""
    if owner.type != 'ARMATURE' or not owner.motus.chains.is_active:
        return []
    rig = owner.evaluated_get(context.evaluated_depsgraph_get())
    color = LINK_COLOR if steps.done(owner) is None else UNFINISHED_COLOR
    found = []
    for chain in groups.chains(rig):
        if not chain.entry.is_muted:
            ends = [rig.matrix_world @ end for bone in chain.bones for end in (bone.head, bone.tail)]
            found.append(Batch('LINES', np.array(ends, np.float32), color, LINK_WIDTH))
    return found


overlay = Overlay(_batches_of)
