"""The pictures of the Inverse Kinematics page, made through the add-on's own operators."""

import math

import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

import ik_arm
import look_at_figure as figure
import stage
import support

# Position and rotation weight of each arm, row by row.
ROWS = (((0.0, 0.0), (0.5, 0.0), (1.0, 0.0)), ((1.0, 0.0), (1.0, 0.5), (1.0, 1.0)))
CELL = Vector((1.13, 0.0, 1.07))
WALL_Y = 0.13
SHOULDER = Vector((-0.37, 0.0, 0.36))  # from the middle of a cell
TARGET = Vector((0.33, 0.0, 0.24))
# Its Y axis points down to the right along the wall, Z up to the right, and X to the camera and a little aside.
TARGET_TURN = (
    Euler((math.radians(90), 0.0, math.radians(24))).to_matrix()
    @ Matrix.Rotation(math.radians(-140), 3, 'Z')
    @ Matrix.Rotation(math.radians(-90), 3, 'Y')
)
BALL = 0.040
ARROW = 0.165
RED, GREEN, BLUE = (0.80, 0.05, 0.05, 1.0), (0.14, 0.50, 0.05, 1.0), (0.05, 0.20, 0.75, 1.0)
POSITION, ROTATION = figure.BODY, figure.HEAD
BAR = 0.34
EMPTY = (0.76, 0.78, 0.80, 1.0)
FADED = (0.36, 0.39, 0.43, 1.0)
CARD = (0.93, 0.94, 0.95, 1.0)

SOFTNESSES = ((0.0, (0.90, 0.30, 0.12, 1.0)), (0.1, (0.10, 0.42, 0.72, 1.0)), (0.3, (0.28, 0.55, 0.20, 1.0)))
NEAREST, FARTHEST = 0.5, 1.7  # of the plot, in lengths of the chain
PLOT = Vector((6.4, 4.0))


