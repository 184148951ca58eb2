"""What chains touch: balls, capsules, planes, bones and meshes, moving ones too, and those that other chains move."""

import types
from unittest import mock

import bmesh
import bpy
import numpy as np
from mathutils import Vector

import support
from chains import chain_cases as cases
from dynamics import dynamics_cases

FRAMES = (1, 8, 13.5, 20, 26, 31.25, 90)
LIMP = {"frequency": 0.0, "drag": 1.0, "thickness": 0.02}

colliders = support.addon("chains.colliders")


def collection_of(*objects):
    """A collection with these objects, which keep the collections that they are in."""
    found = bpy.data.collections.new("Solid")
    bpy.context.scene.collection.children.link(found)
    for obj in objects:
        found.objects.link(obj)
    return found


def empty(name, kind='SPHERE', size=1.0, **place):
    obj = support.link(name, location=place.get("location", (0.0, 0.0, 0.0)))
    obj.empty_display_type, obj.empty_display_size = kind, size
    obj.scale, obj.rotation_euler = place.get("scale", (1.0, 1.0, 1.0)), place.get("turn", (0.0, 0.0, 0.0))
    return obj


def grid(name="Floor", size=3.0, count=8, **place):
    """A square mesh in its X and Y axes."""
    mesh = bpy.data.meshes.new(name)
    made = bmesh.new()
    bmesh.ops.create_grid(made, x_segments=count, y_segments=count, size=size)
    made.to_mesh(mesh)
    made.free()
    obj = support.link(name, mesh)
    obj.location, obj.rotation_euler = place.get("location", (0.0, 0.0, 0.0)), place.get("turn", (0.0, 0.0, 0.0))
    obj.scale = place.get("scale", (1.0, 1.0, 1.0))
    return obj


def told(rig):
    problem = cases.problem(rig)
    return problem and support.addon("chains.told").sentence(rig, problem, bpy.context.scene)


def along(found, start, parts=9):
    """Places on links between joints (n, 3) after a start."""
    joints = np.array([start, *found])
    shares = np.linspace(0.0, 1.0, parts)[:, None, None]
    return ((1.0 - shares) * joints[:-1] + shares * joints[1:]).reshape(-1, 3)


def from_segment(places, start, end):
    way = np.subtract(end, start)
    shares = np.clip((places - start) @ way / (way @ way), 0.0, 1.0)
    return np.linalg.norm(places - start - shares[:, None] * way, axis=1)


