"""What layers make of a pose: masks, modes, weights, time; beneath all other systems, and exact on any frame."""

import math
import random

import bpy
from mathutils import Matrix, Quaternion, Vector

import support
from layers.layer_cases import FIRST, LayerTestCase, new_action, turning
from look_at.look_at_cases import BONES

FRAMES = (1, 21, 7, 13.5, 3.25, 30, 0)
ARM = ("UpperArm.L", "LowerArm.L")


class Masks(LayerTestCase):
    def test_the_throw_plays_on_the_arm_while_the_walk_goes_on(self):
        self.add(bones="UpperArm.L")
        for frame in FRAMES:
            walk, throw = self.played(self.walk, frame), self.played(self.throw, frame)
            self.go_to(frame)
            for name in BONES:
                wanted = throw if name in ARM and frame >= FIRST else walk
                self.assertSameTurn(self.own(name), wanted[name], f"{name} {frame}")

    def test_without_a_mask_all_bones(self):
        self.add(mask='ALL')
        throw = self.played(self.throw, 11)
        self.go_to(11)
        for name in BONES:
            self.assertSameTurn(self.own(name), throw[name], name)

    def test_later_items_count(self):
        entry = self.add(bones="Hips,UpperArm.L")
        entry.mask[1].weight = 0.0
        walk, throw = self.played(self.walk, 11), self.played(self.throw, 11)
        self.go_to(11)
        for name in BONES:
            self.assertSameTurn(self.own(name), (walk if name in ARM else throw)[name], name)

    def test_without_children(self):
        self.add(bones="UpperArm.L", with_children=False)
        walk, throw = self.played(self.walk, 11), self.played(self.throw, 11)
        self.go_to(11)
        self.assertSameTurn(self.own("UpperArm.L"), throw["UpperArm.L"])
        self.assertSameTurn(self.own("LowerArm.L"), walk["LowerArm.L"])

    def test_collections(self):
        if support.addon("core.blender.capabilities").has_bone_collections():
            collection = self.rig.data.collections.new("Arms")
            collection.assign(self.rig.data.bones["UpperArm.L"])
        else:
            self.rig.pose.bones["UpperArm.L"].bone_group = self.rig.pose.bone_groups.new(name="Arms")
        self.add(collections="Arms")
        throw = self.played(self.throw, 11)
        self.go_to(11)
        for name in ARM:
            self.assertSameTurn(self.own(name), throw[name], name)
        self.assertRefused("no bone collection Legs", bpy.ops.motus.layer_add, object="Rig", collections="Legs")

    def test_a_soft_border(self):
        self.add(bones="Chest", feather=2)
        walk, throw = self.played(self.walk, 11), self.played(self.throw, 11)
        self.go_to(11)
        for name, share in (("Chest", 1 / 3), ("UpperArm.L", 2 / 3), ("LowerArm.L", 1.0)):
            wanted = walk[name].to_quaternion().slerp(throw[name].to_quaternion(), share)
            self.assertSameTurn(self.own(name), wanted.to_matrix(), name)

    def test_in_the_armature_hips_do_not_swing_the_chest(self):
        entry = self.add(bones="Chest", in_armature=True)
        self.played(self.throw, 11)
        wanted = self.pose("Chest", bpy.data.objects["Reference"])
        self.go_to(11)
        self.assertSameTurn(self.pose("Chest"), wanted)
        entry.in_armature = False
        self.go_to(11)
        with self.assertRaises(AssertionError):
            self.assertSameTurn(self.pose("Chest"), wanted)


