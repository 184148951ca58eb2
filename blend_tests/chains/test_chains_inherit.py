"""How much of the motion of its rig a chain feels."""

import bpy
import numpy as np

import support
from chains import chain_cases as cases
from dynamics import dynamics_cases

FRAMES = (1, 8, 13.5, 20, 26, 31.25, 90)
LIMP = {"frequency": 0.0, "drag": 0.5, "thickness": 0.02}


def race(rig):
    """Keys that let a rig shoot along, climb and turn about the vertical."""
    dynamics_cases.key(rig, "location", {1: (0.0, 0.0, 0.0), 5: (0.0, 0.0, 0.0), 20: (20.0, 5.0, 3.0), 60: (0.0, 50.0, 1.0)})
    dynamics_cases.key(rig, "rotation_euler", {1: (2.5, 0.0, 0.0), 5: (2.5, 0.0, 0.0), 40: (2.5, 0.0, 8.0)})


def seen(rig):
    """Where the chain is as seen from its rig."""
    found = []
    for frame in FRAMES:
        back = np.linalg.inv(cases.matrix(rig, frame))
        found.append(cases.tails(rig, frame, cases.chain(rig)) @ back[:3, :3].T + back[:3, 3])
    return np.array(found)


class ChainsInheritTest(support.SceneTestCase):
    def build(self, moves, **settings):
        support.empty_scene()
        rig = cases.rope(5)
        # A ball that comes along, and what holds the end: they are parts of the car.
        ball = support.link("Ball", location=(0.0, -0.1, 1.6), parent=rig)
        ball.empty_display_type, ball.empty_display_size = 'SPHERE', 0.2
        post = support.link("Post", location=(0.3, 0.2, 1.9), parent=rig)
        solid = bpy.data.collections.new("Solid")
        bpy.context.scene.collection.children.link(solid)
        solid.objects.link(ball)
        if moves:
            race(rig)
        cases.add(rig, **LIMP, settle=5.0, colliders=solid, **settings)
        bpy.ops.motus.chains_pin(object=rig.name, target=post.name, weight=0.2)
        bpy.context.view_layer.update()
        self.assertIsNone(cases.problem(rig))
        return rig

    def test_nothing_of_it(self):
        """A chain hangs and swings as if its rig stood still."""
        still = seen(self.build(moves=False))
        self.assertGreater(np.ptp(still, axis=0).max(), 0.2, "the root bone moves by keys of its own")
        np.testing.assert_allclose(seen(self.build(moves=True, inherit=0.0)), still, atol=1e-4)

    def test_half_of_it_lies_between(self):
        still = seen(self.build(moves=False))
        found = {inherit: seen(self.build(moves=True, inherit=inherit)) for inherit in (0.2, 0.5, 1.0)}
        apart = {inherit: np.abs(one - still).mean() for inherit, one in found.items()}
        self.assertLess(0.01, apart[0.2])
        self.assertLess(apart[0.2], apart[0.5])
        self.assertLess(apart[0.5], apart[1.0])

    def test_gravity_and_wind_stay_those_of_the_world(self):
        rig = cases.still_rope(4, tilt=0.5)
        dynamics_cases.key(rig, "rotation_euler", {1: (0.5, 0.0, 0.0), 20: (0.5, 2.0, 1.0)})
        dynamics_cases.key(rig, "location", {1: (0.0, 0.0, 0.0), 20: (30.0, 0.0, 0.0)})
        cases.add(rig, frequency=0.0, drag=4.0, inherit=0.0, wind=(0.0, 2.0, 0.0), settle=30.0)
        for frame in (1, 250):
            way = cases.tail(rig, frame, "Tail 0 3") - cases.place(rig, frame, "Tail 0 0")
            self.assertAlmostEqual(way[1] / -way[2], 4.0 * 2.0 / 9.81, delta=0.02)
            self.assertAlmostEqual(way[0], 0.0, delta=0.02)

    def test_what_stands_in_the_world_is_met_there(self):
        rig = cases.still_rope(6)
        race(rig)
        ground = support.link("Ground", location=(0.0, 0.0, -1.2))
        mesh = bpy.data.meshes.new("Wall")
        mesh.from_pydata([(-40.0, 3.0, -9.0), (40.0, 3.0, -9.0), (40.0, 3.0, 9.0), (-40.0, 3.0, 9.0)], [], [(0, 1, 2, 3)])
        wall = support.link("Wall", mesh)
        solid = bpy.data.collections.new("Solid")
        bpy.context.scene.collection.children.link(solid)
        for obj in (ground, wall):
            solid.objects.link(obj)
        cases.add(rig, **LIMP, inherit=0.3, settle=5.0, colliders=solid)
        self.assertIsNone(cases.problem(rig))
        for frame in (1, 4, 8, 9.5):
            self.assertGreater(cases.tails(rig, frame, cases.chain(rig))[:, 2].min(), -1.2 + 0.015, frame)
        dynamics_cases.key(rig, "location", {1: (0.0, 0.0, 0.0), 5: (0.0, 0.0, 0.0), 20: (20.0, 3.2, 0.0)})
        for frame in (14, 17, 19):  # the root is still before the wall, and the chain swings back from it
            self.assertLess(cases.tails(rig, frame, cases.chain(rig))[:, 1].max(), 3.0, frame)

    def test_all_of_it_are_the_same_bits(self):
        rig = cases.rope(4)
        race(rig)
        cases.add(rig)
        plain = {frame: cases.matrix(rig, frame, "Tail 0 3").tobytes() for frame in FRAMES}
        rig.motus.chains.inherit = 0.5
        half = {frame: cases.matrix(rig, frame, "Tail 0 3").tobytes() for frame in FRAMES}
        self.assertNotEqual(half, plain)
        support.addon().forget_all()
        for frame in reversed(FRAMES):
            self.assertEqual(cases.matrix(rig, frame, "Tail 0 3").tobytes(), half[frame])
        rig.motus.chains.inherit = 1.0
        for frame in FRAMES:
            self.assertEqual(cases.matrix(rig, frame, "Tail 0 3").tobytes(), plain[frame])

    def test_it_bakes(self):
        rig = cases.rope(3)
        race(rig)
        cases.add(rig, inherit=0.2)
        live = {frame: cases.matrix(rig, frame, "Tail 0 2") for frame in (1, 15, 30)}
        flag = support.link("Flag", parent=rig)
        flag.parent_type, flag.parent_bone = 'BONE', "Tail 0 2"
        bpy.context.view_layer.update()
        track = support.addon("core.tracks").world_track(flag.evaluated_get(cases.go_to(9)), bpy.context.scene)
        self.assertTrue(track.is_known)
        for frame in (4.0, 12.5, 33.0):
            np.testing.assert_allclose(track.values([frame])[0], cases.matrix(flag, frame), atol=2e-4)
            track = support.addon("core.tracks").world_track(flag.evaluated_get(cases.go_to(9)), bpy.context.scene)
        bpy.context.view_layer.objects.active = rig
        bpy.ops.motus.bake(frame_start=1, frame_end=30)
        for frame, wanted in live.items():
            np.testing.assert_allclose(cases.matrix(rig, frame, "Tail 0 2"), wanted, atol=1e-5)

    def test_the_space_follows_what_it_shall(self):
        """A part of a turn about an axis is a turn about the same axis; the whole is the motion itself."""
        spaces = support.addon("chains.spaces")
        turns = np.linspace(0.0, 2.0, 481)
        moved = np.tile(np.eye(4), (481, 1, 1))
        moved[:, 0, 0] = moved[:, 1, 1] = np.cos(turns)
        moved[:, 1, 0] = np.sin(turns)
        moved[:, 0, 1] = -np.sin(turns)
        moved[:, 0, 3] = 3.0 * turns
        rotations = support.addon("core.tracks.rotations")
        for part in (0.25, 1.0):
            found, shifts = spaces._following(moved, part)
            np.testing.assert_allclose(2.0 * np.arctan2(found[:, 3], found[:, 0]), part * turns, atol=1e-6)
        np.testing.assert_allclose(rotations.matrices(found), moved[:, :3, :3], atol=1e-9)
        np.testing.assert_allclose(shifts, moved[:, :3, 3], atol=1e-9)
        space = spaces.Space(turns, found, shifts)
        places = np.random.default_rng(1).normal(size=(481, 4, 3))
        inside = space.places(places)
        for row in (0, 100, 480):
            np.testing.assert_allclose(space.outside(inside[row], turns[row]), places[row], atol=1e-9)
