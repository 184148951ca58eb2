"""Pulling chains by any of their points, without a window."""

import math

import bpy
import numpy as np
from mathutils import Vector

import support
from ik.ik_cases import ARM, IkTestCase, add_bone, add_chain, tentacle, turn


class DragTestCase(IkTestCase):
    def auto_key(self, only_available):
        """Switches on keying by itself, for this test."""
        edit = bpy.context.preferences.edit
        self.addCleanup(setattr, edit, "use_keyframe_insert_available", edit.use_keyframe_insert_available)
        edit.use_keyframe_insert_available = only_available
        self.scene.tool_settings.use_keyframe_insert_auto = True

    def point(self, rig, bone, factor):
        evaluated = self.evaluated(rig)
        posed = evaluated.pose.bones[bone]
        return evaluated.matrix_world @ posed.head.lerp(posed.tail, factor)

    def drag(self, bone, factor, location, rig="Rig", **keywords):
        self.assertEqual(bpy.ops.motus.ik_drag(object=rig, bone=bone, factor=factor, location=location, **keywords), {'FINISHED'})

    def assertPulled(self, rig, bone, factor, shift, tolerance=1e-5):
        place = self.point(rig, bone, factor) + Vector(shift)
        self.drag(bone, factor, place)
        self.assertNear(self.point(rig, bone, factor), place, tolerance)


class OfControlBones(DragTestCase):
    def test_targets_and_poles_are_moved(self):
        rig = self.arm()
        rig.location, rig.rotation_euler, rig.scale = (1.0, 2.0, 3.0), (0.1, 0.2, 0.3), (2.0, 2.0, 2.0)
        self.reach(target="", make_control_bone=True, make_pole=True)
        for bone, factor, shift in (("Target Bone 1", 0.0, (0.1, -0.05, 0.02)), ("Pole Bone 1", 0.6, (-0.2, 0.1, 0.3))):
            posed = rig.pose.bones[bone]
            turned = posed.matrix_basis.to_3x3()
            self.assertPulled(rig, bone, factor, shift)
            self.assertNear(posed.matrix_basis.to_3x3(), turned, 0.0)

    def test_put_back_where_the_drag_ends_as_it_began(self):
        rig = self.arm()
        self.reach(target="", make_control_bone=True)
        control = rig.pose.bones["Target Bone 1"]
        before = tuple(control.location)
        self.drag(control.name, 0.0, self.point(rig, control.name, 0.0))
        self.assertEqual(tuple(control.location), before)

    def test_one_that_is_driven_stays(self):
        rig = self.arm()
        self.reach(target="", make_control_bone=True)
        rig.pose.bones["Target Bone 1"].driver_add("location", 0)
        self.assertRefused("moved by a driver", bpy.ops.motus.ik_drag, object="Rig", bone="Target Bone 1", location=(1, 0, 0))


