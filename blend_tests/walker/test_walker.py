"""What walkers do: feet that stand and step, ground, walls, a body that leans, in any order of frames."""

import math
from unittest import mock

import bpy
import numpy as np
from mathutils import Matrix

import support
from walker import walker_cases as cases


class Steps(cases.WalkerTestCase):
    def test_feet_stand_step_and_come_to_rest(self):
        spider = cases.spider()
        found, swings = self.assertStands(spider, list(range(1, 121)))
        self.assertWell(spider)
        np.testing.assert_allclose(found[swings == 0.0][:, 2], 0.0, atol=cases.SINGLE)
        self.assertGreater(found[swings > 0.0][:, 2].max(), 0.7 * spider.motus.walker.clearance)
        self.assertEqual(swings[0].max(), 0.0)
        self.assertEqual(swings[-1].max(), 0.0)
        np.testing.assert_allclose(found[-1], cases.rests(spider), atol=2 * cases.SINGLE)
        self.assertGreater((np.diff((swings > 0.0).astype(int), axis=0) > 0).sum(axis=0).min(), 3)

    def test_legs_end_on_their_feet(self):
        spider = cases.spider()
        for frame in (1, 33, 47.5, 80, 119):
            support.go_to(frame)
            np.testing.assert_allclose(cases.tips(spider), cases.places(spider), atol=2e-5)

    def test_a_frame_alone_is_the_frame_in_playback(self):
        spider = cases.spider_on_waves()
        frames = sorted(set(cases.OFF_THE_FRAMES))
        played = dict(zip(frames, cases.over(frames, lambda: (cases.places(spider), cases.tips(spider)))))
        for frame in cases.OFF_THE_FRAMES:
            support.go_to(frame)
            np.testing.assert_array_equal(np.array((cases.places(spider), cases.tips(spider))), played[frame])
        path = self.save()
        bpy.ops.wm.open_mainfile(filepath=path)
        spider = bpy.data.objects["Spider"]
        support.go_to(57)
        np.testing.assert_array_equal(np.array((cases.places(spider), cases.tips(spider))), played[57])

    def test_feet_are_where_the_library_has_them(self):
        spider = cases.spider()
        spider.rotation_euler.z = 0.4
        spider.keyframe_insert("rotation_euler", frame=10)
        spider.rotation_euler.z = -0.6
        spider.keyframe_insert("rotation_euler", frame=90)
        bpy.context.view_layer.update()
        walker = cases.plan_of(spider).walker
        for frame in (1, 20, 44.25, 71, 100):
            support.go_to(frame)
            np.testing.assert_allclose(cases.places(spider), walker.feet(cases.seconds(frame)), atol=cases.SINGLE)

    def test_settings_arrive(self):
        spider = cases.spider(ahead=0.0)
        native = support.addon("core.native").module
        settings = spider.motus.walker
        spider.scale = 3 * [2.0]
        changes = {
            "gait": 'RIPPLE',
            "use_duty": True,
            "duty": 0.75,
            "stride": 0.3,
            "cadence": 2.0,
            "clearance": 0.05,
            "minimum_step": 0.02,
            "reach_up": 0.25,
            "reach_down": 0.5,
            "body_height": 0.5,
            "body_tilt": 0.25,
            "frequency": 3.0,
            "damping": 0.5,
            "jump": 2.0,
            "use_plane": True,
            "plane_height": -0.25,
        }
        for name, value in changes.items():
            setattr(settings, name, value)
        with (
            mock.patch.object(native, "Walker", wraps=native.Walker) as made,
            mock.patch.object(native, "walker_gait", wraps=native.walker_gait) as gait,
        ):
            bpy.context.view_layer.update()
        given = made.call_args.kwargs
        wanted = {
            "duty": 0.75,
            "stride": 0.6,
            "cadence": 2.0,
            "clearance": 0.1,
            "minimum_step": 0.04,
            "reach_up": 0.5,
            "reach_down": 1.0,
            "height": 0.5,
            "tilt": 0.25,
            "frequency": 3.0,
            "damping": 0.5,
            "jump": 4.0,
        }
        for name, value in wanted.items():
            self.assertAlmostEqual(given[name], value, places=6, msg=name)
        self.assertEqual(gait.call_args.args[0], "ripple")
        np.testing.assert_allclose(cases.places(spider)[:, 2], -0.25, atol=1e-5)
        np.testing.assert_array_equal(made.call_args.args[2], [tuple(leg.rest) for leg in settings.legs])

    def test_phases_of_ones_own(self):
        spider = cases.spider(gait='OWN', duty=0.5)
        for index, leg in enumerate(spider.motus.walker.legs):
            leg.phase = 0.5 * (index == 0)
        bpy.context.view_layer.update()
        walker = cases.plan_of(spider).walker
        times = cases.seconds(np.arange(10, 90, 0.5))
        swings = walker.swing(times) > 0.0
        # All but the first step at the same times, and it while they stand.
        self.assertTrue((swings[:, 1:] == swings[:, 1:2]).all())
        self.assertFalse((swings[:, 0] & swings[:, 1]).any())
        self.assertTrue(swings[:, 0].any())

    def test_the_influence_is_keyed(self):
        spider = cases.spider()
        own = np.array([tuple(spider.data.bones[name].head_local) for name in cases.foot_bones(spider)])
        for frame, value in ((40, 1.0), (41, 0.0), (50, 0.0)):
            spider.motus.walker.influence = value
            spider.keyframe_insert("motus.walker.influence", frame=frame)
        support.go_to(50)
        carried = own + np.array(spider.matrix_world.translation)
        np.testing.assert_allclose(cases.places(spider), carried, atol=cases.SINGLE)
        support.go_to(40)
        walker = cases.plan_of(spider).walker
        np.testing.assert_allclose(cases.places(spider), walker.feet(cases.seconds(40)), atol=cases.SINGLE)

    def test_a_jump_takes_the_feet_along(self):
        spider = cases.spider()
        support.key_places(spider, {60: (0.0, 1.0, 0.0), 61: (30.0, 1.0, 0.0), 90: (30.0, 2.0, 0.0)})
        for frame in (60, 61):
            support.go_to(frame)
            away = np.linalg.norm(cases.places(spider) - cases.rests(spider), axis=1)
            self.assertLess(away.max(), 0.75 * spider.motus.walker.stride)

    def test_frame_rates_change_nothing_in_seconds(self):
        spider = cases.spider()
        support.go_to(50)
        before = cases.plan_of(spider).walker.steps
        self.scene.render.fps_base = 0.5
        for curve in support.addon("core.blender.actions").fcurves(spider):
            for point in curve.keyframe_points:
                point.co.x *= 2.0
            curve.update()
        support.go_to(100)
        after = cases.plan_of(spider).walker.steps
        np.testing.assert_array_equal(after["leg"], before["leg"])
        # The motion is read from a frame before its first key on.
        np.testing.assert_allclose(after["touch"], before["touch"], atol=1.0 / 24.0)
        np.testing.assert_allclose(after["end"], before["end"], atol=0.03)
        self.assertWell(spider)


