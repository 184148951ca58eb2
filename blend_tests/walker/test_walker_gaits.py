"""Gaits that are keyed: legs go over from one to the next, and feet that stand stay; strides by the body's height."""

import math
from unittest import mock

import bpy
import numpy as np

import solved_cases
import support
from walker import walker_cases as cases

CHANGE = 60
"""Frame from which on the second gait is keyed."""


def key(owner, name, *keys):
    """Key a setting of a walker. keys: (frame, value)."""
    for frame, value in keys:
        setattr(owner.motus.walker, name, value)
        owner.keyframe_insert(f"motus.walker.{name}", frame=frame)
    support.go_to(bpy.context.scene.frame_current)


def horse(**settings):
    """A body on four feet that goes ahead through all frames; (body, feet)."""
    body = support.link("Body")
    feet = [
        support.link(f"Foot {index}", location=(x, y, 0.0))
        for index, (x, y) in enumerate(((-0.2, 0.5), (0.2, 0.5), (-0.2, -0.5), (0.2, -0.5)))
    ]
    bpy.context.view_layer.update()
    given = {"gait": 'WALK', "stride": 0.4, "use_plane": True, **settings}
    assert bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), **given) == {'FINISHED'}
    support.key_places(body, {1: (0.0, 0.0, 0.0), 120: (0.0, 5.0, 0.0)})
    return body, feet


def given_to_library(owner):
    """Keywords that the native Walker is made with, now that something has changed."""
    native = support.addon("core.native").module
    with mock.patch.object(native, "Walker", wraps=native.Walker) as made:
        owner.update_tag()
        bpy.context.view_layer.update()
        owner.motus.walker.clearance += 0.001
        bpy.context.view_layer.update()
    return made.call_args.args, made.call_args.kwargs


class KeyedGaits(solved_cases.Solved, cases.WalkerTestCase):
    label = "Walker"

    def pattern(self, gait, body):
        rest = np.array([tuple(leg.rest) for leg in body.motus.walker.legs])
        return support.addon("core.native").module.walker_gait(gait, rest)

    def test_settings_arrive(self):
        body, _ = horse()
        body.scale = 3 * [2.0]
        body.motus.walker.transition = 2.0
        key(body, "gait", (1, 'WALK'), (CHANGE, 'GALLOP'), (100, 'WALK'))
        key(body, "stride", (1, 0.4), (100, 0.8))
        key(body, "cadence", (1, 1.0), (100, 2.0))
        (seconds, *_), given = given_to_library(body)
        frames = np.round(seconds / cases.seconds(1.0), 9)
        self.assertEqual(given["transition"], 2.0)
        self.assertEqual([frames[change[0]] for change in given["changes"]], [CHANGE, 100])
        for name, change in (("walk", (0, given["phases"], given["duty"])), ("gallop", given["changes"][0]), ("walk", given["changes"][1])):
            phases, duty = self.pattern(name, body)
            np.testing.assert_array_equal(change[1], phases)
            self.assertEqual(change[2], duty)
        curves = {curve.data_path: curve for curve in support.addon("core.blender.actions").fcurves(body)}
        for name, scale in (("stride", 2.0), ("cadence", 1.0)):
            wanted = [scale * curves[f"motus.walker.{name}"].evaluate(frame) for frame in frames]
            np.testing.assert_allclose(given[f"{name}s"], wanted, rtol=1e-6)
        self.assertNotIn("duties", given)
        body.motus.walker.use_duty = True
        key(body, "duty", (1, 0.7), (100, 0.4))
        _, given = given_to_library(body)
        np.testing.assert_allclose(given["duties"], [curves_of(body, "duty").evaluate(frame) for frame in frames], rtol=1e-6)
        self.assertWell(body)

    def test_custom_gait_among_others(self):
        body, _ = horse()
        for leg, phase in zip(body.motus.walker.legs, (0.1, 0.2, 0.3, 0.4)):
            leg.phase = phase
        body.motus.walker.duty = 0.45
        key(body, "gait", (1, 'WALK'), (CHANGE, 'OWN'))
        _, given = given_to_library(body)
        (change,) = given["changes"]
        np.testing.assert_allclose(change[1], (0.1, 0.2, 0.3, 0.4), rtol=1e-6)
        self.assertAlmostEqual(change[2], 0.45, places=6)

    def test_standing_feet_do_not_slide(self):
        body, _ = horse()
        key(body, "gait", (1, 'WALK'), (CHANGE, 'TROT'), (90, 'GALLOP'))
        key(body, "stride", (1, 0.4), (60, 0.6))
        self.assertStands(body, [1.0 + 0.5 * step for step in range(240)])
        self.assertWell(body)
        # Legs have the phases of the second gait before the third one comes.
        walker = cases.plan_of(body).walker
        steps, (phases, duty) = walker.steps, self.pattern("trot", body)
        self.assertEqual((duty, phases.tolist()), (0.5, [0.0, 0.5, 0.5, 0.0]))
        lifts = [
            steps["lift"][(steps["leg"] == leg) & (steps["lift"] > cases.seconds(80)) & (steps["lift"] < cases.seconds(89))]
            for leg in range(4)
        ]
        for leg, other in ((0, 3), (1, 2)):
            np.testing.assert_allclose(lifts[leg], lifts[other], atol=1e-9)

    def test_one_plan_for_all_frames(self):
        body, _ = horse()
        key(body, "gait", (1, 'WALK'), (CHANGE, 'PACE'))
        key(body, "cadence", (1, 1.0), (100, 2.0))
        frames = sorted(set(cases.OFF_THE_FRAMES))
        played = dict(zip(frames, cases.over(frames, lambda: cases.places(body))))
        native = support.addon("core.native").module
        with mock.patch.object(native, "Walker", wraps=native.Walker) as made:
            for frame in cases.OFF_THE_FRAMES:
                support.go_to(frame)
                np.testing.assert_array_equal(cases.places(body), played[frame])
        self.assertEqual(made.call_count, 0)
        key(body, "cadence", (100, 3.0))
        self.assertTrue((cases.over(frames, lambda: cases.places(body)) != list(played.values())).any())

    def test_over_time(self):
        body, feet = horse()
        key(body, "gait", (1, 'WALK'), (CHANGE, 'CANTER'))
        key(body, "cadence", (1, 1.0), (100, 2.0))
        self.assertSolved(feet[1], 5e-5)

    def test_a_driven_setting_is_told(self):
        body, _ = horse()
        curve = body.driver_add("motus.walker.cadence")
        curve.driver.expression = "frame / 50"
        support.go_to(30)
        self.assertEqual(self.sentence(body), "A setting of the gait is not known ahead, and its feet do not step: key it, without drivers")
        body.driver_remove("motus.walker.cadence")
        body.motus.walker.cadence = 1.5
        support.go_to(31)
        self.assertWell(body)

    def test_keys_out_of_range(self):
        body, _ = horse()
        key(body, "stride", (1, 0.4), (100, 1e9))
        self.assertEqual(self.sentence(body), "Stride is outside of what a walk can be planned by")


