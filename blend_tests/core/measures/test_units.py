"""A scene whose unit is no metre: what nobody gives is as many metres, metres a second, and so on, as in a scene of metres."""

import math

import bpy
from mathutils import Vector

from path.path_cases import PathTestCase, circle_knots

UNITS = 1.0, 0.01, 1000.0, 0.3048


class UnitsTestCase(PathTestCase):
    def use_unit(self, unit, system='METRIC'):
        self.setUp()
        self.scene.unit_settings.system = system
        self.scene.unit_settings.scale_length = unit


class Paths(UnitsTestCase):
    def lean(self, unit, **keywords):
        """Degrees by which 10 m/s lean round a bend of 20 m."""
        self.bezier(circle_knots(20.0 / unit), cyclic=True)
        plane = self.follow("Plane", timing='SPEED', orientation='BANKING', **keywords)
        middle = 1 + 24 * 2.5 * math.pi / 10.0 * 2.0  # of a quarter, where the curve is nearest to a circle
        return math.degrees((self.at(plane, middle).to_3x3() @ Vector((0, 0, 1))).angle((0, 0, 1)))

    def test_bank(self):
        wanted = math.degrees(math.atan2(10.0**2 / 20.0, 9.81))
        for unit in UNITS:
            self.use_unit(unit)
            with self.subTest(unit=unit):
                self.assertAlmostEqual(self.lean(unit, speed=10.0 / unit), wanted, delta=0.3)
        self.use_unit(0.01, 'NONE')  # Blender shows plain numbers
        self.assertAlmostEqual(self.lean(1.0, speed=10.0), wanted, delta=0.3)

    def test_speed(self):
        for unit in UNITS:
            self.use_unit(unit)
            self.line(1000.0 / unit)
            car = self.follow(timing='SPEED')
            with self.subTest(unit=unit):
                self.assertAlmostEqual(self.place(car, 49)[0] * unit, 10.0, places=3)

    def test_what_is_given_stays(self):
        self.use_unit(0.01)
        self.line(1000.0)
        car = self.follow(timing='SPEED', speed=5.0, gravity=9.81)
        self.assertEqual((car.motus.path.speed, round(car.motus.path.gravity, 5)), (5.0, 9.81))
        other = self.link("Other")
        other.motus.path.speed = 7.0
        self.follow("Other", timing='SPEED')
        self.assertEqual(other.motus.path.speed, 7.0)

    def test_one_that_is_there_stays(self):
        self.line(1000.0)
        car = self.follow(timing='SPEED')
        self.scene.unit_settings.scale_length = 0.01
        self.follow(offset=1.0)
        self.assertEqual((car.motus.path.speed, round(car.motus.path.gravity, 5)), (5.0, 9.81))

    def test_preset(self):
        self.use_unit(0.01)
        self.line(1000.0)
        car = self.follow()
        bpy.context.view_layer.objects.active = car
        bpy.ops.motus.path_preset_use(preset='AIRCRAFT')
        settings = car.motus.path
        self.assertAlmostEqual(settings.speed, 1200.0, places=3)
        self.assertAlmostEqual(settings.bank_smoothing, 200.0, places=3)
        self.assertAlmostEqual(settings.bank_limit, math.radians(70.0), places=5)

    def test_trains(self):
        self.use_unit(0.01)
        self.line(100000.0)
        self.link("A")
        self.link("B")
        bpy.ops.motus.path_train_add(objects="A,B", curve="Course", timing='SPEED', gap=200.0)
        self.assertAlmostEqual(bpy.data.objects["A"].motus.path.speed, 500.0, places=3)


class Pendulums(UnitsTestCase):
    """A rod of 1 m swings in 2 pi sqrt(1 m / g), whatever a unit is; so after half of that it is on the other side."""

    def swung(self, **keywords):
        bpy.ops.motus.pendulum_add(kind='SINGLE', angle1=0.05, location=(0, 0, 0), **keywords)
        pivot = bpy.context.object
        half = math.pi * math.sqrt(1.0 / 9.81)
        self.at(pivot, 1 + 24 * half)
        rod = next(child for child in pivot.children)
        bob = next(child for child in rod.children)
        place = self.at(bob).translation
        return math.atan2(place.x, -place.z), place.length

    def test_period(self):
        for unit in UNITS:
            self.use_unit(unit)
            angle, length = self.swung()
            with self.subTest(unit=unit):
                self.assertAlmostEqual(length * unit, 1.0, places=4)
                self.assertAlmostEqual(angle, -0.05, delta=2e-4)

    def test_gravity_that_was_set_in_the_scene_counts(self):
        self.use_unit(0.01)
        self.scene.gravity = 0.0, 0.0, -981.0
        angle, _ = self.swung()
        self.assertTrue(bpy.context.object.motus.pendulum.use_scene_gravity)
        self.assertAlmostEqual(angle, -0.05, delta=2e-4)

    def test_on_the_moon(self):
        self.use_unit(0.01)
        self.swung()
        bpy.ops.motus.pendulum_preset_use(preset='MOON')
        self.assertAlmostEqual(bpy.context.object.motus.pendulum.gravity, 162.0, places=3)

    def test_driver(self):
        for unit in UNITS:
            self.use_unit(unit)
            thing = self.link("Thing")
            bpy.ops.motus.driver_add(datablock="Thing", data_path="rotation_euler", index=0, function='PENDULUM', theta=0.05)
            self.scene.frame_set(0)
            frame = 24 * math.pi * math.sqrt(1.0 / 9.81)
            self.at(thing, frame)
            angle = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).rotation_euler[0]
            with self.subTest(unit=unit):
                self.assertAlmostEqual(angle, -0.05, delta=2e-4)
