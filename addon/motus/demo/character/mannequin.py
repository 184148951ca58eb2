"""The wooden pilot's body: one mesh of many parts, each of which moves with one bone."""

import math

import numpy as np

from ..stage import materials, shapes
from . import face, limbs, parts

GRAIN = (22.0, 14.0, 3.0)  # repetitions of the wood's grain along X, Y and Z
# Profiles (radius, height) in m, turned about the body's upright axis.
CHEST = (
    (0.004, 1.442),
    (0.050, 1.440),
    (0.092, 1.428),
    (0.130, 1.400),
    (0.158, 1.350),
    (0.163, 1.300),
    (0.150, 1.240),
    (0.126, 1.190),
    (0.112, 1.165),
    (0.090, 1.152),
    (0.004, 1.150),
)
PELVIS = (
    (0.004, 1.010),
    (0.085, 1.008),
    (0.112, 0.995),
    (0.126, 0.965),
    (0.140, 0.915),
    (0.136, 0.870),
    (0.105, 0.835),
    (0.060, 0.822),
    (0.004, 0.820),
)
NECK = ((0.004, 1.50), (0.046, 1.49), (0.048, 1.45), (0.052, 1.41), (0.004, 1.40))
CHEST_DEPTH, PELVIS_DEPTH = 0.72, 0.78
BUTTONS = (1.345, 1.290, 1.235)  # heights of the buttons, m


def build(collection, rig):
    """Make the pilot's whole body and skin it to the rig. Returns the mesh object."""
    body = parts.Body()
    _add_torso(body)
    _add_scarf(body)
    face.add(body)
    for side in ("L", "R"):
        limbs.add(body, side)
    return body.finish(collection, rig, _materials())


# --- torso -----------------------------------------------------------------------------------------------------------


def _add_torso(body):
    body.add(parts.turned(CHEST, depth=CHEST_DEPTH), "spine.003", parts.JACKET)
    body.add(shapes.sphere(0.110, (0.0, 0.0, 1.130), (1.0, 0.80, 0.72), 36, 22), "spine.002", parts.DARK)
    body.add(shapes.sphere(0.106, (0.0, 0.0, 1.045), (1.0, 0.80, 0.66), 36, 22), "spine.001", parts.WOOD)
    body.add(parts.turned(PELVIS, depth=PELVIS_DEPTH), "pelvis", parts.CREAM)
    belt = shapes.upright(shapes.torus(0.117, 0.014, 48, 12), (0.0, 0.0, 0.980), PELVIS_DEPTH)
    body.add(belt, "pelvis", parts.LEATHER)
    body.add(shapes.box((0.040, 0.012, 0.030), (0.0, -0.103, 0.980)), "pelvis", parts.BRASS, smooth=False)
    radii, heights = np.array(CHEST)[::-1].T
    for height in BUTTONS:
        depth = CHEST_DEPTH * np.interp(height, heights, radii)
        button = shapes.sphere(0.011, (0.0, -depth - 0.001, height), (1.0, 0.55, 1.0), 16, 10)
        body.add(button, "spine.003", parts.BRASS)
    body.add(parts.turned(NECK), "neck", parts.DARK)


def _add_scarf(body):
    """Add a scarf around the neck, with two ends that hang over the left side of the chest."""
    angle = shapes.ring(72)
    ridges = 0.0045 * np.sin(9.0 * angle) + 0.003 * np.sin(14.0 * angle + 1.0)
    around = np.stack(((0.071 + ridges) * np.cos(angle), (0.068 + ridges) * np.sin(angle), 1.440 - 0.012 * np.sin(angle)), axis=-1)
    body.add(parts.tube(around, 0.029 + 0.3 * ridges, closed=True), "spine.003", parts.SCARF)
    body.add(shapes.sphere(0.034, (0.052, -0.092, 1.412), (1.0, 0.8, 0.9)), "spine.003", parts.SCARF)
    for fall, drift, out in ((0.205, 0.035, 0.0), (0.165, -0.012, 0.012)):
        s = np.linspace(0.0, 1.0, 20)
        x = 0.052 + drift * s + 0.006 * np.sin(5.0 * s)
        z = 1.405 - fall * s
        y = -0.100 - out - 0.036 * np.sin(math.pi * np.minimum(s * 1.4, 1.0) * 0.5)
        body.add(parts.ribbon(np.stack((x, y, z), axis=-1), 0.018 + 0.016 * s, 0.0065), "spine.003", parts.SCARF)


# --- materials -------------------------------------------------------------------------------------------------------


def _materials():
    return [
        materials.wood("Maple", (0.56, 0.290, 0.108), (0.475, 0.225, 0.078), GRAIN, on_skin=True),
        materials.wood("Walnut", (0.155, 0.066, 0.028), (0.085, 0.034, 0.015), GRAIN, on_skin=True),
        materials.principled("Jacket Paint", color=(0.012, 0.105, 0.135), roughness=0.42, coat=0.4, coat_roughness=0.2),
        materials.principled("Cream Paint", color=(0.62, 0.50, 0.33), roughness=0.55, specular=0.3),
        materials.principled("Scarf", color=(0.62, 0.028, 0.018), roughness=0.85, specular=0.15),
        materials.principled("Boot Paint", color=(0.42, 0.022, 0.016), roughness=0.35, coat=0.6, coat_roughness=0.12),
        materials.principled("Cap Leather", color=(0.165, 0.070, 0.030), roughness=0.5, specular=0.4),
        materials.principled("Brass", color=(0.86, 0.58, 0.22), metallic=1.0, roughness=0.24),
        materials.principled("Eye White", color=(0.90, 0.87, 0.80), roughness=0.12, coat=1.0, coat_roughness=0.03),
        materials.principled("Iris", color=(0.03, 0.19, 0.24), roughness=0.10, coat=1.0, coat_roughness=0.03),
        materials.principled("Pupil", color=(0.008, 0.007, 0.007), roughness=0.06, coat=1.0, coat_roughness=0.02),
        materials.principled("Blush", color=(0.74, 0.20, 0.10), roughness=0.6),
        materials.principled("Goggle Glass", color=(0.10, 0.22, 0.25), roughness=0.05, coat=1.0, specular=0.9),
    ]
