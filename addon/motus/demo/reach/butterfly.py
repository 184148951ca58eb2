"""The paper butterfly for which the pilot reaches: two pairs of painted wings that beat, and a course around the pilot."""

import math

import bpy
import numpy as np

from ..stage import materials, shapes

# Outlines of a right fore wing and a right hind wing: x outwards, y ahead; m.
FORE_WING = (
    (0.004, 0.012),
    (0.030, 0.052),
    (0.068, 0.084),
    (0.102, 0.088),
    (0.108, 0.062),
    (0.092, 0.022),
    (0.062, -0.002),
    (0.004, -0.012),
)
HIND_WING = (
    (0.004, -0.002),
    (0.052, 0.000),
    (0.080, -0.022),
    (0.078, -0.052),
    (0.056, -0.078),
    (0.034, -0.066),
    (0.016, -0.040),
    (0.004, -0.020),
)
RIM, COLOR, HEART = range(3)
BAND_EDGES = (1.0, 0.93, 0.86, 0.62, 0.60, 0.35, 0.02)  # fractions of the distance from a wing's root to its outline
BEATS = 40  # wing beats in a cycle of the scene: a whole number, so that the loop closes
BEAT_MIDDLE, BEAT_SWING = math.radians(30.0), math.radians(46.0)


def build(collection, carrier, cycle):
    """Add a butterfly, nose along +Y, as a child of the object that carries it along its path. Returns the body's object.

    cycle: length of the animation's loop in frames, which holds a whole number of wing beats.
    """
    body = shapes.link_object(collection, "Butterfly Body", _body_mesh(), carrier)
    mesh = _wing_mesh()
    for side, sign in (("Left", -1.0), ("Right", 1.0)):
        wing = shapes.link_object(collection, f"{side} Wing", mesh, body)
        wing.scale.x = sign
        beat = wing.driver_add("rotation_euler", 1).driver
        angle = f"{BEAT_MIDDLE:.4f} + {BEAT_SWING:.4f} * sin({2.0 * math.pi * BEATS / cycle:.10f} * (frame - 1))"
        beat.expression = f"{-sign:.0f} * ({angle})"
    return body


def _smooth_outline(points, count=64):
    """Return `count` points of a closed Catmull-Rom curve through the points, which are counter-clockwise seen from above."""
    points = np.asarray(points, dtype=float)
    step = np.linspace(0.0, len(points), count, endpoint=False)
    index, t = step.astype(int), (step % 1.0)[:, None]
    p0, p1, p2, p3 = (points[(index + k) % len(points)] for k in (-1, 0, 1, 2))
    curve = 0.5 * (2 * p1 + (p2 - p0) * t + (2 * p0 - 5 * p1 + 4 * p2 - p3) * t**2 + (3 * p1 - p0 - 3 * p2 + p3) * t**3)
    return curve[::-1]


def _add_wing(builder, outline, root, lift, color, heart):
    """Add a wing: a slightly cupped sheet in three bands. color, heart: material slots of the two bands inside the dark rim."""
    rim = _smooth_outline(outline)
    flat = root + np.array(BAND_EDGES)[:, None, None] * (rim - root)
    cup = lift + 0.5 * flat[..., :1] ** 2
    slots = (RIM, RIM, color, color, heart, heart)
    builder.add(shapes.loft(np.concatenate((flat, cup), axis=-1)), np.repeat(slots, len(rim)))


def _wing_mesh():
    builder = shapes.MeshBuilder()
    _add_wing(builder, HIND_WING, np.array((0.030, -0.022)), 0.0, HEART, COLOR)
    _add_wing(builder, FORE_WING, np.array((0.034, 0.020)), 0.0015, COLOR, HEART)
    return builder.build(
        "Butterfly Wing",
        [
            _paper("Wing Rim", (0.030, 0.012, 0.010)),
            _paper("Wing Orange", (0.86, 0.15, 0.008)),
            _paper("Wing Gold", (0.93, 0.42, 0.03)),
        ],
    )


def _paper(name, color):
    """Make a material of paper through which the sun shines."""
    material, shader, output = materials.new_material(name)
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=color, roughness=0.6, specular=0.2)
    glow = shader.add("ShaderNodeEmission", {"Color": (*color, 1.0), "Strength": 0.35})
    mixed = shader.add("ShaderNodeAddShader", {0: node.outputs[0], 1: glow.outputs[0]})
    materials.finish(material, shader, output, mixed.outputs[0])
    material.diffuse_color = (*color, 1.0)
    return material


def _body_mesh():
    builder = shapes.MeshBuilder()
    builder.add(shapes.sphere(1.0, (0.0, -0.006, 0.0), (0.0065, 0.040, 0.0065), 16, 12))
    builder.add(shapes.sphere(0.0085, (0.0, 0.036, 0.001), segments=16, rings=10))
    for sign in (-1.0, 1.0):
        s = np.linspace(0.0, 1.0, 12)
        line = np.stack((sign * (0.003 + 0.020 * s), 0.040 + 0.034 * s, 0.004 + 0.016 * s**2), axis=-1)
        for place in line:
            builder.add(shapes.sphere(0.0016, place, segments=8, rings=6))
        builder.add(shapes.sphere(0.0032, line[-1], segments=10, rings=8))
    return builder.build("Butterfly Body", [materials.principled("Butterfly Felt", color=(0.028, 0.014, 0.012), roughness=0.7)])


def add_course(collection, stage, knots):
    """Add a closed smooth Bézier curve through the knots as a course. It has no surface, so it is not rendered."""
    data = bpy.data.curves.new("Butterfly Course", "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new("BEZIER")
    spline.bezier_points.add(len(knots) - 1)
    for point, knot in zip(spline.bezier_points, knots):
        point.co = knot
        point.handle_left_type = point.handle_right_type = "AUTO"
    spline.use_cyclic_u = True
    return shapes.link_object(collection, "Butterfly Course", data, stage)
