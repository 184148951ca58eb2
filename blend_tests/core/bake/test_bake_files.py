"""motus.unbake on files that somebody else has written: it puts back transforms and switches, and nothing else."""

import json

import bpy

import support
import toy_system
from core.bake.test_bake import BakeTestCase, actions, sinks_are
from core.wiring.wiring_cases import build_bone, build_object

WITHOUT_MUTED = {"constraints": [], "drivers": []}


def others(obj):
    """What unbaking has no business with."""
    constraint = obj.constraints["Own"]
    return (
        tuple(obj.color),
        obj.hide_render,
        obj.name,
        obj.rotation_mode,
        tuple(obj.delta_location),
        constraint.influence,
        obj.show_name,
        obj.instance_type,
        obj.data and tuple(obj.data.vertices[0].co),
    )


class HostileFileTest(BakeTestCase):
    def build(self):
        owner, _ = build_object(toy_system.new_target())
        constraint = owner.constraints.new('COPY_SCALE')
        constraint.name, constraint.mute, constraint.influence = "Own", True, 0.25
        return owner

    def unbaked(self, kept):
        """The owner, unbaked when that stood in the file."""
        support.empty_scene()
        owner = self.build()
        self.bake(owner, frame_start=1, frame_end=3)
        before = others(owner)
        owner.motus.bake.kept = kept if isinstance(kept, str) else json.dumps(kept)
        self.unbake(owner)
        self.assertEqual(others(owner), before, kept)
        self.assertFalse(owner.motus.bake.is_baked or owner.motus.orbit.is_baked)
        self.assertTrue(sinks_are(owner, False))
        self.assertNotIn("motus_parked", owner)
        return owner

    def test_what_cannot_be_read(self):
        for kept in (
            "",
            "hello",
            "5",
            "null",
            "[]",
            "{}",
            "[" * 100_000,
            '{"values": 5, "muted": 5}',
            '{"values": [], "muted": {"constraints": {}, "drivers": "xyz"}}',
            {"values": {}},
            {"values": {}, "muted": {"constraints": [5, None, []], "drivers": [5, [], ["location", "0", 1], None]}},
        ):
            with self.subTest(str(kept)[:60]):
                self.unbaked(kept)

    def test_values_of_what_is_not_baked(self):
        values = {
            "color": [0.1, 0.2, 0.3, 0.4],
            "delta_location": [1.0, 2.0, 3.0],
            "name": "Mine",
            "hide_render": True,
            'constraints["Own"].influence': 1.0,
            "rotation_mode": "ZYX",
            "data": None,
            "": [1.0],
            "show_name": True,
            "data.vertices[0].co": [9.0, 9.0, 9.0],
            '["custom"]': 5.0,
            'pose.bones["x"]': [1.0, 2.0, 3.0],
            "instance_type": "FACES",
        }
        owner = self.unbaked({"values": values, "muted": WITHOUT_MUTED})
        self.assertNotIn("custom", owner)

    def test_values_that_are_none(self):
        for numbers in (
            [1.0, 2.0],
            [1.0, 2.0, 3.0, 4.0],
            ["a", "b", "c"],
            [float("nan")] * 3,
            [1.0, float("inf"), 0.0],
            5,
            None,
            "abc",
            [[1.0], [2.0], [3.0]],
            [10**400, 0.0, 0.0],
            {"a": 1.0},
        ):
            with self.subTest(str(numbers)[:60]):
                owner = self.unbaked({"values": {"location": numbers}, "muted": WITHOUT_MUTED})
                self.assertLess(owner.location.length, 1e6)

    def test_switches_of_what_is_not_baked(self):
        paths = [
            "hide_render",
            "hide_render.mute",
            "data.mute",
            'modifiers["x"].mute',
            "animation_data.drivers[0].mute",
            'constraints["Gone"].mute',
            'pose.bones["x"].constraints["y"].mute',
            "constraints[0].mute",
            ".mute",
        ]
        self.unbaked({"values": {}, "muted": {"constraints": paths, "drivers": []}})

    def test_drivers(self):
        places = [["hide_render", 0, False], ["location", 1, False], ["color", 1, False], ["location", 0, "x"], [1, 2, 3]]
        for kept in (places, []):
            support.empty_scene()
            owner = self.build()
            owner.driver_add("location", 0).driver.expression = "frame"
            bpy.context.view_layer.update()
            self.bake(owner, frame_start=1, frame_end=3)
            owner.motus.bake.kept = json.dumps({"values": {}, "muted": {"constraints": [], "drivers": kept}})
            self.unbake(owner)
            # Nobody knows any more what it drove: it drives nothing.
            parked = [curve for curve in owner.animation_data.drivers if curve.data_path == '["motus_parked"]']
            self.assertEqual([(curve.array_index, curve.mute) for curve in parked], [(0, True)])
            self.assertFalse(owner.motus.bake.is_baked)

    def test_actions_of_something_else(self):
        owner = self.build()
        material = bpy.data.materials.new("Material")
        material.keyframe_insert("roughness", frame=1)
        self.bake(owner, frame_start=1, frame_end=3)
        state = owner.motus.bake
        state.previous_action = material.animation_data.action
        state.previous_slot = actions.slot_identifier(material)
        self.unbake(owner)
        self.assertFalse(owner.motus.bake.is_baked)
        self.assertEqual(len(actions.fcurves(owner)), 0)

    def test_a_bone_with_a_name_like_a_path(self):
        owner, _ = build_bone(toy_system.new_target())
        bone = owner.pose.bones["Bone.1"]
        bone.name = owner.motus.orbit.bone = 'a"].b\\["c'
        wanted = tuple(bone.rotation_quaternion), bone.constraints.new('COPY_SCALE').mute
        bpy.context.view_layer.update()
        self.bake(owner, frame_start=1, frame_end=3)
        bone.rotation_quaternion = 0.0, 1.0, 0.0, 0.0
        self.unbake(owner)
        self.assertEqual((tuple(bone.rotation_quaternion), bone.constraints[-1].mute), wanted)

    def test_it_says_so(self):
        status, output = support.run_beside("""
import bpy, support, toy_system
from core.wiring import wiring_cases
support.enable()
toy_system.register()
support.empty_scene()
owner, _ = wiring_cases.build_object(toy_system.new_target())
bpy.ops.motus.bake(object=owner.name, frame_start=1, frame_end=3)
owner.motus.bake.kept = "hello"
bpy.ops.motus.unbake(object=owner.name)
""")
        self.assertEqual(status, 0, output)
        self.assertIn("Not all that these were before baking is in the file any more: Owner", output)