class Ground(cases.WalkerTestCase):
    def test_feet_stand_on_meshes(self):
        land = cases.grid("Land", cases.waves)
        spider = cases.spider(ground=land.name)
        found, swings = self.assertStands(spider, list(range(1, 121, 2)))
        standing = found[swings == 0.0]
        # The facets lie this much beside the formula.
        np.testing.assert_allclose(standing[:, 2], cases.waves(standing[:, 0], standing[:, 1]), atol=4e-3)
        self.assertGreater(np.ptp(standing[:, 2]), 0.1)
        self.assertWell(spider)

    def test_collections_and_instances(self):
        land = cases.grid("Land", cases.waves)
        scenery = bpy.data.collections.new("Scenery")
        self.scene.collection.objects.unlink(land)
        scenery.objects.link(land)
        seat = support.link("Instance", location=(0.0, 0.0, 0.5))
        seat.instance_type, seat.instance_collection = 'COLLECTION', scenery
        outer = bpy.data.collections.new("Outer")
        self.scene.collection.children.link(outer)
        self.scene.collection.objects.unlink(seat)
        outer.objects.link(seat)
        spider = cases.spider(grounds="Outer", reach_up=1.0)
        support.go_to(1)
        found = cases.places(spider)
        np.testing.assert_allclose(found[:, 2], 0.5 + cases.waves(found[:, 0], found[:, 1]), atol=4e-3)
        self.assertWell(spider)

    def test_a_wall(self):
        wall = cases.grid("Wall", lambda x, y: 0.0 * x)
        wall.rotation_euler.y = -0.5 * math.pi  # its upper side looks along -X
        spider = cases.spider(ahead=0.0, ground="Wall", location=(0.0, 0.0, 0.0))
        spider.rotation_euler = (0.0, -0.5 * math.pi, 0.0)
        support.key_places(spider, {1: (0.1, 0.0, -1.0), 60: (0.1, 0.0, 1.0)})
        found, swings = self.assertStands(spider, list(range(1, 100, 3)))
        np.testing.assert_allclose(found[swings == 0.0][:, 0], 0.0, atol=1e-5)
        self.assertGreater(np.abs(found[swings > 0.0][:, 0]).max(), 0.02)

    def test_below_a_table(self):
        """Feet stay on the ground, of a table that is mirrored too."""
        land = cases.grid("Land", lambda x, y: 0.0 * x, count=3)
        bpy.ops.mesh.primitive_cube_add(size=1.0, location=(0.0, 1.0, 0.35))
        table, scenery = bpy.context.object, bpy.data.collections.new("Scenery")
        for obj in (land, table):
            scenery.objects.link(obj)
        spider = cases.spider(grounds="Scenery")
        self.assertGreater(spider.motus.walker.reach_up, 0.38)
        for side in (1.0, -1.0):
            table.scale = (3.0 * side, 1.0, 0.1)
            bpy.context.view_layer.update()
            walker = cases.plan_of(spider).walker
            np.testing.assert_allclose(walker.steps["end"][:, 2], 0.0, atol=1e-6)
            self.assertLess(walker.steps["apex"][:, 2].max(), 0.1)
        self.assertWell(spider)

    def test_the_body_rises_and_leans(self):
        land = cases.grid("Land", lambda x, y: 0.3 * y + 0.1)
        spider = cases.spider(ahead=0.0, ground=land.name, body_tilt=1.0)
        support.go_to(1)
        body = cases.body_of(spider)
        rest = np.array(spider.data.bones["body"].matrix_local)
        forward = body[:3, 1]
        self.assertAlmostEqual(forward[2] / math.hypot(*forward[:2]), 0.3, delta=0.02)
        self.assertGreater(body[2, 3], rest[2, 3] + 0.08)
        spider.motus.walker.body_height = spider.motus.walker.body_tilt = 0.0
        support.go_to(1)
        np.testing.assert_allclose(cases.body_of(spider), rest, atol=1e-6)
        spider.motus.walker.body_height = 1.0
        spider.motus.walker.influence = 0.0
        support.go_to(1)
        np.testing.assert_allclose(cases.body_of(spider), rest, atol=1e-6)

    def test_the_body_leans_as_the_library_says(self):
        """On top of its own pose, below a bone, of a rig that is turned and scaled."""
        land = cases.grid("Land", cases.waves)
        spider = cases.spider(ground=land.name)
        spider.rotation_euler, spider.scale = (0.2, -0.1, 0.7), 3 * [1.5]
        body = spider.pose.bones["body"]
        body.rotation_mode = 'XYZ'
        body.location, body.rotation_euler = (0.02, 0.03, -0.01), (0.1, 0.2, 0.3)
        for frame in (1, 50, 81.5):
            support.go_to(frame)
            seen = support.evaluated(spider)
            own = np.array(seen.matrix_world @ spider.data.bones["body"].matrix_local @ body.matrix_basis)
            height, turn = cases.plan_of(spider).walker.body(cases.seconds(frame))
            about = np.array(seen.matrix_world.translation)
            turned = rotation(turn)
            wanted = own.copy()
            wanted[:3, :3] = turned @ own[:3, :3]
            wanted[:3, 3] = turned @ (own[:3, 3] - about) + about + height
            np.testing.assert_allclose(cases.body_of(spider), wanted, atol=5e-6)

    def test_edits_of_the_ground_plan_anew(self):
        land = cases.grid("Land", lambda x, y: 0.0 * x)
        spider = cases.spider(ground=land.name)
        support.go_to(50)
        before = cases.places(spider)
        land.data.transform(Matrix.Translation((0.0, 0.0, 0.1)))
        land.data.update()
        support.go_to(50)
        np.testing.assert_allclose(cases.places(spider)[:, 2], before[:, 2] + 0.1, atol=1e-5)
        land.location.z = 0.1
        bpy.context.view_layer.update()
        np.testing.assert_allclose(cases.places(spider)[:, 2], before[:, 2] + 0.2, atol=1e-5)


