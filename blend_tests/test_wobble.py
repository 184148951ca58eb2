"""The toy along which docs/systems.md tells how to write a system: wired, drawn, baked, removed, and in Spanish."""

import dataclasses
from pathlib import Path

import bpy
import numpy as np

import support
import test_translations
import toy_wobble_system as wobble
from core.test_habits import drawn

native = support.addon("core.native")
FRAMES = (1, 7, 13.5, 20)


def swell(context, amount, **_):
    """Solver that makes the owner wider, and higher still."""
    context.scales[0] = 1.0 + amount, 1.0, 1.0 + 2.0 * amount


SWELLING = dataclasses.replace(wobble.SYSTEM, channels=lambda settings: frozenset({"scale"}), solve=swell, problems=())


class ScaleTest(support.SceneTestCase):
    """A system that declares channels, no groups, and drives scales alone."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        support.register_systems(SWELLING)
        cls.addClassCleanup(support.unregister_systems, SWELLING)

    def scale(self, owner):
        return support.evaluated(owner).matrix_world.to_scale()[:]

    def test_scales_multiply_the_own_ones_live_baked_and_opened(self):
        owner, wiring = self.link("Buoy"), support.addon("core.wiring")
        bpy.context.view_layer.objects.active = owner
        support.key(owner, "scale", {1: (2.0, 1.0, 0.5), 21: (4.0, 1.0, 0.5)})
        owner.motus.wobble.amount = 0.5
        wiring.attach(SWELLING, owner)
        self.go_to(21)
        np.testing.assert_allclose(self.scale(owner), (6.0, 1.0, 1.0), atol=1e-5)
        bpy.ops.motus.bake(frame_start=1, frame_end=21)
        self.go_to(1)
        np.testing.assert_allclose(self.scale(owner), (3.0, 1.0, 1.0), atol=1e-5)
        bpy.ops.motus.unbake()
        bpy.ops.wm.open_mainfile(filepath=self.save())
        owner = bpy.data.objects["Buoy"]
        for frame, wide in ((21, 6.0), (1, 3.0)):
            self.go_to(frame)
            np.testing.assert_allclose(self.scale(owner), (wide, 1.0, 1.0), atol=1e-5)
        bpy.ops.motus.wobble_remove()
        self.assertEqual((self.scale(owner), set(bpy.data.objects)), ((2.0, 1.0, 0.5), {owner}))


class WobbleTest(support.SceneTestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        support.register_systems(wobble.SYSTEM)
        cls.addClassCleanup(support.unregister_systems, wobble.SYSTEM)

    def setUp(self):
        super().setUp()
        self.owner = bpy.data.objects.new("Buoy", None)
        bpy.context.scene.collection.objects.link(self.owner)
        bpy.context.view_layer.objects.active = self.owner
        for frame, x in ((1, 2.0), (21, 4.0)):
            self.owner.location = x, 0.0, 1.0
            self.owner.keyframe_insert("location", frame=frame)
        for curve in support.addon("core.blender.actions").fcurves(self.owner):
            for key in curve.keyframe_points:
                key.interpolation = 'LINEAR'

    def places(self):
        found = []
        for frame in FRAMES:
            support.go_to(frame)
            found.append(self.owner.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.translation[:])
        return np.array(found)

    def expected(self, amount):
        """amount: how far the noise moves the owner, influence included."""
        fps = bpy.context.scene.render.fps / bpy.context.scene.render.fps_base
        noise = [[native.module.noise1(frame / fps * 3.0, 21 + axis) for axis in range(3)] for frame in FRAMES]
        return np.array([(2.0 + 0.1 * (frame - 1.0), 0.0, 1.0) for frame in FRAMES]) + amount * np.array(noise)

    def test_noise_on_top_of_keys_live_baked_and_removed(self):
        still = self.expected(0.0)
        bpy.ops.motus.wobble_add(amount=0.4, frequency=3.0, seed=7, influence=0.5)
        np.testing.assert_allclose(self.places(), self.expected(0.2), atol=1e-5)
        bpy.ops.motus.bake(frame_start=1, frame_end=21, step=0.5)
        self.assertTrue(self.owner.motus.wobble.is_baked)
        np.testing.assert_allclose(self.places(), self.expected(0.2), atol=1e-5)
        with self.assertRaisesRegex(RuntimeError, "baked"):
            bpy.ops.motus.wobble_remove()
        bpy.ops.motus.unbake()
        np.testing.assert_allclose(self.places(), self.expected(0.2), atol=1e-5)
        self.owner.motus.wobble.keyframe_insert("amount")
        bpy.ops.motus.wobble_remove()
        np.testing.assert_allclose(self.places(), still, atol=1e-5)
        self.assertEqual((set(bpy.data.objects), self.owner.is_property_set("motus")), ({self.owner}, False))
        self.assertEqual({curve.data_path for curve in support.addon("core.blender.actions").fcurves(self.owner)}, {"location"})
        with self.assertRaisesRegex(RuntimeError, "Buoy does not wobble"):
            bpy.ops.motus.wobble_remove()

    def test_keys_of_the_amount_count_and_the_other_numbers_have_none(self):
        bpy.ops.motus.wobble_add(frequency=3.0, seed=7)
        for frame, amount in ((1, 0.0), (21, 1.0)):
            self.owner.motus.wobble.amount = amount
            self.owner.keyframe_insert("motus.wobble.amount", frame=frame)
        for curve in support.addon("core.blender.actions").fcurves(self.owner):
            for key in curve.keyframe_points:
                key.interpolation = 'LINEAR'
        amounts = np.array([[(frame - 1.0) / 20.0] for frame in FRAMES])
        np.testing.assert_allclose(self.places(), self.expected(amounts), atol=1e-5)
        bpy.context.scene.frame_set(1)
        problem = support.addon("core.wiring").problem(wobble.SYSTEM, self.owner, bpy.context.evaluated_depsgraph_get())
        self.assertEqual(problem, wobble.NO_AMOUNT)
        for name in ("frequency", "seed"):
            self.assertFalse(self.owner.motus.wobble.bl_rna.properties[name].is_animatable)

    def test_panels_of_both_editors(self):
        adding = drawn(bpy.types.MOTUS_PT_sidebar)
        self.assertIn("motus.wobble_add", adding.named("operator"))
        self.assertIsNone(drawn(bpy.types.MOTUS_PT_wobble))
        with self.assertRaises(support.addon("core.refusals").Refused):  # its button is grey
            wobble.MOTUS_OT_wobble_remove.check_offer(bpy.context)
        bpy.ops.motus.wobble_add()
        wobble.MOTUS_OT_wobble_remove.check_offer(bpy.context)
        for name in ("MOTUS_PT_wobble", "MOTUS_PT_wobble_constraint"):
            self.assertEqual(drawn(getattr(bpy.types, name)).named("prop"), list(wobble.ROWS.names))
            self.assertEqual(drawn(getattr(bpy.types, f"{name}_actions")).named("operator"), ["motus.bake", "motus.wobble_remove"])

    def test_every_text_has_a_spanish_one(self):
        texts = {text for cls in wobble.SYSTEM.classes for text in test_translations.class_texts(cls)}
        texts |= set(test_translations.source_texts(Path(wobble.__file__).read_text(encoding="utf-8")))
        shared = {(context, text) for context, part in support.addon("translations.es").CONTEXTS.items() for text in part}
        own = {("*", text) for text in wobble.INTERFACE} | {("Operator", text) for text in wobble.OPERATORS}
        self.assertEqual({text for text in texts - shared - own if text[1] not in test_translations.UNTRANSLATED}, set())
        self.assertEqual(own - texts, set(), "translated, but not shown")