class WithoutIk(DragTestCase):
    def chain(self, count=5, size=0.3, **options):
        def build(bones):
            root = add_bone(bones, "Root", (0.0, 0.0, -0.5), (0.0, 0.0, 0.0))
            last = add_chain(bones, "Bone", tentacle(count, size), root, **options)
            for side in (-1.0, 1.0):
                add_bone(bones, f"Finger {side}", last.tail, last.tail + Vector((0.1 * side, 0.0, 0.1)), last)

        return self.rig(build)

    def test_any_point_of_any_bone(self):
        for bone, factor in (("Bone 4", 1.0), ("Bone 4", 0.4), ("Bone 2", 0.7), ("Bone 1", 1.0), ("Bone 3", 0.0)):
            with self.subTest(f"{bone} {factor}"):
                self.setUp()
                rig = self.chain()
                turn(rig.pose.bones["Bone 1"], (1.0, 0.0, 0.0), 0.4)
                self.assertPulled(rig, bone, factor, (0.05, 0.1, -0.08))

    def test_only_the_chain_follows(self):
        rig = self.chain()
        before = self.pose(rig, "Root")
        own = np.array(rig.pose.bones["Finger 1.0"].matrix_basis)
        self.assertPulled(rig, "Bone 4", 1.0, (0.1, 0.1, -0.1))
        self.assertNear(self.pose(rig, "Root"), before, 0.0)
        self.assertNear(rig.pose.bones["Finger 1.0"].matrix_basis, own, 0.0)

    def test_chain_ends_at_branches_and_loose_bones(self):
        rig = self.chain()
        free = support.addon("ik.dragging.grab").free_chain
        self.assertEqual(free(rig, "Bone 2", 0), ("Bone 0", "Bone 1", "Bone 2"))
        self.assertEqual(free(rig, "Finger 1.0", 0), ("Finger 1.0",))
        self.assertEqual(free(rig, "Bone 4", 2), ("Bone 3", "Bone 4"))
        self.assertEqual(free(rig, "Finger 1.0", 3), ("Bone 3", "Bone 4", "Finger 1.0"))
        self.reach("Bone 1", target="Elsewhere", chain_length=2)
        self.assertEqual(free(rig, "Bone 4", 0), ("Bone 2", "Bone 3", "Bone 4"))

    def test_no_jump_at_the_start(self):
        rig = self.chain()
        for name, angle in (("Bone 1", 0.5), ("Bone 3", -0.7)):
            turn(rig.pose.bones[name], (0.3, 0.8, 0.4), angle)
        before = self.poses(rig)
        kept = [tuple(bone.rotation_quaternion) for bone in rig.pose.bones]
        self.drag("Bone 4", 0.5, self.point(rig, "Bone 4", 0.5))
        self.assertSamePose(rig, before, 1e-5)
        for bone, values in zip(rig.pose.bones, kept):
            bone.rotation_quaternion = values
        held = support.addon("ik.dragging.grab").grab(bpy.context, rig, "Bone 4", 0.5)
        held.pull(held.point)
        self.assertEqual([tuple(bone.rotation_quaternion) for bone in rig.pose.bones], kept)

    def test_small_pulls_move_little(self):
        rig = self.chain()
        turn(rig.pose.bones["Bone 2"], (1.0, 0.0, 0.0), 0.6)
        before = self.poses(rig)
        held = support.addon("ik.dragging.grab").grab(bpy.context, rig, "Bone 4", 0.3)
        for size in (1e-3, 1e-4):
            held.pull(held.point + Vector((size, 0.0, 0.0)))
            self.assertLess(np.abs(self.poses(rig) - before).max(), 30.0 * size)

    def test_depends_on_the_place_alone(self):
        rig = self.chain()
        held = support.addon("ik.dragging.grab").grab(bpy.context, rig, "Bone 4", 1.0)
        place = held.point + Vector((0.2, -0.1, -0.1))
        held.pull(place)
        first = [tuple(bone.rotation_quaternion) for bone in rig.pose.bones]
        for step in range(10):
            held.pull(held.point + Vector((0.1 * step, math.sin(step), -0.2)))
        held.pull(place)
        self.assertEqual([tuple(bone.rotation_quaternion) for bone in rig.pose.bones], first)

    def test_restored_bit_by_bit(self):
        for mode in ('QUATERNION', 'ZYX', 'AXIS_ANGLE'):
            self.setUp()
            rig = self.chain()
            for bone in rig.pose.bones:
                bone.rotation_mode = mode
                bone.rotation_euler = (7.0, 0.1, -0.3)
                bone.rotation_axis_angle = (9.0, 0.1, 0.9, 0.3)
            before = [
                (tuple(bone.rotation_quaternion), tuple(bone.rotation_euler), tuple(bone.rotation_axis_angle)) for bone in rig.pose.bones
            ]
            held = support.addon("ik.dragging.grab").grab(bpy.context, rig, "Bone 3", 0.5)
            held.pull(held.point + Vector((0.2, 0.1, -0.2)))
            self.assertNear(self.point(rig, "Bone 3", 0.5), held.point + Vector((0.2, 0.1, -0.2)), 1e-5)
            held.restore()
            self.assertEqual(
                [(tuple(bone.rotation_quaternion), tuple(bone.rotation_euler), tuple(bone.rotation_axis_angle)) for bone in rig.pose.bones],
                before,
            )

    def test_scripts_remove_it_meanwhile(self):
        for remove in (lambda rig: bpy.data.objects.remove(rig), lambda rig: self.remove_bone(rig, "Bone 3")):
            self.setUp()
            rig = self.chain()
            held = support.addon("ik.dragging.grab").grab(bpy.context, rig, "Bone 3", 0.5)
            remove(rig)
            self.assertRaises(ReferenceError, held.pull, held.point + Vector((0.2, 0.1, -0.2)))
            self.assertRaises(ReferenceError, held.restore)

    @staticmethod
    def remove_bone(rig, name):
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        rig.data.edit_bones.remove(rig.data.edit_bones[name])
        bpy.ops.object.mode_set(mode='OBJECT')

    def test_scaled_and_turned_rig(self):
        rig = self.chain()
        rig.location, rig.rotation_euler, rig.scale = (1.0, 2.0, 3.0), (0.4, 0.9, -0.2), (2.0, 2.0, 2.0)
        self.assertPulled(rig, "Bone 4", 0.6, (0.2, 0.1, -0.2), 2e-5)

    def test_out_of_reach(self):
        rig = self.chain()
        self.drag("Bone 4", 1.0, (0.0, 0.0, 9.0))
        tip = self.point(rig, "Bone 4", 1.0)
        self.assertNear(tip, (0.0, 0.0, 1.5), 1e-4)

    def test_auto_key(self):
        rig = self.chain()
        self.auto_key(only_available=False)
        self.scene.frame_set(5)
        self.assertPulled(rig, "Bone 2", 1.0, (0.05, 0.1, -0.1))
        curves = support.addon("core.blender.actions").fcurves(rig)
        self.assertEqual({curve.data_path for curve in curves}, {f'pose.bones["Bone {index}"].rotation_quaternion' for index in range(3)})
        self.assertEqual({point.co.x for curve in curves for point in curve.keyframe_points}, {5.0})

    def test_refusals(self):
        rig = self.chain()
        drag = bpy.ops.motus.ik_drag
        self.assertRefused("no bone Nose", drag, object="Rig", bone="Nose", location=(0, 0, 0))
        self.assertRefused("location is missing", drag, object="Rig", bone="Bone 1")
        self.assertRefused("not a finite", drag, object="Rig", bone="Bone 1", location=(math.nan, 0, 0))
        rig.pose.bones["Bone 0"].driver_add("rotation_quaternion", 1)
        self.assertRefused("Bone 0 is moved by a driver", drag, object="Rig", bone="Bone 1", location=(0, 0, 0))


