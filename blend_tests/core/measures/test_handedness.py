"""Every system under one table of parents: placed, larger, mirrored, uneven, sheared, and these together.

What is right: the follower's axes as without parents; tips, eyes and vertices at their goals in the world; what hangs on its owner
(pendulums, layers) the matrix times what it is without it.
"""

import math

import bpy
import numpy as np
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Euler, Matrix, Vector

import support
from ik import ik_cases
from lattice import lattice_cases
from layers import layer_cases
from look_at import look_at_cases
from path import path_cases
from snow import snow_cases
from stereo import stereo_cases
from walker import walker_cases

TURN = Euler((0.4, -0.3, 1.1)).to_matrix().to_4x4()
PLACE = Matrix.Translation((1.0, 2.0, 0.5))


def scaled(*factors):
    return Matrix.Diagonal((*factors, 1.0))


PARENTS = {
    "none": Matrix(),
    "placed": PLACE @ TURN,
    "larger": PLACE @ TURN @ scaled(2.5, 2.5, 2.5),
    "mirrored": PLACE @ TURN @ scaled(-1.0, 1.0, 1.0),
    "inside out": PLACE @ TURN @ scaled(-2.0, -2.0, -2.0),
    "uneven": PLACE @ TURN @ scaled(1.0, 1.6, 0.7),
    "mirrored and uneven": PLACE @ TURN @ scaled(1.0, 1.6, -0.7),
    "sheared": PLACE @ scaled(1.0, 2.0, 0.6) @ TURN,
    "mirrored and sheared": PLACE @ scaled(-1.0, 1.8, 0.7) @ TURN,
}


def put_under(obj, matrix):
    """Give an object parents whose matrices are together this one: U S V, by the singular values."""
    u, sizes, v = np.linalg.svd(np.array(matrix.to_3x3()))
    sizes = sizes * (1.0, 1.0, np.linalg.det(u) * np.linalg.det(v))
    u[:, 2] *= np.linalg.det(u)
    v[2] *= np.linalg.det(v)
    outer, inner = (bpy.data.objects.new(f"{obj.name} {name}", None) for name in ("Outer", "Inner"))
    for one, turn in ((outer, u), (inner, v)):
        bpy.context.scene.collection.objects.link(one)
        one.rotation_mode = 'QUATERNION'
        one.rotation_quaternion = Matrix(turn.tolist()).to_quaternion()
    outer.location, outer.scale = matrix.translation, sizes.tolist()
    inner.parent, obj.parent = outer, inner
    bpy.context.view_layer.update()
    return matrix @ obj.matrix_basis


class ParentsTestCase(support.SceneTestCase):
    """Each test goes through the table, in a scene of its own each time."""

    parents = ""

    def each(self):
        for self.parents, matrix in PARENTS.items():
            support.empty_scene()
            bpy.context.scene.render.fps = 24
            yield matrix

    def world(self, obj, frame=None):
        if frame is not None:
            bpy.context.scene.frame_set(frame)
        bpy.context.view_layer.update()
        return obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.copy()

    def bone(self, rig, name):
        bpy.context.view_layer.update()
        evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
        return evaluated.matrix_world @ evaluated.pose.bones[name].matrix

    def assertNear(self, found, wanted, tolerance=1e-4):
        found, wanted = np.array(found), np.array(wanted)
        np.testing.assert_allclose(found, wanted, atol=tolerance * max(1.0, np.abs(wanted).max()), err_msg=self.parents)


