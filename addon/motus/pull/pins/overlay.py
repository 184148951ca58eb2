"""Viewport overlay of pins, in addition to their handles.

Draws the path of each vertex that a pin pulls, and a note that pins have no effect in Edit Mode.
"""

from ...core.declare import Problem
from ...core.interface.overlay import Batch, Overlay
from ...core.lazy import numpy as np
from . import handles

RESTING = Problem("Pins rest in Edit Mode: the mesh is shown without them", blocking=False)
WAY_COLOR = (1.0, 0.72, 0.4, 0.9)


def _batches(context, owner):
    if owner.type != 'MESH' or not owner.motus.pull.is_active or owner.mode != 'OBJECT':
        return []
    shown = handles.read(owner, context.evaluated_depsgraph_get())
    ways = np.stack([shown.starts[shown.acts], shown.places[shown.acts]], axis=1).reshape(-1, 3)
    return [Batch('LINES', ways.astype(np.float32), WAY_COLOR, 1.5)] if len(ways) else []


def _note(_context, owner):
    is_resting = owner.type == 'MESH' and owner.mode == 'EDIT' and owner.motus.pull.is_active
    return RESTING.sentence if is_resting else ""


overlay = Overlay(_batches, note=_note)
