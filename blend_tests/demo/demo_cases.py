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
