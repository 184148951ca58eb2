"""Every demo scene that is listed can be built, and has what `./motus demo` takes of it."""

import unittest

import bpy

import support
from demo import demo_cases


class DemoScenes(unittest.TestCase):
    @classmethod
    def tearDownClass(cls):
        support.empty_scene()

    def test_the_operator_offers_those_that_are_listed(self):
        offered = bpy.ops.motus.demo_scene.get_rna_type().properties["system"].enum_items
        listed = support.addon("demo.scenes").SCENES
        self.assertEqual(
            [(item.identifier, item.name, item.description) for item in offered],
            [(demo.identifier, demo.label, demo.description) for demo in listed],
        )

    def test_those_that_no_other_test_has_built(self):
        for demo in support.addon("demo.scenes").SCENES:
            if demo.identifier not in demo_cases.built:
                with self.subTest(scene=demo.name):
                    support.empty_scene()
                    self.assertEqual(demo_cases.build(demo.identifier), {'FINISHED'})
