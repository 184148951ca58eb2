"""The wooden pilot's head: an egg with eyes that can look, lids, a smile, and a leather cap with goggles."""

import math

import numpy as np

from ..stage import shapes
from . import parts, skeleton

CENTRE = np.array((0.0, -0.004, 1.606))
RADII = np.array((0.124, 0.130, 0.150))
CHIN = 0.13  # how much narrower the head is at its lower end
EYE_RADIUS = 0.040
IRIS_ANGLE, PUPIL_ANGLE = math.radians(33.0), math.radians(17.0)
LID_THICKNESS = 0.0022
LID_ANGLE = math.radians(84.0)  # half the opening of an upper lid
LID_TILT = math.radians(27.0)  # angle of the lid's middle, tilted back from straight up
CAP_TILT = math.radians(33.0)  # angle of the cap's middle, tilted back from straight up
CAP_ANGLE = math.radians(81.0)
CAP_GROWTH = 1.055  # the cap's radii, in head radii


def add(body):
    """Add the head, the cap, the goggles, the features and the eyes to the pilot's body."""
    body.add(_egg(), "head", parts.WOOD)
    _add_cap(body)
    _add_goggles(body)
    _add_features(body)
    for side, sign in (("L", 1.0), ("R", -1.0)):
        _add_eye(body, side)
        ear = CENTRE + (sign * 0.126, 0.022, -0.006)
        body.add(shapes.sphere(0.040, ear, (0.42, 1.0, 1.15), 28, 18), "head", parts.LEATHER)
        body.add(shapes.sphere(0.014, ear + (sign * 0.014, 0.0, 0.0), (0.5, 1.0, 1.0)), "head", parts.BRASS)


def _narrowing(z):
    """Return the factor of the head's width at heights z, in head radii from the middle."""
    return 1.0 + CHIN * np.clip(z, -1.0, 0.35)


def _egg():
    profile = [(math.sin(a), math.cos(a)) for a in np.linspace(1e-3, math.pi - 1e-3, 40)]
    vertices, faces = shapes.upright(shapes.lathe(profile, 56))
    return _on_head(vertices), faces


def _on_head(directions, growth=1.0):
    """Convert unit directions to points on the head's surface, enlarged by the factor `growth`."""
    directions = np.asarray(directions, dtype=float)
    narrow = _narrowing(directions[..., 2:3])
    scale = np.concatenate((narrow, narrow, np.ones_like(narrow)), axis=-1)
    return CENTRE + RADII * growth * directions * scale


def _front(x, z, lift=0.0):
    """Return the points of the face at x and z, `lift` metres in front of the surface."""
    unit_z = (z - CENTRE[2]) / RADII[2]
    unit_x = x / (RADII[0] * _narrowing(unit_z))
    unit_y = -np.sqrt(np.maximum(1.0 - unit_x**2 - unit_z**2, 0.0))
    y = CENTRE[1] + RADII[1] * _narrowing(unit_z) * unit_y - lift
    return np.stack(np.broadcast_arrays(x, y, z), axis=-1)


def _tilted(vertices, angle):
    """Rotate vertices about X by an angle in radians, so that the top tilts back."""
    cos, sin = math.cos(angle), math.sin(angle)
    return np.asarray(vertices) @ np.array(((1.0, 0.0, 0.0), (0.0, cos, -sin), (0.0, sin, cos)))


def _cap_ring(polar, count=72):
    """Return `count` unit directions at the angle `polar` from the cap's middle, all around it."""
    angle = shapes.ring(count)
    ring = np.stack((math.sin(polar) * np.cos(angle), math.sin(polar) * np.sin(angle), np.full(count, math.cos(polar))), axis=-1)
    return _tilted(ring, CAP_TILT)


# --- features --------------------------------------------------------------------------------------------------------


def _add_eye(body, side):
    """Add an eyeball in three colours, and an upper lid that a separate bone moves."""
    polar = np.concatenate(
        (
            np.linspace(1e-3, PUPIL_ANGLE, 6),
            np.linspace(PUPIL_ANGLE, IRIS_ANGLE, 5)[1:],
            np.linspace(IRIS_ANGLE, math.pi - 1e-3, 18)[1:],
        )
    )
    ball = shapes.lathe(np.column_stack((np.sin(polar), np.cos(polar))) * EYE_RADIUS, 36)
    middle = 0.5 * (polar[1:] + polar[:-1])
    slots = np.where(middle < IRIS_ANGLE, parts.IRIS, parts.WHITE)
    slots[middle < PUPIL_ANGLE] = parts.PUPIL
    body.add_local(ball, f"eye.{side}", np.repeat(slots, 36))
    rows = np.linspace(1e-3, LID_ANGLE, 16)
    outer, inner = EYE_RADIUS + LID_THICKNESS, EYE_RADIUS + 0.0006
    radius = np.concatenate((np.full(16, outer), np.full(4, inner)))
    polar = np.concatenate((rows, np.linspace(LID_ANGLE, LID_ANGLE - 0.25, 4)))
    shell = shapes.lathe(np.column_stack((radius * np.sin(polar), radius * np.cos(polar))), 36)
    vertices, faces = shapes.upright(shell)
    vertices = _tilted(vertices, LID_TILT) + skeleton.JOINTS[f"eye.{side}"].head
    body.add((vertices, faces), f"lid.{side}", parts.WOOD)


