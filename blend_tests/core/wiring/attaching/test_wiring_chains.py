"""Systems of different kinds that wait for each other: a follower on a curve that follows, and a toy around both."""

import bpy
from mathutils import Vector

import toy_system
from core.wiring.wiring_cases import WiringTestCase, build_followers, build_object, frame_set

FRAMES = (10, 55, 3.5, 54)


def new_line(name, length=10.0):
    """A straight curve along X, from its origin."""
    data = bpy.data.curves.new(name, 'CURVE')
    data.dimensions = '3D'
    points = data.splines.new('BEZIER').bezier_points
    points.add(1)
    for point, x in zip(points, (0.0, length)):
        point.co = (x, 0.0, 0.0)
        point.handle_left_type = point.handle_right_type = 'VECTOR'
    return toy_system.new_object(name, data=data)


class ChainTest(WiringTestCase):
    def setUp(self):
        super().setUp()
        bpy.context.scene.render.fps, bpy.context.scene.render.fps_base = 25, 1.0

    def follow(self, follower, curve, **options):
        """Let an object run along a line of 10 m in 100 frames, from frame 1."""
        self.assertEqual(
            bpy.ops.motus.path_follow_add(
                object=follower.name, curve=curve.name, duration=4.0, start_frame=1.0, ease_in=0.0, ease_out=0.0, **options
            ),
            {'FINISHED'},
        )

    def assert_on_line(self, follower, curve):
        frame = bpy.context.scene.frame_current_final
        wanted = toy_system.world_matrix(curve) @ Vector((min(max((frame - 1.0) / 10.0, 0.0), 10.0), 0.0, 0.0))
        self.assert_close(toy_system.world_matrix(follower).translation, wanted, 2e-5)

    def test_curve_follows_a_curve(self):
        first, second = new_line("First"), new_line("Second")
        second.rotation_euler = (0.0, 0.0, 1.0)
        carrier, follower = toy_system.new_object("Carrier"), toy_system.new_object("Follower")
        second.parent = carrier
        self.follow(carrier, first)
        self.follow(follower, second)
        for frame in FRAMES:
            frame_set(frame)
            self.assert_on_line(carrier, first)
            self.assert_on_line(follower, second)

    def test_toy_around_a_follower_and_back(self):
        curve = new_line("Line")
        follower = toy_system.new_object("Follower")
        self.follow(follower, curve)
        for build in (build_object, build_followers):
            owner, things = build(follower)
            carried = new_line("Carried")
            carried.parent = things[-1]
            last = toy_system.new_object("Last")
            self.follow(last, carried)
            for frame in FRAMES:
                frame_set(frame)
                self.assert_follows(owner, things)
                self.assert_on_line(last, carried)

    def test_both_on_one_object(self):
        curve = new_line("Line")
        owner, _ = build_object(toy_system.new_target(), use_location=False)
        self.follow(owner, curve, orientation='NONE')
        for frame in FRAMES:
            frame_set(frame)
            self.assert_on_line(owner, curve)
            rotation = toy_system.expected(owner)[1].to_matrix()
            self.assert_same_matrix(toy_system.world_matrix(owner).to_3x3().normalized(), rotation)

    def test_both_are_baked_and_restored(self):
        curve = new_line("Line")
        owner, _ = build_object(toy_system.new_target(), use_location=False)
        self.follow(owner, curve, orientation='NONE')
        frame_set(30)
        live = toy_system.world_matrix(owner)
        for system in ("", "path", "orbit"):
            with self.subTest(system):
                bpy.ops.motus.bake(object=owner.name, system=system, frame_start=20, frame_end=40)
                self.assertEqual([owner.motus.path.is_baked, owner.motus.orbit.is_baked], [system in ("", "path"), system in ("", "orbit")])
                frame_set(30)
                self.assert_same_matrix(toy_system.world_matrix(owner), live)
                bpy.ops.motus.unbake(object=owner.name)
                frame_set(30)
                self.assertEqual(toy_system.world_matrix(owner), live)
