"""Overlay of a walker in the viewport: footholds, the ways of the feet between footholds, and the rest position of each foot."""

import math

from ..core.declare import Problem, is_owner, leader_of, registered
from ..core.file.choices import chosen
from ..core.interface.overlay import Batch, Overlay, Switch
from ..core.lazy import numpy as np
from ..core.measures import axes, scene_time
from . import told
from .carrier import Carried

LEFT_COLOR, RIGHT_COLOR = (0.35, 0.80, 1.0, 0.9), (1.0, 0.65, 0.25, 0.9)
REST_COLOR = (0.85, 0.85, 0.90, 0.5)
FAINT = 0.35
"""Opacity of the line of a foot's way, as a share of the opacity of the foothold that it leads to."""
SECONDS = 4.0
"""Seconds before and after the present frame within which footholds are drawn."""
SIDES = 12
SIZE = 0.12
"""Radius of a drawn foothold, as a share of the stride."""
TINY = 1e-30
"""Smallest length that is divided by, so that the rings of a body that is scaled to nothing are points."""


def _batches(context, obj):
    walker = registered["walker"]
    owner = obj if is_owner(walker, obj) else leader_of(walker, obj)
    if owner is None or not is_owner(walker, owner):
        return []
    planned = told.found(context, owner)
    if isinstance(planned, Problem):
        return []
    evaluated = owner.evaluated_get(context.evaluated_depsgraph_get())
    now = scene_time.seconds(context.scene, scene_time.present(context.scene))
    shown, found = context.scene.motus, []
    scale = evaluated.matrix_world.median_scale
    size = SIZE * scale * owner.motus.walker.stride
    if shown.show_walker_footholds:
        found += _of_steps(planned.walker, now, size, is_left(owner))
    if shown.show_walker_rests:
        matrix = np.array(evaluated.matrix_world)
        up = matrix[:3, :3] @ axes.vector(owner.motus.walker.up_axis)
        rings = _rings(_rests(owner) @ matrix[:3, :3].T + matrix[:3, 3], up[None], 0.7 * size)
        found.append(Batch('LINES', rings.reshape(-1, 3).astype(np.float32), REST_COLOR))
    return found


def _rests(owner):
    return np.array([tuple(leg.rest) for leg in owner.motus.walker.legs])


def is_left(owner):
    """Whether each leg is on the left side of the body, (n,) bool: left of the middle of all rest positions, as the gaits count."""
    settings = owner.motus.walker
    across = _rests(owner) @ np.cross(axes.vector(chosen(settings, "forward_axis")), axes.vector(chosen(settings, "up_axis")))
    return across < 0.5 * (across.min() + across.max())


def _of_steps(walker, now, size, is_left):
    steps = walker.steps_at(now) if isinstance(walker, Carried) else walker.steps
    near = np.flatnonzero((steps["touch"] > now - SECONDS) & (steps["lift"] < now + SECONDS))
    if len(near) == 0:
        return []
    legs = steps["leg"][near]
    left, normals = is_left[legs], walker.normals(steps["touch"][near])[np.arange(len(near)), legs]
    found = []
    for which, color in ((left, LEFT_COLOR), (~left, RIGHT_COLOR)):
        rows = near[which]
        if len(rows) == 0:
            continue
        rings = _rings(steps["end"][rows], normals[which], size)
        ways = np.stack([steps["start"][rows], steps["apex"][rows], steps["apex"][rows], steps["end"][rows]], axis=1)
        found.append(Batch('LINES', rings.reshape(-1, 3).astype(np.float32), color, 2.0))
        found.append(Batch('LINES', ways.reshape(-1, 3).astype(np.float32), (*color[:3], FAINT * color[3])))
    return found


def _rings(middles, normals, radius):
    """Ends of the line segments of rings, (n, 2 * SIDES, 3). middles: (n, 3). normals: (n, 3), of any length. radius: of all rings."""
    angles = np.repeat(np.arange(SIDES + 1) * 2.0 * math.pi / SIDES, 2)[1:-1, None]
    aside = np.cross(normals, np.where(np.abs(normals).argmax(axis=1)[:, None] == 0, (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)))
    sides = [part / np.maximum(np.linalg.norm(part, axis=1, keepdims=True), TINY) for part in (aside, np.cross(normals, aside))]
    return middles[:, None, :] + radius * (np.cos(angles) * sides[0][:, None, :] + np.sin(angles) * sides[1][:, None, :])


overlay = Overlay(
    _batches,
    (
        Switch("show_walker_footholds", "Footholds", "Draw where feet stand, and how they come there, around the present frame"),
        Switch(
            "show_walker_times",
            "Step Times",
            "Draw a chart of when the feet of the active walker stand; the ends of its bars are dragged",
            False,
        ),
        Switch("show_walker_rests", "Rest Positions", "Draw the rest position of each foot below the body", False),
    ),
)
