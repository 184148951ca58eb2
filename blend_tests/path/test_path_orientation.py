"""Follow Path's orientation modes on the object: axes, roll, own rotation, influence."""

import math

import bpy
import numpy as np
from mathutils import Euler

from path.path_cases import PathTestCase, axis, circle_knots

UP = np.array((0.0, 0.0, 1.0))


class Modes(PathTestCase):
    def assertAxis(self, car, letter, wanted, frame=None, places=5):
        found = axis(self.at(car, frame), letter)
        self.assertAlmostEqual(np.abs(found - wanted).max(), 0.0, places=places, msg=f"{letter} is {found}")

    def tangent(self, car, frame):
        """Direction of travel by central difference."""
        step = self.place(car, frame + 0.05) - self.place(car, frame - 0.05)
        return step / np.linalg.norm(step)

    def test_forward_axis_lies_on_the_tangent(self):
        self.cubic()
        for mode in ('WORLD_UP', 'MINIMAL', 'BANKING', 'CURVATURE', 'TILT'):
            car = self.follow(orientation=mode, duration=10.0)
            for frame in (20, 110, 200.5):
                with self.subTest(mode=mode, frame=frame):
                    self.assertAxis(car, "Y", self.tangent(car, frame), frame, places=3)

    def test_axes_on_one_line_set_by_hand(self):
        self.cubic()
        car = self.follow()
        car.motus.path.up_axis = 'NEG_Y'
        self.assertIn("perpendicular", self.sentence(car))

    def test_every_pair_of_axes(self):
        self.cubic()
        self.link("Car")
        for forward in ('POS_X', 'POS_Y', 'POS_Z', 'NEG_X', 'NEG_Y', 'NEG_Z'):
            for up in ('POS_X', 'POS_Y', 'POS_Z', 'NEG_X', 'NEG_Y', 'NEG_Z'):
                if forward[-1] == up[-1]:
                    self.assertRefused(
                        "perpendicular", bpy.ops.motus.path_follow_add, object="Car", curve="Course", forward_axis=forward, up_axis=up
                    )
                    continue
                car = self.follow(forward_axis=forward, up_axis=up, orientation='WORLD_UP', duration=10.0)
                with self.subTest(forward=forward, up=up):
                    self.assertIsNone(self.sentence(car, 110))
                    along = self.tangent(car, 110)
                    self.assertAxis(car, _letter(forward), along, 110, places=3)
                    level = UP - along * along[2]
                    self.assertAxis(car, _letter(up), level / np.linalg.norm(level), places=3)

    def test_none_keeps_the_own_rotation(self):
        self.cubic()
        car = self.link("Car")
        car.rotation_euler = 0.3, -0.4, 1.2
        car.scale = 1.0, 2.0, 3.0
        self.follow(orientation='NONE')
        found = self.at(car, 50)
        self.assertLess(_angle(found.to_quaternion(), Euler((0.3, -0.4, 1.2)).to_quaternion()), 1e-3)
        self.assertTrue(np.allclose(found.to_scale(), (1.0, 2.0, 3.0), atol=1e-6))
        car.motus.path.orientation = 'WORLD_UP'
        self.assertAxis(car, "Y", self.tangent(car, 50), 50, places=3)
        self.assertTrue(np.allclose(self.at(car, 50).to_scale(), (1.0, 2.0, 3.0), atol=1e-6))

    def roll(self, car, frame):
        """Angle of the up axis from world up, about the direction of travel: positive to the left."""
        matrix = self.at(car, frame)
        left = np.cross(UP, axis(matrix, "Y"))
        return math.atan2(axis(matrix, "Z") @ left, axis(matrix, "Z") @ UP)

    def circling(self, radius, **keywords):
        self.bezier(circle_knots(radius), cyclic=True)
        return self.follow(timing='SPEED', speed=10.0, extend='LOOP', orientation='BANKING', **keywords)

    def test_bank_is_the_turn_of_an_aircraft(self):
        car = self.circling(20.0)
        # 10 m/s on a radius of 20 m, anticlockwise; four cubics are a circle to 0.6 % of curvature.
        self.assertAlmostEqual(self.roll(car, 30), math.atan(100.0 / (20.0 * 9.81)), delta=4e-3)
        car.motus.path.bank_strength = 2.0
        self.assertAlmostEqual(self.roll(car, 30), math.atan(200.0 / (20.0 * 9.81)), delta=6e-3)
        car.motus.path.bank_strength = -1.0
        self.assertAlmostEqual(self.roll(car, 30), -math.atan(100.0 / (20.0 * 9.81)), delta=4e-3)
        car.motus.path.bank_strength = 1.0
        car.motus.path.gravity = 1.62
        self.assertAlmostEqual(self.roll(car, 30), math.atan(100.0 / (20.0 * 1.62)), delta=4e-3)

    def test_bank_limit(self):
        car = self.circling(5.0, bank_limit=math.radians(20.0))
        self.assertLessEqual(self.roll(car, 30), math.radians(20.01))
        self.assertGreater(self.roll(car, 30), math.radians(15.0))

    def test_bank_grows_with_the_keyed_speed(self):
        car = self.circling(20.0)
        for frame, speed in ((1, 5.0), (101, 15.0)):
            car.motus.path.speed = speed
            car.keyframe_insert("motus.path.speed", frame=frame)
        rolls = [self.roll(car, frame) for frame in (10, 50, 90)]
        self.assertLess(rolls[0], rolls[1])
        self.assertLess(rolls[1], rolls[2])
        speed = self.output(car, "speed", 50)
        self.assertAlmostEqual(rolls[1], math.atan(speed**2 / (20.0 * 9.81)), delta=6e-3)

    def test_bank_smoothing_leans_before_the_bend(self):
        knots = [((-9, 0, 0), (0, 0, 0), (9, 0, 0)), ((10, 0, 0), (20, 0, 0), (25, 0, 0)), ((30, 5, 0), (30, 10, 0), (30, 20, 0))]
        self.bezier(knots, "Bend")
        sharp = self.follow("Sharp", "Bend", timing='SPEED', speed=10.0, orientation='BANKING')
        smooth = self.follow("Smooth", "Bend", timing='SPEED', speed=10.0, orientation='BANKING', bank_smoothing=12.0)
        before = 1 + 24 * 1.7  # at 17 m, three metres before the bend
        self.assertLess(abs(self.roll(sharp, before)), 1e-2)
        self.assertGreater(self.roll(smooth, before), 3e-2)

    def test_curvature_points_to_the_centre_or_away(self):
        self.bezier(circle_knots(5.0), cyclic=True)
        car = self.follow(orientation='CURVATURE', duration=10.0)
        inward = -self.place(car, 77) / 5.0
        self.assertAxis(car, "Z", inward, 77, places=2)
        car.motus.path.curvature_outward = True
        self.assertAxis(car, "Z", -inward, 77, places=2)

    def test_tilt(self):
        curve = self.line(10.0)
        for point, tilt in zip(curve.data.splines[0].bezier_points, (0.0, 1.0)):
            point.tilt = tilt
        car = self.follow(timing='MANUAL', orientation='TILT')
        for fraction in (0.0, 0.5, 1.0):
            car.motus.path.distance_factor = fraction
            found = axis(self.at(car), "Z")
            # Right-handed about +X, the direction of travel.
            self.assertAlmostEqual(math.atan2(-found[1], found[2]), fraction, places=4)

    def test_tilt_of_every_kind_of_spline(self):
        for index, options in enumerate(
            (
                {"kind": 'POLY'},
                {"kind": 'POLY', "use_cyclic_u": True},
                {"kind": 'NURBS', "use_endpoint_u": True},
                {"kind": 'NURBS', "use_cyclic_u": True},
            )
        ):
            corners = [(0, 0, 0), (4, 0, 0), (8, 2, 0), (8, 8, 0), (0, 8, 0)]
            curve = self.points(points=corners, name=f"Tilted {index}", **options)
            for point in curve.data.splines[0].points:
                point.tilt = 0.5
            car = self.follow(f"Car {index}", curve.name, timing='MANUAL', orientation='TILT', distance_factor=0.37)
            with self.subTest(**options):
                self.assertIsNone(self.sentence(car))
                self.assertAlmostEqual(axis(self.at(car), "Z")[2], math.cos(0.5), places=4)

    def test_tilt_of_a_mirrored_curve(self):
        """Up is the mirror image of the tilt along the curve that is not mirrored, as with Blender's own Follow Path."""
        curve = self.points('POLY', [(0, 0, 0), (0, 10, 0)])
        curve.data.twist_mode = 'Z_UP'
        for point in curve.data.splines[0].points:
            point.tilt = 0.5
        car, own = self.follow(timing='MANUAL', orientation='TILT', distance_factor=0.5), self.link("Own")
        follow = own.constraints.new('FOLLOW_PATH')
        follow.target, follow.use_fixed_location, follow.offset_factor, follow.use_curve_follow = curve, True, 0.5, True
        follow.forward_axis, follow.up_axis = 'FORWARD_Y', 'UP_Z'
        parent = self.link("Parent")
        curve.parent = parent
        for scale in ((1, 1, 1), (-1, 1, 1), (1, -1, 1), (-1, -1, 1), (-2, -2, -2), (-0.5, 0.5, 0.5)):
            for mirrored, still in ((curve, parent), (parent, curve)):
                mirrored.scale, still.scale = scale, (1, 1, 1)
                bpy.context.view_layer.update()
                with self.subTest(scale=scale, mirrored=mirrored.name):
                    # Along +Y the tilt turns up towards +X. Upside down the mirror image is half a turn from Z, which is up in the world.
                    side = math.sin(0.5) * math.copysign(1.0, scale[0] * scale[2])
                    wanted = np.array((side, 0.0, math.cos(0.5)))
                    image = self.at(own).to_3x3().col[2].normalized()
                    np.testing.assert_allclose(image, wanted * math.copysign(1.0, scale[2]), atol=1e-5)
                    np.testing.assert_allclose(axis(self.at(car), "Z"), wanted, atol=1e-5)

    def test_lag_trails_behind(self):
        self.bezier(circle_knots(5.0), cyclic=True)
        keywords = {"timing": 'SPEED', "speed": 5.0, "extend": 'LOOP', "orientation": 'WORLD_UP'}
        exact = self.follow("Exact", **keywords)
        angles = []
        for rate in (2.0, 20.0):
            lagging = self.follow("Lagging", lag_rate=rate, lag_by='CURVATURE', **keywords)
            self.assertPlace(lagging, self.place(exact, 100), 100)
            angles.append(_angle(self.at(lagging, 100).to_quaternion(), self.at(exact, 100).to_quaternion()))
        # A target that turns at v / R, trailed at rate / R: behind by v / rate radians.
        self.assertAlmostEqual(angles[1], 5.0 / 20.0, delta=0.02)
        self.assertGreater(angles[0], angles[1])


