"""Footage of a subject whose alpha is known, in front of a screen that is lit unevenly and noisy; and what comes out of a key."""

import functools

import bpy
import numpy as np

import support

WIDTH, HEIGHT = 192, 128
GREEN, BLUE = (0.06, 0.42, 0.09), (0.05, 0.1, 0.5)
FRAMES = 3


def encoded(linear):
    """sRGB's values of scene-linear ones."""
    linear = np.clip(linear, 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1.0 / 2.4) - 0.055)


def over(subject, background):
    """A premultiplied subject over opaque colours."""
    found = np.ones_like(subject)
    found[..., :3] = subject[..., :3] + (1.0 - subject[..., 3:]) * background
    return found


def screen(color, noise=0.015, dark=0.3):
    """A screen that is darker to the right and below, with noise."""
    x, y = np.meshgrid(np.linspace(0.0, 1.0, WIDTH), np.linspace(0.0, 1.0, HEIGHT))
    light = 1.0 + 0.5 * dark - dark * (0.7 * x + 0.3 * (1.0 - y))
    found = light[..., None] * np.asarray(color)
    return np.clip(found + np.random.default_rng(7).normal(0.0, noise, found.shape), 0.0, 1.0)


@functools.cache
def subject():
    """(rows, columns, 4) of a rendered figure, premultiplied, scene-linear: round, with thin parts, and out of focus nowhere."""
    support.empty_scene()
    scene = bpy.context.scene
    for place, size, color in (((0.0, 0.0, 0.6), 0.55, (0.7, 0.45, 0.35)), ((0.0, 0.0, -0.6), 0.8, (0.5, 0.1, 0.12))):
        bpy.ops.mesh.primitive_uv_sphere_add(location=place, radius=size, segments=48, ring_count=24)
        _paint(color)
    bpy.ops.mesh.primitive_cube_add(location=(1.0, 0.0, 0.1), scale=(0.8, 0.03, 0.02), rotation=(0.0, -0.5, 0.0))
    _paint((0.2, 0.2, 0.22))
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location, camera.rotation_euler = (0.2, -6.0, 0.1), (1.5708, 0.0, 0.0)
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", 'SUN'))
    sun.data.energy, sun.rotation_euler = 2.0, (0.7, 0.3, 0.0)
    for one in (camera, sun):
        scene.collection.objects.link(one)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("World")
    scene.world.color = (0.3, 0.3, 0.3)
    scene.render.engine = 'CYCLES'
    scene.cycles.samples, scene.cycles.use_denoising = 24, False
    scene.render.film_transparent = True
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = WIDTH, HEIGHT, 100
    return rendered(scene, "subject")


def _paint(color):
    material = bpy.data.materials.new("Paint")
    if not material.use_nodes:
        material.use_nodes = True
    material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (*color, 1.0)
    material.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.8
    bpy.context.object.data.materials.append(material)


def rendered(scene, name):
    """(rows, columns, 4) of the scene's picture, scene-linear."""
    image_settings = scene.render.image_settings
    image_settings.file_format, image_settings.color_depth, image_settings.color_mode = 'OPEN_EXR', '32', 'RGBA'
    scene.render.filepath = f"{bpy.app.tempdir}{name}.exr"
    bpy.ops.render.render(write_still=True, scene=scene.name)
    image = bpy.data.images.load(scene.render.filepath)
    found = values(image)
    bpy.data.images.remove(image)
    return found


def values(image):
    """(rows, columns, 4) of an image's pixels."""
    found = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(found)
    return found.reshape(image.size[1], image.size[0], -1)


def written(picture, path, kind='PNG'):
    """Write scene-linear colours as a file of 8 bits; gives its path."""
    image = bpy.data.images.new("Footage", picture.shape[1], picture.shape[0], alpha=True)
    stored = np.array(picture, np.float32)
    stored[..., :3] = encoded(picture[..., :3])
    image.pixels.foreach_set(stored.ravel())
    image.file_format = kind
    image.filepath_raw = str(path)
    image.save()
    bpy.data.images.remove(image)
    return str(path)


def filmed(picture, folder):
    """The same as a film of H.264, whose colours have half the pixels across and down; gives its path."""
    return filmed_of([picture] * FRAMES, folder, 24)


def filmed_of(pictures, folder, fps):
    """A film of H.264 of these pictures, of so many a second; gives its path."""
    scene = bpy.data.scenes.new("Film")
    for number, picture in enumerate(pictures, 1):
        written(picture, folder / f"frame_{number:03d}.png")
    image = bpy.data.images.load(str(folder / "frame_001.png"))
    scene.render.resolution_x, scene.render.resolution_y = image.size
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = 'Standard'
    scene.frame_start, scene.frame_end, scene.render.fps = 1, len(pictures), fps
    image.source = 'SEQUENCE'
    compositor = support.addon("chroma.compositor")
    nodes = support.addon("core.blender.node_groups")
    tree = compositor.prepared(scene, scene.motus.chroma)
    node = nodes.add_node(tree, "CompositorNodeImage")
    node.image, node.frame_duration, node.frame_start = image, len(pictures), 1
    nodes.link(tree, node.outputs["Image"], compositor.outlet(tree))
    for other in [other for other in tree.nodes if other.type == 'R_LAYERS']:
        tree.nodes.remove(other)
    path = render_film(scene, folder)
    bpy.data.scenes.remove(scene)
    bpy.data.images.remove(image)
    return path


def render_film(scene, folder):
    """Render a scene's frames as a film of H.264; gives its path."""
    path, settings = str(folder / "film.mp4"), scene.render.image_settings
    if "media_type" in settings.bl_rna.properties:
        settings.media_type = 'VIDEO'
    settings.file_format = 'FFMPEG'
    scene.render.ffmpeg.format, scene.render.ffmpeg.codec, scene.render.ffmpeg.constant_rate_factor = 'MPEG4', 'H264', 'HIGH'
    scene.render.filepath = path
    bpy.ops.render.render(animation=True, scene=scene.name)
    return path


def keyed(view, name="keyed"):
    """What the scene's key shows in a view, scene-linear."""
    scene = bpy.context.scene
    scene.motus.chroma.view = view
    return rendered(scene, name)


def eroded(matte, reach):
    """Whether all pixels so far away are opaque."""
    found = matte > 0.999
    for _ in range(reach):
        grown = found.copy()
        grown[1:] &= found[:-1]
        grown[:-1] &= found[1:]
        grown[:, 1:] &= found[:, :-1]
        grown[:, :-1] &= found[:, 1:]
        found = grown
    return found