class ShapesTest(support.SceneTestCase):
    def obstacles(self, rig, frames=(1.0,)):
        evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
        settings = evaluated.motus.chains
        touched = [obj.evaluated_get(bpy.context.evaluated_depsgraph_get()) for obj in colliders.objects(rig.motus.chains)]
        found = colliders.over_time(settings, touched, bpy.context.scene)
        return types.SimpleNamespace(**colliders.at(found, np.array(frames, float), 0.5))

    def test_empties(self):
        rig = cases.still_rope(2)
        ball = empty("Ball", size=0.5, scale=(2.0, 2.0, 2.0), location=(1.0, 2.0, 3.0))
        capsule = empty("Capsule", size=0.5, scale=(1.0, 0.4, 3.0), location=(0.0, 0.0, 1.0), turn=(np.pi / 2.0, 0.0, 0.0))
        plane = empty("Plane", 'PLAIN_AXES', location=(0.0, 0.0, -1.0))
        cases.add(rig, colliders=collection_of(ball, capsule, plane, support.link("Lamp", bpy.data.lights.new("Lamp", 'POINT'))))
        found = self.obstacles(rig, (1.0, 2.0))
        self.assertEqual(found.obstacles, ["capsule", "capsule", "plane"])
        np.testing.assert_allclose(found.radii, [1.0, 0.5, 0.0], rtol=1e-6)
        np.testing.assert_array_equal(found.obstacle_places[:, 0], np.broadcast_to((1.0, 2.0, 3.0), (2, 2, 3)))
        # 3 * 0.5 long to either side, of which 0.5 is round; Z has become -Y.
        np.testing.assert_allclose(found.obstacle_places[1, 1], [(0.0, 1.0, 1.0), (0.0, -1.0, 1.0)], atol=1e-6)
        np.testing.assert_allclose(found.obstacle_places[0, 2], [(0.0, 0.0, -1.0), (0.0, 0.0, 0.0)], atol=1e-6)

    def test_bones(self):
        rig = cases.still_rope(2)
        rig.scale = (2.0, 2.0, 2.0)
        root = rig.data.bones["Root"]
        root.head_radius, root.tail_radius = 0.1, 0.2
        other = cases.still_rope(1, name="Other", tilt=0.0)
        other.location = (1.0, 0.0, 0.0)
        other.data.bones["Root"].use_deform = False
        cases.add(rig, colliders=collection_of(rig, other))
        found = self.obstacles(rig)
        # Of the rig itself the root alone, of the other rig the deforming bone alone.
        self.assertEqual(found.obstacles, ["capsule"] * 2)
        bone = other.data.bones["Tail 0 0"]
        np.testing.assert_allclose(found.radii, [0.4, max(bone.head_radius, bone.tail_radius)], rtol=1e-6)
        np.testing.assert_allclose(found.obstacle_places[0, 0, 1], cases.place(rig, 1, "Tail 0 0"), atol=1e-5)
        np.testing.assert_allclose(found.obstacle_places[0, 1], [(1.0, 0.0, 1.0), (1.0, 0.0, 1.3)], atol=1e-5)
        self.assertIsNone(told(rig))

    def test_meshes(self):
        """However an object is scaled, sheared and mirrored, its points are where Blender has them."""
        rig = cases.still_rope(2)
        above = empty("Above", 'PLAIN_AXES', scale=(1.0, 3.0, 0.5), turn=(0.3, 0.2, 0.1))
        floor = grid(location=(0.5, 0.0, 0.2), turn=(0.5, 0.4, 0.3), scale=(-1.0, 0.5, 2.0))
        floor.modifiers.new("Thick", 'SOLIDIFY').thickness = 0.3
        flat = grid("Flat", scale=(1.0, 1.0, 0.0))
        floor.parent = above
        dynamics_cases.key(above, "location", {1: (0.0, 0.0, 0.0), 30: (1.0, 2.0, 3.0)})
        cases.add(rig, colliders=collection_of(floor, flat))
        made = []
        with mock.patch.object(support.addon("core.native").module, "StrandSurface", lambda points, _: made.append(points) or Kept()):
            support.addon().forget_all()
            found = self.obstacles(rig, (1.0, 30.0))
        evaluated = floor.evaluated_get(bpy.context.evaluated_depsgraph_get())
        points = np.array([tuple(vertex.co) for vertex in evaluated.data.vertices])
        self.assertGreater(len(points), len(floor.data.vertices))
        for row, frame in enumerate((1, 30)):
            world = cases.matrix(floor, frame)
            placed = made[0] @ found.surface_matrices[row, 0, :3, :3].T + found.surface_matrices[row, 0, :3, 3]
            np.testing.assert_allclose(placed, points @ world[:3, :3].T + world[:3, 3], atol=1e-5)
            np.testing.assert_allclose(
                found.surface_matrices[row, 1, :3, :3] @ found.surface_matrices[row, 1, :3, :3].T, np.eye(3), atol=1e-12
            )

    def test_what_is_left_out(self):
        rig = cases.still_rope(2)
        waving = grid("Waving")
        cases.add(rig, **LIMP, colliders=collection_of(grid(), grid("Empty", count=1), waving))
        bpy.data.meshes["Empty"].clear_geometry()
        cases.go_to(2)
        self.assertIsNone(told(rig))
        waving.modifiers.new("Wave", 'WAVE')
        cases.go_to(3)
        self.assertIn("changes its shape", told(rig))
        skin = grid("Skin")
        skin.modifiers.new("Armature", 'ARMATURE').object = rig
        solid = rig.motus.chains.colliders
        solid.objects.link(skin)
        solid.objects.unlink(waving)
        cases.go_to(4)
        self.assertIsNone(told(rig), "it does not wait for itself; the panel says that it is left out")
        self.assertEqual(colliders.objects(rig.motus.chains)[0].name, "Floor")
        with mock.patch.object(colliders, "MOST_TRIANGLES", 10):
            support.addon().forget_all()
            cases.go_to(5)
            self.assertIn("too many triangles", told(rig))


