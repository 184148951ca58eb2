"""What a walker is given that it cannot walk on, or with: it says so, and nothing is lost."""

import math
from unittest import mock

import bpy
import numpy as np

import support
from walker import walker_cases as cases


class NoGround(cases.WalkerTestCase):
    def test_without_any_feet_stand_at_their_height(self):
        spider = cases.spider(use_plane=False)
        found = cases.over((1, 120), lambda: cases.places(spider))
        np.testing.assert_allclose(found[:, :, 2], 0.0, atol=1e-6)
        self.assertWell(spider)

    def test_out_of_reach(self):
        land = cases.grid("Land", lambda x, y: np.where(y > 1.0, -5.0, 0.0))
        spider = cases.spider(ground=land.name)
        said = self.sentence(spider)
        self.assertRegex(said, r"^foot .* finds no ground within reach on frames \d+-\d+, and \d+ more problems$")
        self.assertTrue(np.isfinite(cases.over((1, 60, 120), lambda: cases.places(spider))).all())

    def test_faces_are_missing(self):
        land = support.link("Land", bpy.data.meshes.new("Land"))
        spider = cases.spider(ahead=0.0)
        spider.motus.walker.ground = land
        self.assertIn("has no faces", self.sentence(spider))

    def test_its_own_mesh(self):
        spider = cases.spider(ahead=0.0)
        spider.motus.walker.ground = bpy.data.objects["Spider Mesh"]
        self.assertEqual(self.sentence(spider), "Spider Mesh walks itself, and is no ground")

    def test_a_deleted_ground(self):
        land = cases.grid("Land", cases.waves)
        spider = cases.spider(ground=land.name)
        support.go_to(2)
        bpy.ops.object.select_all(action='DESELECT')
        land.select_set(True)
        bpy.context.view_layer.objects.active = land
        bpy.ops.object.delete()
        bpy.context.view_layer.update()
        support.go_to(3)
        self.assertIn("ground is gone", self.sentence(spider))
        standing = cases.places(spider)
        np.testing.assert_allclose(standing[:, 2], 0.0, atol=1e-5)

    def test_what_moves_is_left_out(self):
        land = cases.grid("Land", cases.waves)
        spider = cases.spider(ground=land.name)
        support.key_places(land, {1: (0.0, 0.0, 1.0), 50: (0.0, 0.0, 0.0)})
        bpy.context.view_layer.update()
        self.assertIn("may move", self.sentence(spider))
        support.go_to(1)
        np.testing.assert_allclose(cases.places(spider)[:, 2], 0.0, atol=1e-5)

    def test_a_walker_is_not_its_own_ground(self):
        scenery = bpy.data.collections.new("Scenery")
        self.scene.collection.children.link(scenery)
        spider = cases.spider(grounds="Scenery")
        hat = cases.grid("Hat", lambda x, y: 0.3 + 0.0 * x)
        hat.parent = spider
        for obj in (spider, bpy.data.objects["Spider Mesh"], hat):
            scenery.objects.link(obj)
        for _ in range(2):
            bpy.context.view_layer.update()
        ground = support.addon("walker.ground")
        self.assertEqual(ground.objects(spider.motus.walker), [])
        support.go_to(50)
        self.assertIn("has no faces", self.sentence(spider))
        swing = cases.plan_of(spider).walker.swing(cases.seconds(50))
        np.testing.assert_allclose(cases.places(spider)[swing == 0.0][:, 2], 0.0, atol=1e-5)

    def test_what_moves_with_the_feet_is_left_alone(self):
        spider = cases.spider(ahead=0.0)
        land = cases.grid("Land", lambda x, y: 0.0 * x)
        spider.motus.walker.ground = land
        constraint = land.constraints.new('COPY_LOCATION')
        constraint.target, constraint.subtarget = spider, "foot 1.L"
        bpy.ops.motus.refresh(object=spider.name, system="walker")
        self.assertIn("moves with what the walker drives", self.sentence(spider))

    @support.in_one_blender
    def test_a_large_ground_is_built_once(self):
        land = cases.grid("Land", cases.waves, count=708)
        self.assertGreater(2 * len(land.data.polygons), 999_000)
        native = support.addon("core.native").module
        with mock.patch.object(native, "WalkerGround", wraps=native.WalkerGround) as made:
            spider = cases.spider(ground=land.name)
            for frame in (10, 40, 80):
                support.go_to(frame)
            spider.motus.walker.stride = 0.4
            support.go_to(50)
            spider.motus.walker.use_plane = True
            spider.motus.walker.plane_height = -0.3
            support.go_to(60)
        self.assertEqual(made.call_count, 1)

    def test_stones_on_a_still_empty_stand_still(self):
        root, spare = support.link("Root"), support.link("Spare")
        stones = bpy.data.collections.new("Stones")
        self.scene.collection.children.link(stones)
        for index in range(3):
            stone = cases.grid(f"Stone {index}", lambda x, y: 0.2 + 0.0 * x, half=1.0, count=2)
            stone.parent = root
            self.scene.collection.objects.unlink(stone)
            stones.objects.link(stone)
        spider = cases.spider(ahead=0.0, grounds="Stones")
        support.go_to(1)
        self.assertWell(spider)
        np.testing.assert_allclose(cases.places(spider)[:, 2], 0.2, atol=1e-5)
        root.parent = spare
        support.key_places(spare, {1: (0.0, 0.0, 0.0), 50: (0.0, 0.0, 1.0)})
        support.go_to(2)
        self.assertIn("may move", self.sentence(spider))


