"""Overlay of a pendulum in the viewport: the path of its end bob around the present time."""

from ..core.interface.overlay import Batch, Overlay
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from . import clock, directions, parts, solve

SECONDS = 4.0  # of the pendulum's own time, before and after the present moment
STEPS = 480
COLOR = (0.98, 0.80, 0.25, 0.9)


def _batches(context, obj):
    """List the Batches that draw the path of the first pendulum's end bob around the present frame; [] if it cannot be computed."""
    pivot = parts.pivot_of(obj)
    if pivot is None:
        return []
    depsgraph = context.evaluated_depsgraph_get()
    evaluated = pivot.evaluated_get(depsgraph)
    settings, scene = evaluated.motus.pendulum, context.scene
    swing = solve.swing_of(settings, scene)
    if settings.use_pivot_motion or not hasattr(swing, "at"):
        return []
    fps = scene_time.fps(scene)
    now = clock.read(evaluated, settings, scene_time.present(scene), fps).seconds
    try:
        states = swing.way(np.linspace(max(0.0, now - SECONDS), now + SECONDS, STEPS))
    except ValueError:
        return []
    points = directions.ends(swing, states, parts.lengths(settings))
    world = np.array(evaluated.matrix_world)
    points = points @ world[:3, :3].T + world[:3, 3]
    return [Batch('LINE_STRIP', points.astype(np.float32), COLOR, 1.5)]


overlay = Overlay(_batches)
