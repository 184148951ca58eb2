"""Make the scenes and collections of the demo."""

import bpy


def new_scene(context, name, frames_per_second, last_frame=250):
    """Make an empty scene and show it in the window at its first frame. Returns the scene."""
    scene = bpy.data.scenes.new(name)
    context.window.scene = scene
    scene.render.fps = frames_per_second
    scene.render.resolution_x, scene.render.resolution_y = 1280, 720
    scene.frame_start, scene.frame_end = 1, last_frame
    scene.frame_set(1)
    return scene


def new_collection(scene, name):
    """Make an empty collection in a scene. Returns the collection."""
    collection = bpy.data.collections.new(f"Motus {name}")
    scene.collection.children.link(collection)
    return collection
