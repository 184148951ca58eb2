"""Systems that drive bones on top of their animation: what is evaluated, by every kind of carrier and sink."""

from unittest import mock

import bpy

import support
import toy_bone_system
import toy_system
from core.wiring.bone_cases import FRAMES, BoneTestCase, build, build_few, build_many, drive, each_kind, poses
from core.wiring.wiring_cases import assert_playback_equals_jumps, frame_set

wiring = support.addon("core.wiring")
hub_lookup = support.addon("core.wiring.hubs.hub_lookup")
results = support.addon("core.wiring.solving.results")
capabilities = support.addon("core.blender.capabilities")
SYSTEM, NOD = toy_bone_system.SYSTEM, toy_bone_system.NOD


class EvaluationTest(BoneTestCase):
    @each_kind
    def test_frames_in_any_order(self, build):
        self.assert_alive(build())

    @each_kind
    def test_playback_equals_jumps(self, build):
        rig = build()
        assert_playback_equals_jumps(self, lambda: poses(rig))

    @each_kind
    def test_dragged_target_and_bones(self, build):
        rig = build()
        frame_set(5)
        for step in range(3):
            rig.motus.bend.entries[0].target.location.y = 0.3 * step
            rig.pose.bones["root"].rotation_mode = 'XYZ'
            rig.pose.bones["root"].rotation_euler.z = 0.2 * step
            bpy.context.view_layer.update()
            self.assert_bent(rig)

    @each_kind
    def test_influence_between(self, build):
        rig = build()
        rig.motus.bend.influence = 0.4
        for frame in FRAMES:
            frame_set(frame)
            self.assert_bent(rig)

    @each_kind
    def test_edited_and_keyed_settings(self, build):
        rig = build()
        entry = rig.motus.bend.entries[-1]
        entry.weight = 0.3
        bpy.context.view_layer.update()
        self.assert_bent(rig)
        for frame, value in ((1, 0.0), (60, 1.0)):
            rig.motus.bend.influence = value
            rig.keyframe_insert("motus.bend.influence", frame=frame)
        for frame in FRAMES:
            frame_set(frame)
            self.assert_bent(rig)

    def test_turned_and_scaled_rig(self):
        rig = build()
        rig.rotation_euler, rig.scale, rig.location = (0.5, 0.2, 0.1), (1.0, 2.0, 0.5), (3.0, 1.0, 0.0)
        for frame in FRAMES:
            frame_set(frame)
            self.assert_bent(rig)

    @each_kind
    def test_problem_leaves_the_animation(self, build):
        rig = build()
        frame_set(5)
        for entry in rig.motus.bend.entries:
            entry.target = None
        self.assert_untouched(rig)
        graph = bpy.context.evaluated_depsgraph_get()
        self.assertIs(wiring.problem(SYSTEM, rig, graph), toy_bone_system.NOBODY)

    @each_kind
    def test_error_of_our_own_leaves_the_animation(self, build):
        rig = build()
        frame_set(4)
        with mock.patch.object(toy_bone_system, "angle", side_effect=RuntimeError), self.assertLogs(results.log, "ERROR"):
            frame_set(6)
            problem = wiring.problem(SYSTEM, rig, bpy.context.evaluated_depsgraph_get())
            found = poses(rig)
        self.assertTrue(problem.blocking)
        self.assertNotIn(problem, SYSTEM.problems)
        rig.motus.bend.influence = 0.0
        frame_set(7)
        frame_set(6)
        for name, matrix in poses(rig).items():
            self.assert_same_matrix(found[name], matrix)

    @each_kind
    def test_outputs(self, build):
        rig = build()
        frame_set(9)
        graph = bpy.context.evaluated_depsgraph_get()
        evaluated = rig.evaluated_get(graph)
        for entry in evaluated.motus.bend.entries:
            wanted = toy_bone_system.bent(evaluated, entry, 1.0)[0].angle
            self.assertAlmostEqual(wiring.output(SYSTEM, rig, f"{entry.name}.angle", graph), wanted, places=5)
        self.assertIsNone(wiring.output(SYSTEM, rig, "nothing", graph))
        carrier = rig.motus.bend.hub.data if rig.motus.bend.hub else rig
        path = wiring.output_path(SYSTEM, "A.0.angle", rig)
        self.assertEqual(carrier.evaluated_get(graph).path_resolve(path), wiring.output(SYSTEM, rig, "A.0.angle", graph))


