"""Squash: bones of chains that take on the lengths of their links, and keep their volume."""

import functools
import math

import bpy
import numpy as np

import solved_cases
import support
from chains import chain_cases as cases
from dynamics import dynamics_cases

SOFT = {"frequency": 2.0, "damping": 0.3, "gravity": 0.0, "drag": 0.0, "stretch": 1.0, "squash": 1.0}
UP = {1: (0.0, 0.0, 0.0), 10: (0.0, 0.0, 0.0), 16: (0.0, 0.2, 0.0)}
FRAMES = (1, 12, 14.5, 20, 33)


def bouncing(count=1, tilt=0.0, inherits='NONE'):
    """A rope() whose root is thrown up along the chain. inherits: Inherit Scale of all its bones."""
    rig = cases.rope(count, tilt=tilt)
    rig.animation_data_clear()
    cases.key(rig.pose.bones["Root"], "location", UP)
    for bone in rig.data.bones:
        bone.inherit_scale = inherits
    return rig


def scales(rig, frame, bone="Tail 0 0"):
    """Lengths of the axes of a bone in the world on a frame."""
    return np.linalg.norm(cases.matrix(rig, frame, bone)[:3, :3], axis=0)


def interpolated(heights, frames):
    """Heights {frame: m} at frames (n,), as places (n, 3)."""
    return np.interp(frames, list(heights), list(heights.values()))[:, None].repeat(3, 1)


def moved(rig):
    """The motion of the only chain of a rig, solved to its end: a function of the frame that returns the places of the particles."""
    (made,) = cases.made(lambda: setattr(rig.motus.chains.entries[0], "drag", rig.motus.chains.entries[0].drag + 0.01))
    keywords = {name: value for name, value in vars(made).items() if name not in ("parents", "times", "poses")}
    solver = cases.solver()(made.parents, made.times, made.poses, **keywords)
    solver.solve()
    return lambda frame: np.array(solver.places(frame / 24.0))


