"""What the tests of the demo scenes share: each is built by its operator, and looked at then for what `./motus demo` takes of it."""

import unittest

import bpy

import support

CHECKS = unittest.TestCase()
built = set()
"""Identifiers of the scenes that this run has built."""


def build(identifier):
    """Builds the demo scene and shows it; returns what the operator did. Raises where its cameras and times are not there."""
    result = bpy.ops.motus.demo_scene(system=identifier)
    built.add(identifier)
    demo = next(one for one in support.addon("demo.scenes").SCENES if one.identifier == identifier)
    scene = bpy.context.window.scene
    seconds = (scene.frame_end - scene.frame_start + 1) * scene.render.fps_base / scene.render.fps
    for camera, moment in demo.stills:
        CHECKS.assertEqual(scene.objects[camera].type, 'CAMERA')
        CHECKS.assertTrue(0.0 <= moment <= seconds, moment)
    start, end = demo.film
    CHECKS.assertTrue(0.0 <= start < end <= seconds, demo.film)
    return result


def show_shapes(scene, are_shown):
    """Whether modifiers and snow are evaluated: they are what most of a frame's time goes into, and tests of transforms look at none of them."""
    for thing in scene.objects:
        if thing.motus.snow.is_active or thing.motus.snow_cover.is_active:
            thing.hide_viewport = not are_shown
        for modifier in thing.modifiers:
            modifier.show_viewport = are_shown