def render_all(folder):
    """Render every picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    return [_render_weights(folder / "ik_weights.png"), _render_reach(folder / "ik_reach.png")]


def _render_weights(file):
    """An arm with its position weight raised, then its rotation weight; behind it what weight 0 gives."""
    scene = stage.new_scene((0.62, 0.68, 0.75), 0.75)
    _add_wall()
    stage.add_sun((math.radians(52), math.radians(-14), math.radians(-28)), 2.2, softness=8.0)
    for row, weights in enumerate(ROWS):
        for column, (position, rotation) in enumerate(weights):
            middle = Vector(((column - 1) * CELL.x, 0.0, (0.5 - row) * CELL.z))
            target = _add_target(middle + TARGET)
            _add_arm(f"Arm {row} {column}", middle, target, position, rotation)
            if column:
                _add_arm(f"Ghost {row} {column}", middle, target, *weights[0], is_ghost=True)
            _add_card(middle, position, rotation)
    stage.add_camera(scene, (0.0, -9.0, 0.0), (0.0, 0.0, 0.0), width=3 * CELL.x)
    return stage.render(scene, file, (1280, round(1280 * 2 * CELL.z / (3 * CELL.x))), samples=96)


def _add_wall():
    wall = stage.add_floor(stage.glossy_material("Wall", (0.50, 0.58, 0.65, 1.0), 0.95), side=20.0)
    wall.rotation_euler.x = math.radians(90.0)
    wall.location.y = WALL_Y


def _add_arm(name, middle, target, position, rotation, is_ghost=False):
    depth = Vector((0.0, 0.085 if is_ghost else 0.0, 0.0))
    rig = ik_arm.build(middle + SHOULDER + depth, name, is_ghost)
    if is_ghost:
        # Of its own, as far behind as the ghost stands.
        goal = stage.link(bpy.data.objects.new(name + " Target", None))
        goal.matrix_world = Matrix.Translation(depth) @ target.matrix_world
        target = goal
    bpy.ops.motus.ik_add(
        object=rig.name,
        bone="Hand",
        target=target.name,
        chain_length=3,
        position_weight=position,
        rotation_weight=rotation,
        keep_rotation=False,
    )


def _add_target(place):
    """A ball with its axes: X red, Y green, Z blue."""
    mesh = figure.ball("Target")
    mesh.materials.append(stage.glossy_material("Target", (0.80, 0.05, 0.03, 1.0), 0.25))
    ball = stage.link(bpy.data.objects.new("Target", mesh))
    ball.location = place
    ball.rotation_euler = TARGET_TURN.to_euler()
    bpy.context.view_layer.update()
    for axis, color in enumerate((RED, GREEN, BLUE)):
        _add_arrow(place, ball.matrix_world.to_3x3().col[axis], color)
    ball.scale = (BALL, BALL, BALL)
    bpy.context.view_layer.update()
    return ball


def _add_arrow(start, direction, color):
    name = f"Arrow {color}"
    material = bpy.data.materials.get(name) or stage.glossy_material(name, color, 0.4)
    neck = start + (ARROW - 0.05) * direction
    stage.add_tube([start, neck], 0.0095, material)
    tip = stage.add_tube([neck, start + ARROW * direction], 0.025, material)
    tip.data.splines[0].points[1].radius = 0.0


def _add_card(middle, position, rotation):
    """Both weights as bars."""
    x, z = middle.x - 0.5 * BAR + 0.09, middle.z - 0.5 * CELL.z
    _add_plate((middle.x - 0.47, -0.30, z + 0.05), 0.94, 0.235, CARD)
    _add_bar("position", position, POSITION, (x, -0.32, z + 0.187))
    _add_bar("rotation", rotation, ROTATION, (x, -0.32, z + 0.084))


def _add_bar(name, value, color, place):
    x, y, z = place
    ink = color if value else FADED
    labels = (
        stage.add_text(name, (x - 0.045, y, z + 0.004), 0.088, ink, align='RIGHT'),
        stage.add_text(f"{value:g}", (x + BAR + 0.045, y, z + 0.004), 0.088, ink, align='LEFT'),
    )
    for label in labels:
        label.visible_shadow = False
    _add_plate((x, y + 0.005, z), BAR, 0.062, EMPTY)
    if value:
        _add_plate((x, y, z), BAR * value, 0.062, color)


def _add_plate(corner, width, height, color):
    x, y, z = corner
    mesh = bpy.data.meshes.new("Plate")
    mesh.from_pydata([(x, y, z), (x + width, y, z), (x + width, y, z + height), (x, y, z + height)], [], [(0, 1, 2, 3)])
    mesh.materials.append(stage.flat_material("Plate", color))
    plate = stage.link(bpy.data.objects.new("Plate", mesh))
    plate.visible_shadow = False


def _render_reach(file):
    """Where the tip stands, and how far the joint between two equal bones is open, over the target's distance."""
    native = support.addon("core.native").module
    scene = stage.new_scene((1.0, 1.0, 1.0))
    distance = np.linspace(NEAREST, FARTHEST, 481)
    right = PLOT.x + 2.5
    _add_axes(0.0, "distance of the tip", (f"{NEAREST:g}", "1.0"))
    _add_axes(right, "angle of the elbow", (f"{math.degrees(_elbow(NEAREST)):.0f}°", "180°"))
    for row, (softness, color) in enumerate(SOFTNESSES):
        tip = native.soft_reach(distance, 1.0, softness)
        _add_curve(0.0, distance, (tip - NEAREST) / (1.0 - NEAREST), color)
        _add_curve(right, distance, (_elbow(tip) - _elbow(NEAREST)) / (math.pi - _elbow(NEAREST)), color)
        for left in (0.0, right):
            stage.add_text(
                f"softness {softness:g}", (left + PLOT.x - 0.1, 1.75 - 0.62 * row, 0.0), 0.46, color, align='RIGHT', upright=False
            )
    middle = (0.5 * (right + PLOT.x) - 0.35, 1.83)
    stage.add_camera(scene, (*middle, 10.0), (*middle, 0.0), width=right + PLOT.x + 2.2)
    return stage.render(scene, file, (1280, 512), samples=32)


def _elbow(reach):
    """Angle between two equal bones that together span `reach` of their length."""
    return 2.0 * np.arcsin(reach)


def _add_axes(left, title, values):
    """values: what stands at the lower and the upper end of what the curves run through."""
    ink, hair = stage.flat_material("Axis", stage.INK), stage.flat_material("Hair", (0.45, 0.48, 0.52, 1.0))
    stage.add_tube([(left, 0, 0), (left + PLOT.x, 0, 0)], 0.014, ink)
    stage.add_tube([(left, 0, 0), (left, PLOT.y + 0.4, 0)], 0.014, ink)
    stage.add_tube([(left, PLOT.y, 0), (left + PLOT.x, PLOT.y, 0)], 0.007, hair)
    whole = left + PLOT.x * _along(1.0)
    stage.add_tube([(whole, 0, 0), (whole, PLOT.y + 0.4, 0)], 0.007, hair)
    for text, height in zip(values, (0.0, PLOT.y)):
        stage.add_text(text, (left - 0.15, height - 0.14, 0), 0.40, align='RIGHT', upright=False)
    for number in (NEAREST, 1.0, 1.5):
        stage.add_text(f"{number:.1f}", (left + PLOT.x * _along(number), -0.52, 0), 0.40, upright=False)
    stage.add_text(title, (left - 0.02, PLOT.y + 0.6, 0), 0.46, align='LEFT', upright=False)
    stage.add_text("distance of the target", (left + 0.5 * PLOT.x, -1.15, 0), 0.46, upright=False)


def _along(distance):
    return (distance - NEAREST) / (FARTHEST - NEAREST)


def _add_curve(left, distance, height, color):
    points = [(left + PLOT.x * a, PLOT.y * h, 0.02) for a, h in zip(_along(distance), height)]
    stage.add_tube(points, 0.04, stage.flat_material("Curve", color))
