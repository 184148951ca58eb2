"""Viewport overlay of chains: lines along the links of each chain that is not muted."""

from ..core.interface.overlay import Batch, Overlay
from ..core.lazy import numpy as np
from . import groups

LINK_COLOR = (0.35, 0.80, 0.75, 0.9)
LINK_WIDTH = 2.0  # pixels


def _batches_of(context, owner):
    """List of Batches to draw for an object with chains; empty for any different object."""
    if not owner.motus.chains.is_active:
        return []
    shown = owner.evaluated_get(context.evaluated_depsgraph_get())
    ends = (chain.ends for chain in groups.chains(shown) if not chain.entry.is_muted)
    return [Batch('LINES', np.array(one, np.float32), LINK_COLOR, LINK_WIDTH) for one in ends]


overlay = Overlay(_batches_of)