def curves_of(owner, name):
    return next(curve for curve in support.addon("core.blender.actions").fcurves(owner) if curve.data_path == f"motus.walker.{name}")


class NaturalStrides(cases.WalkerTestCase):
    def test_settings_arrive(self):
        body, _ = horse(use_natural=True, hip_height=0.9)
        body.scale = 3 * [2.0]
        _, given = given_to_library(body)
        self.assertAlmostEqual(given["hip_height"], 1.8, places=6)
        body.motus.walker.use_natural = False
        _, given = given_to_library(body)
        self.assertEqual(given["hip_height"], 0.0)

    def test_the_height_of_legs(self):
        spider = cases.spider(use_natural=True)
        legs = spider.motus.walker.legs
        _, given = given_to_library(spider)
        self.assertAlmostEqual(given["hip_height"], sum(leg.hip[2] - leg.rest[2] for leg in legs) / len(legs), places=6)
        self.assertGreater(given["hip_height"], 0.01)

    def test_without_a_height(self):
        body, _ = horse(use_natural=True)
        self.assertEqual(self.sentence(body), "Natural Stride has no height to go by: set Hip Height")

    def test_readouts(self):
        """On a slope of 1 in 5, at 1.5 m/s over ground."""
        body, _ = horse(use_natural=True, hip_height=0.8)
        for frame in (1, 120):
            y = 1.5 * (frame - 1) / 24.0
            support.key_places(body, {frame: (0.0, y, 0.2 * y)})
        for curve in support.addon("core.blender.actions").fcurves(body):
            for point in curve.keyframe_points:
                point.interpolation = 'LINEAR'
        support.go_to(60)
        panel = support.addon("walker.panel")
        shown = {one.text: one.value for one in panel._of_the_pace(bpy.context, body)}
        speed = 1.5 * math.hypot(1.0, 0.2)
        self.assertEqual(shown["Speed"], f"{speed:.2f} m/s")
        self.assertEqual(shown["Froude Number"], f"{speed**2 / (9.81 * 0.8):.2f}")
        self.assertEqual(shown["Speed at Ease"], f"{math.sqrt(0.25 * 9.81 * 0.8) * math.exp(-3.5 * 0.2):.2f} m/s")
        body.motus.walker.use_natural = False
        self.assertEqual(panel._of_the_pace(bpy.context, body), [])

    def test_speed_at_ease(self):
        pace = support.addon("walker.pace")
        level = pace.at_ease(0.9, 0.0)
        self.assertAlmostEqual(level, math.sqrt(0.25 * 9.81 * 0.9))
        self.assertAlmostEqual(pace.at_ease(0.9, -0.05) / level, 6.0 / 5.0366, places=4)
        self.assertEqual(pace.at_ease(0.9, math.inf), 0.0)
        self.assertAlmostEqual(pace.at_ease(0.9, 0.3), pace.at_ease(0.9, -0.4))
