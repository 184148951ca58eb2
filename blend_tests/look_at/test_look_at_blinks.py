"""Blinks of heads that look at something: by seed, along with turns of the gaze, on eyelids and shape keys."""

import math

import bpy
from mathutils import Quaternion, Vector

import support
from look_at.look_at_cases import BONES, FAR, LookAtTestCase, build_rig, direction

LIDS = ("Eyelid.L",)
SEED, RATE = 5, 60.0


def key(holder, path, rows, interpolation):
    """Keys of a property: frame -> value, with an interpolation between them."""
    support.key(holder, path, rows)
    for curve in support.addon("core.blender.actions").curves_of(holder.id_data.animation_data):
        for point in curve.keyframe_points:
            point.interpolation = interpolation


class BlinkCase(LookAtTestCase):
    def setUp(self):
        super().setUp()
        self.aim(0)
        self.entry = self.look(body_weight=0.0)
        self.native = support.addon("core.native").module

    def blink(self, **settings):
        for name, value in ({"blink_rate": RATE, "eyes_seed": SEED, "blink_angle": math.pi, "use_blinks": True} | settings).items():
            setattr(self.entry, name, value)

    def shut(self):
        """How far a blink has shut the eyes, by the head's output."""
        return self.told("blink")

    def head(self):
        return self.rig.data.bones["Head"].head_local


class Blinks(BlinkCase):
    def test_by_seed_on_any_frame(self):
        self.blink()
        found = {}
        for frame in (1, 40, 7.5, 22, 90, 13, -5):
            support.go_to(frame)
            found[frame] = self.shut()
            self.assertAlmostEqual(found[frame], self.native.blinks(frame / 24, RATE / 60.0, SEED), delta=1e-9)
        for frame, wanted in reversed(found.items()):
            support.go_to(frame)
            self.assertEqual(self.shut(), wanted)

    def shut_frame(self):
        """A frame on which a blink of the seed has shut the eyes by more than a half."""
        return next(frame for frame in range(1, 400) if self.native.blinks(frame / 24, RATE / 60.0, SEED) > 0.5)

    def test_eyelids_turn_by_it(self):
        self.assertEqual(bpy.ops.motus.look_at_lid_add(object="Rig", bone="Head"), {'FINISHED'})
        self.assertEqual(tuple(self.entry.lids.keys()), LIDS)
        self.assertTrue(self.entry.use_blinks)
        self.blink()
        rest = self.rig.data.bones["Eyelid.L"].matrix_local
        for influence in (1.0, 0.5):
            self.rig.motus.look_at.influence = influence
            support.go_to(self.shut_frame())
            shut = self.native.blinks(self.shut_frame() / 24, RATE / 60.0, SEED)
            turn = (rest.inverted() @ self.evaluated().pose.bones["Eyelid.L"].matrix).to_quaternion()
            self.assertAlmostEqual(turn.angle, influence * shut * math.radians(40.0), delta=1e-5)
            self.assertGreater(abs(turn.axis.x), 1.0 - 1e-6)
        # The lid's tail goes down.
        lid = self.evaluated().pose.bones["Eyelid.L"]
        self.assertLess(lid.tail.z, self.rig.data.bones["Eyelid.L"].tail_local.z - 1e-3)

    def test_lids_of_every_make_shut(self):
        eye = Vector((0.04, -0.08, 1.7))
        for index, (name, way) in enumerate(
            (("Lid", (0, -1, 0)), ("Lid upright", (0, 0, 1)), ("Lid lower", (0, -1, 0)), ("Lid bottom", (0, 0, -1)))
        ):
            for roll in (0.0, math.pi):
                with self.subTest(name, roll=roll):
                    rig = build_rig(BONES | {name: ("Head", tuple(eye), tuple(eye + 0.04 * Vector(way)))}, f"Rig {index} {roll:.0f}")
                    bpy.ops.object.mode_set(mode='EDIT')
                    rig.data.edit_bones[name].roll += roll
                    bpy.ops.object.mode_set(mode='OBJECT')
                    self.look(rig.name)
                    self.assertEqual(bpy.ops.motus.look_at_lid_add(object=rig.name, bone="Head", lid=name), {'FINISHED'})
                    angle = rig.motus.look_at.entries[0].lids[0].angle
                    bone = rig.data.bones[name].matrix_local.to_3x3()
                    moved = bone @ Quaternion((1.0, 0.0, 0.0), angle).to_matrix() @ Vector((0.0, 1.0, 0.0)) - bone.col[1]
                    is_lower = index >= 2
                    self.assertAlmostEqual(abs(angle), math.radians(10.0 if is_lower else 40.0), delta=1e-6)
                    if way[2]:
                        self.assertLess(moved.y, -0.1)  # over the front
                    else:
                        self.assertGreater(moved.z if is_lower else -moved.z, 0.1)

    def test_a_shape_key_follows_it(self):
        mesh = bpy.data.meshes.new("Face")
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
        face = self.link("Face", mesh)
        face.shape_key_add(name="Basis")
        face.shape_key_add(name='Shut "Eyes"').value = 0.0  # a new one is at 1 in Blender 5.2
        self.entry.shut_object, self.entry.shut_key = face, 'Shut "Eyes"'
        self.blink()
        frame = self.shut_frame()
        support.go_to(frame)

        def value():
            bpy.context.view_layer.update()
            keys = face.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.shape_keys or mesh.shape_keys
            return mesh.shape_keys.key_blocks[1].value if keys is None else keys.key_blocks[1].value

        shut = self.native.blinks(frame / 24, RATE / 60.0, SEED)
        self.assertAlmostEqual(value(), shut, delta=1e-6)
        self.entry.is_muted = True
        self.assertAlmostEqual(value(), 0.0, delta=1e-6)
        self.entry.is_muted = False
        self.assertAlmostEqual(value(), shut, delta=1e-6)
        bpy.ops.motus.look_at_remove(object="Rig")
        self.assertIsNone(
            mesh.shape_keys.animation_data and mesh.shape_keys.animation_data.drivers.find('key_blocks["Shut \\"Eyes\\""].value')
        )

    def test_removing_restores_the_lids(self):
        bpy.ops.motus.look_at_lid_add(object="Rig", bone="Head", lid="Eyelid.L")
        self.blink()
        support.go_to(self.shut_frame())
        before = self.rig.data.bones["Eyelid.L"].matrix_local.copy()
        self.assertNotEqual(self.evaluated().pose.bones["Eyelid.L"].matrix, before)
        self.assertEqual(bpy.ops.motus.look_at_lid_remove(object="Rig", bone="Head", lid="Eyelid.L"), {'FINISHED'})
        bpy.context.view_layer.update()
        self.assertSamePoses({"Eyelid.L": self.evaluated().pose.bones["Eyelid.L"].matrix.copy()}, {"Eyelid.L": before}, 1e-6)
        self.assertEqual(len(self.rig.pose.bones["Eyelid.L"].constraints), 0)

    def test_refusals(self):
        for lid, words in (("Nobody", "no bone"), ("Chest", "not below"), ("Head", "not below")):
            with self.assertRaisesRegex(RuntimeError, words):
                bpy.ops.motus.look_at_lid_add(object="Rig", bone="Head", lid=lid)
        self.look(eyes="Eye.L")
        with self.assertRaisesRegex(RuntimeError, "turns with Head already"):
            bpy.ops.motus.look_at_lid_add(object="Rig", bone="Head", lid="Eye.L")
        with self.assertRaisesRegex(RuntimeError, "no eyelid"):
            bpy.ops.motus.look_at_lid_remove(object="Rig", bone="Head", lid="Eye.L")

    def test_heads_that_do_not_blink_have_no_output(self):
        self.assertIsNone(self.shut())

    def test_a_renamed_lid(self):
        bpy.ops.motus.look_at_lid_add(object="Rig", bone="Head", lid="Eyelid.L")
        self.rig.data.bones["Eyelid.L"].name = "Cover"
        bpy.context.view_layer.update()
        self.assertEqual(self.entry.lids[0].name, "Cover")