class Objects(cases.WalkerTestCase):
    def test_feet_and_a_body_that_are_objects(self):
        body, shell, feet = cases.cross()
        land = cases.grid("Land", cases.waves)
        self.assertEqual(
            bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), body=shell.name, ground=land.name, gait='TROT'), {'FINISHED'}
        )
        support.key_places(body, {1: (0.0, 0.0, 0.0), 60: (0.0, 2.0, 0.0)})
        found, swings = self.assertStands(body, list(range(1, 100)), 0.0)
        standing = found[swings == 0.0]
        np.testing.assert_allclose(standing[:, 2], cases.waves(standing[:, 0], standing[:, 1]), atol=6e-3)
        support.go_to(44)
        walker = cases.plan_of(body).walker
        height, turn = walker.body(cases.seconds(44))
        about = np.array(support.evaluated(body).matrix_world.translation)
        np.testing.assert_allclose(cases.body_of(body)[:3, 3], about + height + rotation(turn) @ (0.0, 0.0, 0.5), atol=2e-6)
        self.assertWell(body)

    def test_a_body_that_hangs_on_something_else(self):
        body, shell, feet = cases.cross()
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), body=shell.name)
        shell.parent = support.link("Crane")
        bpy.context.view_layer.update()
        self.assertIn("hangs on something else", self.sentence(body))
        self.assertFalse(shell.constraints)
        shell.parent = body
        bpy.context.view_layer.update()
        self.assertWell(body)
        self.assertTrue(shell.constraints)

    def test_a_body_with_keys_of_its_own(self):
        body, shell, feet = cases.cross()
        land = cases.grid("Land", cases.waves)
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), body=shell.name, ground=land.name)
        support.key_places(body, {1: (0.0, 0.0, 0.0), 60: (0.0, 2.0, 0.0)})
        support.key_places(shell, {1: (0.0, 0.0, 0.5), 60: (0.3, 0.0, 0.9)})
        for frame in (60, 1, 44, 12.5, 44):
            support.go_to(frame)
            seen = support.evaluated(shell)
            own = np.array(support.evaluated(body).matrix_world @ Matrix.Translation(seen.location))
            height, turn = cases.plan_of(body).walker.body(cases.seconds(frame))
            about = np.array(support.evaluated(body).matrix_world.translation)
            np.testing.assert_allclose(cases.body_of(body)[:3, 3], about + height + rotation(turn) @ (own[:3, 3] - about), atol=2e-6)

    def test_a_deleted_foot(self):
        body, _, feet = cases.cross()
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet))
        support.key_places(body, {1: (0.0, 0.0, 0.0), 60: (0.0, 2.0, 0.0)})
        bpy.context.view_layer.update()
        bpy.data.objects.remove(feet[1])
        bpy.ops.motus.refresh(object=body.name, system="walker")
        self.assertIn("no foot any more", self.sentence(body))
        support.go_to(60)
        left = feet[0].evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.translation
        self.assertGreater(left.y, 1.5)