class Modes(LayerTestCase):
    def test_weight(self):
        entry = self.add(bones="UpperArm.L", weight=0.25)
        walk, throw = self.played(self.walk, 11), self.played(self.throw, 11)
        self.go_to(11)
        wanted = walk["UpperArm.L"].to_quaternion().slerp(throw["UpperArm.L"].to_quaternion(), 0.25)
        self.assertSameTurn(self.own("UpperArm.L"), wanted.to_matrix())
        for frame, weight in ((1, 0.0), (21, 1.0)):
            entry.weight = weight
            entry.keyframe_insert("weight", frame=frame)
        for curve in self.actions.fcurves(self.rig):
            if curve.data_path.endswith("weight"):
                for point in curve.keyframe_points:
                    point.interpolation = 'LINEAR'
        for frame in (11, 6, 16):
            walk, throw = self.played(self.walk, frame), self.played(self.throw, frame)
            self.go_to(frame)
            share = (frame - 1) / 20
            wanted = walk["UpperArm.L"].to_quaternion().slerp(throw["UpperArm.L"].to_quaternion(), share)
            self.assertSameTurn(self.own("UpperArm.L"), wanted.to_matrix(), frame)

    def test_nothing_of_a_layer_is_nothing(self):
        self.go_to(11)
        before = self.poses()
        entry = self.add(mask='ALL')
        for name, value, back in (("weight", 0.0, 1.0), ("is_muted", True, False)):
            setattr(entry, name, value)
            self.go_to(11)
            self.assertSamePoses(self.poses(), before, 2e-6)
            setattr(entry, name, back)
        self.rig.motus.layers.influence = 0.0
        self.go_to(11)
        self.assertSamePoses(self.poses(), before, 2e-6)

    def test_additive(self):
        entry = self.add(bones="UpperArm.L", mode='ADDITIVE', reference='REST', weight=0.5)
        for frame in (11, 17.5):
            walk, throw = self.played(self.walk, frame), self.played(self.throw, frame)
            self.go_to(frame)
            part = Quaternion().slerp(throw["UpperArm.L"].to_quaternion(), 0.5)
            wanted = walk["UpperArm.L"].to_quaternion() @ part
            self.assertSameTurn(self.own("UpperArm.L"), wanted.to_matrix())
        entry.reference, entry.reference_frame, entry.weight = 'FRAME', 16.0, 1.0
        walk, throw, beyond = (
            self.played(action, frame)["UpperArm.L"].to_quaternion()
            for action, frame in ((self.walk, 20), (self.throw, 20), (self.throw, 16))
        )
        self.go_to(20)
        self.assertSameTurn(self.own("UpperArm.L"), (walk @ beyond.inverted() @ throw).to_matrix())

    def test_a_pose_of_a_different_action_is_what_a_layer_is_compared_with(self):
        other = turning("Other", {"UpperArm.L": (0.5, 0.2, 0.1)})
        entry = self.add(bones="Chest", mode='ADDITIVE', reference='ACTION', reference_action="Other", reference_frame=16.0)
        self.assertEqual(entry.reference_action, other)
        beyond = self.played(other, 16)
        walk, throw = self.played(self.walk, 8), self.played(self.throw, 8)
        self.go_to(8)
        turns = [found["UpperArm.L"].to_quaternion() for found in (walk, beyond, throw)]
        self.assertSameTurn(self.own("UpperArm.L"), (turns[0] @ turns[1].inverted() @ turns[2]).to_matrix())
        turns = [found["LowerArm.L"].to_quaternion() for found in (walk, throw)]  # Other says nothing of it: at rest
        self.assertSameTurn(self.own("LowerArm.L"), (turns[0] @ turns[1]).to_matrix())
        for curves in self.actions.all_fcurves(other):
            for curve in [one for one in curves if one.array_index == 1]:
                curve.keyframe_points[-1].co.y += 0.3
                curve.update()
        other.update_tag()
        beyond = self.played(other, 16)["UpperArm.L"].to_quaternion()
        self.go_to(8)
        walk, throw = (found["UpperArm.L"].to_quaternion() for found in (walk, throw))
        self.assertSameTurn(self.own("UpperArm.L"), (walk @ beyond.inverted() @ throw).to_matrix())
        self.assertEqual(bpy.ops.motus.layer_duplicate(object="Rig"), {'FINISHED'})
        copy = self.rig.motus.layers.entries[1]
        self.assertEqual(copy.reference_action, other)
        fault = support.addon("layers.panel").fault
        self.assertEqual(fault(self.rig, copy), "")
        copy.reference_action = None
        self.assertIn("is compared with", fault(self.rig, copy))

    def test_locations_and_scales(self):
        keys = {('pose.bones["Hips"].location', 1): [(1, 0.0), (21, 0.5)], ('pose.bones["Hips"].scale', 0): [(1, 2.0), (21, 3.0)]}
        new_action("Jump", keys)
        entry = self.add(action="Jump", bones="Hips", with_children=False, weight=0.5)
        self.rig.pose.bones["Hips"].location = (1.0, 0.0, 0.0)
        self.go_to(21)
        self.assertSamePlace(self.own("Hips").translation, (0.5, 0.25, 0.0))
        self.assertSamePlace(self.own("Hips").to_scale(), (2.0, 1.0, 1.0))
        self.assertSameTurn(self.own("Hips"), self.played(self.walk, 21)["Hips"])
        entry.mode, entry.reference, entry.weight = 'ADDITIVE', 'FIRST', 1.0
        self.go_to(21)
        self.assertSamePlace(self.own("Hips").translation, (1.0, 0.5, 0.0))
        self.assertSamePlace(self.own("Hips").to_scale(), (1.5, 1.0, 1.0))

    def test_layers_lie_one_over_the_other(self):
        turning("Wave", {"LowerArm.L": (0.0, 0.0, 1.2)})
        self.add(bones="UpperArm.L")
        self.add(action="Wave", bones="LowerArm.L", mode='ADDITIVE', reference='REST')
        throw = self.played(self.throw, 21)
        self.go_to(21)
        wanted = throw["LowerArm.L"].to_quaternion() @ Quaternion((0, 0, 1), 1.2)
        self.assertSameTurn(self.own("LowerArm.L"), wanted.to_matrix())
        self.assertEqual(bpy.ops.motus.layer_move(object="Rig", layer="Wave"), {'FINISHED'})
        self.go_to(21)
        self.assertSameTurn(self.own("LowerArm.L"), throw["LowerArm.L"])


