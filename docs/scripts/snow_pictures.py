"""The pictures of the Snow page, made through the add-on's own operators."""

import math

import bpy
from mathutils import Vector

import stage

NIGHT = (0.012, 0.02, 0.05)
LABEL = (0.9, 0.93, 1.0, 1.0)
PRESETS = (('GENTLE', "gentle"), ('BLIZZARD', "blizzard"), ('WET', "wet"), ('DUST', "dust"), ('PETALS', "petals"),
           ('SPARKS', "sparks"))
SHAPES = (('SQUARE', "square"), ('DISC', "disc"), ('BOX', "box"), ('SPHERE', "sphere"), ('CONE', "cone"),
          ('SURFACE', "mesh surface"))
CELL = 3.4


def render_all(folder):
    """Render every picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    return [_render_presets(folder / "snow_presets.png"), _render_emitters(folder / "snow_emitters.png")]


def _scene():
    scene = stage.new_scene(NIGHT, 1.0)
    stage.add_sun((math.radians(50), math.radians(10), math.radians(-25)), 3.5, softness=5.0)
    return scene


def _render_presets(file):
    """A column of each preset's flakes, larger than they are."""
    scene = _scene()
    for column, (preset, label) in enumerate(PRESETS):
        x = (column - 0.5 * (len(PRESETS) - 1)) * CELL
        is_rising = preset == 'SPARKS'
        bpy.ops.motus.snow_add(preset=preset, location=(x, 0.0, -1.6 if is_rising else 3.0), seed=column)
        emitter = bpy.context.object
        settings = emitter.motus.snow
        if is_rising:
            emitter.rotation_euler.x = 0.0
        else:
            thinner = (1.1 / settings.cone_radius) ** 2
            settings.cone_radius, settings.rate = 1.1, max(settings.rate * thinner * 8.0, 25.0)
        if preset == 'BLIZZARD':
            settings.wind = 2.4, 0.5, -3.0
        if preset == 'DUST':
            emitter.location.z, settings.cone_radius = 0.5, 1.3
        settings.flake_width = 0.05 if is_rising or preset == 'DUST' else 0.16
        stage.add_text(label, Vector((x, -1.6, -2.55)), 0.36, LABEL)
    stage.add_camera(scene, (0.0, -16.0, 0.3), (0.0, 0.0, 0.3), width=6.1 * CELL)
    return stage.render(scene, file, (1280, 420), samples=48)


def _render_emitters(file):
    """A moment after the births from each shape."""
    scene = _scene()
    for column, (shape, label) in enumerate(SHAPES):
        x = (column - 0.5 * (len(SHAPES) - 1)) * CELL
        keywords = {"shape": shape, "rate": 260.0, "lifetime": 1.2, "start_speed": 1.2, "look": 'SPECK', "flake_width": 0.05,
                    "cone_radius": 0.7, "cone_angle": math.radians(35.0), "tumble": 2.0, "start_frame": -60.0}
        if shape == 'SURFACE':
            bpy.ops.mesh.primitive_torus_add(location=(x, 0.0, 0.0), major_radius=0.75, minor_radius=0.28)
            torus = bpy.context.object
            torus.rotation_euler.x = math.radians(60.0)
            torus.data.materials.append(stage.glossy_material("Ring", (0.05, 0.10, 0.25, 1.0), 0.4))
            keywords |= {"surface": torus.name, "start_speed": 0.5}
            keywords.pop("shape")
        bpy.ops.motus.snow_add(location=(x, 0.0, 1.3 if shape in {'SQUARE', 'DISC', 'CONE'} else 0.4), **keywords)
        stage.add_text(label, Vector((x, -1.6, -2.0)), 0.34, LABEL)
    stage.add_camera(scene, (0.0, -15.0, 3.2), (0.0, 0.0, 0.0), width=6.1 * CELL)
    return stage.render(scene, file, (1280, 340), samples=48)