class RefusalTest(BakeTestCase):
    def test_what_blender_does_not_let_be_unbaked(self):
        owner, _ = build_object(toy_system.new_target())
        self.bake(owner, frame_start=1, frame_end=3)
        animation = owner.animation_data
        track = animation.nla_tracks.new()
        track.strips.new("Strip", 1, animation.action)
        animation.action = None
        track.select = True
        animation.use_tweak_mode = True
        if not animation.use_tweak_mode:
            self.skipTest("no tweak mode without an editor")
        with self.assertRaisesRegex(RuntimeError, "tweak mode"):
            bpy.ops.motus.unbake(object=owner.name)
        self.assertTrue(owner.motus.bake.is_baked)

    def test_another_files_object(self):
        owner, _ = build_object(toy_system.new_target())
        self.bake(owner, frame_start=1, frame_end=3)
        path = str(self.folder / "library.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
        support.empty_scene()
        with bpy.data.libraries.load(path, link=True) as (_, into):
            into.objects = ["Owner"]
        (linked,) = into.objects
        bpy.context.scene.collection.objects.link(linked)
        with self.assertRaisesRegex(RuntimeError, "linked from another file"):
            bpy.ops.motus.unbake(object="Owner")
        self.assertTrue(linked.motus.bake.is_baked)