class Bodies(cases.WalkerTestCase):
    def test_one_that_does_not_move(self):
        spider = cases.spider(ahead=0.0)
        found = cases.over((1, 40, 100), lambda: cases.places(spider))
        np.testing.assert_array_equal(found[1:], found[:-1])
        self.assertWell(spider)

    def test_one_that_is_dragged_stands_where_it_is(self):
        spider = cases.spider(ahead=0.0)
        spider.location = (1.0, 2.0, 0.0)
        spider.rotation_euler.z = 1.0
        bpy.context.view_layer.update()
        np.testing.assert_allclose(cases.places(spider), cases.rests(spider), atol=1e-5)

    def test_one_that_is_moved_and_then_keyed(self):
        spider = cases.spider()
        support.go_to(60)
        spider.location = (1.0, 1.0, 0.0)
        bpy.context.view_layer.update()
        np.testing.assert_allclose(cases.places(spider), cases.rests(spider), atol=1e-5)
        self.assertIn("until it is keyed", self.sentence(spider))
        spider.keyframe_insert("location")
        for _ in range(2):  # an insertion is noticed after the evaluation
            bpy.context.view_layer.update()
        walker = cases.plan_of(spider).walker
        np.testing.assert_allclose(cases.places(spider), walker.feet(cases.seconds(60)), atol=cases.SINGLE)
        self.assertWell(spider)

    def test_no_numbers_in_its_keys(self):
        spider = cases.spider()
        curve = next(one for one in support.addon("core.blender.actions").fcurves(spider) if one.data_path == "location")
        curve.keyframe_points[1].co.y = math.nan
        curve.update()
        support.go_to(50)
        self.assertEqual(self.sentence(spider), "The body's motion is not a finite number")

    def test_axes_that_there_are_not(self):
        """As a file has them that somebody has changed: '' to Blender."""
        spider = cases.spider()
        for name, label in (("forward_axis", "Forward"), ("up_axis", "Up"), ("gait", "Gait")):
            with self.subTest(name):
                kept = getattr(spider.motus.walker, name)
                cases.set_raw(spider, name, 99)
                bpy.context.view_layer.update()
                self.assertEqual(self.sentence(spider), f"{label} is outside of what a walk can be planned by")
                setattr(spider.motus.walker, name, kept)

    def test_a_setting_that_is_wrong_is_named(self):
        spider = cases.spider()
        settings = spider.motus.walker
        leg = settings.legs[3]
        outside, infinite = "is outside of what a walk can be planned by", "is not a finite number"
        for place, name, number, said in (
            (settings, "plane_height", math.nan, f"Height {infinite}"),
            (leg, "length", math.inf, f"Length {infinite}"),
            (leg, "rest", (0.0, math.nan, 0.0), f"Rest {infinite}"),
            (settings, "stride", 1e30, f"Stride {outside}"),
            (settings, "reach_up", 1e30, f"Reach Up {outside}"),
            (leg, "hip", (1e30, 0.0, 0.0), f"Hip {outside}"),
            (leg, "length", 1e30, f"Length {outside}"),
            (leg, "rest", (0.0, 1e30, 0.0), f"Rest {outside}"),
        ):
            with self.subTest(name=name, number=number):
                kept = getattr(place, name)
                kept = tuple(kept) if hasattr(kept, "__len__") else kept
                setattr(place, name, number)
                bpy.context.view_layer.update()
                self.assertEqual(self.sentence(spider), said)
                setattr(place, name, kept)
        bpy.context.view_layer.update()
        self.assertWell(spider)

    def test_a_body_that_goes_too_far(self):
        spider = cases.spider(ahead=1e20)
        support.go_to(50)
        self.assertIn("goes too far away", self.sentence(spider))

    def walked(self, scale):
        """Where the feet of a scaled spider are, on a way that is scaled too, at whose speed its stride counts."""
        support.empty_scene()
        spider = cases.spider(ahead=0.0)
        spider.scale = scale
        support.key_places(spider, {10: (0.0, 0.0, 0.0), 90: (0.0, 5.0 * scale[1], 0.0)})
        found = cases.over((1, 33, 50, 67.5, 110), lambda: cases.places(spider))
        self.assertTrue(np.isfinite(cases.body_of(spider)).all())
        return found

    def test_scaled(self):
        plain = self.walked((1.0, 1.0, 1.0))
        for scale in ((2.0, 2.0, 2.0), (0.1, 0.1, 0.1), (-1.0, 1.0, 1.0), (-2.0, -2.0, -2.0)):
            with self.subTest(scale):
                np.testing.assert_allclose(self.walked(scale), plain * scale, atol=1e-4)

    def test_scaled_differently_along_its_axes(self):
        for scale in ((1.0, 2.0, 0.5), (-0.5, 1.0, 2.0)):
            with self.subTest(scale):
                support.empty_scene()
                spider = cases.spider()
                spider.scale = scale
                bpy.context.view_layer.update()
                walker = cases.plan_of(spider).walker
                for frame in (1, 50, 110):
                    support.go_to(frame)
                    np.testing.assert_allclose(cases.places(spider), walker.feet(cases.seconds(frame)), atol=1e-5)
                self.assertTrue(np.isfinite(cases.body_of(spider)).all())

    def test_a_body_that_grows(self):
        """As one that pops into the picture: it has legs, and steps, of the size that it grows to."""
        for smallest in (0.0, 0.1, 0.5):
            with self.subTest(smallest):
                support.empty_scene()
                spider = cases.spider(ahead=4.0, last=110)
                for frame, size in ((1, smallest), (30, 1.0)):
                    spider.scale = (size, size, size)
                    spider.keyframe_insert("scale", frame=frame)
                support.go_to(2)
                self.assertWell(spider)
                steps = cases.plan_of(spider).walker.steps
                length = np.linalg.norm(steps["end"] - steps["start"], axis=1)[steps["touch"] > cases.seconds(40)]
                self.assertGreater(length.max(), 0.3)

    def test_scaled_to_nothing(self):
        spider = cases.spider()
        spider.scale = (0.0, 0.0, 0.0)
        support.go_to(50)
        self.assertTrue(np.isfinite(cases.places(spider)).all())

    def test_a_mirrored_body_leans_the_same_way(self):
        land = cases.grid("Land", lambda x, y: 0.3 * y + 0.2 * x)
        spider = cases.spider(ahead=0.0, ground=land.name, body_tilt=1.0)
        support.go_to(1)
        plain = cases.body_of(spider)
        spider.scale.x = -1.0
        support.go_to(1)
        mirrored = cases.body_of(spider)
        np.testing.assert_allclose(mirrored[:3, 1], plain[:3, 1], atol=0.02)
        np.testing.assert_allclose(mirrored[:3, 2], plain[:3, 2], atol=0.02)

    def test_legs_without_a_length(self):
        spider = cases.spider()
        for leg in spider.motus.walker.legs:
            leg.length = 0.0
        bpy.context.view_layer.update()
        self.assertWell(spider)

    def test_a_motion_that_is_too_long(self):
        spider = cases.spider(ahead=0.0)
        support.key_places(spider, {1: (0.0, 0.0, 0.0), 60_000: (0.0, 50.0, 0.0)})
        support.go_to(2)
        self.assertIn("first 9,000 frames", self.sentence(spider))

    def test_settings_beyond_all_bounds(self):
        spider = cases.spider(ahead=30.0, stride=0.0, cadence=100.0)
        bpy.context.view_layer.update()
        self.assertWell(spider)
        support.go_to(50)  # where each frame is a jump of more than four strides
        np.testing.assert_allclose(cases.places(spider), cases.rests(spider), atol=1e-3)
        spider.motus.walker.jump = 1000.0
        self.assertIn("more than 1,000,000 steps", self.sentence(spider))