class Time(LayerTestCase):
    def test_start_speed_and_what_follows(self):
        entry = self.add(bones="UpperArm.L", start=10.0, speed=2.0, after='REPEAT')
        for frame, of_action in ((10, 1), (14.5, 10), (19.75, 20.5), (20, 1), (24.5, 10), (44.5, 10)):
            wanted = self.played(self.throw, of_action)["UpperArm.L"]
            self.go_to(frame)
            self.assertSameTurn(self.own("UpperArm.L"), wanted, frame)
        entry.after = 'HOLD'
        wanted = self.played(self.throw, 21)["UpperArm.L"]
        self.go_to(100)
        self.assertSameTurn(self.own("UpperArm.L"), wanted)
        entry.after = 'STOP'
        for frame in (9.5, 20.5):
            wanted = self.played(self.walk, frame)["UpperArm.L"]
            self.go_to(frame)
            self.assertSameTurn(self.own("UpperArm.L"), wanted, frame)

    def test_a_part_of_the_action_backwards(self):
        self.add(bones="UpperArm.L", speed=-1.0, use_range=True, first_frame=5.0, last_frame=15.0)
        for frame, of_action in ((1, 15), (4, 12), (11, 5), (30, 5)):
            wanted = self.played(self.throw, of_action)["UpperArm.L"]
            self.go_to(frame)
            self.assertSameTurn(self.own("UpperArm.L"), wanted, frame)

    def test_blending(self):
        self.add(bones="UpperArm.L", after='STOP', blend_in=8.0, blend_out=8.0)
        for frame, share in ((1, 0.0), (5, 0.5), (11, 1.0), (17, 0.5), (21, 0.0)):
            walk, throw = self.played(self.walk, frame), self.played(self.throw, frame)
            self.go_to(frame)
            wanted = walk["UpperArm.L"].to_quaternion().slerp(throw["UpperArm.L"].to_quaternion(), share)
            self.assertSameTurn(self.own("UpperArm.L"), wanted.to_matrix(), frame)

    def turned(self, **keywords):
        """Angle about Y of a bone at rest on frames 1, 2, ... 97, under a layer that turns it twice in 48 frames."""
        self.rig.animation_data_clear()
        if self.rig.motus.layers.entries:
            bpy.ops.motus.layer_remove(object="Rig")
        mode = keywords.pop("rotation_mode", 'XYZ')
        self.rig.pose.bones["Head"].rotation_mode = mode
        path, index = ("rotation_axis_angle", 0) if mode == 'AXIS_ANGLE' else ("rotation_euler", 1)
        easing = keywords.pop("interpolation", 'LINEAR')
        action = new_action("Spin", {(f'pose.bones["Head"].{path}', index): [(1, 0.0), (49, 4 * math.pi)]})
        for curve in self.actions.curves_for_object(action):
            for point in curve.keyframe_points:
                point.interpolation = easing
            curve.update()
        self.add(action="Spin", bones="Head", layer="Spin", **keywords)
        for frame in range(1, 98):
            self.go_to(frame)
            yield frame, self.own("Head").to_quaternion()

    def assertTurns(self, angle, **keywords):
        for frame, found in self.turned(**keywords):
            self.assertSameTurn(found.to_matrix(), Quaternion((0, 1, 0), angle(frame)).to_matrix(), (keywords, frame), 1e-5)

    def test_two_turns_stay_two_turns(self):
        """As strips of Blender's NLA have it, Replace or Combine: a part of the angle."""
        way = 4 * math.pi / 48
        for mode in ('OVERRIDE', 'ADDITIVE'):
            for rotation_mode in ('XYZ', 'ZXY', 'AXIS_ANGLE'):
                self.assertTurns(lambda frame: 0.25 * way * min(frame - 1, 48), mode=mode, weight=0.25, rotation_mode=rotation_mode)
        self.assertTurns(lambda frame: 0.25 * way * (frame - 1), weight=0.25, after='REPEAT')
        self.assertTurns(lambda frame: -0.25 * way * (frame - 1), weight=0.25, after='REPEAT', speed=-1.0)
        self.assertTurns(lambda frame: 0.5 * way * min(frame - 1, 48), weight=0.5, in_armature=True)
        # Compared with its last pose it has nothing to add there.
        self.assertTurns(
            lambda frame: 0.25 * way * min(frame - 49, 0), mode='ADDITIVE', weight=0.25, reference='FRAME', reference_frame=49.0
        )

    def test_turns_that_blender_eases(self):
        curves = self.actions.curves_for_object
        self.assertTurns(lambda frame: 0.25 * curves(bpy.data.actions["Spin"])[0].evaluate(frame), interpolation='SINE', weight=0.25)

    def test_any_frame_in_any_order(self):
        entry = self.add(bones="Chest", in_armature=True, feather=1, after='REPEAT')
        for frame, weight in ((1, 0.2), (30, 1.0)):
            entry.weight = weight
            entry.keyframe_insert("weight", frame=frame)
        played = {}
        for frame in range(1, 41):
            self.go_to(frame)
            played[frame] = self.poses()
        for frame in random.Random(1).sample(range(1, 41), 40):
            self.go_to(frame)
            self.assertSamePoses(self.poses(), played[frame], 0.0)

    def test_an_edited_action_gives_new_poses_at_once(self):
        self.add(bones="UpperArm.L")
        self.go_to(21)
        before = self.own("UpperArm.L")
        for curve in self.actions.curves_for_object(self.throw):
            if "UpperArm" in curve.data_path:
                curve.keyframe_points[-1].co.y = 1.0 if curve.array_index == 1 else 0.0
                curve.update()
        bpy.context.view_layer.update()
        with self.assertRaises(AssertionError):
            self.assertSameTurn(self.own("UpperArm.L"), before)
        self.assertSameTurn(self.own("UpperArm.L"), Quaternion((1, 0, 0), math.pi).to_matrix().to_4x4())