class Overlay(cases.WalkerTestCase):
    def drawn(self, owner):
        return support.addon("walker.overlay").overlay.draw(bpy.context, owner)

    def test_left_is_where_the_body_looks_from(self):
        """Of a body that looks along +X that is +Y."""
        body, _, feet = cases.cross()
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), forward_axis='POS_X')
        colors = support.addon("walker.overlay")
        sides = {batch.colors: batch.points[:, 1] for batch in self.drawn(body) if batch.width > 1.0}
        self.assertGreater(sides[colors.LEFT_COLOR].min(), 0.0)
        self.assertLess(sides[colors.RIGHT_COLOR].max(), 0.0)

    def test_rings_lie_on_what_feet_stand_on(self):
        wall = cases.grid("Wall", lambda x, y: 0.0 * x)
        wall.rotation_euler.y = -0.5 * math.pi
        spider = cases.spider(ahead=0.0, ground="Wall", location=(0.0, 0.0, 0.0))
        spider.rotation_euler = (0.0, -0.5 * math.pi, 0.0)
        self.scene.motus.show_walker_rests = True
        support.key_places(spider, {1: (0.0, 0.0, -1.0), 60: (0.0, 0.0, 1.0)})
        support.go_to(30)
        rings = [batch.points for batch in self.drawn(spider) if batch.width > 1.0 or batch.colors[3] == 0.5]
        self.assertEqual(len(rings), 3)
        for points in rings:
            np.testing.assert_allclose(points[:, 0], 0.0, atol=1e-5)
            self.assertGreater(np.ptp(points[:, 1]), 0.2)


def rotation(turn):
    """3 x 3 of a quaternion."""
    w, x, y, z = turn
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
