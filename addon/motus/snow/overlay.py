"""Overlay of an emitter in the viewport: the shape in which flakes are born, and the directions in which they leave."""

import math

from ..core.declare import is_owner, registered
from ..core.interface.overlay import Batch, Overlay
from ..core.lazy import numpy as np
from . import handles

COLOR = (0.55, 0.80, 1.0, 0.9)
STEPS = 48
RAYS = 8


def _batches(context, obj):
    if not is_owner(registered["snow"], obj) or obj.motus.snow.shape in {'SURFACE', 'CAMERA'}:
        return []
    settings = obj.motus.snow
    matrix = np.array(obj.evaluated_get(context.evaluated_depsgraph_get()).matrix_world)
    lines = np.concatenate([_lines(settings), _arrow(settings), *([_rays(settings)] if handles.leans(settings) else [])])
    points = lines @ matrix[:3, :3].T + matrix[:3, 3]
    return [Batch('LINES', points.astype(np.float32), COLOR, 1.5)]


def _lines(settings):
    """Ends of the line segments (2n, 3) of the shape in which flakes are born, in the emitter's space."""
    radius = settings.emitter_radius
    if settings.shape == 'SQUARE':
        return radius * _square(0.0)
    if settings.shape == 'BOX':
        corners = [(x, y) for x in (-1.0, 1.0) for y in (-1.0, 1.0)]
        posts = np.array([(x, y, z) for x, y in corners for z in (-1.0, 1.0)])
        return radius * np.concatenate([_square(-1.0), _square(1.0), posts])
    circle = radius * _circle()
    if settings.shape == 'SPHERE':
        return np.concatenate([circle, circle[:, (0, 2, 1)], circle[:, (2, 0, 1)]])
    return circle


def _square(z):
    corners = [(-1.0, -1.0, z), (1.0, -1.0, z), (1.0, 1.0, z), (-1.0, 1.0, z)]
    return np.array([one for pair in zip(corners, corners[1:] + corners[:1]) for one in pair])


def _circle():
    angles = np.linspace(0.0, 2.0 * math.pi, STEPS + 1)
    points = np.column_stack((np.cos(angles), np.sin(angles), np.zeros(STEPS + 1)))
    return np.repeat(points, 2, axis=0)[1:-1]


def _rays(settings):
    """Ends of line segments (2 * RAYS, 3) that show the largest angle at which flakes leave the edge, in the emitter's space."""
    ends = np.array(handles.ray(settings))
    turns = np.arange(RAYS) * 2.0 * math.pi / RAYS
    across = ends[None, :, :1] * np.stack((np.cos(turns), np.sin(turns)), axis=1)[:, None, :]
    return np.concatenate((across, np.broadcast_to(ends[:, 2:], (RAYS, 2, 1))), axis=2).reshape(-1, 3)


def _arrow(settings):
    """Ends of the line segments (6, 3) of an arrow from the emitter's middle: the way of a flake in handles.SECONDS."""
    length = handles.SECONDS * settings.start_speed
    head = 0.15 * length
    tip = (0.0, 0.0, length)
    return np.array([(0.0, 0.0, 0.0), tip, tip, (head, 0.0, length - head), tip, (-head, 0.0, length - head)])


overlay = Overlay(_batches)
