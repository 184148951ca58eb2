"""The pictures of the Pendulums page, made through the add-on's own operators."""

import math

import bpy
import numpy as np
from mathutils import Vector

import stage

# Angle, sideways velocity and damping of each spherical pendulum, and the seconds of its way that are shown.
SPHERICAL = ((0.9, 0.6, 0.0, 16.0), (0.7, 3.0, 0.12, 14.0), (0.6, 2.03, 0.0, 2.2))

SKY = (0.80, 0.85, 0.92)
TRAIL = (0.85, 0.20, 0.05, 1.0)


def render_all(folder):
    """Render every picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    return [
        _render_double(folder / "pendulum_double.png"),
        _render_fan(folder / "pendulum_fan.png"),
        _render_spherical(folder / "pendulum_spherical.png"),
    ]


def _scene():
    scene = stage.new_scene(SKY, 0.6)
    wall = stage.add_floor(stage.glossy_material("Wall", (0.62, 0.66, 0.72, 1.0), 0.95))
    wall.rotation_euler.x, wall.location.y = math.radians(90.0), 0.6
    stage.add_sun((math.radians(50), math.radians(-18), math.radians(-25)), 2.2, softness=5.0)
    return scene


def _add(x, **keywords):
    bpy.ops.motus.pendulum_add(location=(x, 0.0, 0.0), rod_radius=0.022, bob_radius=0.11, **keywords)
    return bpy.context.object


def _places(pivot, frames):
    """Where the end bob of the first pendulum is on frames."""
    settings, found = pivot.motus.pendulum, []
    bob = settings.rods[1 if settings.kind == 'DOUBLE' else 0].bob
    for frame in frames:
        whole = math.floor(frame)
        bpy.context.scene.frame_set(whole, subframe=frame - whole)
        found.append(bob.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.translation.copy())
    return found


def _trail(pivot, frames, material):
    stage.add_tube([place + Vector((0.0, 0.2, 0.0)) for place in _places(pivot, frames)], 0.018, material)


def _render_double(file):
    """One pendulum at several times: a copy for each, that stands still there."""
    scene = _scene()
    count, shade = 7, np.linspace(0.75, 0.0, 7)
    for index in range(count):
        pivot = _add(0.0, kind='DOUBLE', start_frame=1.0 - 6.0 * index, hue=0.58)
        for entry in pivot.motus.pendulum.rods:
            for obj in (entry.object, entry.bob):
                light = float(shade[index])
                color = (light + 0.02, 0.75 * light + 0.10, 0.45 * light + 0.45, 1.0)
                obj.material_slots[0].material = stage.glossy_material(f"Shade {index}", color, 0.4)
        pivot.location.y = 0.3 - 0.06 * index
    _trail(pivot, np.arange(1.0 - 6.0 * (count - 1), 1.01, 0.25), stage.glossy_material("Trail", TRAIL, 0.6))
    stage.add_camera(scene, (0.0, -12.0, -0.3), (0.0, 0.0, -0.55), width=7.6)
    return stage.render(scene, file, (1280, 560), samples=48)


def _render_fan(file):
    """The fan at three times."""
    scene = _scene()
    for column, seconds in enumerate((1.0, 4.0, 7.0)):
        x = (column - 1) * 4.8
        _add(x, kind='FAN', count=20, start_frame=1.0 - seconds * scene.render.fps)
        stage.add_text(f"{seconds:.0f} s", Vector((x, -0.3, -2.75)), 0.34)
    stage.add_camera(scene, (0.0, -16.0, -0.2), (0.0, 0.0, -0.3), width=14.6)
    return stage.render(scene, file, (1280, 470), samples=48)


def _render_spherical(file):
    """Three pendulums that swing to all sides, seen from above, with the ways that their bobs have come."""
    scene = stage.new_scene(SKY, 0.6)
    floor = stage.add_floor(stage.glossy_material("Floor", (0.62, 0.66, 0.72, 1.0), 0.95))
    floor.location.z = -1.35
    stage.add_sun((math.radians(35), math.radians(-18), math.radians(-25)), 2.2, softness=5.0)
    trail = stage.glossy_material("Trail", TRAIL, 0.6)
    for column, (angle, sideways, damping, seconds) in enumerate(SPHERICAL):
        first = 1.0 - seconds * scene.render.fps
        settings = {"angle1": angle, "velocity_sideways": sideways, "damping": damping, "start_frame": first}
        pivot = _add((column - 1) * 2.3, kind='SPHERICAL', hue=0.58, **settings)
        places = _places(pivot, np.arange(first, 1.01, 0.5))
        scene.frame_set(1)
        stage.add_tube(places, 0.012, trail)
    stage.add_camera(scene, (0.0, -5.0, 9.0), (0.0, 0.0, -0.75), width=6.9)
    return stage.render(scene, file, (1280, 430), samples=48)