class Curves(LayerTestCase):
    """Keys of every kind are what Blender makes of them."""

    def test_every_interpolation(self):
        path = 'pose.bones["Hips"].location'
        kinds = bpy.types.Keyframe.bl_rna.properties["interpolation"].enum_items.keys()
        generator = random.Random(2)
        for kind in kinds:
            action = new_action(kind, {(path, 0): [(3 * i + 1, generator.uniform(-1.0, 1.0)) for i in range(6)]})
            (curve,) = self.actions.curves_for_object(action)
            for point in curve.keyframe_points:
                point.interpolation = kind
                if kind == 'BEZIER':
                    point.handle_left_type = point.handle_right_type = 'FREE'
                    point.handle_left = point.co - Vector((generator.uniform(0.0, 5.0), generator.uniform(-2.0, 2.0)))
                    point.handle_right = point.co + Vector((generator.uniform(0.0, 5.0), generator.uniform(-2.0, 2.0)))
            curve.extrapolation = 'LINEAR'
            curve.update()
            entry = self.add(action=kind, bones="Hips", layer="One")
            entry.use_range, entry.first_frame, entry.last_frame, entry.start = True, -5.0, 25.0, -5.0
            for frame in (-4.5, 1, 2.3, 5.99, 7, 11.2, 16, 21.5):
                self.go_to(frame)
                self.assertAlmostEqual(self.own("Hips").translation.x, curve.evaluate(frame), delta=2e-5, msg=f"{kind} {frame}")

    def test_modifiers(self):
        action = new_action("Noisy", {('pose.bones["Hips"].location', 2): [(1, 0.0), (21, 1.0)]})
        (curve,) = self.actions.curves_for_object(action)
        curve.modifiers.new('NOISE').strength = 0.5
        curve.update()
        self.add(action="Noisy", bones="Hips")
        for frame in (4, 9.5, 20):
            self.go_to(frame)
            self.assertAlmostEqual(self.own("Hips").translation.z, curve.evaluate(frame), delta=2e-6)

    def test_rotation_modes(self):
        bone = self.rig.pose.bones["UpperArm.L"]
        generator = random.Random(3)
        for mode in ('XYZ', 'XZY', 'YXZ', 'YZX', 'ZXY', 'ZYX', 'AXIS_ANGLE'):
            bone.rotation_mode = mode
            name, size = ("rotation_axis_angle", 4) if mode == 'AXIS_ANGLE' else ("rotation_euler", 3)
            keys = {
                (f'pose.bones["UpperArm.L"].{name}', index): [(frame, generator.uniform(-2.0, 2.0)) for frame in (1, 11, 21)]
                for index in range(size)
            }
            action = new_action(mode, keys)
            self.add(action=mode, bones="UpperArm.L", layer="One")
            for frame in (6, 21):
                self.go_to(frame)
                found = self.own("UpperArm.L")
                numbers = [curve.evaluate(frame) for curve in self.actions.curves_for_object(action)]
                posed = self.rig.pose.bones["LowerArm.L"]
                posed.rotation_mode = mode
                setattr(posed, name, numbers)
                wanted = posed.matrix_basis.copy()
                self.assertSameTurn(found, wanted, f"{mode} {frame}", 5e-6)

    def test_muted_channels_say_nothing(self):
        for curve in self.actions.curves_for_object(self.throw):
            curve.mute = "UpperArm" in curve.data_path
        self.add(bones="UpperArm.L")
        walk = self.played(self.walk, 21)
        self.go_to(21)
        self.assertSameTurn(self.own("UpperArm.L"), walk["UpperArm.L"])

    def test_an_action_of_another_rig(self):
        new_action("Strange", {('pose.bones["Tentacle"].location', 0): [(1, 1.0)], ('pose.bones["Hips"].location', 0): [(1, 0.5)]})
        self.add(action="Strange", bones="Hips,UpperArm.L")
        self.go_to(5)
        self.assertSamePlace(self.own("Hips").translation, (0.5, 0.0, 0.0))
        self.assertIsNone(self.sentence())