def _add_features(body):
    """Add nose, smile, cheeks and brows."""
    nose = _front(0.0, 1.566)
    body.add(shapes.sphere(0.022, nose + (0.0, -0.006, 0.0), (0.95, 1.15, 0.95)), "head", parts.BLUSH)
    s = np.linspace(-1.0, 1.0, 25)
    mouth = _front(0.048 * s, 1.504 + 0.026 * s**2, 0.0005)
    body.add(parts.tube(mouth, 0.0036 * np.sqrt(np.maximum(1.02 - s**2, 0.0)) + 0.0012), "head", parts.DARK)
    for sign in (-1.0, 1.0):
        x, z = 0.078 * sign, 1.552
        body.add(_patch(x, z, 0.020), "head", parts.BLUSH)
        brow = _front(sign * (0.056 + 0.030 * s), 1.684 + 0.008 * (1.0 - s**2) - 0.008 * s, 0.002)
        body.add(parts.tube(brow, 0.0052 * np.sqrt(np.maximum(1.03 - s**2, 0.0)) + 0.001), "head", parts.DARK)


def _patch(x, z, radius, rows=6, segments=28):
    """Make a disc that follows the face's surface 1.2 mm in front of it, as if painted on."""
    angle = shapes.ring(segments)
    reach = np.linspace(1.0, 1e-3, rows)[:, None] * radius
    return shapes.loft(_front(x + reach * np.cos(angle), z + reach * np.sin(angle), 0.0012)[:, ::-1])


# --- cap -------------------------------------------------------------------------------------------------------------


def _add_cap(body):
    polar = np.linspace(1e-3, CAP_ANGLE, 28)
    rows = np.stack([_on_head(_cap_ring(a), CAP_GROWTH) for a in polar])
    body.add(shapes.loft(rows[:, ::-1]), "head", parts.LEATHER)
    rim = _on_head(_cap_ring(CAP_ANGLE), 0.5 * (1.0 + CAP_GROWTH) + 0.012)
    body.add(parts.tube(rim, 0.0085, closed=True), "head", parts.CREAM)
    s = np.linspace(-0.62, 0.80, 40) * math.pi / 2
    ridge = np.stack((np.zeros_like(s), -np.sin(s), np.cos(s)), axis=-1)
    body.add(parts.tube(_on_head(_tilted(ridge, CAP_TILT), CAP_GROWTH + 0.004), 0.006), "head", parts.LEATHER)


def _add_goggles(body):
    """Add goggles that are pushed up on the cap: two brass rings with glass, on a strap."""
    polar = math.radians(52.0)
    band = np.stack(
        [
            _on_head(_cap_ring(math.radians(56.0) + d), CAP_GROWTH + g)
            for d, g in ((-0.085, 0.0), (-0.085, 0.022), (0.085, 0.022), (0.085, 0.0))
        ]
    )
    body.add(shapes.loft(band[:, ::-1]), "head", parts.DARK, smooth=False)
    for sign in (-1.0, 1.0):
        turn = -0.5 * math.pi + sign * 0.46
        out = np.array((math.sin(polar) * math.cos(turn), math.sin(polar) * math.sin(turn), math.cos(polar)))
        out = _tilted(out, CAP_TILT)
        place = _on_head(out, CAP_GROWTH + 0.10)
        normal = out / RADII
        normal /= np.linalg.norm(normal)
        normal = normal * 0.8 + np.array((0.0, -0.5, 0.1))
        _add_goggle(body, place, normal / np.linalg.norm(normal))


def _add_goggle(body, place, normal):
    across = np.cross(normal, (0.0, 0.0, 1.0))
    across /= np.linalg.norm(across)
    turn = np.stack((across, normal, np.cross(across, normal)))
    barrel = ((0.030, -0.030), (0.040, -0.028), (0.042, -0.004), (0.041, 0.006), (0.036, 0.010), (0.032, 0.006))
    vertices, faces = shapes.lathe(np.array(barrel)[::-1], 36)
    body.add((vertices @ turn + place, faces), "head", parts.BRASS)
    vertices, faces = shapes.lathe(((0.001, 0.011), (0.018, 0.009), (0.034, 0.004)), 36)
    body.add((vertices @ turn + place, faces), "head", parts.GLASS)
