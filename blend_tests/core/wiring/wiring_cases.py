"""The ways in which results reach the scene, each as a small scene to test: KINDS."""

import functools
from unittest import mock

import bpy

import support
import toy_system

capabilities = support.addon("core.blender.capabilities")


def build_object(target, **settings):
    """One object that drives itself."""
    owner = toy_system.new_object("Owner", (7.0, 8.0, 9.0))
    owner.rotation_euler = (0.5, 0.6, 0.7)
    owner.scale = (1.0, 2.0, 3.0)
    toy_system.orbit(owner, target, **settings)
    return owner, [owner]


def build_bone(target, **settings):
    """A bone of the owner, within a chain, of a turned armature."""
    owner = toy_system.new_rig()
    owner.location, owner.rotation_euler = (3.0, -1.0, 0.5), (0.2, 0.3, 0.4)
    toy_system.orbit(owner, target, bone="Bone.1", **settings)
    return owner, [owner.pose.bones["Bone.1"]]


def build_followers(target, count=5, **settings):
    """A solver that drives many objects: by a mesh attribute where Blender has the constraint for it."""
    owner = toy_system.new_object("Owner")
    followers = [toy_system.new_object(f"Follower.{index}", (index, 0.0, 0.0)) for index in range(count)]
    toy_system.orbit(owner, target, followers=followers, **settings)
    return owner, followers


def build_followers_without_attribute(target, **settings):
    """The same by Transformation constraints, as files from older Blenders have it."""
    with mock.patch.object(capabilities, "has_geometry_attribute_constraint", return_value=False):
        return build_followers(target, **settings)


KINDS = (build_object, build_bone, build_followers, build_followers_without_attribute)


def each_of(kinds):
    """Makes a decorator that runs a test method, which takes the build function, for every kind in an empty scene."""

    def decorate(test):
        @functools.wraps(test)
        def test_each(self):
            for build in kinds:
                with self.subTest(build.__name__):
                    support.empty_scene()
                    test(self, build)

        return test_each

    return decorate


each_kind = each_of(KINDS)


class WiringTestCase(support.SceneTestCase):
    """Tests with the toy system registered."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        toy_system.register()
        cls.addClassCleanup(toy_system.unregister)

    def assert_follows(self, owner, things, tolerance=1e-5):
        """All driven things stand where the system says."""
        for index, thing in enumerate(things):
            location, rotation = toy_system.expected(owner, index)
            matrix = toy_system.world_matrix(thing)
            self.assert_close(matrix.translation, location, tolerance)
            actual = matrix.to_3x3().normalized()
            for row, wanted in zip(actual, rotation.to_matrix()):
                self.assert_close(row, wanted, tolerance)

    def assert_same_matrix(self, actual, wanted, tolerance=1e-5):
        for row, wanted_row in zip(actual, wanted):
            self.assert_close(row, wanted_row, tolerance)

    def assert_close(self, actual, wanted, tolerance=1e-5):
        for one, other in zip(actual, wanted):
            self.assertAlmostEqual(one, other, delta=tolerance * max(1.0, abs(other)))


def frame_set(frame):
    """Goes to a frame, sub-frames included."""
    whole = int(frame // 1)
    bpy.context.scene.frame_set(whole, subframe=frame - whole)


def assert_playback_equals_jumps(test, read, step=1.0, count=12):
    """Assert that read() gives on frames that are jumped to what it gave when they were played, `step` frames apart."""
    frame_set(1)  # here what is driven is noticed
    played = []
    for index in range(1, count + 1):
        frame_set(step * index)
        played.append(read())
    for index in (count, 4, 2 * count // 3, 1):
        frame_set(step * index)
        test.assertEqual(read(), played[index - 1])