class WaitingTest(BoneTestCase):
    """Things that become driven, and entries that wait for each other."""

    def test_driven_later(self):
        for path, index in (
            ('motus.bend.entries["A.0"].weight', None),
            ("motus.bend.influence", None),
            ('pose.bones["A.0"].rotation_euler', 0),
            ('pose.bones["B.1"].rotation_euler', 2),
        ):
            with self.subTest(path):
                support.empty_scene()
                rig = build()
                for bone in rig.pose.bones:
                    bone.rotation_mode = 'XYZ'
                frame_set(2)
                drive(rig, path, "0.6+0.4*sin(frame)", index)
                for frame in FRAMES:
                    frame_set(frame)
                    self.assert_bent(rig)

    def test_chain_on_a_chain(self):
        rig = toy_bone_system.animate(toy_bone_system.new_rig(chains=2, length=4))
        target = toy_system.new_target()
        toy_bone_system.bend(rig, {"A.0": target, "A.2": target, "B.0": (rig, "A.3"), "B.2": target})
        self.assertEqual([group.key for group in SYSTEM.groups(rig)], ["", "1", "2", "3"])
        self.assert_alive(rig)
        self.assertIsNone(wiring.problem(SYSTEM, rig, bpy.context.evaluated_depsgraph_get()))
        self.assertEqual(len(wiring.sinks(SYSTEM, rig)), 8)

    def test_chain_on_a_chain_in_hubs(self):
        rig = toy_bone_system.animate(toy_bone_system.new_rig(chains=2, length=4))
        target = toy_system.new_target()
        toy_bone_system.bend(rig, {"A.0": target, "A.2": target, "B.0": (rig, "A.3")})
        rig.motus.bend.entries["A.2"].stretch = 0.2
        drive(rig, 'motus.bend.entries["A.2"].weight', "sin(frame)")
        wiring.refresh(SYSTEM, rig)
        self.assertEqual(len(rig.motus.bend.more_hubs), 2)
        self.assert_alive(rig)
        wiring.detach(SYSTEM, rig)
        self.assertEqual([mesh.name for mesh in bpy.data.meshes], [])

    def test_two_systems_on_one_rig(self):
        for chains in (2, 14):
            with self.subTest(chains):
                support.empty_scene()
                rig = toy_bone_system.animate(toy_bone_system.new_rig(chains=chains))
                target = toy_system.new_target()
                names = [f"{toy_bone_system.chain_name(chain)}.0" for chain in range(chains)]
                toy_bone_system.bend(rig, dict.fromkeys(names[1:], target), stretch=0.2)
                toy_bone_system.bend(rig, {"A.0": (rig, "B.1")}, system=NOD)
                self.assertEqual([group.key for group in NOD.groups(rig)], ["1"])
                self.assert_alive(rig, (SYSTEM, NOD))
                self.assertEqual([hub.name for hub in rig.motus.nod.more_hubs], ["1"])

    def test_other_system_is_wired_again(self):
        rig = build()
        toy_bone_system.bend(rig, {"A.end": (rig, "B.1")}, system=NOD, length=1)
        self.assertEqual([key for key, _ in hub_lookup.carriers_of(NOD, rig)], ["1"])
        entry = rig.motus.bend.entries["B.0"]
        rig.motus.bend.entries.remove(list(rig.motus.bend.entries).index(entry))
        rig.motus.bend.entries.remove(0)
        wiring.refresh(SYSTEM, rig)
        self.assertEqual([key for key, _ in hub_lookup.carriers_of(NOD, rig)], [""])
        frame_set(5)
        self.assert_bent(rig, (NOD,))

    def test_target_on_another_rig(self):
        first = build()
        second = toy_bone_system.animate(toy_bone_system.new_rig("Second"))
        toy_bone_system.bend(second, {"A.0": (first, "B.1"), "B.0": (first, "A.end")})
        for frame in FRAMES:
            frame_set(frame)
            self.assert_bent(first)
            self.assert_bent(second)

    def test_target_follows_a_chain(self):
        first = build_many()
        child = toy_system.new_object("Child", (0.0, 1.0, 0.0))
        child.parent, child.parent_type, child.parent_bone = first, 'BONE', "B.1"
        second = toy_bone_system.animate(toy_bone_system.new_rig("Second"))
        toy_bone_system.bend(second, {"A.0": child, "B.0": child})
        for frame in FRAMES:
            frame_set(frame)
            self.assert_bent(first)
            self.assert_bent(second)