class Turns(BlinkCase):
    def setUp(self):
        super().setUp()
        self.blink(blink_rate=0.0, blink_angle=math.radians(33.0))

    def turn(self, keys):
        """Key the target on frames, at degrees to the left."""
        places = {frame: self.head() + FAR * direction(yaw) for frame, yaw in keys.items()}
        key(self.target, "location", places, 'CONSTANT')

    def shuts(self, frames=range(1, 49)):
        found = {}
        for frame in frames:
            support.go_to(frame)
            found[frame] = self.shut()
        return found

    def test_a_large_turn_shuts_the_eyes_and_a_small_one_does_not(self):
        self.turn({1: 0.0, 25: 40.0, 37: 30.0})
        found = self.shuts()
        # The eyes are shut as the target jumps, a tenth of a second after the blink has begun.
        self.assertGreater(found[25], 0.9)
        for frame, shut in found.items():
            seconds = (frame - 25) / 24
            near = self.native.blink(seconds + 0.1)
            self.assertAlmostEqual(shut, near, delta=0.35)  # the beginning lies on a multiple of 0.02 s
            if not -0.13 < seconds < 0.23:
                self.assertEqual(shut, 0.0, frame)

    def test_by_formula(self):
        self.turn({1: 0.0, 25: 40.0})
        # The first multiple of 0.02 s from which on the turn lies within a tenth of a second.
        begin = 0.02 * math.ceil((25 / 24 - 0.1) / 0.02 - 1e-9)
        for frame, shut in self.shuts().items():
            self.assertAlmostEqual(shut, self.native.blink(frame / 24 - begin), delta=1e-9)

    def test_any_order_gives_the_same_bits(self):
        self.turn({1: 0.0, 25: 40.0, 40: -20.0})
        found = self.shuts()
        self.assertEqual(self.shuts(reversed(list(found))), found)
        self.assertGreater(sum(shut > 0.9 for shut in found.values()), 1)

    def test_a_keyed_weight_turns_the_gaze_too(self):
        self.target.location = self.head() + FAR * direction(60.0)
        key(self.entry, "weight", {1: 0.0, 25: 1.0}, 'CONSTANT')
        self.assertGreater(self.shuts()[25], 0.9)

    def test_a_slow_turn_does_not(self):
        key(self.target, "location", {1: self.head() + direction(-60.0), 48: self.head() + direction(60.0)}, 'LINEAR')
        self.assertEqual(set(self.shuts().values()), {0.0})

    def test_edited_keys_count_at_once(self):
        self.turn({1: 0.0, 25: 40.0})
        support.go_to(24)
        self.assertGreater(self.shut(), 0.1)
        self.target.keyframe_delete("location", frame=25)
        bpy.context.view_layer.update()
        self.assertEqual(self.shut(), 0.0)

    def test_a_target_that_is_not_known_is_told_and_can_be_recorded(self):
        self.turn({1: 0.0, 25: 40.0})
        self.target.constraints.new('LIMIT_LOCATION')
        support.go_to(25)
        self.assertEqual(self.shut(), 0.0)
        self.assertIn("record it", self.sentence())
        self.assertEqual(bpy.ops.motus.track_record(datablock="Target", frame_start=1, frame_end=48, step=0.25), {'FINISHED'})
        support.go_to(25)
        self.assertIsNone(self.sentence())
        self.assertGreater(self.shut(), 0.5)