class SquashTest(support.SceneTestCase):
    def test_a_bone_is_as_long_as_the_second_order_system_says(self):
        """Its tail is on the spring of the chain, and on that of Stretch, whose pull is the bone's weight over what that lengthens it by."""
        for stretch in (100.0, 0.2):
            support.empty_scene()
            rig = bouncing()
            plain = {frame: cases.tail(rig, frame, "Tail 0 0")[2] for frame in np.arange(8, 8 * 60) / 8}
            (entry,) = cases.add(rig, **SOFT | {"stretch": stretch})
            weight = 9.80665 / (entry.stretch * cases.LENGTH * math.tau**2)
            frequency = math.sqrt(2.0**2 + weight)
            numbers = frequency, entry.damping * 2.0 / frequency, 0.0
            longest = []
            for frame in (12, 16, 19, 24, 31.5, 40):
                wanted = dynamics_cases.filtered(functools.partial(interpolated, plain), numbers, frame, last=59)
                head = cases.place(rig, frame, "Tail 0 0")[2]
                along = (wanted[0] - head) / cases.LENGTH
                longest.append(abs(along - 1.0))
                found = scales(rig, frame)
                np.testing.assert_allclose(found, [along**-0.5, along, along**-0.5], atol=4e-3, err_msg=f"{stretch} {frame}")
                self.assertAlmostEqual(float(np.prod(found)), 1.0, delta=1e-6)
            self.assertGreater(max(longest), 0.08)

    def test_the_bones_of_a_chain_end_where_the_particles_are(self):
        """Also in rigs that are scaled, unevenly too, and of bones that keys scale and turn."""
        for scale, inherits in (((1.0, 1.0, 1.0), 'NONE'), ((2.0, 2.0, 2.0), 'AVERAGE'), ((1.0, 1.5, 0.7), 'NONE')):
            with self.subTest(scale=scale, inherits=inherits):
                support.empty_scene()
                rig = bouncing(3, tilt=2.5, inherits=inherits)
                rig.scale = scale
                rig.pose.bones["Tail 0 1"].scale = (1.2, 1.2, 1.2)
                rig.pose.bones["Tail 0 1"].rotation_quaternion = (0.96, 0.0, 0.0, 0.28)
                cases.add(rig, **SOFT | {"gravity": 0.5})
                places = moved(rig)
                for frame in FRAMES:
                    np.testing.assert_allclose(cases.tails(rig, frame, cases.chain(rig)), places(frame)[1:], atol=1e-5)
                self.assertIsNone(cases.problem(rig))

    def test_a_part_of_squash_or_weight_is_a_power_of_the_ratio(self):
        rig = bouncing()
        (entry,) = cases.add(rig, **SOFT)
        whole = scales(rig, 15)
        self.assertGreater(abs(whole[1] - 1.0), 0.1)
        for name in ("squash", "weight"):
            setattr(entry, name, 0.5)
            np.testing.assert_allclose(scales(rig, 15), np.sqrt(whole), atol=1e-5, err_msg=name)
            setattr(entry, name, 1.0)
        entry.weight = 0.0
        np.testing.assert_array_equal(scales(rig, 15), (1.0, 1.0, 1.0))
        entry.weight, entry.is_muted = 1.0, True
        np.testing.assert_array_equal(scales(rig, 15), (1.0, 1.0, 1.0))

    def test_bones_whose_children_inherit_their_scale_keep_their_lengths(self):
        for inherits in ('FULL', 'FIX_SHEAR', 'ALIGNED'):
            support.empty_scene()
            rig = bouncing(3, inherits=inherits)
            cases.add(rig, **SOFT)
            for name in cases.chain(rig)[:2]:
                np.testing.assert_allclose(scales(rig, 15, name), (1.0, 1.0, 1.0), atol=1e-6)
            self.assertGreater(np.ptp([scales(rig, frame, "Tail 0 2")[1] for frame in FRAMES]), 0.005, "it has no children")
            sentence = support.addon("chains.told").sentence(rig, cases.problem(rig), bpy.context.scene)
            self.assertEqual(
                sentence, "Tail 0 0 keeps its length, since Tail 0 1 inherits its scale: set Inherit Scale of Tail 0 1 to None"
            )
        for bone in rig.data.bones:
            bone.inherit_scale = 'NONE'
        rig.data.update_tag()
        bpy.context.view_layer.update()
        self.assertGreater(abs(scales(rig, 15)[1] - 1.0), 0.01)
        self.assertIsNone(cases.problem(rig))

    def test_a_bone_is_never_without_length_and_never_endless(self):
        rig = bouncing()
        cases.key(rig.pose.bones["Root"], "location", {1: (0.0, 0.0, 0.0), 10: (0.0, 0.0, 0.0), 12: (0.0, 50.0, 0.0), 14: (0.0, 0.0, 0.0)})
        cases.add(rig, **SOFT | {"stretch": 100.0})
        found = np.array([scales(rig, frame) for frame in np.arange(20, 60) / 2])
        self.assertAlmostEqual(found[:, 1].max(), 5.0, places=4)
        self.assertGreaterEqual(found[:, 1].min(), 0.2 - 1e-6)
        np.testing.assert_allclose(found.prod(axis=1), 1.0, atol=1e-5)

    def test_a_bone_that_keys_flatten_to_nothing_stays_so(self):
        rig = bouncing()
        cases.key(rig.pose.bones["Tail 0 0"], "scale", {1: (1.0, 1.0, 1.0), 20: (1.0, 0.0, 1.0)})
        cases.add(rig, **SOFT)
        self.assertTrue(np.isfinite(cases.matrix(rig, 30, "Tail 0 0")).all())
        np.testing.assert_allclose(scales(rig, 30), (1.0, 0.0, 1.0), atol=1e-6)

    def test_bones_reach_for_a_pin_that_is_out_of_reach(self):
        rig = cases.still_rope(3, tilt=0.0)
        for bone in rig.data.bones:
            bone.inherit_scale = 'NONE'
        cases.add(rig, **SOFT | {"stretch": 0.0})
        place = cases.place(rig, 1, "Tail 0 0") + (0.6, 0.0, 1.2)
        bpy.ops.motus.chains_pin(object=rig.name, bones="Tail 0 2", target=support.link("Far", location=place).name)
        np.testing.assert_allclose(cases.tail(rig, 20, "Tail 0 2"), place, atol=1e-5)
        np.testing.assert_allclose(scales(rig, 20)[1], np.linalg.norm((0.6, 1.2)) / (3 * cases.LENGTH), atol=0.02)

    def test_only_chains_with_squash_have_drivers_for_it(self):
        rig = cases.rope(2, chains=2)
        first, _ = cases.add(rig, "Tail 0 0, Tail 1 0")

        def count():
            return [len(rig.pose.bones[name].constraints) for name in ("Tail 0 0", "Tail 1 0")], len(rig.animation_data.drivers)

        plain = count()
        first.squash = 1.0
        bpy.context.view_layer.update()
        self.assertEqual(count()[0][1], plain[0][1])
        members = [member.channels for group in support.addon("chains.groups").groups(rig) for member in group.members]
        self.assertEqual([("scale" in channels) for channels in members], [True, True, False, False])
        first.squash = 0.0
        bpy.context.view_layer.update()
        self.assertEqual(count(), plain)

    def test_any_frame_first_bake_and_removal(self):
        rig = bouncing(3, tilt=2.5)
        before = {frame: cases.matrix(rig, frame, "Tail 0 2").tobytes() for frame in FRAMES}
        cases.add(rig, **SOFT)
        live = {frame: cases.matrix(rig, frame, "Tail 0 2") for frame in FRAMES}
        support.addon().forget_all()
        for frame in reversed(FRAMES):
            np.testing.assert_array_equal(cases.matrix(rig, frame, "Tail 0 2"), live[frame])
        bpy.context.view_layer.objects.active = rig
        bpy.ops.motus.bake(frame_start=1, frame_end=40)
        for frame in (1, 12, 20, 33):
            np.testing.assert_allclose(cases.matrix(rig, frame, "Tail 0 2"), live[frame], atol=1e-5)
        bpy.ops.motus.unbake()
        for frame in FRAMES:
            np.testing.assert_array_equal(cases.matrix(rig, frame, "Tail 0 2"), live[frame])
        bpy.ops.motus.chains_remove(object=rig.name)
        self.assertEqual({frame: cases.matrix(rig, frame, "Tail 0 2").tobytes() for frame in FRAMES}, before)

    def test_a_loop_and_what_does_not_feel_its_owners_motion(self):
        """The lengths in the animation are those of the shown time of the cycle, and are the same in whichever space is solved."""
        rig = bouncing(2)
        bpy.context.scene.frame_end = 40
        cases.key(rig.pose.bones["Root"], "location", {41: (0.0, 0.0, 0.0)})
        cases.key(rig, "rotation_euler", {1: (0.0, 0.0, 0.0), 20: (1.0, 0.5, 0.0), 41: (0.0, 0.0, 0.0)})
        cases.key(rig.pose.bones["Tail 0 0"], "scale", {1: (1.0, 1.0, 1.0), 20: (1.0, 1.5, 1.0), 41: (1.0, 1.0, 1.0)})
        cases.add(rig, **SOFT, use_loop=True, inherit=0.3)
        self.assertIsNone(cases.problem(rig))
        for frame in (5, 20):
            found = scales(rig, frame)
            own = dynamics_cases.own(rig.pose.bones["Tail 0 0"])(np.array([float(frame)])).scales[0]
            self.assertAlmostEqual(float((found / own).prod()), 1.0, delta=1e-5)
            np.testing.assert_allclose(scales(rig, frame + 40), found / own, atol=1e-5, err_msg="its own scale is 1 then")


class SquashOverTime(solved_cases.Solved, support.SceneTestCase):
    label = "Chains"

    def test_what_hangs_on_a_bone_is_known(self):
        for scale in ((1.0, 1.0, 1.0), (1.0, 1.5, 0.7)):
            support.empty_scene()
            rig = bouncing(2, tilt=2.5)
            rig.scale = scale
            cases.add(rig, **SOFT)
            flag = support.link("Flag", parent=rig)
            flag.parent_type, flag.parent_bone = 'BONE', "Tail 0 1"
            for thing in (rig.pose.bones["Tail 0 0"], rig.pose.bones["Tail 0 1"], flag):
                self.assertSolved(thing, 1e-4)
