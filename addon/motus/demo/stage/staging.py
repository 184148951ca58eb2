"""What the demo's scenes begin with, and are sorted into."""

import bpy


def new_scene(context, name, frames_per_second, last_frame=250):
    """An empty scene, shown in the window, on its first frame."""
    scene = bpy.data.scenes.new(name)
    context.window.scene = scene
    scene.render.fps = frames_per_second
    scene.render.resolution_x, scene.render.resolution_y = 1280, 720
    scene.frame_start, scene.frame_end = 1, last_frame
    scene.frame_set(1)
    return scene


def new_collection(scene, name):
    """A collection of the scene's own, empty."""
    collection = bpy.data.collections.new(f"Motus {name}")
    scene.collection.children.link(collection)
    return collection
