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
CELL = Vector((1.32, 0.0, 1.16))
WALL_Y = 0.13
SHOULDER = Vector((-0.44, 0.0, 0.33))  # from the middle of a cell
TARGET = Vector((0.20, 0.0, 0.13))
TARGET_TURN = Euler((math.radians(14), math.radians(100), math.radians(-10)))
BALL = 0.034
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
    return stage.render(scene, file, (1280, round(1280 * 2 * CELL.z / (3 * CELL.x))), samples=128)


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
        object=rig.name, bone="Hand", target=target.name, chain_length=3, position_weight=position,
        rotation_weight=rotation, keep_rotation=False)


def _add_target(place):
    """A ball with its axes: X red, Y green, Z blue."""
    mesh = figure.ball("Target")
    mesh.materials.append(stage.glossy_material("Target", (0.80, 0.05, 0.03, 1.0), 0.25))
    ball = stage.link(bpy.data.objects.new("Target", mesh))
    ball.location = place
    ball.rotation_euler = TARGET_TURN
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
    stage.add_tube([start, neck], 0.0075, material)
    tip = stage.add_tube([neck, start + ARROW * direction], 0.021, material)
    tip.data.splines[0].points[1].radius = 0.0


def _add_card(middle, position, rotation):
    """Both weights as bars."""
    x, z = middle.x - 0.5 * BAR + 0.07, middle.z - 0.5 * CELL.z
    _add_plate((middle.x - 0.47, -0.30, z + 0.05), 0.94, 0.235, CARD)
    _add_bar("position", position, POSITION, (x, -0.32, z + 0.187))
    _add_bar("rotation", rotation, ROTATION, (x, -0.32, z + 0.084))


def _add_bar(name, value, color, place):
    x, y, z = place
    stage.add_text(name, (x - 0.045, y, z + 0.004), 0.088, color if value else FADED, align='RIGHT')
    _add_plate((x, y + 0.005, z), BAR, 0.062, EMPTY)
    if value:
        _add_plate((x, y, z), BAR * value, 0.062, color)
    stage.add_text(f"{value:g}", (x + BAR + 0.045, y, z + 0.004), 0.088, color if value else FADED, align='LEFT')


def _add_plate(corner, width, height, color):
    x, y, z = corner
    mesh = bpy.data.meshes.new("Plate")
    mesh.from_pydata(
        [(x, y, z), (x + width, y, z), (x + width, y, z + height), (x, y, z + height)], [], [(0, 1, 2, 3)])
    mesh.materials.append(stage.flat_material("Plate", color))
    plate = stage.link(bpy.data.objects.new("Plate", mesh))
    plate.visible_shadow = False


def _render_reach(file):
    """Where the tip stands, and how far the joint between two equal bones is open, over the target's distance."""
    native = support.addon("core.native").module
    scene = stage.new_scene((1.0, 1.0, 1.0))
    distance = np.linspace(NEAREST, FARTHEST, 481)
    left, right = Vector((0.0, 0.0)), Vector((PLOT.x + 1.9, 0.0))
    for corner, title in ((left, "distance of the tip"), (right, "angle of the elbow")):
        _add_axes(corner, title)
    for softness, color in SOFTNESSES:
        tip = native.soft_reach(distance, 1.0, softness)
        angle = 2.0 * np.arcsin(np.minimum(tip, 1.0))
        _add_curve(left, distance, (tip - NEAREST) / (1.0 - NEAREST), color)
        _add_curve(right, distance, (angle - angle[0]) / (math.pi - angle[0]), color)
    width = right.x + PLOT.x + 2.2
    middle = (0.5 * (right.x + PLOT.x) - 0.2, 1.85)
    stage.add_camera(scene, (*middle, 10.0), (*middle, 0.0), width=width)
    return stage.render(scene, file, (1280, 480), samples=32)


def _add_axes(corner, title):
    ink = stage.flat_material("Axis", stage.INK)
    x, y = corner
    stage.add_tube([(x, y, 0), (x + PLOT.x, y, 0)], 0.014, ink)
    stage.add_tube([(x, y, 0), (x, y + PLOT.y + 0.5, 0)], 0.014, ink)
    return title


def _add_curve(corner, distance, height, color):
    along = (distance - NEAREST) / (FARTHEST - NEAREST)
    stage.add_tube([(corner.x + PLOT.x * a, corner.y + PLOT.y * h, 0.02) for a, h in zip(along, height)], 0.04,
                   stage.flat_material("Curve", color))
