"""motus.bake and motus.unbake, on the toy system: the same motion by keys, and everything back."""

import itertools

import bpy

import support
import toy_system
from core.wiring.wiring_cases import WiringTestCase, build_bone, build_followers, build_object, each_kind, frame_set

actions = support.addon("core.blender.actions")
wiring = support.addon("core.wiring")
ROTATION_MODES = ('XYZ', 'ZXY', 'QUATERNION', 'AXIS_ANGLE')


def matrices(things, frames):
    """Evaluated world matrices, a list a frame."""
    collected = []
    for frame in frames:
        frame_set(frame)
        collected.append([toy_system.world_matrix(thing) for thing in things])
    return collected


def snapshot(objects):
    """What unbaking must bring back bit for bit, as plain data."""
    return [
        {
            "matrix": [tuple(row) for row in one.matrix_basis],
            "action": one.animation_data and one.animation_data.action,
            "slot": actions.slot_identifier(one),
            "curves": [
                (curve.data_path, curve.array_index, [tuple(key.co) for key in curve.keyframe_points]) for curve in actions.fcurves(one)
            ],
            "drivers": [
                (curve.data_path, curve.array_index, curve.mute) for curve in (one.animation_data.drivers if one.animation_data else ())
            ],
            "constraints": [(constraint.name, constraint.mute) for constraint in one.constraints],
            "properties": sorted(key for key in one.keys() if key != "motus"),
            "is_baked": (one.motus.orbit.is_baked, one.motus.bake.is_baked),
        }
        for one in objects
    ]


def sinks_are(owner, muted):
    sinks = wiring.sinks(toy_system.SYSTEM, owner)
    return bool(sinks) and all(constraint.mute == muted for _, constraint in sinks)


class BakeTestCase(WiringTestCase):
    def setUp(self):
        super().setUp()
        bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 40

    def bake(self, owner, **options):
        self.assertEqual(bpy.ops.motus.bake(object=owner.name, **options), {'FINISHED'})

    def unbake(self, owner):
        self.assertEqual(bpy.ops.motus.unbake(object=owner.name), {'FINISHED'})

    def assert_bakes(self, owner, things, frames=tuple(range(1, 41)), tolerance=1e-5, **options):
        """Baked equals live at each frame; unbaking brings all back; the current frame stays."""
        objects = list({thing.id_data for thing in things} | {owner})
        frame_set(17.5)
        before = snapshot(objects)
        live = matrices(things, frames)
        frame_set(17.5)
        self.bake(owner, **options)
        self.assertEqual(bpy.context.scene.frame_current_final, 17.5)
        self.assertTrue(sinks_are(owner, True))
        self.assertTrue(owner.motus.orbit.is_baked)
        for baked_frame, live_frame in zip(matrices(things, frames), live):
            for baked, wanted in zip(baked_frame, live_frame):
                self.assert_same_matrix(baked, wanted, tolerance)
        self.unbake(owner)
        frame_set(17.5)
        self.assertEqual(snapshot(objects), before)
        self.assertEqual(matrices(things, frames), live)


