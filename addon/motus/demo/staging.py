"""What the demo's scenes are sorted into."""

import bpy


def new_collection(scene, name):
    """A collection of the scene's own, empty."""
    collection = bpy.data.collections.new(f"Motus {name}")
    scene.collection.children.link(collection)
    return collection
