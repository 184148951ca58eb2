"""The pictures of the Follow Path page, made through the add-on's own operators."""

import math

import bpy
import numpy as np
from mathutils import Vector

import support

LANES = (
    ("World Up", 'WORLD_UP'),
    ("Minimal Twist", 'MINIMAL'),
    ("Banking", 'BANKING'),
    ("Curvature", 'CURVATURE'),
    ("Curve Tilt", 'TILT'),
)
# A course over the lane's own axis: a bend to either side, then a hump. Metres; x, y, z.
COURSE = ((0, 0, 0), (0, 12, 0), (7, 24, 0), (-7, 40, 1), (0, 54, 7), (0, 66, 2), (0, 78, 2))
LANE_WIDTH = 24.0
PLANES = 11
GAP = 8.2
SPEED = 13.0
# An S of two tight bends, x and y; wagons of length and width, m.
BENDS = ((-2, 0), (7, 4), (-3, 12), (7, 20), (-2, 24))
WAGON_LANE = 19.0
WAGONS = 5
WAGON, CAR, WHEELBASE = (6.0, 1.3), (2.4, 1.1), 5.0
WAGON_GAP = 6.6
TILT_STEP = math.radians(25.0)
INK = (0.012, 0.016, 0.028, 1.0)
CHALK = (1.0, 1.0, 1.0, 1.0)
ACCENTS = ((0.90, 0.30, 0.12, 1.0), (0.10, 0.42, 0.72, 1.0), (0.28, 0.55, 0.20, 1.0))