class Paths(ParentsTestCase):
    def course(self):
        data = path_cases.curve_data("Course")
        path_cases.add_bezier(data, path_cases.cubic_knots(path_cases.CLIMB))
        for point, tilt in zip(data.splines[0].bezier_points, (0.3, 0.7)):
            point.tilt = tilt
        return self.link("Course", data)

    def follow(self, name, **keywords):
        obj = bpy.data.objects.get(name) or self.link(name)
        bpy.ops.motus.path_follow_add(object=name, curve="Course", timing='SPEED', speed=5.0, **keywords)
        return obj

    def axes(self, obj):
        world = self.world(obj, 20)
        return [world.translation, *(world.to_3x3().col[axis].normalized() for axis in (1, 2))]

    def test_follower_and_wagon(self):
        """Whatever its parents and its own scale are, place, forward and up are those of a follower without any."""
        for matrix in self.each():
            self.course()
            plain, hung, wagon = self.follow("Plain"), self.link("Hung"), self.link("Wagon")
            put_under(hung, matrix)
            put_under(wagon, matrix)
            for scale in ((1.0, 1.0, 1.0), (-1.0, 1.0, 1.0), (1.0, -2.0, 1.0), (-1.5, -1.5, -1.5)):
                hung.scale = wagon.scale = scale
                for orientation in ('WORLD_UP', 'BANKING'):
                    bpy.ops.motus.path_follow_add(object="Plain", curve="Course", orientation=orientation)
                    bpy.ops.motus.path_train_add(
                        objects="Hung,Wagon", curve="Course", gap=0.001, timing='SPEED', speed=5.0, orientation=orientation
                    )
                    wanted = self.axes(plain)
                    self.assertNear(self.axes(hung), wanted)
                    self.assertNear(self.axes(wagon), wanted, 5e-3)

    def test_curve(self):
        """A mirrored curve that keeps Z up is gone along by the mirror image, in every orientation."""
        upright = Matrix.Rotation(0.7, 4, 'Z')
        for factors in ((1.0, 1.0, 1.0), (-1.0, 1.0, 1.0), (1.0, -1.0, 1.0)):
            matrix = PLACE @ upright @ scaled(*factors)
            for orientation in ('WORLD_UP', 'MINIMAL', 'BANKING', 'CURVATURE', 'TILT'):
                support.empty_scene()
                bpy.context.scene.render.fps = 24
                course, car = self.course(), self.follow("Car", orientation=orientation)
                place, forward, up = self.axes(car)
                put_under(course, matrix)
                linear = matrix.to_3x3()
                with self.subTest(orientation=orientation, factors=factors):
                    self.assertNear(self.axes(car), [matrix @ place, linear @ forward, linear @ up])


class Rigs(ParentsTestCase):
    def test_tip_meets_the_target_and_the_elbow_its_pole(self):
        for matrix in self.each():
            rig = self.link("Arm", bpy.data.armatures.new("Arm"))
            bpy.context.view_layer.objects.active = rig
            bpy.ops.object.mode_set(mode='EDIT')
            ik_cases.add_chain(rig.data.edit_bones, "Bone", ik_cases.ARM, None)
            bpy.ops.object.mode_set(mode='OBJECT')
            put_under(rig, matrix)
            target = self.link("Target", location=matrix @ Vector(ik_cases.REACHABLE))
            pole = self.link("Pole", location=matrix @ Vector((0.7, -2.0, 1.5)))
            bpy.ops.motus.ik_add(object="Arm", bone="Bone 1", target="Target", pole="Pole")
            evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
            root, elbow, tip = (
                self.bone(rig, "Bone 0").translation,
                self.bone(rig, "Bone 1").translation,
                evaluated.matrix_world @ evaluated.pose.bones["Bone 1"].tail,
            )
            self.assertNear(tip, target.location)
            along = (target.location - root).normalized()
            sides = [place - root - along * (place - root).dot(along) for place in (elbow, pole.location)]
            self.assertLess(sides[0].angle(sides[1]), 1e-3, self.parents)

    def test_eyes_meet_the_target(self):
        for matrix in self.each():
            rig = look_at_cases.build_rig()
            put_under(rig, matrix)
            target = self.link("Target", location=matrix @ Vector((0.6, -3.0, 2.1)))
            bpy.ops.motus.look_at_add(
                object="Rig", bone="Head", target="Target", body_weight=0.2, head_weight=0.5, eyes_weight=1.0, clamp=0.0
            )
            entry = rig.motus.look_at.entries["Head"]
            entry.eyes_limit = entry.head_limit = entry.body_limit = math.pi
            for scale in ((1.0, 1.0, 1.0), (-1.0, 1.0, 1.0), (-1.0, -1.0, -1.0)):
                rig.pose.bones["Head"].scale = scale
                for eye in ("Eye.L", "Eye.R"):
                    world = self.bone(rig, eye)
                    gaze = world.to_3x3().col[1]
                    self.assertLess(gaze.angle(target.location - world.translation), 2e-3, (self.parents, eye, scale))