class BakeTest(BakeTestCase):
    @each_kind
    def test_every_kind(self, build):
        owner, things = build(toy_system.new_target())
        self.assert_bakes(owner, things, frame_start=1, frame_end=40)

    def test_rotation_modes(self):
        for mode in ROTATION_MODES:
            for build in (build_object, build_bone):
                with self.subTest(mode=mode, build=build.__name__):
                    support.empty_scene()
                    owner, things = build(toy_system.new_target(), speed=5.0)
                    things[0].rotation_mode = mode
                    self.assert_bakes(owner, things, frame_start=1, frame_end=40)

    def test_rotation_is_continuous(self):
        for mode in ROTATION_MODES:
            for build in (build_object, build_bone):
                with self.subTest(mode=mode, build=build.__name__):
                    support.empty_scene()
                    owner, things = build(toy_system.new_target(), speed=5.0)
                    things[0].rotation_mode = mode
                    self.bake(owner, frame_start=1, frame_end=120)
                    curves = [curve for curve in actions.fcurves(owner) if "rotation" in curve.data_path]
                    self.assertGreaterEqual(len(curves), 3)
                    for curve in curves:
                        values = [key.co.y for key in curve.keyframe_points]
                        self.assertLess(max(abs(b - a) for a, b in itertools.pairwise(values)), 2.0)

    def test_under_parents(self):
        parent = toy_system.new_object("Parent", (4.0, 5.0, 6.0))
        parent.rotation_euler = (1.0, 0.5, 0.2)
        parent.scale = (2.0, 2.0, 2.0)
        parent.driver_add("location", 1).driver.expression = "0.3*frame"
        owner, things = build_object(toy_system.new_target())
        owner.parent = parent
        owner.matrix_parent_inverse = toy_system.world_matrix(parent).inverted()
        self.assert_bakes(owner, things)

    def test_under_a_bone(self):
        rig = toy_system.new_rig("Carrier")
        rig.pose.bones["Bone.1"].rotation_mode = 'XYZ'
        rig.pose.bones["Bone.1"].driver_add("rotation_euler", 0).driver.expression = "0.05*frame"
        owner, things = build_object(toy_system.new_target())
        owner.parent, owner.parent_type, owner.parent_bone = rig, 'BONE', "Bone.2"
        self.assert_bakes(owner, things)

    def test_delta_transform_and_negative_scale(self):
        for mode in ROTATION_MODES[:3]:
            with self.subTest(mode):
                support.empty_scene()
                owner, things = build_object(toy_system.new_target())
                owner.rotation_mode = mode
                owner.delta_location = (1.0, 2.0, 3.0)
                owner.delta_rotation_euler = (0.5, 0.2, 0.1)
                owner.delta_rotation_quaternion = (0.8, 0.6, 0.0, 0.0)
                owner.delta_scale = (1.5, 1.0, 1.0)
                owner.scale = (-1.0, 2.0, 0.5)
                self.assert_bakes(owner, things, frame_start=1, frame_end=40)

    def test_bone_inheritance(self):
        for scale in ('FULL', 'NONE', 'ALIGNED', 'AVERAGE'):
            for turn in (True, False):
                with self.subTest(scale=scale, turn=turn):
                    support.empty_scene()
                    owner, things = build_bone(toy_system.new_target())
                    bone = owner.data.bones["Bone.1"]
                    bone.inherit_scale, bone.use_inherit_rotation, bone.use_local_location = scale, turn, turn
                    owner.pose.bones["Bone.0"].rotation_mode = 'XYZ'
                    owner.pose.bones["Bone.0"].driver_add("rotation_euler", 2).driver.expression = "0.1*frame"
                    owner.pose.bones["Bone.0"].scale = (2.0, 2.0, 2.0)
                    self.assert_bakes(owner, things, frame_start=1, frame_end=40)

    def test_half_influence(self):
        owner, things = build_object(toy_system.new_target(), influence=0.5)
        self.assert_bakes(owner, things)

    def test_sub_frames(self):
        owner, things = build_object(toy_system.new_target())
        self.assert_bakes(owner, things, frames=[1 + 0.25 * index for index in range(37)], frame_start=1, frame_end=10, step=0.25)

    def test_channels(self):
        owner, things = build_object(toy_system.new_target(), use_rotation=False)
        self.assert_bakes(owner, things)
        self.bake(owner)
        self.assertEqual({curve.data_path for curve in actions.fcurves(owner)}, {"location"})

    def test_users_keys_and_action(self):
        owner, things = build_object(toy_system.new_target())
        for frame, value in ((1, 1.0), (40, 3.0)):
            owner.location.x = owner.scale.x = value
            owner.keyframe_insert("location", frame=frame)
            owner.keyframe_insert("scale", frame=frame)
        users_action = owner.animation_data.action
        self.assert_bakes(owner, things)
        self.bake(owner)
        baked_action = owner.animation_data.action
        self.assertIsNot(baked_action, users_action)
        self.assertEqual(baked_action.name, "Owner Motus Bake")
        scales = [curve for curve in actions.fcurves(owner) if curve.data_path == "scale"]
        self.assertEqual([len(curve.keyframe_points) for curve in scales], [2, 2, 2])
        name = baked_action.name
        self.unbake(owner)
        self.assertNotIn(name, bpy.data.actions)

    def test_shared_action(self):
        owner, things = build_object(toy_system.new_target())
        other = toy_system.new_object("Other")
        for one, value in ((owner, 2.0), (other, 5.0)):
            if one is other:
                other.animation_data_create().action = owner.animation_data.action
            one.scale.x = value
            one.keyframe_insert("scale", frame=1)
        wanted = snapshot([other])
        self.assert_bakes(owner, things)
        self.bake(owner)
        self.assertEqual(snapshot([other]), wanted)
        self.assertEqual(len(bpy.data.actions), 2)
        self.assertEqual({curve.data_path for curve in actions.fcurves(owner)}, {"location", "rotation_euler", "scale"})

    def test_users_constraints_and_drivers(self):
        other = toy_system.new_object("Other")
        other.rotation_euler = (0.4, 0.0, 1.0)
        other.driver_add("scale", 1).driver.expression = "1.0 + 0.02*frame"
        owner, things = build_object(toy_system.new_target())
        owner.driver_add("location", 0).driver.expression = "frame"
        copy = owner.constraints.new('COPY_ROTATION')
        copy.target, copy.mix_mode = other, 'AFTER'
        below = owner.constraints.new('COPY_SCALE')
        below.target = other
        owner.constraints.move(len(owner.constraints) - 1, 0)
        bpy.context.view_layer.update()
        self.assert_bakes(owner, things)

    def test_linear_between_keys(self):
        owner, _ = build_object(toy_system.new_target())
        self.bake(owner, step=3.0)
        for curve in actions.fcurves(owner):
            self.assertEqual(len(curve.keyframe_points), 14)
            self.assertEqual({key.interpolation for key in curve.keyframe_points}, {'LINEAR'})

    def test_survives_the_file(self):
        owner, things = build_object(toy_system.new_target())
        owner.keyframe_insert("scale", frame=1)
        frames = (3, 30)
        live = matrices(things, frames)
        self.bake(owner)
        path = str(self.folder / "baked.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        owner = bpy.data.objects["Owner"]
        for baked, wanted in zip(matrices([owner], frames), live):
            self.assert_same_matrix(baked[0], wanted[0])
        self.unbake(owner)
        self.assertEqual({curve.data_path for curve in actions.fcurves(owner)}, {"scale"})
        self.assertEqual(matrices([owner], frames), live)

    def test_by_a_member(self):
        owner, followers = build_followers(toy_system.new_target())
        self.bake(followers[2])
        self.assertTrue(all(one.motus.bake.is_baked for one in followers))
        self.unbake(followers[3])
        self.assertFalse(any(one.motus.bake.is_baked for one in followers))
        self.assertTrue(sinks_are(owner, False))

    def test_refresh_keeps_it_baked(self):
        owner, things = build_object(toy_system.new_target())
        live = matrices(things, (9,))
        self.bake(owner)
        owner.motus.orbit.use_rotation = False
        self.assertTrue(sinks_are(owner, True))
        self.assert_same_matrix(matrices(things, (9,))[0][0], live[0][0])

    def test_report(self):
        owner, _ = build_followers(toy_system.new_target(), count=3)
        status, output = support.run_beside(f"""
import bpy, support, toy_system
from core.wiring import wiring_cases
support.enable()
toy_system.register()
support.empty_scene()
wiring_cases.build_followers(toy_system.new_target(), count=3)
bpy.ops.motus.bake(object={owner.name!r}, frame_start=1, frame_end=25)
""")
        self.assertEqual(status, 0, output)
        self.assertIn("Baked 3 objects, 25 frames: ", output)


class RefusalTest(BakeTestCase):
    def assert_refused(self, sentence, operator=bpy.ops.motus.bake, **options):
        with self.assertRaisesRegex(RuntimeError, sentence):
            operator(**options)

    def test_nothing_to_bake(self):
        toy_system.new_object("Plain")
        self.assert_refused("is not driven by Motus", object="Plain")
        self.assert_refused("no object Nobody", object="Nobody")
        self.assert_refused("is not baked", bpy.ops.motus.unbake, object="Plain")

    def test_empty_range(self):
        owner, _ = build_object(toy_system.new_target())
        self.assert_refused("range is empty", object=owner.name, frame_start=10, frame_end=9)
        self.assertIsNone(owner.animation_data.action)

    def test_baked_already(self):
        owner, _ = build_object(toy_system.new_target())
        self.bake(owner)
        self.assert_refused("baked already", object=owner.name)

    def test_connected_bone(self):
        owner, _ = build_bone(toy_system.new_target())
        bpy.ops.object.mode_set(mode='EDIT')
        owner.data.edit_bones["Bone.1"].use_connect = True
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assert_refused("Bone.1 is connected", object=owner.name)
        owner.motus.orbit.use_location = False
        self.assert_bakes(owner, [owner.pose.bones["Bone.1"]])

    def test_not_evaluated(self):
        owner, _ = build_object(toy_system.new_target())
        owner.hide_viewport = True
        bpy.context.view_layer.update()
        self.assert_refused("is not evaluated", object=owner.name)


class ProgressTest(BakeTestCase):
    def test_cancelled_job_changes_nothing(self):
        job = support.addon("core.bake.job")
        owner, _ = build_object(toy_system.new_target())
        frame_set(5.25)
        before = snapshot([owner])
        scene, view_layer = bpy.context.scene, bpy.context.view_layer
        steps = job.bake(scene, view_layer, owner, [toy_system.SYSTEM], [1, 2, 3, 4])
        self.assertEqual([next(steps), next(steps)], [1, 2])
        steps.close()
        self.assertEqual(scene.frame_current_final, 5.25)
        self.assertEqual(snapshot([owner]), before)

    def test_what_is_baked_is_removed_meanwhile(self):
        job = support.addon("core.bake.job")
        for remove in (lambda owner: bpy.data.objects.remove(owner), self.remove_bones):
            self.setUp()
            owner, _ = build_bone(toy_system.new_target())
            steps = job.bake(bpy.context.scene, bpy.context.view_layer, owner, [toy_system.SYSTEM], [1, 2, 3, 4])
            next(steps)
            remove(owner)
            self.assertRaises(ReferenceError, next, steps)

    def test_the_view_layer_is_removed_meanwhile(self):
        owner, _ = build_object(toy_system.new_target())
        before = snapshot([owner])
        layer = bpy.context.scene.view_layers.new("Other")
        steps = support.addon("core.bake.job").bake(bpy.context.scene, layer, owner, [toy_system.SYSTEM], [1, 2, 3, 4])
        next(steps)
        bpy.context.scene.view_layers.remove(layer)
        self.assertRaises(ReferenceError, next, steps)
        self.assertEqual(snapshot([owner]), before)

    @staticmethod
    def remove_bones(owner):
        bpy.context.view_layer.objects.active = owner
        bpy.ops.object.mode_set(mode='EDIT')
        for bone in list(owner.data.edit_bones):
            owner.data.edit_bones.remove(bone)
        bpy.ops.object.mode_set(mode='OBJECT')

    def test_evaluates_each_frame_once(self):
        owner, _ = build_followers(toy_system.new_target())
        seen = []
        bpy.app.handlers.frame_change_post.append(lambda scene, _: seen.append(scene.frame_current))
        self.addCleanup(bpy.app.handlers.frame_change_post.pop)
        self.bake(owner, frame_start=1, frame_end=20)
        self.assertEqual(seen[:20], list(range(1, 21)))
        self.assertLessEqual(len(seen), 22)