def render_all(folder):
    """Render every picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    return [_render_modes(folder / "path_modes.png"), _render_ease(folder / "path_ease.png"), _render_wagons(folder / "path_wagons.png")]


def _render_modes(file):
    scene = _new_scene((0.42, 0.50, 0.60))
    body = _build_aeroplane(scene)
    # All copies first: a follower's copy would be a follower.
    fleet = [body] + [_duplicate(body) for _ in range(PLANES * len(LANES) - 1)]
    for index, (label, mode) in enumerate(LANES):
        x = (index - (len(LANES) - 1) / 2) * LANE_WIDTH
        course = _add_curve(f"Course {label}", COURSE, x, tilt=(mode == 'TILT'))
        planes = fleet[index * PLANES : (index + 1) * PLANES]
        bpy.ops.motus.path_train_add(
            objects=",".join(plane.name for plane in planes),
            curve=course.name,
            gap=GAP,
            timing='SPEED',
            speed=SPEED,
            offset=GAP * (PLANES - 0.5),
            orientation=mode,
            forward_axis='POS_Y',
            up_axis='POS_Z',
        )
        _add_label(label, (x, -6.0, 1.0), 2.5, CHALK, tilt=math.radians(42))
    _add_floor((0.20, 0.34, 0.36, 1.0))
    _add_sun((math.radians(48), 0, math.radians(35)), 2.6)
    _add_camera(scene, (0.0, -66.0, 66.0), (0.0, 30.0, 0.0), lens=26)
    return _render(scene, file, (1280, 640))


def _render_ease(file):
    """The distance (thick) and the speed (thin) over time, for three settings of ease."""
    native = support.addon("core.native").module
    scene = _new_scene((1.0, 1.0, 1.0))
    u = np.linspace(0.0, 1.0, 241)
    for index, (ease_in, ease_out) in enumerate(((0.0, 0.0), (0.3, 0.3), (0.6, 0.1))):
        left = index * 5.2
        color = ACCENTS[index]
        _add_line([(left, 0, 0), (left + 4, 0, 0)], 0.012, INK)
        _add_line([(left, 0, 0), (left, 4, 0)], 0.012, INK)
        distance = native.ease(u, ease_in, ease_out)
        speed = native.ease_derivative(u[1:-1], ease_in, ease_out)
        _add_line([(left + 4 * a, 3.4 * d, 0.02) for a, d in zip(u, distance)], 0.045, color)
        _add_line([(left + 4 * a, 1.7 * v, 0.01) for a, v in zip(u[1:-1], speed)], 0.016, color)
        _add_label(f"in {ease_in:g}, out {ease_out:g}", (left + 2.0, -0.62, 0.0), 0.42)
    camera = _add_camera(scene, (7.2, 1.75, 10.0), (7.2, 1.75, 0.0), lens=50)
    camera.data.type = 'ORTHO'
    camera.data.ortho_scale = 16.2
    return _render(scene, file, (1280, 480), samples=32)


def _render_wagons(file):
    """Wagons in an S bend, seen from above: on one point of the path, on bogies, and beside the path in three lanes."""
    scene = _new_scene((1.0, 1.0, 1.0))
    for index, (label, wheelbase, sides) in enumerate(
        (("Wheelbase 0", 0.0, (0.0,)), ("Wheelbase 5", WHEELBASE, (0.0,)), ("Side -2, 0 and 2", 0.0, (-2.0, 0.0, 2.0)))
    ):
        left = index * WAGON_LANE
        course = _add_curve(f"Track {index}", [(x, y, -4.0) for x, y in BENDS], left, tilt=False)
        course.data.bevel_depth, course.data.resolution_u = 0.08, 48
        course.data.materials.clear()
        course.data.materials.append(_flat_material("Track", INK))
        long, wide = WAGON if len(sides) == 1 else CAR
        for side, color in zip(sides, ACCENTS):
            train = [_add_box(long, wide, color) for _ in range(WAGONS)]
            for wagon in train:
                for place in {0.5 * wheelbase, -0.5 * wheelbase} if side == 0.0 else ():
                    dot = _add_box(0.7, 0.7, INK)
                    dot.parent, dot.location = wagon, (0.0, place, 1.0)
            bpy.ops.motus.path_train_add(
                objects=",".join(wagon.name for wagon in train),
                curve=course.name,
                gap=WAGON_GAP,
                timing='MANUAL',
                offset=WAGON_GAP * (WAGONS - 0.25),
                wheelbase=wheelbase,
                side=side,
                height=-0.5,
            )
        _add_label(label, (left + 2.0, -3.0, 0.0), 1.5)
    camera = _add_camera(scene, (WAGON_LANE + 2.0, 10.5, 40.0), (WAGON_LANE + 2.0, 10.5, 0.0), lens=50)
    camera.data.type = 'ORTHO'
    camera.data.ortho_scale = 3.2 * WAGON_LANE
    return _render(scene, file, (1280, 600), samples=32)


def _add_box(long, wide, color):
    """A flat box along Y with its origin in its middle, of one colour; returns the object."""
    mesh = bpy.data.meshes.new("Wagon")
    mesh.from_pydata([(x * wide, y * long, 0.0) for x, y in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))], [], [(0, 1, 2, 3)])
    mesh.materials.append(_flat_material("Wagon", color))
    obj = bpy.data.objects.new("Wagon", mesh)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def _new_scene(sky):
    support.empty_scene()
    scene = bpy.context.scene
    world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*sky, 1.0)
    scene.world = world
    scene.view_settings.view_transform = 'Standard'
    return scene


def _build_aeroplane(scene):
    return support.addon("demo.flying.aeroplane").build(scene.collection)


def _duplicate(body):
    copy = body.copy()
    bpy.context.scene.collection.objects.link(copy)
    for child in body.children:
        part = child.copy()
        part.parent = copy
        bpy.context.scene.collection.objects.link(part)
    return copy


def _add_curve(name, points, x, tilt):
    data = bpy.data.curves.new(name, 'CURVE')
    data.dimensions = '3D'
    data.bevel_depth = 0.1
    spline = data.splines.new('BEZIER')
    spline.bezier_points.add(len(points) - 1)
    for index, (point, place) in enumerate(zip(spline.bezier_points, points)):
        point.co = Vector(place) + Vector((x, 0.0, 4.0))
        point.handle_left_type = point.handle_right_type = 'AUTO'
        point.tilt = TILT_STEP * index if tilt else 0.0
    data.materials.append(_flat_material(name, (0.9, 0.28, 0.1, 1.0)))
    obj = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def _add_line(points, radius, color):
    data = bpy.data.curves.new("Line", 'CURVE')
    data.dimensions = '3D'
    data.bevel_depth = radius
    spline = data.splines.new('POLY')
    spline.points.add(len(points) - 1)
    spline.points.foreach_set("co", [value for point in points for value in (*point, 1.0)])
    data.materials.append(_flat_material("Line", color))
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Line", data))


def _add_label(text, place, size, color=INK, tilt=0.0):
    data = bpy.data.curves.new(text, 'FONT')
    data.body = text
    data.size = size
    data.align_x = 'CENTER'
    data.materials.append(_flat_material("Label", color))
    obj = bpy.data.objects.new(text, data)
    obj.location = place
    obj.rotation_euler.x = tilt
    bpy.context.scene.collection.objects.link(obj)


def _flat_material(name, color):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    emission = nodes.new("ShaderNodeEmission")
    emission.inputs["Color"].default_value = color
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(emission.outputs[0], output.inputs["Surface"])
    return material


def _add_floor(color):
    mesh = bpy.data.meshes.new("Floor")
    side = 400.0
    mesh.from_pydata([(-side, -side, 0), (side, -side, 0), (side, side, 0), (-side, side, 0)], [], [(0, 1, 2, 3)])
    material = bpy.data.materials.new("Floor")
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = color
    shader.inputs["Roughness"].default_value = 0.9
    mesh.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Floor", mesh))


def _add_sun(rotation, strength):
    light = bpy.data.lights.new("Sun", 'SUN')
    light.energy = strength
    light.angle = math.radians(1.0)
    obj = bpy.data.objects.new("Sun", light)
    obj.rotation_euler = rotation
    bpy.context.scene.collection.objects.link(obj)


def _add_camera(scene, place, target, lens):
    data = bpy.data.cameras.new("Camera")
    data.lens = lens
    camera = bpy.data.objects.new("Camera", data)
    camera.location = place
    camera.rotation_euler = (Vector(target) - Vector(place)).to_track_quat('-Z', 'Y').to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera
    return camera


def _render(scene, file, size, samples=48):
    scene.render.engine = 'CYCLES'
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.render.filepath = str(file)
    scene.frame_set(1)
    bpy.ops.render.render(write_still=True)
    return file