class Shapes(ParentsTestCase):
    def ball(self, matrix):
        ball = lattice_cases.ball()
        put_under(ball, matrix)
        return ball

    def shape(self, obj):
        bpy.context.view_layer.update()
        return np.array(lattice_cases.evaluated(obj), float)

    def test_lattice(self):
        """Fitting moves nothing; a vertex that is pulled moves by the displacement in the world; applying keeps that."""
        for matrix in self.each():
            ball = self.ball(matrix)
            before = self.shape(ball)
            bpy.ops.motus.lattice_fit(objects=ball.name)
            self.assertNear(self.shape(ball), before, 1e-5)
            bpy.ops.motus.lattice_pull(object=ball.name, vertex=40, displacement=(0.1, -0.2, 0.3))
            pulled = self.shape(ball)
            self.assertNear(pulled[40] - before[40], (0.1, -0.2, 0.3))
            bpy.ops.motus.lattice_remove(objects=ball.name, use_apply=True)
            self.assertNear(self.shape(ball), pulled, 1e-5)

    def test_pull_and_pin(self):
        """A root moves by the displacement in the world, and along its normal outwards, whichever hand the object has."""
        for matrix in self.each():
            ball = self.ball(matrix)
            before = self.shape(ball)
            bpy.ops.motus.pick_pull(object=ball.name, vertex=40, displacement=(0.1, -0.2, 0.3), radius=0.3)
            pulled = self.shape(ball)
            self.assertNear(pulled[40] - before[40], (0.1, -0.2, 0.3))
            bpy.ops.motus.pin_add(object=ball.name, vertex=200, displacement=(-0.3, 0.1, 0.2), radius=0.3)
            self.assertNear(self.shape(ball)[200] - pulled[200], (-0.3, 0.1, 0.2))
            far = before - before.mean(axis=0)
            outwards = np.linalg.inv(np.array(matrix.to_3x3())).T @ np.linalg.inv(np.array(matrix.to_3x3())) @ far[120]
            bpy.ops.motus.pick_pull(object=ball.name, vertex=120, direction='NORMAL', strength=0.1, radius=0.3)
            self.assertGreater((self.shape(ball)[120] - pulled[120]) @ outwards, 0.0)


class Hanging(ParentsTestCase):
    """What is on top of its owner's own transform: the parents' matrix times what it is without them."""

    def test_pendulum(self):
        wanted = None
        for matrix in self.each():
            bpy.ops.motus.pendulum_add(kind='DOUBLE', location=(0.2, 0.1, 0.3), angle1=0.5, angle2=-0.4)
            pivot = bpy.context.object
            bobs = [rod.bob for rod in pivot.motus.pendulum.rods]
            put_under(pivot, matrix)
            found = [self.world(bob, 17).translation for bob in bobs]
            wanted = wanted or found
            self.assertNear(found, [matrix @ place for place in wanted])

    def test_dynamics(self):
        """A ball that is moved in its parents' space springs there."""
        wanted = None
        for matrix in self.each():
            ball = self.link("Ball")
            for frame, place in ((1, (0.0, 0.0, 0.0)), (10, (2.0, 1.0, 0.0)), (30, (0.0, 0.0, 1.0))):
                ball.location = place
                ball.keyframe_insert("location", frame=frame)
            put_under(ball, matrix)
            bpy.ops.motus.dynamics_add(object="Ball", style='BOUNCY', channels={'LOCATION'})
            found = self.world(ball, 17).translation
            wanted = wanted or found
            self.assertNear(found, matrix @ wanted)

    def test_layers(self):
        wanted = None
        for matrix in self.each():
            rig = look_at_cases.build_rig()
            layer_cases.turning("Wave", layer_cases.THROWING)
            bpy.ops.motus.layer_add(object=rig.name, action="Wave", bones="Chest")
            put_under(rig, matrix)
            bpy.context.scene.frame_set(13)
            found = [np.array(self.bone(rig, bone)) for bone in ("Chest", "Head", "LowerArm.L")]
            wanted = wanted or found
            self.assertNear(found, [np.array(matrix) @ pose for pose in wanted])


