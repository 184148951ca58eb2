"""What the panels of snow show: the rows that matter, what was recorded, and what is known over time."""

import bpy

import support
from core.test_habits import Layout
from snow.snow_cases import MANY, SnowTestCase
from support import key_places


class Panels(SnowTestCase):
    def drawn(self, name):
        """What a part of the panel shows of the active emitter."""
        layout = Layout()
        getattr(support.addon("snow.panel"), f"draw_{name}")(layout, bpy.context)
        return layout

    def test_the_emitter(self):
        emitter = self.add(**MANY)
        for shape, extent in (
            ('SQUARE', ["emitter_radius", "emitter_velocity", "use_local", "use_scale"]),
            ('CONE', ["emitter_radius", "cone_angle", "emitter_velocity", "use_local", "use_scale"]),
            ('SURFACE', ["surface", "emitter_velocity", "use_local", "use_scale"]),
            ('CAMERA', ["camera", "closest", "farthest"]),
        ):
            emitter.motus.snow.shape = shape
            self.assertEqual(self.drawn("emitter").named("prop"), ["shape", *extent])

    def test_a_loop_and_a_keyed_rate(self):
        emitter = self.add(**MANY)
        self.assertEqual(self.drawn("loop").named("prop"), [])
        self.assertEqual(self.drawn("loop").named("operator"), ["motus.snow_loop"])
        self.assertIn("start_frame", self.drawn("main").named("prop"))
        self.assertEqual(bpy.ops.motus.snow_loop(object=emitter.name), {'FINISHED'})
        self.assertEqual(self.drawn("loop").named("prop"), ["loop_start", "loop_end"])
        shown = self.drawn("main")
        self.assertNotIn("start_frame", shown.named("prop"))
        self.assertNotIn("read from keys", " ".join(shown.named("label")))
        emitter.keyframe_insert("motus.snow.rate", frame=1)
        self.assertIn("read from keys", " ".join(self.drawn("main").named("label")))

    def test_colliders(self):
        emitter = self.add(**MANY)
        self.assertEqual(self.drawn("landing").named("operator"), [])
        roof = self.mesh("Roof", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        key_places(roof, {1: (0.0, 0.0, 0.0), 30: (1.0, 0.0, 0.0)})
        emitter.motus.snow.collider = roof
        self.assertEqual(self.drawn("landing").named("operator"), ["motus.snow_colliders_record"])
        bpy.context.scene.frame_set(7)
        bpy.ops.motus.snow_colliders_record(object=emitter.name)
        shown = self.drawn("landing")
        self.assertEqual(shown.named("operator"), ["motus.snow_colliders_clear"])
        self.assertIn("As they were on frame 7", " ".join(shown.named("label")))

    def test_the_radius_of_what_is_flat_counts_no_height(self):
        emitter = self.add(emitter_radius=1.0)
        value = support.addon("snow.handles").value
        for shape, radius in (('SQUARE', 1.0), ('DISC', 1.0), ('BOX', 3.0)):
            emitter.motus.snow.shape = shape
            self.assertAlmostEqual(value(emitter.motus.snow, "emitter_radius", (-1.0, 0.0, 3.0)), radius)

    def test_wind_over_time(self):
        emitter = self.add(drag=1.0, **MANY)
        self.assertEqual(self.drawn("air").named("label"), [])
        emitter.keyframe_insert("motus.snow.wind", frame=1)
        emitter.motus.snow.wind = 1.0, 0.0, 0.0
        emitter.keyframe_insert("motus.snow.wind", frame=9)
        self.assertIn("read from keys", " ".join(self.drawn("air").named("label")))
        emitter.driver_add("motus.snow.wind", 1).driver.expression = "frame"
        shown = self.drawn("air")
        self.assertIn("Needs recording", " ".join(shown.named("label")))
        self.assertEqual(shown.named("operator"), ["motus.track_record"])