class Kept:
    nbytes = 0


class TouchingTest(support.SceneTestCase):
    def test_a_capsule_is_not_entered(self):
        rig = cases.rope(6)
        start = cases.place(rig, 1, "Tail 0 0")
        centre = start + (0.3, 0.0, -0.6)
        capsule = empty("Capsule", size=0.1, location=centre, scale=(2.0, 8.0, 1.0))
        dynamics_cases.key(capsule, "rotation_euler", {1: (0.0, 0.0, 0.0), 40: (0.0, 0.0, 3.0)})
        cases.add(rig, **LIMP, settle=5.0, colliders=collection_of(capsule))
        self.assertIsNone(told(rig))
        for frame in (1, 12, 15, 18, 22, 40, 80):
            found = cases.tails(rig, frame, cases.chain(rig))
            turn = cases.matrix(capsule, frame)[:3, 1]
            way = turn / np.linalg.norm(turn) * (0.8 - 0.2)
            apart = from_segment(along(found, cases.place(rig, frame, "Tail 0 0")), centre - way, centre + way)
            self.assertGreater(apart.min(), 0.2 + 0.9 * 0.02, frame)

    def test_a_mesh_that_moves_is_not_entered_and_carries(self):
        rig = cases.still_rope(6)
        start = cases.place(rig, 1, "Tail 0 0")
        floor = grid(location=start - (0.0, 0.0, 2.5), turn=(0.2, 0.0, 0.0), scale=(1.5, 0.7, 1.0))
        dynamics_cases.key(floor, "location", {1: floor.location, 10: floor.location, 30: start - (0.0, 0.0, 0.9)})
        cases.add(rig, **LIMP, settle=20.0, colliders=collection_of(floor))
        self.assertIsNone(told(rig))
        for frame in (1, 10, 15.5, 20, 25, 30, 60):
            matrix = cases.matrix(floor, frame)
            heights = (cases.tails(rig, frame, cases.chain(rig)) - matrix[:3, 3]) @ (matrix[:3, 2] / np.linalg.norm(matrix[:3, 2]))
            self.assertGreater(heights.min(), 0.9 * 0.02, frame)
        self.assertLess(heights.min(), 0.03)

    def test_any_frame_in_any_order(self):
        rig = cases.rope(6)
        start = cases.place(rig, 1, "Tail 0 0")
        other = cases.still_rope(2, name="Other")
        other.location = start + (0.2, 0.3, -0.5)
        floor = grid(location=start - (0.0, 0.0, 1.3), turn=(0.2, 0.0, 0.0))
        dynamics_cases.key(floor, "rotation_euler", {1: (0.2, 0.0, 0.0), 40: (-0.2, 0.1, 0.3)})
        cases.add(rig, **LIMP, colliders=collection_of(floor, other))
        first = {frame: cases.matrix(rig, frame, "Tail 0 5").tobytes() for frame in FRAMES}
        support.addon().forget_all()
        for frame in reversed(FRAMES):
            self.assertEqual(cases.matrix(rig, frame, "Tail 0 5").tobytes(), first[frame])
        before = cases.tail(rig, 40, "Tail 0 5")
        for vertex in floor.data.vertices:
            vertex.co.z += 0.2
        floor.data.update()
        self.assertGreater(np.linalg.norm(cases.tail(rig, 40, "Tail 0 5") - before), 0.05)

    def test_friction(self):
        """Ground that moves on takes along what lies on it."""
        found = {}
        for friction in (0.0, 3.0):
            support.empty_scene()
            rig = cases.still_rope(8)
            start = cases.place(rig, 1, "Tail 0 0")
            ground = empty("Ground", 'PLAIN_AXES', location=start - (0.0, 0.0, 0.8))
            dynamics_cases.key(ground, "location", {1: ground.location, 60: ground.location, 80: ground.location + Vector((1.0, 0.0, 0.0))})
            cases.add(rig, **LIMP, settle=20.0, friction=friction, colliders=collection_of(ground))
            found[friction] = cases.tail(rig, 85, "Tail 0 7")[0] - cases.tail(rig, 1, "Tail 0 7")[0]
        self.assertLess(abs(found[0.0]), 0.02)
        self.assertGreater(found[3.0], 0.5)

    def hanging_ball(self, name):
        """A rope and a ball at the end of it, which swings."""
        rig = cases.rope(3, name=name)
        cases.add(rig, frequency=0.0, drag=0.2, settle=10.0)
        return rig

    def test_a_collider_that_another_chain_moves(self):
        """It is touched where that chain takes it (Wiggle 2, issue 51)."""
        mover = self.hanging_ball("Mover")
        ball = empty("Ball", size=0.25)
        ball.parent, ball.parent_type, ball.parent_bone = mover, 'BONE', "Tail 0 2"
        rig = cases.still_rope(4)
        # The ball hangs beside the rope, and hits it as it swings.
        rig.location = (1.5, 0.0, 0.15)
        bpy.context.view_layer.update()
        cases.add(rig, **LIMP, settle=20.0, colliders=collection_of(ball))
        self.assertIsNone(told(rig))
        still = cases.tails(rig, 1, cases.chain(rig))
        moved = 0.0
        for frame in (12, 16, 18, 20, 24, 28, 35, 50):
            found = cases.tails(rig, frame, cases.chain(rig))
            centre = cases.place(ball, frame)
            apart = np.linalg.norm(along(found, cases.place(rig, frame, "Tail 0 0")) - centre, axis=1)
            self.assertGreater(apart.min(), 0.25 + 0.9 * 0.02, frame)
            moved = max(moved, np.abs(found - still).max())
        self.assertGreater(moved, 0.2)
        # Bones that another chain moves are capsules as well.
        rig.location.z = 0.6
        rig.motus.chains.colliders.objects.unlink(ball)
        rig.motus.chains.colliders.objects.link(mover)
        for bone in mover.data.bones:
            bone.head_radius = bone.tail_radius = 0.15
        bpy.context.view_layer.update()
        self.assertIsNone(told(rig))
        still = cases.tails(rig, 1, cases.chain(rig))
        moved = 0.0
        for frame in (12, 16, 18, 20, 24, 28, 35, 50):
            found = cases.tails(rig, frame, cases.chain(rig))
            places = along(found, cases.place(rig, frame, "Tail 0 0"))
            for bone in ("Root", *cases.chain(mover)):
                apart = from_segment(places, cases.place(mover, frame, bone), cases.tail(mover, frame, bone))
                self.assertGreater(apart.min(), 0.14, f"{frame} {bone}")
            moved = max(moved, np.abs(found - still).max())
        self.assertGreater(moved, 0.1)

    def test_the_own_rig_without_what_the_chain_drives(self):
        """A ponytail that lies on the back: it does not enter the bones that it does not drive."""
        rig = cases.still_rope(5, tilt=0.0)
        for name in cases.chain(rig):
            rig.data.bones[name].head_radius = rig.data.bones[name].tail_radius = 0.5
        rig.data.bones["Root"].head_radius = rig.data.bones["Root"].tail_radius = 0.2
        rig.rotation_euler.x = -0.15
        cases.add(rig, **LIMP, settle=20.0, colliders=collection_of(rig))
        self.assertIsNone(told(rig))
        found = along(cases.tails(rig, 60, cases.chain(rig)), cases.place(rig, 60, "Tail 0 0"))
        apart = from_segment(found[1:], cases.place(rig, 60, "Root"), cases.tail(rig, 60, "Root"))
        hanging = found[found[:, 2] < cases.place(rig, 60, "Tail 0 0")[2] - 0.3]
        self.assertGreater(len(hanging), 10)
        self.assertGreater(from_segment(hanging, cases.place(rig, 60, "Root"), cases.tail(rig, 60, "Root")).min(), 0.2 + 0.8 * 0.02)
        self.assertTrue(np.isfinite(apart).all())


