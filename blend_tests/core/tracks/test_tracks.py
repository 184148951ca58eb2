"""Inputs over time: what is read from keys is what Blender evaluates, on any frame."""

import bpy
import numpy as np

import support
from core.tracks.track_cases import EASINGS, FRAMES, INTERPOLATIONS, TrackTestCase, seconds_of

INHERITANCES = ('FULL', 'FIX_SHEAR', 'ALIGNED', 'AVERAGE', 'NONE', 'NONE_LEGACY')
MODES = ('QUATERNION', 'AXIS_ANGLE', 'XYZ', 'XZY', 'YXZ', 'YZX', 'ZXY', 'ZYX')


class Numbers(TrackTestCase):
    def test_interpolations_and_easings(self):
        cube = self.link("Cube")
        for interpolation in INTERPOLATIONS:
            for easing in EASINGS:
                self.key(cube, "location", frames=(1, 20, 45))
                for curve in support.addon("core.blender.actions").fcurves(cube):
                    for point in curve.keyframe_points:
                        point.interpolation, point.easing = interpolation, easing
                    curve.update()
                with self.subTest(interpolation, easing=easing):
                    self.assertNumber(cube, "location", 1, (-3.0, 1.0, 4.4, 20.0, 31.7, 45.0, 80.0))

    def test_modifiers_and_extrapolation(self):
        cube = self.link("Cube")
        self.key(cube, "location")
        curve = support.addon("core.blender.actions").find(cube, "location", 2)
        for extrapolation in ('CONSTANT', 'LINEAR'):
            curve.extrapolation = extrapolation
            for kind in ('CYCLES', 'NOISE', 'GENERATOR', 'FNGENERATOR', 'ENVELOPE', 'LIMITS', 'STEPPED'):
                modifier = curve.modifiers.new(kind)
                if kind == 'LIMITS':
                    modifier.use_max_y, modifier.max_y = True, 0.1
                if kind == 'CYCLES':
                    modifier.mode_before, modifier.mode_after = 'MIRROR', 'REPEAT_OFFSET'
                # Blender is not told of a new modifier.
                cube.animation_data.action.update_tag()
                with self.subTest(kind, extrapolation=extrapolation):
                    self.assertNumber(cube, "location", 2)
                curve.modifiers.remove(modifier)

    def test_kinds_of_properties(self):
        """Floats, whole numbers, switches and choices, with the limits within which Blender keeps them."""
        cube, camera = self.link("Cube"), self.link("Camera", bpy.data.cameras.new("Camera"))
        cube["own"], cube["count"], cube["pair"] = 1.0, 3, [1.0, 2.0]
        cube.id_properties_ui("own").update(min=-0.5, max=0.75)
        for path, values in (('["own"]', (-2.0, 2.0)), ('["count"]', (-3, 9))):
            for frame, value in zip((1, 40), values):
                cube[path[2:-2]] = value
                cube.keyframe_insert(path, frame=frame)
            self.assertNumber(cube, path)
        cube.keyframe_insert('["pair"]', index=1, frame=3)
        self.assertNumber(cube, '["pair"]', 1)
        for frame, value in ((1, 3), (30, 900)):
            cube.pass_index = value
            cube.keyframe_insert("pass_index", frame=frame)
        self.assertNumber(cube, "pass_index")
        for frame, value in ((1, True), (20, False), (33, True)):
            cube.hide_render = value
            cube.keyframe_insert("hide_render", frame=frame)
        self.assertNumber(cube, "hide_render")
        self.key(camera.data, "lens", low=-40.0, high=60.0)
        self.assertNumber(camera.data, "lens")
        for frame, value in ((1, 'TEXTURED'), (20, 'WIRE')):
            cube.display_type = value
            cube.keyframe_insert("display_type", frame=frame)
        values = self.tracks.property_track(cube, "display_type").values((1.0, 30.0))
        items = cube.bl_rna.properties["display_type"].enum_items
        self.assertEqual([next(one.identifier for one in items if one.value == value) for value in values], ['TEXTURED', 'WIRE'])

    def test_shape_key_keeps_its_range(self):
        mesh = bpy.data.meshes.new("Mesh")
        mesh.vertices.add(1)
        cube = self.link("Cube", mesh)
        cube.shape_key_add(name="Basis")
        key = cube.shape_key_add(name="Key")
        key.slider_min, key.slider_max = 0.25, 0.5
        keys = mesh.shape_keys
        curve_path = 'key_blocks["Key"].value'
        for frame in (1, 30):
            keys.keyframe_insert(curve_path, frame=frame)
        curve = support.addon("core.blender.actions").find(keys, curve_path)
        for point, value in zip(curve.keyframe_points, (-1.0, 2.0)):
            point.co[1] = value
            point.interpolation = 'LINEAR'
        curve.update()
        self.assertNumber(keys, curve_path)

    def test_what_animates_nothing(self):
        cube = self.link("Cube")
        cube.location = 1.0, 2.0, 3.0
        self.assertNumber(cube, "location", 1)
        self.key(cube, "location")
        curve = support.addon("core.blender.actions").find(cube, "location", 1)
        curve.mute = True
        cube.location = 4.0, 5.0, 6.0
        self.assertEqual(list(self.tracks.property_track(cube, "location", 1).values((1.0, 50.0))), [5.0, 5.0])

    def test_what_is_no_number(self):
        cube = self.link("Cube")
        refused = support.addon("core.refusals").Refused
        cube["text"] = "text"
        camera = self.link("Camera", bpy.data.cameras.new("Camera"))
        with self.assertRaisesRegex(refused, "has no number"):  # but its datablock has
            self.tracks.property_track(camera, "data.lens")
        for path, index in (
            ("name", -1),
            ("nothing", -1),
            ('["text"]', -1),
            ("location", 3),
            ("location", -1),
            ("data", -1),
            ('["absent"]', -1),
            ("pass_index", 0),
            ("pose.bones", -1),
            ("", -1),
            ("[", -1),
            ('["', -1),
        ):
            with self.subTest(path, index=index), self.assertRaisesRegex(refused, "has no number"):
                self.tracks.property_track(cube, path, index)

    def test_a_driver_is_not_known_ahead(self):
        cube = self.link("Cube")
        cube.driver_add("location", 0).driver.expression = "frame"
        track = self.tracks.property_track(cube, "location", 0)
        self.assertEqual(track.kind, self.tracks.Kind.RECORDED)
        self.assertFalse(track.is_known)
        self.assertIn("driver", track.sentence)
        with self.assertRaises(ValueError):
            track.values((1.0,))
        self.assertEqual(self.tracks.property_track(cube, "location", 1).kind, self.tracks.Kind.EXACT)
        self.assertEqual(self.tracks.own_track(cube).kind, self.tracks.Kind.RECORDED)

    def test_a_thousand_frames(self):
        """A thousand values take as many evaluations of the F-curve, whatever its keys."""
        cube = self.link("Cube")
        self.key(cube, "location", frames=range(1, 250, 5))
        times = np.linspace(1.0, 250.0, 1000)
        best = min(seconds_of(lambda: self.tracks.property_track(cube, "location", 0).values(times)) for _ in range(5))
        print(f"1000 values of a keyed number: {best * 1e3:.3f} ms")
        best = min(seconds_of(lambda: self.tracks.world_track(cube, self.scene).values(times)) for _ in range(5))
        print(f"1000 world matrices of an object with three keyed channels: {best * 1e3:.3f} ms")
        self.assertLess(best, 0.1)

    def test_a_great_many_keys(self):
        """Where it bends is told by a bounded number of frames, and found by bounded work."""
        cube = self.link("Cube")
        cube.keyframe_insert("location", index=0, frame=1)
        curve = support.addon("core.blender.actions").find(cube, "location", 0)
        count = 300_000
        curve.keyframe_points.add(count - 1)
        places = np.stack((np.arange(count), np.arange(count) % 7), axis=1).astype(np.float32)
        curve.keyframe_points.foreach_set("co", places.ravel())
        curve.update()
        keys = support.addon("core.animation.keys")
        seconds = seconds_of(lambda: keys.integral(curve, 0.0, count - 1.0))
        print(f"the integral over {count} keys: {seconds * 1e3:.1f} ms")
        self.assertLess(seconds, 1.0)
        self.assertLessEqual(len(self.tracks.property_track(cube, "location", 0).bounds(0.0, count)), 3 * keys.MOST)