class Walkers(ParentsTestCase):
    def test_standing_feet_stay(self):
        """On a level ground, under parents that keep Z up: what stands stays where it is in the world, and legs reach their feet."""
        for factors, turn in (((2.0, 2.0, 2.0), 0.0), ((-1.0, 1.0, 1.0), 0.5), ((1.0, 1.4, 0.8), 0.5), ((1.0, -1.4, 0.8), 0.5)):
            support.empty_scene()
            bpy.context.scene.render.fps = 24
            spider = walker_cases.spider(ahead=0.0)
            put_under(spider, Matrix.Translation((1.0, 2.0, 0.0)) @ scaled(*factors) @ Matrix.Rotation(turn, 4, 'Z'))
            outer = bpy.data.objects[f"{spider.name} Outer"]
            x, y, z = outer.location
            support.key_places(outer, {1: (x, y, z), 40: (x, y + 1.2, z)})
            with self.subTest(factors=factors, turn=turn):
                self.assert_stand(spider)

    def assert_stand(self, spider):
        before, stood = None, 0
        for frame in range(5, 36):
            support.go_to(frame)
            places = walker_cases.places(spider)
            self.assertNear(walker_cases.tips(spider), places, 1e-3)
            stands = np.array(walker_cases.plan_of(spider).walker.swing(frame / 24.0)) == walker_cases.STANDS
            if before is not None:
                both = stands & before[1]
                self.assertNear(places[both], before[0][both], 1e-5)
                stood += both.sum()
            before = places, stands
        self.assertGreater(stood, 80)
        self.assertEqual(len(walker_cases.plan_of(spider).walker.problems), 0)


class Snowfall(ParentsTestCase):
    def test_flakes_go_along_the_emitters_axis(self):
        """From its place, along its Z axis as it is in the world, and as fast whatever it is scaled by."""
        for matrix in self.each():
            bpy.ops.motus.snow_add(preset='PLAIN', location=(0.3, 0.2, 0.1), start_frame=1, emitter_radius=0.0)
            emitter = bpy.context.object
            world = put_under(emitter, matrix)
            support.go_to(30)
            found = snow_cases.flakes(emitter)
            along = np.array(world.to_3x3().col[2].normalized())
            self.assertGreater(len(found["age"]), 4)
            self.assertNear(found["position"], np.array(world.translation) + 5.0 * np.outer(found["age"], along), 1e-4)


class Cameras(ParentsTestCase):
    """What a camera sees under the table's parents is what Blender says of it (world_to_camera_view): across, up, and the depth."""

    def camera(self, matrix):
        """(a camera under parents, camera space as Blender sees it -> world)."""
        camera = stereo_cases.camera()
        world = put_under(camera, matrix)
        return camera, world.normalized()

    def test_stereo_focus_lies_on_the_screen(self):
        for matrix in self.each():
            camera, _ = self.camera(matrix)
            focus = self.link("Focus", location=matrix @ Vector((0.4, 3.0, 0.2)))
            bpy.ops.motus.stereo_rig_add(object="Camera", focus="Focus")
            bpy.context.view_layer.update()
            depth = world_to_camera_view(bpy.context.scene, camera, focus.location).z
            self.assertNear(stereo_cases.eyes(camera)[1], depth)

    def test_stereo_measures_a_wall(self):
        for matrix in self.each():
            camera, seen = self.camera(matrix)
            wall = stereo_cases.square("Wall", (0.0, 0.0, 0.0))
            for vertex, (x, y) in zip(wall.data.vertices, ((-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0))):
                vertex.co = seen @ Vector((x, y, -4.0))
            bpy.ops.motus.stereo_rig_add(object="Camera", convergence='BUDGET')
            bpy.ops.motus.stereo_measure(object="Camera", range='CURRENT')
            self.assertNear(camera.motus.stereo.near, 4.0)

    def test_plane_of_a_chroma_key_fills_the_picture(self):
        for matrix in self.each():
            camera, _ = self.camera(matrix)
            image = bpy.data.images.new("Screen", 8, 8)
            image.pixels = [0.1, 0.6, 0.1, 1.0] * 64
            bpy.ops.motus.chroma_key_setup(clip="Screen", camera="Camera", use_plane=True, plane_distance=7.0)
            bpy.context.view_layer.update()
            plane = bpy.context.scene.motus.chroma.plane
            corners = [world_to_camera_view(bpy.context.scene, camera, plane.matrix_world @ vertex.co) for vertex in plane.data.vertices]
            self.assertNear(sorted((round(place.x), round(place.y)) for place in corners), [(0, 0), (0, 1), (1, 0), (1, 1)], 0.0)
            self.assertNear(corners, [(round(place.x), round(place.y), 7.0) for place in corners])