class WithIk(DragTestCase):
    def test_the_target_moves(self):
        rig = self.arm()
        self.reach()
        own = [tuple(bone.rotation_quaternion) for bone in rig.pose.bones]
        self.assertPulled(rig, "Bone 1", 1.0, (0.05, -0.2, 0.1))
        self.assertNear(bpy.data.objects["Target"].location, Vector((0.6, 0.3, 1.4)) + Vector((0.05, -0.2, 0.1)), 1e-5)
        self.assertEqual([tuple(bone.rotation_quaternion) for bone in rig.pose.bones], own)

    def test_points_within_the_chain(self):
        for bone, factor in (("Bone 1", 0.5), ("Bone 1", 0.2), ("Bone 1", 0.0)):
            for pole in (False, True):
                with self.subTest(f"{bone} {factor} {pole}"):
                    self.setUp()
                    rig = self.arm()
                    self.reach(make_pole=pole)
                    place = self.point(rig, bone, factor)
                    elbow_only = factor == 0.0
                    shift = Vector((0.02, -0.05, 0.03))
                    if elbow_only:  # it moves on a sphere about the shoulder
                        root = self.head(rig, "Bone 0")
                        place = root + (place + shift - root).normalized() * (place - root).length
                    else:
                        place = place + shift
                    self.drag(bone, factor, place)
                    left = (self.point(rig, bone, factor) - place).length
                    # A pole holds the plane: only what lies in it can be reached.
                    self.assertLess(left, 0.08 if pole else 1e-4)

    def test_long_chain(self):
        rig = self.arm(tentacle(8))
        self.reach("Bone 7", target="", chain_length=8)
        self.assertPulled(rig, "Bone 5", 0.5, (0.05, 0.02, -0.05), 1e-4)

    def test_effector_that_is_not_in_the_chain(self):
        rig = self.arm()
        self.reach("Hand", use_tail=False, rotation_weight=1.0)
        for factor in (0.0, 0.5, 1.0):
            self.assertPulled(rig, "Hand", factor, (0.05, 0.05, -0.05))

    def test_target_in_another_space(self):
        rig = self.arm()
        holder = self.link("Holder", None, (1.0, 2.0, 3.0))
        holder.rotation_euler, holder.scale = (0.5, 0.2, 0.1), (2.0, 2.0, 2.0)
        self.target(name="Target").parent = holder
        bpy.data.objects["Target"].matrix_parent_inverse = holder.matrix_basis.inverted()
        bpy.data.objects["Target"].delta_location = (0.02, 0.0, 0.05)
        self.reach()
        self.assertPulled(rig, "Bone 1", 1.0, (0.05, -0.2, 0.1))

    def test_target_bone(self):
        def build(bones):
            add_bone(bones, "Root", (0.0, 1.0, 0.0), (0.3, 1.0, 0.4))
            add_bone(bones, "Goal", (0.6, 0.3, 1.4), (0.6, 0.3, 1.6), bones["Root"])
            add_chain(bones, "Bone", ARM)

        rig = self.rig(build)
        turn(rig.pose.bones["Root"], (0.0, 1.0, 0.0), 0.05)
        self.reach(target="Rig", target_bone="Goal")
        self.assertPulled(rig, "Bone 1", 1.0, (0.05, -0.1, 0.1))

    def test_further_target(self):
        rig = self.arm()
        entry = self.reach()
        self.target((0.3, 0.4, 1.2), "Second")
        bpy.ops.motus.ik_target_add(object="Rig", bone="Bone 1", target="Second")
        entry.target_blend = 1.0
        self.assertPulled(rig, "Bone 1", 1.0, (0.05, -0.1, 0.1))
        self.assertNear(bpy.data.objects["Target"].location, (0.6, 0.3, 1.4), 1e-7)
        entry.target_blend = 0.5
        self.assertRefused("between two targets", bpy.ops.motus.ik_drag, object="Rig", bone="Bone 1", location=(0, 0, 0))

    def test_out_of_reach_and_back(self):
        rig = self.arm()
        self.reach()
        held = support.addon("ik.dragging.grab").grab(bpy.context, rig, "Bone 1", 1.0)
        start = tuple(bpy.data.objects["Target"].location)
        held.pull(Vector((5.0, 0.0, 1.0)))
        self.assertLess(bpy.data.objects["Target"].location.length, 10.0)
        held.pull(held.point + Vector((0.0, -0.1, 0.0)))
        self.assertNear(self.tail(rig), held.point + Vector((0.0, -0.1, 0.0)), 1e-5)
        held.restore()
        self.assertEqual(tuple(bpy.data.objects["Target"].location), start)

    def test_back_from_a_target_far_out_of_reach(self):
        for distance in (5.0, 50.0, 500.0):
            for place in ((0.8, 0.2, 1.3), (0.5, -0.9, 0.8), (-0.8, 0.2, 1.3)):
                with self.subTest(distance=distance, place=place):
                    self.setUp()
                    rig = self.arm()
                    self.target((distance, 0.0, 0.0))
                    self.reach()
                    self.drag("Bone 1", 1.0, place)
                    self.assertNear(self.tail(rig), place, 1e-5)

    def test_small_pulls_at_a_target_out_of_reach(self):
        rig = self.arm()
        self.target((5.0, 0.0, 0.0))
        self.reach()
        before = self.tail(rig)
        held = support.addon("ik.dragging.grab").grab(bpy.context, rig, "Bone 1", 1.0)
        for way in ((-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.3, -0.4, 0.5)):
            for size in (1e-4, 1e-3, 1e-2):
                held.pull(held.point + size * Vector(way))
                self.assertLessEqual((self.tail(rig) - before).length, 2.0 * size)

    def test_weight_0_turns_the_bones(self):
        rig = self.arm()
        self.reach(position_weight=0.0)
        self.assertPulled(rig, "Bone 1", 1.0, (-0.2, -0.2, 0.1))
        self.assertEqual(tuple(bpy.data.objects["Target"].location), tuple(Vector((0.6, 0.3, 1.4))))

    def test_limits_are_kept(self):
        rig = self.arm(tentacle(4, 0.3))
        for index in range(4):
            bone = rig.pose.bones[f"Bone {index}"]
            for axis in "xyz":
                setattr(bone, f"use_ik_limit_{axis}", True)
                setattr(bone, f"ik_min_{axis}", -0.3)
                setattr(bone, f"ik_max_{axis}", 0.3)
        self.reach("Bone 3", target="Far", use_limits=True, position_weight=0.0, chain_length=4)
        self.drag("Bone 3", 1.0, (1.0, 0.0, 0.0))
        for index in range(4):
            rotation = rig.pose.bones[f"Bone {index}"].rotation_quaternion
            self.assertLess(2.0 * math.acos(min(abs(rotation.w), 1.0)), 0.3 * math.sqrt(3.0) + 0.01)
        rig.motus.ik.entries[0].use_limits = False
        self.drag("Bone 3", 1.0, (1.0, 0.0, 0.0))
        self.assertNear(self.point(rig, "Bone 3", 1.0), (1.0, 0.0, 0.0), 1e-4)

    def test_limits_of_a_keyed_length(self):
        """The chain is wired with more bones than it has now: each is held to its own limits."""
        rig = self.arm(tentacle(4, 0.3))
        for index, most in enumerate((0.01, 0.01, 1.5, 1.5)):
            bone = rig.pose.bones[f"Bone {index}"]
            for axis in "xyz":
                setattr(bone, f"use_ik_limit_{axis}", True)
                setattr(bone, f"ik_min_{axis}", -most)
                setattr(bone, f"ik_max_{axis}", most)
        entry = self.reach("Bone 3", target="Far", use_limits=True, position_weight=0.0, chain_length=2)
        for frame, length in ((1, 2), (10, 4)):
            entry.chain_length = length
            rig.keyframe_insert("motus.ik.entries[0].chain_length", frame=frame)
        self.scene.frame_set(1)
        tip = self.point(rig, "Bone 3", 1.0)
        away = (self.point(rig, "Bone 2", 0.0) - tip) * 0.3 + Vector((0.0, 0.1, 0.1))
        self.assertPulled(rig, "Bone 3", 1.0, away, 1e-4)

    def test_auto_key(self):
        self.arm()
        self.reach()
        self.auto_key(only_available=True)
        self.drag("Bone 1", 1.0, (0.5, 0.2, 1.3))
        self.assertEqual(len(support.addon("core.blender.actions").fcurves(bpy.data.objects["Target"])), 0)
        self.auto_key(only_available=False)
        self.drag("Bone 1", 1.0, (0.5, 0.1, 1.3))
        curves = support.addon("core.blender.actions").fcurves(bpy.data.objects["Target"])
        self.assertEqual({curve.data_path for curve in curves}, {"location"})

    def test_immovable_target(self):
        self.arm()
        self.reach()
        bpy.data.objects["Target"].constraints.new('LIMIT_LOCATION')
        self.assertRefused("has a constraint", bpy.ops.motus.ik_drag, object="Rig", bone="Bone 1", location=(0, 0, 0))