class Strips(TrackTestCase):
    """Keys in NLA strips."""

    def pushed(self, thing, track, start, **options):
        """The thing's action becomes a strip of a track, and the thing has none any more."""
        animation = thing.animation_data
        action, slot = animation.action, getattr(animation, "action_slot", None)
        animation.action = None
        strip = track.strips.new("Strip", int(start), action)
        if slot:
            strip.action_slot = slot
        for name, value in options.items():
            setattr(strip, name, value)
        return strip

    def track(self, thing):
        return thing.animation_data.nla_tracks.new()

    def keyed(self):
        thing = self.link("Thing")
        self.key(thing, "location")
        self.key(thing, "scale", low=0.5, high=2.0)
        self.key(thing, "rotation_euler")
        return thing

    def assertAll(self, thing):
        for path in ("location", "scale", "rotation_euler"):
            for index in (0, 2):
                self.assertNumber(thing, path, index, (*FRAMES, 5.0, 65.0, 95.0, 124.5), 2e-6)

    def test_one_strip(self):
        thing = self.keyed()
        self.pushed(thing, self.track(thing), 5)
        self.assertAll(thing)
        self.assertWorld(thing)

    def test_time(self):
        for options in (
            {"scale": 1.7},
            {"repeat": 2.5},
            {"repeat": 2.0},
            {"use_reverse": True},
            {"action_frame_start": 8.0},
            {"scale": 0.6, "repeat": 3.0, "use_reverse": True},
            {"extrapolation": 'HOLD_FORWARD'},
            {"extrapolation": 'NOTHING'},
        ):
            with self.subTest(str(options)):
                thing = self.keyed()
                # Below it one that is always there.
                self.pushed(thing, self.track(thing), 1)
                self.key(thing, "location")
                self.pushed(thing, self.track(thing), 10, **options)
                self.assertAll(thing)
                bpy.data.objects.remove(thing)

    def test_blending(self):
        for blend in ('REPLACE', 'ADD', 'SUBTRACT', 'MULTIPLY', 'COMBINE'):
            for blends in ({}, {"blend_in": 9.0, "blend_out": 13.0}):
                with self.subTest(blend, **blends):
                    thing = self.keyed()
                    self.pushed(thing, self.track(thing), 1)
                    self.key(thing, "location")
                    self.key(thing, "scale", low=0.5, high=2.0)
                    self.pushed(thing, self.track(thing), 12, blend_type=blend, **blends)
                    self.assertAll(thing)
                    bpy.data.objects.remove(thing)

    def test_the_action_above(self):
        for blend in ('REPLACE', 'ADD', 'COMBINE'):
            for extrapolation in ('HOLD', 'NOTHING'):
                with self.subTest(blend, extrapolation=extrapolation):
                    thing = self.keyed()
                    self.pushed(thing, self.track(thing), 1)
                    self.key(thing, "location", frames=(10, 20, 40))
                    thing.animation_data.action_blend_type = blend
                    thing.animation_data.action_influence = 0.6
                    thing.animation_data.action_extrapolation = extrapolation
                    self.assertAll(thing)
                    bpy.data.objects.remove(thing)

    def test_strips_beside_each_other(self):
        thing = self.keyed()
        track = self.track(thing)
        self.pushed(thing, track, 1)
        self.key(thing, "location")
        self.key(thing, "scale", low=0.5, high=2.0)
        self.key(thing, "rotation_euler")
        self.pushed(thing, track, 90)
        self.assertAll(thing)

    def test_influence_and_time_by_keys(self):
        for cyclic in (False, True):
            thing = self.keyed()
            self.pushed(thing, self.track(thing), 1)
            self.key(thing, "location")
            strip = self.pushed(
                thing, self.track(thing), 10, use_animated_influence=True, use_animated_time=True, use_animated_time_cyclic=cyclic
            )
            for frame, influence, at in ((10, 0.0, 1.0), (30, 1.0, 45.0), (60, 0.3, 20.0)):
                strip.influence, strip.strip_time = influence, at
                strip.keyframe_insert("influence", frame=frame)
                strip.keyframe_insert("strip_time", frame=frame)
            with self.subTest(cyclic=cyclic):
                self.assertAll(thing)
            bpy.data.objects.remove(thing)

    def test_quaternions(self):
        """Mixed number by number, but for Combine."""
        for blend in ('REPLACE', 'ADD', 'COMBINE'):
            thing = self.link("Thing")
            thing.rotation_mode = 'QUATERNION'
            for start, kind in ((1, 'REPLACE'), (12, blend)):
                self.key(thing, "rotation_quaternion")
                self.pushed(thing, self.track(thing), start, blend_type=kind, blend_in=9.0 * (start > 1))
            with self.subTest(blend):
                if blend == 'COMBINE':
                    self.assertFalse(self.tracks.own_track(thing).is_known)
                else:
                    self.assertNumber(thing, "rotation_quaternion", 2, tolerance=2e-6)
                    self.assertWorld(thing)
            bpy.data.objects.remove(thing)

    def test_kept_until_a_strip_changes(self):
        thing = self.keyed()
        strip = self.pushed(thing, self.track(thing), 10)
        made = []

        def ask(index):
            bpy.context.view_layer.update()
            track = self.tracks.property_track(self.evaluated(thing), "location", index)
            return self.tracks.kept(track, "test", lambda: made.append(index) or len(made))

        self.assertEqual([ask(0), ask(1), ask(0), ask(1)], [1, 2, 1, 2])
        strip.scale = 2.0
        self.assertEqual([ask(0), ask(0)], [3, 3])
        strip.use_animated_influence = True
        self.key(thing, "location")
        self.assertEqual([ask(0), ask(0)], [4, 4], "the action above covers all")
        thing.animation_data.action_influence = 0.5
        self.pushed(thing, self.track(thing), 1).blend_type = 'ADD'
        strip.use_animated_influence = False
        self.assertEqual([ask(0), ask(0)], [5, 5])
        strip.use_animated_time = True
        self.assertEqual([ask(0), ask(0)], [6, 7], "keys of the strip itself")

    def test_what_is_not_known(self):
        """A gap, in which a value stays what it was on the frame before; quaternions that are combined; solo; tweak mode."""
        thing = self.keyed()
        strip = self.pushed(thing, self.track(thing), 10, extrapolation='NOTHING')
        track = self.tracks.property_track(thing, "location", 0)
        self.assertIn("NLA strips of Thing", track.sentence)
        self.assertFalse(track.is_known)
        self.assertEqual(self.tracks.property_track(thing, "delta_location", 0).kind, self.tracks.Kind.EXACT)
        strip.extrapolation = 'HOLD'
        self.assertTrue(self.tracks.property_track(thing, "location", 0).is_known)
        self.key(thing, "location")
        thing.animation_data.action_extrapolation = 'HOLD_FORWARD'
        self.assertFalse(self.tracks.property_track(thing, "location", 0).is_known)
        thing.animation_data.action = None
        thing.animation_data.nla_tracks[0].is_solo = True
        self.assertFalse(self.tracks.property_track(thing, "location", 0).is_known)
        thing.animation_data.nla_tracks[0].is_solo = False
        strip.mute = True
        self.assertTrue(self.tracks.property_track(thing, "location", 0).is_known)
        thing.animation_data.use_nla = False
        self.assertTrue(self.tracks.property_track(thing, "location", 0).is_known)


