"""The mesh of a small vintage aeroplane: nose along +Y, up along +Z, with a wing span of eight metres."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..stage import materials, shapes

SPAN = 8.0
PROPELLER_RADIUS = 0.98
PROPELLER_TURN_PER_FRAME = 2.35  # radians; not a simple fraction of a turn, so that the blades never seem to stand still
PROPELLER_Y = 2.74
RED, CREAM, METAL, DARK = range(4)  # material slots of the body

# Cross-sections of the fuselage from nose to tail: y, half width, half height, height of the middle; in m.
FUSELAGE = (
    (2.30, 0.60, 0.60, 0.00),
    (1.90, 0.605, 0.62, 0.00),
    (1.30, 0.575, 0.63, 0.01),
    (0.60, 0.53, 0.62, 0.03),
    (-0.20, 0.46, 0.56, 0.06),
    (-1.10, 0.34, 0.44, 0.11),
    (-2.00, 0.20, 0.30, 0.17),
    (-2.70, 0.09, 0.185, 0.22),
    (-3.05, 0.015, 0.06, 0.25),
)
FUSELAGE_SQUARENESS = 2.35  # exponent of the superellipse: 2 is an ellipse
# Profile (radius, y) of the engine cowling in m: from the inside at the engine over the lip to the rear edge.
COWL = (
    (0.10, 2.34),
    (0.44, 2.36),
    (0.46, 2.50),
    (0.49, 2.58),
    (0.545, 2.62),
    (0.60, 2.58),
    (0.645, 2.46),
    (0.67, 2.25),
    (0.67, 1.95),
    (0.645, 1.72),
    (0.60, 1.66),
)
SPINNER = ((0.002, 3.04), (0.07, 3.0), (0.13, 2.9), (0.17, 2.76), (0.185, 2.62), (0.185, 2.36))
TYRE = ((0.02, 0.075), (0.2, 0.075), (0.24, 0.03), (0.24, -0.03), (0.2, -0.075), (0.02, -0.075))


def build(collection, last_frame=None):
    """Make the aeroplane's objects: the body, and canopy, pilot and propeller as children of the body. Returns the body.

    last_frame: from this frame on the propeller stands still; if None, it never stops.
    """
    body = shapes.link_object(collection, "Aeroplane", _body_mesh())
    shapes.link_object(collection, "Canopy", _canopy_mesh(), parent=body)
    shapes.link_object(collection, "Pilot", _pilot_mesh(), parent=body)
    propeller = shapes.link_object(collection, "Propeller", _propeller_mesh(), parent=body)
    propeller.location.y = PROPELLER_Y
    spin = propeller.driver_add("rotation_euler", 1).driver
    spin.expression = f"{'frame' if last_frame is None else f'min(frame, {last_frame})'} * {PROPELLER_TURN_PER_FRAME}"
    disc = shapes.link_object(collection, "Propeller Disc", _disc_mesh(), parent=body)
    disc.location.y = PROPELLER_Y
    return body


# --- body ------------------------------------------------------------------------------------------------------------


def _body_mesh():
    builder = shapes.MeshBuilder()
    _add_fuselage(builder)
    builder.add(shapes.lathe(shapes.smooth_profile_points(COWL, 40), 48), _cowl_slots(40, 48))
    _add_surface(builder, WING)
    _add_surface(builder, TAILPLANE)
    _add_fin(builder)
    for side in (-1.0, 1.0):
        _add_wheel(builder, side)
    return builder.build("Aeroplane", _body_materials())


def _body_materials():
    return [
        materials.principled("Racing Red", color=(0.58, 0.022, 0.016), roughness=0.32, coat=0.8, coat_roughness=0.06),
        materials.principled("Cream", color=(0.86, 0.77, 0.60), roughness=0.35, coat=0.6, coat_roughness=0.08),
        materials.principled("Polished Metal", color=(0.86, 0.82, 0.76), metallic=1.0, roughness=0.2),
        materials.principled("Rubber", color=(0.018, 0.017, 0.017), roughness=0.6),
    ]


def _add_fuselage(builder, rows=44, points=40):
    profile = shapes.smooth_profile(FUSELAGE, rows)
    angle = shapes.ring(points)
    power = 2.0 / FUSELAGE_SQUARENESS
    across = np.sign(np.cos(angle)) * np.abs(np.cos(angle)) ** power
    upward = np.sign(np.sin(angle)) * np.abs(np.sin(angle)) ** power
    y, width, tall, middle = (profile[:, i : i + 1] for i in range(4))
    sections = np.stack((width * across, np.broadcast_to(y, (rows, points)), middle + tall * upward), axis=-1)
    # A cream stripe along each side, narrowing towards the tail.
    centre_angle = np.abs(np.abs((angle + math.pi / points + math.pi / 2) % (2 * math.pi) - math.pi) - math.pi / 2)
    flash = np.broadcast_to(centre_angle < 0.27, (rows - 1, points))
    belly = np.broadcast_to(np.sin(angle + math.pi / points) < -0.55, (rows - 1, points))
    builder.add(shapes.loft(sections), np.where(flash | belly, CREAM, RED).ravel())


def _cowl_slots(rows, segments):
    """Material slots of the engine cowling's faces: cream at the lip, dark inside, red for the rest."""
    along = np.arange(rows - 1) / (rows - 1)
    slots = np.where(along < 0.18, DARK, np.where(along < 0.46, CREAM, RED))
    return np.repeat(slots, segments)


