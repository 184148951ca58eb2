"""Base class and helpers of tests that set up a chroma key."""

import bpy
import numpy as np

import support
from chroma import chroma_cases as cases

compositor = support.addon("chroma.compositor")
settings = support.addon("chroma.settings")


def footage(folder, color=cases.GREEN, size=(60, 40), name="footage.png"):
    """A grey square in front of a screen."""
    picture = np.ones((size[1], size[0], 4)) * (*color, 1.0)
    if min(size) > 2:
        picture[size[1] // 4 : -size[1] // 4, size[0] // 3 : -size[0] // 3, :3] = 0.4
    return cases.written(picture, folder / name)


def state(scene):
    """All of a scene that a key changes."""
    render, view, tree = scene.render, scene.view_settings, compositor.tree_of(scene)
    if not scene.use_nodes and len(tree.nodes if tree else ()) == 2:
        tree = None  # what Blender leaves of one that it made
    return (
        render.resolution_x,
        render.resolution_y,
        render.resolution_percentage,
        render.pixel_aspect_x,
        render.pixel_aspect_y,
        scene.frame_start,
        scene.frame_end,
        render.fps,
        render.fps_base,
        view.view_transform,
        view.look,
        scene.use_nodes,
        view.exposure,
        view.gamma,
        view.use_curve_mapping,
        getattr(view, "use_white_balance", None),
        len(bpy.data.masks),
        None
        if tree is None
        else (
            tree.name,
            sorted(node.name for node in tree.nodes),
            sorted((link.from_node.name, link.from_socket.identifier, link.to_node.name, link.to_socket.identifier) for link in tree.links),
        ),
        len(bpy.data.node_groups),
        len(bpy.data.images),
        len(bpy.data.objects),
        len(bpy.data.materials),
        len(bpy.data.meshes),
        sorted(thing.name for thing in scene.objects),
    )


class SetUpTestCase(support.SceneTestCase):
    """Base of tests that set up a chroma key in the scene's compositor."""

    def set_up(self, **keywords):
        self.assertEqual(bpy.ops.motus.chroma_key_setup(**keywords), {'FINISHED'})
        return compositor.key_of(bpy.context.scene)

    def refused(self, sentence, **keywords):
        before = state(bpy.context.scene)
        with self.assertRaisesRegex(RuntimeError, sentence):
            bpy.ops.motus.chroma_key_setup(**keywords)
        self.assertEqual(state(bpy.context.scene), before)

    def value(self, key, keyword):
        return getattr(*settings.place(key, next(one for one in settings.OF_KEYING if one.keyword == keyword)))
