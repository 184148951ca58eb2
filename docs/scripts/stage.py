"""What the manual's pictures share: an empty scene, floor, lights, camera, labels, and the render."""

import math

import bpy
from mathutils import Vector

import support

INK = (0.012, 0.016, 0.028, 1.0)


def new_scene(sky, strength=1.0):
    """An empty scene under an even sky."""
    support.empty_scene()
    scene = bpy.context.scene
    world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*sky, 1.0)
    background.inputs["Strength"].default_value = strength
    scene.world = world
    scene.view_settings.view_transform = 'Standard'
    return scene


def link(obj):
    """Put an object into the scene."""
    bpy.context.scene.collection.objects.link(obj)
    return obj


def flat_material(name, color):
    """A colour that no light changes."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    emission = nodes.new("ShaderNodeEmission")
    emission.inputs["Color"].default_value = color
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(emission.outputs[0], output.inputs["Surface"])
    return material


def glossy_material(name, color, roughness=0.5, metallic=0.0):
    """An ordinary surface."""
    material = bpy.data.materials.new(name)
    material.diffuse_color = color  # what a viewport without lights shows
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = color
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Metallic"].default_value = metallic
    return material


def add_text(text, place, size, color=INK, align='CENTER', upright=True):
    """A line of text that faces -Y where it stands upright, else Z."""
    data = bpy.data.curves.new(text, 'FONT')
    data.body = text
    data.size = size
    data.align_x = align
    data.materials.append(flat_material("Text", color))
    obj = link(bpy.data.objects.new(text, data))
    obj.location = place
    obj.rotation_euler.x = math.radians(90.0) if upright else 0.0
    return obj


def add_tube(points, radius, material):
    """A round line through points."""
    data = bpy.data.curves.new("Line", 'CURVE')
    data.dimensions = '3D'
    data.bevel_depth = radius
    data.use_fill_caps = True
    spline = data.splines.new('POLY')
    spline.points.add(len(points) - 1)
    spline.points.foreach_set("co", [value for point in points for value in (*point, 1.0)])
    data.materials.append(material)
    return link(bpy.data.objects.new("Line", data))


def add_floor(material, side=200.0):
    """A wide floor at height 0."""
    mesh = bpy.data.meshes.new("Floor")
    mesh.from_pydata([(-side, -side, 0), (side, -side, 0), (side, side, 0), (-side, side, 0)], [], [(0, 1, 2, 3)])
    mesh.materials.append(material)
    return link(bpy.data.objects.new("Floor", mesh))


def add_sun(rotation, strength, softness=1.0):
    """A sun; rotation in radians, softness in degrees."""
    light = bpy.data.lights.new("Sun", 'SUN')
    light.energy = strength
    light.angle = math.radians(softness)
    obj = link(bpy.data.objects.new("Sun", light))
    obj.rotation_euler = rotation


def add_camera(scene, place, target, lens=50.0, width=None):
    """A camera; with a width, in metres, without perspective."""
    data = bpy.data.cameras.new("Camera")
    data.lens = lens
    if width:
        data.type = 'ORTHO'
        data.ortho_scale = width
    camera = link(bpy.data.objects.new("Camera", data))
    camera.location = place
    camera.rotation_euler = (Vector(target) - Vector(place)).to_track_quat('-Z', 'Y').to_euler()
    scene.camera = camera
    return camera


def render(scene, file, size, samples=48):
    """Render the first frame into a file."""
    scene.render.engine = 'CYCLES'
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.render.filepath = str(file)
    scene.frame_set(1)
    bpy.ops.render.render(write_still=True)
    return file