class BakeTest(BoneTestCase):
    @each_kind
    def test_baked_and_restored(self, build):
        rig = build()
        frame_set(1)
        live = {}
        for frame in (20, 25, 30):
            frame_set(frame)
            live[frame] = poses(rig)
        bpy.ops.motus.bake(object=rig.name, system="bend", frame_start=20, frame_end=30)
        for frame, wanted in live.items():
            frame_set(frame)
            for name, matrix in poses(rig).items():
                # With stretch a parent's shear cannot be keyed on its children.
                if not rig.motus.bend.entries[0].stretch or name.endswith(".0"):
                    self.assert_same_matrix(matrix, wanted[name], 1e-4)
        bpy.ops.motus.unbake(object=rig.name)
        for frame, wanted in live.items():
            frame_set(frame)
            self.assertEqual(poses(rig), wanted)

    def test_all_groups_are_baked(self):
        rig = toy_bone_system.animate(toy_bone_system.new_rig(chains=2, length=4))
        target = toy_system.new_target()
        toy_bone_system.bend(rig, {"A.0": target, "A.2": target, "B.0": (rig, "A.3")})
        frame_set(25)
        wanted = poses(rig)
        bpy.ops.motus.bake(object=rig.name, frame_start=20, frame_end=30)
        frame_set(25)
        for name, matrix in poses(rig).items():
            self.assert_same_matrix(matrix, wanted[name], 1e-4)


class CostTest(BoneTestCase):
    """Counted, since milliseconds depend on the machine."""

    @staticmethod
    def drivers_of(rig):
        return list(rig.animation_data.drivers if rig.animation_data else ())

    def test_one_solve_a_group_and_frame(self):
        for make in (build_few, build_many):
            support.empty_scene()
            make()
            frame_set(1)
            with mock.patch.object(toy_bone_system, "solve_calls", 0):
                frame_set(2)
                self.assertEqual(toy_bone_system.solve_calls, 1)

    def test_drivers_of_a_relative_member(self):
        rig = build(stretch=0.0)
        uses_attribute = capabilities.has_geometry_attribute_constraint()
        self.assertEqual(len(self.drivers_of(rig)), 0 if uses_attribute else 4 * 3)
        self.assertEqual(len(rig.motus.bend.hub.data.vertices), 4 if uses_attribute else 0)
        self.assertEqual([bone.name for bone in rig.pose.bones if bone.constraints], ["A.0", "A.1", "B.0", "B.1"])

    def test_one_hidden_object_a_group(self):
        first, second = build_few(), build_few()
        hidden = [obj for obj in bpy.data.objects if not obj.users_collection]
        self.assertEqual({first.motus.bend.hub, second.motus.bend.hub}, set(hidden))
        wiring.detach(SYSTEM, first)
        frame_set(5)
        self.assert_bent(second)
        wiring.detach(SYSTEM, second)
        self.assertEqual([obj.name for obj in bpy.data.objects if obj.name.startswith(".Motus")], [])
