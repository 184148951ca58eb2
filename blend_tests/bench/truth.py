"""Independent truth for positions on a cubic Bézier by arc length: dense Gauss-Legendre quadrature and Newton, in NumPy."""

import numpy as np

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)
_PANELS = 64


def position(points, t):
    """Position of the cubic with control points (4, 3) at t (m,)."""
    a, b, c, d = points
    t = np.asarray(t, float)[:, None]
    u = 1.0 - t
    return u**3 * a + 3 * u**2 * t * b + 3 * u * t**2 * c + t**3 * d


def _speed(points, t):
    a, b, c, d = points
    t = np.asarray(t, float)[..., None]
    u = 1.0 - t
    return np.linalg.norm(3 * u**2 * (b - a) + 6 * u * t * (c - b) + 3 * t**2 * (d - c), axis=-1)


def length_to(points, t):
    """Length from 0 to each t (m,)."""
    t = np.asarray(t, float)
    edges = np.linspace(0.0, 1.0, _PANELS + 1)[None, :] * t[:, None]
    middle, half = (edges[:, 1:] + edges[:, :-1]) / 2, (edges[:, 1:] - edges[:, :-1]) / 2
    nodes = middle[..., None] + half[..., None] * _NODES
    return (_speed(points, nodes) @ _WEIGHTS * half).sum(axis=1)


def positions_at_fractions(points, fractions):
    """Exact positions at fractions of the length, and the length."""
    points = np.asarray(points, float)
    total = float(length_to(points, np.array([1.0]))[0])
    goal = np.asarray(fractions, float) * total
    low, high = np.zeros_like(goal), np.ones_like(goal)
    t = np.asarray(fractions, float).copy()
    for _ in range(60):
        excess = length_to(points, t) - goal
        low, high = np.where(excess < 0, t, low), np.where(excess < 0, high, t)
        with np.errstate(divide='ignore', invalid='ignore'):
            step = t - excess / _speed(points, t)
        t = np.where((step > low) & (step < high), step, (low + high) / 2)
        if np.max(np.abs(excess)) < 1e-14 * total:
            break
    return position(points, t), total