class ReportedTest(support.SceneTestCase):
    """What users of Wiggle 2 and of Jiggle Physics report."""

    def speeds(self, rig, frames):
        seconds = np.diff(frames) / 24.0
        places = [cases.tails(rig, frame, cases.chain(rig)) for frame in frames]
        return np.linalg.norm(np.diff(places, axis=0), axis=2) / seconds[:, None]

    def test_many_balls_that_overlap(self):
        """Contacts do not explode (Wiggle 2, issues 103 and 104)."""
        rig = cases.rope(8)
        start = cases.place(rig, 1, "Tail 0 0")
        numbers = np.random.default_rng(1)
        balls = []
        for index in range(24):
            place = start + numbers.uniform((-0.5, -0.5, -2.5), (2.5, 0.5, 0.2))
            balls.append(empty(f"Ball {index}", size=numbers.uniform(0.1, 0.5), location=place))
        cases.add(rig, frequency=0.0, drag=0.0, thickness=0.05, settle=1.0, colliders=collection_of(*balls))
        found = self.speeds(rig, np.arange(1.0, 60.0, 0.5))
        self.assertTrue(np.isfinite(found).all())
        self.assertLess(found.max(), 100.0)

    def lies(self, floor):
        rig = cases.still_rope(40, tilt=0.4)
        rig.location.z = 0.5
        cases.add(rig, frequency=0.0, drag=1.0, thickness=0.03, settle=0.0, colliders=collection_of(floor))
        bpy.context.scene.frame_end = 300
        lowest = min(cases.tails(rig, frame, cases.chain(rig))[:, 2].min() for frame in (5, 20, 40, 80, 160, 300))
        self.assertIsNone(told(rig))
        self.assertGreater(lowest, 0.0)
        self.assertLess(self.speeds(rig, np.array([280.0, 290.0, 300.0])).max(), 1e-3)

    def test_a_long_chain_on_a_plane(self):
        """It comes to rest (Jiggle Physics, issue 37)."""
        self.lies(empty("Ground", 'PLAIN_AXES'))

    def test_a_long_chain_on_a_mesh(self):
        self.lies(grid(size=20.0))

    def test_what_is_scaled_unevenly(self):
        """Bones keep their lengths, and hang from where their parent has them (Wiggle 2, issue 32)."""
        above = empty("Above", 'PLAIN_AXES', scale=(2.0, 0.5, 1.0), turn=(0.0, 0.0, 0.6))
        rig = cases.still_rope(4)
        rig.parent = above
        rig.scale = (1.0, 1.5, 0.8)
        bpy.context.view_layer.update()
        plain = cases.place(rig, 1, "Tail 0 0")
        cases.add(rig, **LIMP, settle=60.0)
        self.hangs(rig, plain)
        rig.motus.chains.colliders = collection_of(empty("Ground", 'PLAIN_AXES', location=(0.0, 0.0, -20.0)))
        for frame in (5, 30.5):
            self.hangs(rig, plain, frame)
        flag = support.link("Flag", parent=rig)
        flag.parent_type, flag.parent_bone = 'BONE', "Tail 0 3"
        bpy.context.view_layer.update()
        track = support.addon("core.tracks").world_track(flag.evaluated_get(cases.go_to(9)), bpy.context.scene)
        np.testing.assert_allclose(track.values([9.0])[0], cases.matrix(flag, 9), atol=1e-4)

    def hangs(self, rig, start, frame=1):
        """Straight down from a start, and each bone is as long as ever in the rig's own space."""
        np.testing.assert_allclose(cases.place(rig, frame, "Tail 0 0"), start, atol=1e-5)
        back = np.linalg.inv(cases.matrix(rig, frame))
        for name in cases.chain(rig):
            head, tail = cases.place(rig, frame, name), cases.tail(rig, frame, name)
            self.assertLess(np.abs((tail - start)[:2]).max(), 2e-3)
            self.assertLess(tail[2], head[2])
            self.assertAlmostEqual(np.linalg.norm(back[:3, :3] @ (tail - head)), cases.LENGTH, places=5)
