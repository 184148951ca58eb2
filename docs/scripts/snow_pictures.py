"""The pictures of the Snow page, made through the add-on's own operators."""

import math

import bpy
from mathutils import Vector

import stage

NIGHT = (0.012, 0.02, 0.05)
LABEL = (0.9, 0.93, 1.0, 1.0)
PRESETS = (('GENTLE', "gentle"), ('BLIZZARD', "blizzard"), ('WET', "wet"), ('DUST', "dust"), ('PETALS', "petals"), ('SPARKS', "sparks"))
MOTIONS = (("keyed rate", {}), ("left behind", {}), ("emitter velocity", {"emitter_velocity": 1.0}), ("local space", {"use_local": True}))
SHAPES = (('SQUARE', "square"), ('DISC', "disc"), ('BOX', "box"), ('SPHERE', "sphere"), ('CONE', "cone"), ('SURFACE', "mesh surface"))
CELL = 3.4


def render_all(folder):
    """Render every picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    return [
        _render_presets(folder / "snow_presets.png"),
        _render_emitters(folder / "snow_emitters.png"),
        _render_motion(folder / "snow_motion.png"),
        _render_cover(folder / "snow_cover.png"),
        _render_marks(folder / "snow_marks.png"),
    ]


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
            thinner = (1.1 / settings.emitter_radius) ** 2
            settings.emitter_radius, settings.rate = 1.1, max(settings.rate * thinner * 8.0, 25.0)
        if preset == 'BLIZZARD':
            settings.wind = 2.4, 0.5, -3.0
        if preset == 'DUST':
            emitter.location.z, settings.emitter_radius = 0.5, 1.3
        settings.flake_width = 0.05 if is_rising or preset == 'DUST' else 0.16
        stage.add_text(label, Vector((x, -1.6, -2.55)), 0.36, LABEL)
    stage.add_camera(scene, (0.0, -16.0, 0.3), (0.0, 0.0, 0.3), width=6.1 * CELL)
    return stage.render(scene, file, (1280, 420), samples=48)


def _render_emitters(file):
    """A moment after the births from each shape."""
    scene = _scene()
    for column, (shape, label) in enumerate(SHAPES):
        x = (column - 0.5 * (len(SHAPES) - 1)) * CELL
        keywords = {
            "shape": shape,
            "rate": 260.0,
            "lifetime": 1.2,
            "start_speed": 1.2,
            "look": 'SPECK',
            "flake_width": 0.05,
            "emitter_radius": 0.7,
            "cone_angle": math.radians(35.0),
            "tumble": 2.0,
            "start_frame": -60.0,
        }
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


def _render_motion(file):
    """Flakes that fall straight: of a rate that rises and falls, and of emitters that have moved to the right."""
    scene = _scene()
    first, cell = -71, 4.6
    for column, (label, keywords) in enumerate(MOTIONS):
        x = (column - 0.5 * (len(MOTIONS) - 1)) * cell
        common = {
            "lifetime": 3.0,
            "start_speed": 1.2,
            "look": 'SPECK',
            "flake_width": 0.06,
            "tumble": 2.0,
            "emitter_radius": 0.5,
            "seed": column,
        }
        bpy.ops.motus.snow_add(location=(x, 0.0, 1.8), rate=180.0, start_frame=first, **common, **keywords)
        emitter = bpy.context.object
        if column == 0:
            for frame, rate in ((-71, 0.0), (-47, 800.0), (-35, 0.0), (-23, 0.0), (-11, 500.0), (1, 0.0)):
                emitter.motus.snow.rate = rate
                emitter.keyframe_insert("motus.snow.rate", frame=frame)
        else:
            for frame, place in ((first, x - 1.4), (1, x + 1.0)):
                emitter.location.x = place
                emitter.keyframe_insert("location", frame=frame)
        stage.add_text(label, Vector((x, -1.6, -2.5)), 0.36, LABEL)
    scene.frame_set(1)
    stage.add_camera(scene, (0.0, -16.0, 0.0), (0.0, 0.0, 0.0), width=4.1 * cell)
    return stage.render(scene, file, (1280, 400), samples=48)


def _render_cover(file):
    """The same roof, fence and tree after some, more, and much snow."""
    scene = _scene()
    materials = [
        stage.glossy_material(name, color, 0.8)
        for name, color in (
            ("Roof", (0.16, 0.05, 0.035, 1.0)),
            ("Wood", (0.10, 0.06, 0.035, 1.0)),
            ("Needles", (0.02, 0.07, 0.04, 1.0)),
            ("Grass", (0.06, 0.07, 0.03, 1.0)),
        )
    ]
    for column, seconds in enumerate((2.0, 5.0, 10.0)):
        x = (column - 1) * 7.2
        surfaces = _yard(x, *materials)
        bpy.ops.motus.snow_add(
            preset='GENTLE',
            location=(x, 0.0, 6.0),
            rate=2500.0,
            emitter_radius=3.4,
            lifetime=8.0,
            seed=column,
            start_frame=1.0 - (6.0 + seconds) * scene.render.fps,
            preview=6.0,
        )
        emitter = bpy.context.object
        emitter.motus.snow.influence = 0.0
        bpy.ops.motus.snow_cover_add(surfaces=",".join(surfaces), emitters=emitter.name, lump=0.042 * 2.0, resolution=0.07, smoothing=0.14)
        stage.add_text(f"{seconds:g} s", Vector((x, -3.7, -0.75)), 0.4, LABEL)
    stage.add_camera(scene, (0.0, -19.0, 8.5), (0.0, 0.0, 0.95), width=22.5)
    return stage.render(scene, file, (1280, 440), samples=64)


def _render_marks(file):
    """The way of a ball on which snow has fallen since, the road of a plough, and the steps of a walker."""
    scene = _scene()
    ground = stage.glossy_material("Road", (0.05, 0.045, 0.04, 1.0), 0.9)
    thing = stage.glossy_material("Thing", (0.45, 0.08, 0.05, 1.0), 0.4)
    for column, (label, add, packed) in enumerate(
        (("a ball, and later snow", _roll, 0.02), ("a plough", _plough, 0.0), ("feet", _walk, 0.03))
    ):
        x = (column - 1) * 7.2
        bpy.ops.mesh.primitive_plane_add(size=6.4, location=(x, 0.0, 0.0))
        meadow = bpy.context.object
        meadow.data.materials.append(ground)
        movers = add(x, thing)
        bpy.ops.motus.snow_add(
            preset='GENTLE',
            location=(x, 0.0, 6.0),
            rate=250.0,
            emitter_radius=3.4,
            lifetime=8.0,
            seed=column,
            start_frame=-1900.0,
            preview=10.0,
        )
        emitter = bpy.context.object
        emitter.motus.snow.influence = 0.0
        bpy.ops.motus.snow_cover_add(
            surfaces=meadow.name,
            emitters=emitter.name,
            movers=",".join(one.name for one in movers),
            lump=0.08,
            resolution=0.05,
            smoothing=0.16,
            packed=packed,
        )
        stage.add_text(label, Vector((x, -3.9, -0.6)), 0.42, LABEL)
    scene.frame_set(1)
    stage.add_camera(scene, (0.0, -17.0, 11.0), (0.0, 0.0, -0.1), width=22.5)
    return stage.render(scene, file, (1280, 440), samples=40)


def _roll(x, material):
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.6, segments=64, ring_count=32)
    ball = bpy.context.object
    ball.data.materials.append(material)
    for frame, place in ((-900, (x - 3.9, -2.4, 0.62)), (-700, (x - 0.4, 0.2, 0.62)), (-500, (x + 1.9, 1.5, 0.62))):
        ball.location = place
        ball.keyframe_insert("location", frame=frame)
    return [ball]


def _plough(x, material):
    bpy.ops.mesh.primitive_cube_add(size=1.0)
    plough = bpy.context.object
    plough.scale, plough.rotation_euler.z = (0.12, 1.5, 0.5), math.radians(25.0)
    plough.data.materials.append(material)
    for frame, place in ((-40, (x - 4.0, -1.2, 0.25)), (0, (x + 1.6, 0.9, 0.25))):
        plough.location = place
        plough.keyframe_insert("location", frame=frame)
    return [plough]


def _walk(x, material):
    """Two feet under a body that walks; returns their soles."""
    body = stage.link(bpy.data.objects.new("Body", None))
    soles = []
    for side in (-1.0, 1.0):
        foot = stage.link(bpy.data.objects.new("Foot", None))
        foot.location = x + 0.28 * side, 0.0, 0.0
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5, segments=32, ring_count=16, location=(0.0, 0.0, 0.12))
        sole = bpy.context.object
        sole.scale = 0.32, 0.62, 0.22
        sole.data.materials.append(material)
        sole.parent = foot
        soles.append(sole)
    body.location = x, 0.0, 0.0
    bpy.context.view_layer.update()
    bpy.ops.motus.walker_add(object=body.name, feet=",".join(sole.parent.name for sole in soles), stride=1.3, clearance=0.5, use_plane=True)
    for frame, place in ((-120, (x - 0.6, -2.9, 0.0)), (-50, (x, 0.0, 0.0)), (0, (x + 0.7, 2.2, 0.0))):
        body.location = place
        body.keyframe_insert("location", frame=frame)
    return soles


def _yard(x, roof, wood, needles, grass):
    """A hut, a fence and a fir on a meadow; returns the names of what snow lies on."""
    found = []

    def add(kind, material, place, scale, turn=(0.0, 0.0, 0.0), **more):
        getattr(bpy.ops.mesh, f"primitive_{kind}_add")(location=(x + place[0], place[1], place[2]), rotation=turn, **more)
        obj = bpy.context.object
        obj.scale = scale
        obj.data.materials.append(material)
        found.append(obj.name)
        return obj

    add('plane', grass, (0.0, 0.0, 0.0), (3.3, 3.3, 1.0))
    add('cube', wood, (-0.9, 0.6, 0.8), (0.95, 0.8, 0.8))
    for side in (-1.0, 1.0):
        add('cube', roof, (-0.9, 0.6 + 0.55 * side, 1.95), (1.3, 0.8, 0.05), (math.radians(-38.0) * side, 0.0, 0.0))
    for post in range(5):
        add('cube', wood, (-2.4 + 1.2 * post, -1.9, 0.35), (0.06, 0.06, 0.35))
    add('cube', wood, (0.0, -1.9, 0.5), (2.4, 0.04, 0.06))
    for level in range(4):
        add(
            'cone',
            needles,
            (1.9, 0.7, 0.75 + 0.55 * level),
            (1.0, 1.0, 1.0),
            vertices=24,
            radius1=1.0 - 0.2 * level,
            radius2=0.0,
            depth=0.9,
        )
    return found