class WithOthers(LayerTestCase):
    def test_ik_and_look_at_come_after(self):
        self.target.location = (0.5, -1.0, 1.6)
        grip = self.link("Grip")
        grip.location = (0.45, -0.3, 1.35)
        self.add(mask='ALL')
        self.assertEqual(bpy.ops.motus.ik_add(object="Rig", bone="LowerArm.L", target="Grip", chain_length=2), {'FINISHED'})
        self.look(head_limit=math.pi, body_weight=0.5)
        for frame in (21, 5, 12.5):
            self.go_to(frame)
            pose = self.pose("LowerArm.L")
            tip = pose.translation + self.rig.data.bones["LowerArm.L"].length * pose.to_3x3().col[1]
            self.assertSamePlace(tip, grip.location, 2e-5)
            self.assertLess(self.off("Head"), 1e-2)

    def test_ik_starts_from_what_the_layers_give(self):
        grip = self.link("Grip")
        grip.location = (0.45, -0.3, 1.35)
        bpy.ops.motus.ik_add(object="Rig", bone="LowerArm.L", target="Grip", chain_length=2)
        self.rig.motus.ik.entries[0].position_weight = 0.0
        self.add(bones="UpperArm.L")  # wired later than the chain
        throw = self.played(self.throw, 21)
        self.go_to(21)
        for name in ARM:
            self.assertSameTurn(self.own(name), throw[name], name)
            self.assertTrue(self.rig.pose.bones[name].constraints[0].name.startswith("Motus Animation Layers"))
        bpy.ops.motus.layer_remove(object="Rig")
        walk = self.played(self.walk, 21)
        self.go_to(21)
        for name in ARM:
            self.assertSameTurn(self.own(name), walk[name], name)

    def test_the_users_constraints_come_after(self):
        constraint = self.rig.pose.bones["LowerArm.L"].constraints.new('LIMIT_ROTATION')
        constraint.use_limit_x = constraint.use_limit_y = constraint.use_limit_z = True
        constraint.owner_space = 'LOCAL'
        self.add(bones="UpperArm.L")
        self.go_to(21)
        self.assertSameTurn(self.own("LowerArm.L"), Matrix())
        self.assertEqual(self.rig.pose.bones["LowerArm.L"].constraints[-1].type, 'LIMIT_ROTATION')

    def test_driven_bones_are_laid_over_too(self):
        control = self.link("Control")
        curve = self.rig.driver_add('pose.bones["Neck"].rotation_quaternion', 1)
        variable = curve.driver.variables.new()
        variable.targets[0].id, variable.targets[0].data_path = control, "location.x"
        curve.driver.expression = "var"
        for frame, place in ((1, 0.0), (21, 0.4)):
            control.location.x = place
            control.keyframe_insert("location", frame=frame)
        turning("Nod", {"Neck": (0.0, 0.8, 0.0)})
        self.add(action="Nod", bones="Chest", mode='ADDITIVE', reference='REST')
        self.go_to(21)
        wanted = Quaternion((1.0, 0.4, 0.0, 0.0)).normalized() @ Quaternion((0, 1, 0), 0.8)
        self.assertSameTurn(self.own("Neck"), wanted.to_matrix())

    def test_a_driver_that_reads_a_bone_of_the_mask(self):
        curve = self.rig.driver_add('pose.bones["LowerArm.L"].rotation_quaternion', 1)
        variable = curve.driver.variables.new()
        variable.type = 'TRANSFORMS'
        variable.targets[0].id, variable.targets[0].bone_target = self.rig, "UpperArm.L"
        variable.targets[0].transform_type, variable.targets[0].transform_space = 'ROT_X', 'LOCAL_SPACE'
        curve.driver.expression = "var"
        self.add(bones="UpperArm.L")
        throw = self.played(self.throw, 21)
        self.go_to(21)
        for name in ARM:
            self.assertSameTurn(self.own(name), throw[name])
        self.assertIsNone(self.sentence())

    def test_a_weight_that_reads_a_bone_of_the_mask_leaves_all_alone(self):
        entry = self.add(bones="UpperArm.L")
        curve = self.rig.driver_add("motus.layers.entries[0].weight")
        variable = curve.driver.variables.new()
        variable.type = 'TRANSFORMS'
        variable.targets[0].id, variable.targets[0].bone_target = self.rig, "UpperArm.L"
        curve.driver.expression = "var"
        self.assertEqual(bpy.ops.motus.refresh(object="Rig", system="layers"), {'FINISHED'})
        walk = self.played(self.walk, 21)
        self.go_to(21)
        self.assertSameTurn(self.own("UpperArm.L"), walk["UpperArm.L"])
        self.assertIn("leave these alone", self.sentence())
        self.assertEqual(entry.name, "Throw")

    def test_keys_beneath_layers_cannot_be_matched(self):
        grip = self.link("Grip")
        grip.location = (0.45, -0.3, 1.35)
        bpy.ops.motus.ik_add(object="Rig", bone="LowerArm.L", target="Grip", chain_length=2)
        entry = self.add(bones="UpperArm.L")
        self.assertRefused("flatten or mute", bpy.ops.motus.fk_match_ik, object="Rig", frame_start=20, frame_end=21)
        entry.is_muted = True
        self.assertEqual(bpy.ops.motus.fk_match_ik(object="Rig", frame_start=20, frame_end=21), {'FINISHED'})

    def test_nla_strips_lie_beneath(self):
        animation = self.rig.animation_data
        action, slot = animation.action, getattr(animation, "action_slot", None)
        animation.action = None
        strip = animation.nla_tracks.new().strips.new("Walk", 1, action)
        if slot:
            strip.action_slot = slot
        self.add(bones="UpperArm.L")
        walk, throw = self.played(self.walk, 11), self.played(self.throw, 11)
        self.go_to(11)
        self.assertSameTurn(self.own("UpperArm.L"), throw["UpperArm.L"])
        self.assertSameTurn(self.own("Chest"), walk["Chest"])
