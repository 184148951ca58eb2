"""The pictures of the Look At page, made through the add-on's own operators."""

import math

import bpy
from mathutils import Vector

import look_at_figure as figure
import stage

# Title, and the weights of body, head and eyes; a general weight of 0 first.
LOOKS = (
    ("At Rest", 0.0, 0.0, 0.0),
    ("Eyes", 0.0, 0.0, 1.0),
    ("Head", 0.0, 1.0, 0.0),
    ("Body", 1.0, 0.0, 0.0),
    ("Default", 0.3, 1.0, 0.0),
    ("Everything", 0.3, 0.6, 1.0),
)
SPACING = 0.98
TARGET = Vector((0.43, -0.45, 1.60))  # m from the figure's stand
BALL = 0.055
BAR = 0.32
TURNS = (0, 45, 90, 135, 180)  # degrees to the figure's left
CARD = (0.93, 0.94, 0.95, 1.0)
EMPTY = (0.76, 0.78, 0.80, 1.0)
FADED = (0.42, 0.45, 0.49, 1.0)
CARD_Y = -0.36
RED, GREEN = (0.80, 0.03, 0.03, 1.0), (0.05, 0.50, 0.12, 1.0)
NEAR = 1.0  # degrees: a gaze that is off by less counts as on the target


def render_all(folder):
    """Render every picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    return [_render_weights(folder / "look_at_weights.png"), _render_limits(folder / "look_at_limits.png")]


def _render_weights(file):
    """The same figure with several weights side by side."""
    scene = _new_scene((math.radians(42), math.radians(-8), math.radians(-30)))
    for index, (title, body, head, eyes) in enumerate(LOOKS):
        x = (index - (len(LOOKS) - 1) / 2) * SPACING
        rig = figure.build((x, 0.0, 0.0), f"Figure {title}")
        target = _add_ball(Vector((x, 0.0, 0.0)) + TARGET)
        _look(rig, target, weight=float(body + head + eyes > 0.0), body_weight=body, head_weight=head, eyes_weight=eyes)
        if body or head or eyes:
            _add_gaze(rig, target)
        _add_plate((x - 0.38, CARD_Y + 0.02, 0.02), 0.76, 0.52, CARD)
        stage.add_text(title, (x, CARD_Y, 0.415), 0.105)
        for row, (name, value, color) in enumerate((("eyes", eyes, figure.EYES), ("head", head, figure.HEAD), ("body", body, figure.BODY))):
            _add_bar(name, value, color, (x - 0.13, CARD_Y, 0.29 - 0.105 * row))
    stage.add_camera(scene, (0.0, -9.0, 1.75), (0.0, 0.0, 0.85), width=SPACING * len(LOOKS) + 0.1)
    return stage.render(scene, file, (1280, 410), samples=96)


def _render_limits(file):
    """The figure from above, with the target farther and farther around it."""
    scene = _new_scene((math.radians(12), math.radians(10), 0.0))
    for index, turn in enumerate(TURNS):
        x = (index - (len(TURNS) - 1) / 2) * 1.35
        rig = figure.build((x, 0.0, 0.0), f"Figure {turn}")
        angle = math.radians(turn)
        target = _add_ball(Vector((x + 0.62 * math.sin(angle), -0.62 * math.cos(angle), 1.435)))
        _look(rig, target, eyes_weight=1.0)
        off = _add_gaze(rig, target)
        reached = "on the target" if off < NEAR else f"{off:.0f}° are left"
        stage.add_text(f"{turn}°: {reached}", (x, -0.95, 1.5), 0.105, upright=False)
    stage.add_camera(scene, (0.0, -0.11, 9.0), (0.0, -0.11, 0.0), width=1.35 * len(TURNS))
    return stage.render(scene, file, (1280, 380), samples=96)


def _new_scene(sun):
    scene = stage.new_scene((0.52, 0.60, 0.68), 0.80)
    stage.add_floor(stage.glossy_material("Floor", (0.44, 0.52, 0.58, 1.0), 0.95))
    stage.add_sun(sun, 2.0, softness=10.0)
    return scene


def _look(rig, target, **weights):
    bpy.ops.motus.look_at_add(object=rig.name, bone="Head", target=target.name, **weights)


def _add_ball(place):
    mesh = figure.ball("Target")
    mesh.materials.append(stage.glossy_material("Target", (0.80, 0.05, 0.03, 1.0), 0.25))
    ball = stage.link(bpy.data.objects.new("Target", mesh))
    ball.location = place
    ball.scale = (BALL, BALL, BALL)
    return ball


def _add_gaze(rig, target):
    """Draw where the eyes look, as far as the target is; returns the angle that is left, degrees."""
    bpy.context.view_layer.update()
    evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    eyes = [evaluated.matrix_world @ evaluated.pose.bones[name].matrix for name in ("Eye.L", "Eye.R")]
    start = 0.5 * (eyes[0].translation + eyes[1].translation)
    gaze = sum((eye.to_3x3().col[1].normalized() for eye in eyes), Vector()).normalized()
    wanted = target.location - start
    off = math.degrees(gaze.angle(wanted))
    color = GREEN if off < NEAR else RED
    material = bpy.data.materials.get(f"Gaze {color}") or stage.flat_material(f"Gaze {color}", color)
    end = wanted.length - BALL if off < NEAR else wanted.length
    dash, first = 0.045, 0.07
    for step in range(int((end - first) / dash)):
        along = first + dash * step
        stage.add_tube([start + along * gaze, start + (along + 0.55 * dash) * gaze], 0.0075, material)
    return off


def _add_bar(name, value, color, place):
    """A weight as a bar with its name and number."""
    x, y, z = place
    ink = color if value else FADED
    stage.add_text(name, (x - 0.04, y, z), 0.080, ink, align='RIGHT')
    _add_plate((x, y + 0.005, z), BAR, 0.055, EMPTY)
    if value:
        _add_plate((x, y, z), BAR * value, 0.055, color)
    stage.add_text(f"{value:g}", (x + BAR + 0.04, y, z), 0.080, ink, align='LEFT')


def _add_plate(corner, width, height, color):
    x, y, z = corner
    mesh = bpy.data.meshes.new("Plate")
    mesh.from_pydata([(x, y, z), (x + width, y, z), (x + width, y, z + height), (x, y, z + height)], [], [(0, 1, 2, 3)])
    mesh.materials.append(stage.flat_material("Plate", color))
    stage.link(bpy.data.objects.new("Plate", mesh))