class Influence(PathTestCase):
    def test_influence_of_one_half_is_half_way(self):
        self.line(10.0)
        car = self.link("Car")
        car.location = 0.0, 6.0, 0.0
        self.follow(timing='MANUAL', distance_factor=0.4, influence=0.5)
        self.assertPlace(car, np.array((2.0, 3.0, 0.0)))

    def test_keyed(self):
        self.line(10.0)
        car = self.link("Car")
        car.location = 0.0, 6.0, 0.0
        self.follow(timing='MANUAL', distance_factor=0.4)
        for frame, value in ((1, 0.0), (21, 1.0)):
            car.motus.path.influence = value
            car.keyframe_insert("motus.path.influence", frame=frame)
        self.assertPlace(car, np.array((4.0, 0.0, 0.0)), 21)
        self.assertPlace(car, np.array((0.0, 6.0, 0.0)), 1)
        self.assertPlace(car, np.array((2.0, 3.0, 0.0)), 11, tolerance=1e-6)

    def test_driven_setting(self):
        self.line(10.0)
        car = self.follow(timing='MANUAL')
        car.motus.path.driver_add("distance_factor").driver.expression = "frame/100"
        bpy.ops.motus.refresh(object="Car", system="path")
        for frame in (60, 10, 33.5):
            self.assertPlace(car, np.array((frame / 10.0, 0.0, 0.0)), frame, tolerance=1e-6)

    def test_output_drives_another_object(self):
        self.line(10.0)
        car, meter = self.follow(timing='SPEED', speed=2.0), self.link("Meter")
        driver = meter.driver_add("location", 2).driver
        variable = driver.variables.new()
        variable.name = "distance"
        variable.targets[0].id = car
        variable.targets[0].data_path = self.wiring.output_path(self.system, "distance")
        driver.expression = "distance"
        for frame in (61, 13, 37):
            self.assertAlmostEqual(self.place(meter, frame)[2], (frame - 1) / 12.0, places=5)


def _letter(identifier):
    return identifier.replace("POS_", "").replace("NEG_", "-")


def _angle(first, second):
    difference = first.rotation_difference(second).angle
    return min(difference, math.tau - difference)