class Transforms(TrackTestCase):
    def thing(self, mode, name="Thing"):
        thing = self.link(name)
        thing.rotation_mode = mode
        rotation = {'QUATERNION': "rotation_quaternion", 'AXIS_ANGLE': "rotation_axis_angle"}.get(mode, "rotation_euler")
        for path in ("location", rotation, "scale"):
            self.key(thing, path)
        thing.delta_location = 0.1, 0.2, 0.3
        thing.delta_rotation_euler = 0.3, -0.4, 0.5
        thing.delta_rotation_quaternion = 0.5, 0.1, -0.4, 0.2
        thing.delta_scale = 1.1, 0.9, -1.2
        return thing

    def test_rotation_modes_and_deltas(self):
        for mode in MODES:
            with self.subTest(mode):
                thing = self.thing(mode)
                self.key(thing, "delta_location")
                self.assertWorld(thing)
                own = self.tracks.own_track(thing).values(FRAMES)
                np.testing.assert_allclose(np.linalg.norm(own.rotations, axis=1), 1.0)
                np.testing.assert_array_equal(own.matrices, self.tracks.world_track(thing, self.scene).values(FRAMES))
                bpy.data.objects.remove(thing)

    def test_no_rotation_at_all(self):
        for mode, path, values in (
            ('QUATERNION', "rotation_quaternion", (0.0, 0.0, 0.0, 0.0)),
            ('AXIS_ANGLE', "rotation_axis_angle", (1.0, 0.0, 0.0, 0.0)),
        ):
            thing = self.link("Thing")
            thing.rotation_mode = mode
            setattr(thing, path, values)
            with self.subTest(mode):
                self.assertWorld(thing, (1.0, 5.0))
            bpy.data.objects.remove(thing)

    def test_parents(self):
        top, middle, low = self.thing('XYZ', "Top"), self.thing('ZXY', "Middle"), self.thing('QUATERNION', "Low")
        middle.parent, low.parent = top, middle
        self.go_to(17)
        low.matrix_parent_inverse = middle.matrix_world.inverted()
        self.assertWorld(low, tolerance=2e-5)
        track = self.tracks.world_track(low, self.scene)
        self.assertEqual(len(track.values(())), 0)
        bounds = track.bounds(1.0, 60.0)
        self.assertTrue({1.0, 12.0, 12.25, 30.0, 60.0} <= set(bounds), bounds)
        self.assertEqual(bounds, sorted(bounds))

    def test_bones(self):
        rig = self.rig()
        self.key(rig, "location")
        for index, bone in enumerate(rig.pose.bones):
            bone.rotation_mode = MODES[index]
            name = {'QUATERNION': "rotation_quaternion", 'AXIS_ANGLE': "rotation_axis_angle"}.get(bone.rotation_mode, "rotation_euler")
            for path in ("location", name, "scale"):
                self.key(rig, f"{bone.path_from_id()}.{path}", low=0.3, high=1.5)
        last = rig.pose.bones["Bone.3"]
        self.assertWorld(last, tolerance=1e-5)
        for inherits in INHERITANCES:
            for rotation in (True, False):
                for local in (True, False):
                    for bone in rig.data.bones:
                        bone.inherit_scale, bone.use_inherit_rotation, bone.use_local_location = inherits, rotation, local
                    with self.subTest(inherits, rotation=rotation, local=local):
                        self.assertWorld(last, (1.0, 9.5, 30.0, 44.0), 2e-5)
        rig.data.pose_position = 'REST'
        self.assertWorld(last)

    def test_connected_bones_do_not_move(self):
        rig = self.rig()
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        for bone in rig.data.edit_bones:
            bone.use_connect = bone.parent is not None
        bpy.ops.object.mode_set(mode='OBJECT')
        for bone in rig.pose.bones:
            bone.rotation_mode = 'XYZ'
            self.key(rig, f"{bone.path_from_id()}.location")
            self.key(rig, f"{bone.path_from_id()}.rotation_euler")
        self.assertWorld(rig.pose.bones["Bone.2"], tolerance=1e-5)

    def test_what_hangs_on_a_bone(self):
        rig = self.rig()
        bone = rig.pose.bones["Bone.1"]
        self.key(rig, f"{bone.path_from_id()}.location")
        thing = self.thing('XYZ')
        thing.parent, thing.parent_type, thing.parent_bone = rig, 'BONE', "Bone.1"
        for relative in (False, True):
            bone.bone.use_relative_parent = relative
            with self.subTest(relative=relative):
                self.assertWorld(thing, tolerance=1e-5)
        bone.bone.use_relative_parent = False
        thing.parent_bone = "Gone"
        self.assertWorld(thing, tolerance=1e-5)
        thing.parent_type = 'ARMATURE'
        self.assertWorld(thing, tolerance=1e-5)

    def assertUnknown(self, thing, part):
        track = self.tracks.world_track(thing, self.scene)
        self.assertEqual(track.kind, self.tracks.Kind.RECORDED)
        self.assertIn(part, track.sentence)

    def test_what_is_not_known_ahead(self):
        top, thing = self.thing('XYZ', "Top"), self.thing('XYZ', "Low")
        thing.parent = top
        constraint = top.constraints.new('CHILD_OF')
        self.assertUnknown(thing, "Top has the constraint Child Of")
        self.assertTrue(self.tracks.own_track(top).is_known)
        constraint.mute = True
        self.assertWorld(thing, (3.0,), 2e-5)
        mesh = self.link("Mesh", bpy.data.meshes.new("Mesh"))
        thing.parent, thing.parent_type = mesh, 'VERTEX'
        self.assertUnknown(thing, "vertices of Mesh")
        course = self.link("Course", bpy.data.curves.new("Course", 'CURVE'))
        course.data.use_path = True
        thing.parent, thing.parent_type = course, 'OBJECT'
        self.assertUnknown(thing, "along the curve Course")
        course.data.use_path = False
        self.assertTrue(self.tracks.world_track(thing, self.scene).is_known)
        thing.parent = None
        thing.keyframe_insert("rotation_mode", frame=1)
        self.assertUnknown(thing, "rotation mode")

    def test_bones_that_others_turn(self):
        rig = self.rig()
        constraint = rig.pose.bones["Bone.3"].constraints.new('IK')
        constraint.chain_count = 3
        self.assertUnknown(rig.pose.bones["Bone.2"], "IK of Bone.3 turns Bone.2")
        self.assertWorld(rig.pose.bones["Bone.0"], (1.0,))
        self.assertUnknown(rig.pose.bones["Bone.3"], "constraint IK")