# --- wings and tail --------------------------------------------------------------------------------------------------


def _wing_outline(s):
    """Return (chord, y of the leading edge relative to the root's quarter-chord line) at fractions s of the half span."""
    chord = (1.62 - 0.66 * s) * _rounded(s, 0.80)
    return chord, 0.27 * chord - 0.10 * s


def _tail_outline(s):
    chord = (0.92 - 0.34 * s) * _rounded(s, 0.68)
    return chord, 0.45 * chord - 0.08 * s


def _fin_outline(s):
    chord = (1.16 - 0.52 * s) * _rounded(s, 0.62)
    return chord, 0.50 * chord - 0.42 * s


def _rounded(s, start):
    """Return the factor of the chord at fractions s of the half span: 1 up to `start`, then a quarter ellipse down to a narrow tip."""
    u = np.clip((s - start) / (1.0 - start), 0.0, 1.0)
    return np.sqrt(np.maximum(1.0 - u * u, 0.0)) * 0.985 + 0.015


def _airfoil(points=15):
    """Return the wing's section for a chord of 1, from the upper trailing edge around the leading edge to the lower trailing edge.

    Columns: distance behind the leading edge, half thickness with its sign, camber.
    """
    x = 0.5 * (1.0 - np.cos(np.linspace(0.0, math.pi, points)))
    half = 5.0 * (0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    camber = 0.16 * x * (1.0 - x)
    upper = np.column_stack((x, half, camber))[::-1]
    lower = np.column_stack((x, -half, camber))[1:]
    return np.concatenate((upper, lower))


def _surface_sections(outline, span, thickness, rows, both_sides):
    """Return (sections, s) of a lifting surface with its span along X and its chord along Y.

    sections: (rows, points, 3). s: fraction of the half span of each row. both_sides: whether the surface has a left half as well.
    """
    u = np.linspace(-1.0 if both_sides else 0.0, 1.0, rows)
    s = np.sin(0.5 * math.pi * np.abs(u))  # denser towards the tips
    side = np.sign(u)
    chord, lead = outline(s)
    section = _airfoil()
    x = np.broadcast_to((side * s * span)[:, None], (rows, len(section)))
    y = lead[:, None] - chord[:, None] * section[:, 0]
    z = chord[:, None] * (thickness * section[:, 1] + (0.22 * section[:, 2] if both_sides else 0.0))
    return np.stack((x, y, z), axis=-1), s


@dataclass(frozen=True)
class LiftingSurface:
    """Dimensions of a wing or tailplane, which is symmetric."""

    outline: Callable  # chord and leading edge at fractions of the half span
    span: float  # m from tip to tip
    centre: tuple  # of the quarter line at the root, m
    dihedral: float  # rise over run
    thickness: float  # of the section, in chords
    accent: float  # fraction of the half span where the cream tip begins


WING = LiftingSurface(_wing_outline, SPAN, (0.0, 0.95, -0.34), dihedral=0.105, thickness=0.15, accent=0.76)
TAILPLANE = LiftingSurface(_tail_outline, 2.75, (0.0, -2.45, 0.26), dihedral=0.0, thickness=0.10, accent=0.72)


def _add_surface(builder, surface, rows=65):
    sections, s = _surface_sections(surface.outline, surface.span / 2.0, surface.thickness, rows, both_sides=True)
    sections[..., 2] += surface.dihedral * np.abs(sections[..., 0])
    middle = 0.5 * (s[1:] + s[:-1])
    # The tip is cream, with one cream stripe nearer to the middle.
    band = (middle > surface.accent) | ((middle > surface.accent - 0.09) & (middle < surface.accent - 0.045))
    slots = np.repeat(np.where(band, CREAM, RED), sections.shape[1] - 1)
    builder.add(shapes.loft(sections + np.asarray(surface.centre), closed=False), slots)


def _add_fin(builder):
    sections, s = _surface_sections(_fin_outline, 1.32, 0.10, 33, both_sides=False)
    # Stand the surface up: its span along Z, its thickness along X.
    upright = np.stack((-sections[..., 2], sections[..., 1] - 2.32, sections[..., 0] + 0.22), axis=-1)
    middle = 0.5 * (s[1:] + s[:-1])
    slots = np.repeat(np.where(middle > 0.66, CREAM, RED), sections.shape[1] - 1)
    builder.add(shapes.loft(upright, closed=False), slots)


def _add_wheel(builder, side):
    """Add a wheel with a streamlined cover and leg. side: 1 or -1."""
    x = side * 0.98
    builder.add(shapes.sphere(0.3, (x, 1.12, -1.16), (0.5, 1.75, 0.86), 24, 16), RED)
    wheel, faces = shapes.lathe(TYRE, 28)
    builder.add((wheel[:, (1, 0, 2)] + (x, 1.16, -1.29), faces[:, ::-1]), DARK)
    leg = shapes.sphere(1.0, (x, 1.02, -0.72), (0.055, 0.17, 0.52), 16, 12)
    builder.add(leg, CREAM)


# --- canopy, pilot, propeller ----------------------------------------------------------------------------------------


def _canopy_mesh():
    builder = shapes.MeshBuilder()
    builder.add(shapes.sphere(1.0, (0.0, 0.12, 0.50), (0.355, 0.92, 0.46), 36, 22))
    glass = materials.principled("Canopy Glass", color=(0.03, 0.07, 0.09), roughness=0.03, alpha=0.42, coat=1.0, specular=0.9)
    materials.make_transparent(glass)
    return builder.build("Canopy", [glass])


def _pilot_mesh():
    builder = shapes.MeshBuilder()
    builder.add(shapes.sphere(0.135, (0.0, 0.10, 0.69), (0.95, 1.05, 1.1)), 0)
    builder.add(shapes.sphere(0.105, (0.0, 0.155, 0.675), (0.95, 0.85, 1.0)), 1)
    builder.add(shapes.sphere(0.3, (0.0, 0.06, 0.42), (0.85, 0.6, 0.62)), 0)
    leather = materials.principled("Leather", color=(0.16, 0.075, 0.035), roughness=0.55)
    skin = materials.principled("Skin", color=(0.62, 0.36, 0.25), roughness=0.6)
    return builder.build("Pilot", [leather, skin])


def _propeller_mesh():
    builder = shapes.MeshBuilder()
    spinner = np.array(SPINNER)
    spinner[:, 1] -= PROPELLER_Y
    builder.add(shapes.lathe(shapes.smooth_profile_points(spinner, 20), 36), 0)
    for turn in (0.0, math.pi):
        builder.add(_blade(turn), 1)
    metal = materials.principled("Spinner", color=(0.90, 0.86, 0.78), metallic=1.0, roughness=0.14)
    wood = materials.principled("Blade", color=(0.23, 0.105, 0.045), roughness=0.3, coat=1.0)
    return builder.build("Propeller", [metal, wood])


def _blade(turn, rows=18):
    """Make a twisted propeller blade from the hub out to the tip. turn: angle of the blade around the hub, in radians."""
    s = np.linspace(0.08, 1.0, rows)
    chord = (0.10 + 0.16 * np.sin(math.pi * np.minimum(s * 0.95 + 0.1, 1.0)) ** 0.8) * _rounded(s, 0.82)
    pitch = np.arctan2(0.30, s)
    angle = shapes.ring(12)
    along, thick = chord[:, None] * 0.5 * np.cos(angle), chord[:, None] * 0.09 * np.sin(angle)
    x = along * np.cos(pitch)[:, None] - thick * np.sin(pitch)[:, None]
    y = along * np.sin(pitch)[:, None] + thick * np.cos(pitch)[:, None]
    z = np.broadcast_to((s * PROPELLER_RADIUS)[:, None], x.shape)
    sections = np.stack((x * math.cos(turn) - z * math.sin(turn), y, x * math.sin(turn) + z * math.cos(turn)), axis=-1)
    return shapes.loft(sections)


def _disc_mesh():
    """Make the mesh of a faint disc that looks like the shimmer of turning blades."""
    builder = shapes.MeshBuilder()
    builder.add(shapes.lathe(((PROPELLER_RADIUS, 0.0), (0.9 * PROPELLER_RADIUS, 0.001), (0.19, 0.002)), 48))
    shimmer = materials.principled("Propeller Shimmer", color=(0.75, 0.68, 0.58), roughness=0.5, alpha=0.07)
    materials.make_transparent(shimmer)
    return builder.build("Propeller Disc", [shimmer])
