"""What users do to rigs that are driven: copies, edited and renamed bones, undo, and taking the system off again."""

import bpy

import support
import toy_bone_system
import toy_system
from core.wiring.bone_cases import BoneTestCase, build, build_few, build_many, drive, each_kind, each_lasting_kind, poses
from core.wiring.wiring_cases import frame_set

wiring = support.addon("core.wiring")
signature = support.addon("core.wiring.attaching.signature")
hub_lookup = support.addon("core.wiring.hubs.hub_lookup")
SYSTEM = toy_bone_system.SYSTEM


def choose(chosen):
    """Selects one object alone, and makes it the active one."""
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj == chosen)
    bpy.context.view_layer.objects.active = chosen


def select(rig, name, is_selected):
    """Selects a bone in Pose Mode; in Blender 5 poses have a selection of their own."""
    bone = rig.pose.bones[name]
    (bone if hasattr(bone, "select") else bone.bone).select = is_selected


class CopyTest(BoneTestCase):
    def assert_independent(self, rig, copy):
        copy.motus.bend.entries[-1].weight = 0.2
        self.assert_alive(rig)
        self.assert_alive(copy)
        hubs = [one.motus.bend.hub for one in (rig, copy) if one.motus.bend.hub]
        self.assertEqual(len(set(hubs)), len(hubs))

    @each_lasting_kind
    def test_copied(self, build):
        rig = build()
        frame_set(3)
        copy = rig.copy()
        bpy.context.scene.collection.objects.link(copy)
        frame_set(4)
        self.assert_independent(rig, copy)

    @each_lasting_kind
    def test_copied_with_its_armature(self, build):
        rig = build()
        copy = rig.copy()
        copy.data = rig.data.copy()
        bpy.context.scene.collection.objects.link(copy)
        bpy.context.view_layer.update()
        self.assert_independent(rig, copy)

    @each_lasting_kind
    def test_duplicated_by_the_operator(self, build):
        rig = build()
        frame_set(3)
        choose(rig)
        bpy.ops.object.duplicate()
        copy = bpy.context.view_layer.objects.active
        self.assertIsNot(copy, rig)
        self.assert_independent(rig, copy)

    @each_lasting_kind
    def test_original_deleted(self, build):
        rig = build()
        copy = rig.copy()
        bpy.context.scene.collection.objects.link(copy)
        bpy.context.view_layer.update()
        bpy.data.objects.remove(rig)
        self.assert_alive(copy)

    def test_wired_once(self):
        rig = build_many()
        copy = rig.copy()
        bpy.context.scene.collection.objects.link(copy)
        for frame in (2, 3):
            frame_set(frame)
            bpy.context.view_layer.update()
        names = [obj.name for obj in bpy.data.objects]
        sinks = [constraint.name for _, constraint in wiring.sinks(SYSTEM, copy)]
        for frame in (4, 5):
            frame_set(frame)
            copy.location.x += 1.0
            bpy.context.view_layer.update()
        self.assertEqual([obj.name for obj in bpy.data.objects], names)
        self.assertEqual([constraint.name for _, constraint in wiring.sinks(SYSTEM, copy)], sinks)


class ArmatureTest(BoneTestCase):
    """Armatures that are edited while they are driven."""

    @staticmethod
    def edit(rig, change):
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        change(rig.data.edit_bones)
        bpy.ops.object.mode_set(mode='OBJECT')

    @each_lasting_kind
    def test_removed_bone(self, build):
        rig = build()
        frame_set(3)
        self.edit(rig, lambda bones: bones.remove(bones["A.end"]))
        self.assert_alive(rig)
        self.assertTrue(all(curve.is_valid and "A.end" not in curve.data_path for curve in rig.animation_data.drivers))

    @each_lasting_kind
    def test_removed_first_bone_of_a_chain(self, build):
        rig = build()
        frame_set(3)
        self.edit(rig, lambda bones: bones.remove(bones["A.0"]))
        for frame in (5, 12):
            frame_set(frame)
            self.assert_bent(rig)

    @each_lasting_kind
    def test_other_parent(self, build):
        rig = build()
        frame_set(3)

        def change(bones):
            bones["A.side"].parent = bones["root"]
            bones["A.1"].use_connect = False
            bones["A.end"].parent = bones["A.side"]

        self.edit(rig, change)
        self.assert_alive(rig)

    @each_lasting_kind
    def test_new_bone_becomes_a_guard(self, build):
        rig = build()
        frame_set(3)

        def change(bones):
            bone = bones.new("New")
            bone.head, bone.tail, bone.parent = (0.0, 0.0, 1.0), (0.0, 1.0, 1.0), bones["A.1"]

        self.edit(rig, change)
        self.assert_alive(rig)

    @each_lasting_kind
    def test_copied_bones(self, build):
        rig = build()
        frame_set(3)
        before = set(rig.pose.bones.keys())

        def change(bones):
            for bone in bones:
                bone.select = bone.select_head = bone.select_tail = bone.name != "root"
            bpy.ops.armature.duplicate()

        self.edit(rig, change)
        copies = [bone for bone in rig.pose.bones if bone.name not in before]
        self.assertEqual(len(copies), len(before) - 1)
        self.assertEqual({bone.name: list(bone.constraints) for bone in copies if bone.constraints}, {})
        self.assert_alive(rig)
        wiring.detach(SYSTEM, rig)
        self.assertEqual([bone.name for bone in rig.pose.bones if bone.constraints], [])

    @each_lasting_kind
    def test_copied_sinks(self, build):
        """As Symmetrize onto bones that are there and Copy Constraints to Selected Bones leave them."""
        rig = build()
        frame_set(3)
        choose(rig)
        bpy.ops.object.mode_set(mode='POSE')
        bone = rig.pose.bones["root"]
        for one in rig.data.bones:
            select(rig, one.name, one.name in {"root", "A.0"})
        rig.data.bones.active = rig.data.bones["A.0"]
        bpy.ops.pose.constraints_copy()
        bpy.ops.object.mode_set(mode='OBJECT')
        bpy.context.view_layer.update()
        self.assertEqual(list(bone.constraints), [])
        self.assert_alive(rig)

    @each_lasting_kind
    def test_renamed_bones(self, build):
        rig = build()
        frame_set(3)
        for old, new in (("A.0", "Upper"), ("A.1", "Lo\"wer"), ("B.0", "A.0")):
            if old in rig.data.bones:
                rig.data.bones[old].name = new
            bpy.context.view_layer.update()
        names = [entry.name for entry in rig.motus.bend.entries]
        self.assertEqual(names[:2], ["Upper", "A.0"][: len(names)])
        self.assert_alive(rig)

    @each_lasting_kind
    def test_bones_that_exchange_names(self, build):
        self.check_renamed_at_once(build(), ("A.0", "Kept"), ("A.1", "A.0"), ("Kept", "A.1"))

    @each_lasting_kind
    def test_bones_that_hand_names_on(self, build):
        self.check_renamed_at_once(build(), ("A.1", "A.2"), ("A.0", "A.1"))

    def check_renamed_at_once(self, rig, *names):
        """The entry of "A.0" follows that bone to the name "A.1"."""
        frame_set(3)
        for old, new in names:
            rig.data.bones[old].name = new
        bpy.context.view_layer.update()
        self.assertEqual(rig.motus.bend.entries[0].name, "A.1")
        self.assert_alive(rig)

    def test_renamed_while_edited(self):
        for make in (build_few, build_many):
            support.empty_scene()
            rig = make()
            copy = rig.copy()
            bpy.context.scene.collection.objects.link(copy)
            frame_set(3)

            def change(bones):
                bones["B.0"].name = "Leg"

            self.edit(rig, change)
            for one in (rig, copy):
                self.assertIn("Leg", one.motus.bend.entries)
                self.assert_alive(one)

    @each_lasting_kind
    def test_renamed_and_refreshed_at_once(self, build):
        rig = build()
        frame_set(3)
        rig.data.bones["A.0"].name = "Upper"
        wiring.refresh(SYSTEM, rig)
        self.assertIn("Upper", rig.motus.bend.entries)
        self.assert_alive(rig)

    def test_keys_and_drivers_of_a_renamed_entry(self):
        for plays in ("action", "strip"):
            with self.subTest(plays=plays):
                support.empty_scene()
                self.check_renamed_entry(plays)

    def test_renamed_in_tweak_mode(self):
        rig = build()
        rig.keyframe_insert('motus.bend.entries["A.0"].weight', frame=1)
        animation = rig.animation_data
        strip = animation.nla_tracks.new().strips.new("Strip", 1, animation.action)
        animation.action = None
        animation.nla_tracks.active, strip.select = animation.nla_tracks[0], True
        animation.use_tweak_mode = True
        self.assertTrue(animation.use_tweak_mode)
        with self.assertNoLogs():
            rig.data.bones["A.0"].name = "Upper"
            bpy.context.view_layer.update()
        self.assertIn("Upper", rig.motus.bend.entries)
        self.assert_bent(rig)

    def test_renamed_below_another_system(self):
        """Each system comes to know the name before the levels of the other one are final."""
        nod, rig = toy_bone_system.NOD, toy_bone_system.animate(toy_bone_system.new_rig())
        toy_bone_system.bend(rig, {"B.0": toy_system.new_target()}, system=nod)
        toy_bone_system.bend(rig, {"A.0": (rig, "B.1")})
        bpy.context.view_layer.update()
        rig.data.bones["B.0"].name = "Lower"
        bpy.context.view_layer.update()
        for system in (SYSTEM, nod):
            settings = getattr(rig.motus, system.name)
            self.assertEqual(settings.wired, signature.of(system, rig, tuple(system.groups(rig))), system.name)
        self.assertEqual([key for key, _ in hub_lookup.carriers_of(SYSTEM, rig)], ["1"])

    def check_renamed_entry(self, plays):
        rig = build()
        for frame, value in ((1, 0.0), (60, 1.0)):
            rig.motus.bend.entries["A.0"].weight = value
            rig.keyframe_insert('motus.bend.entries["A.0"].weight', frame=frame)
        animation = rig.animation_data
        if plays == "strip":
            animation.nla_tracks.new().strips.new("Strip", 1, animation.action)
            animation.action = None
        drive(rig, 'motus.bend.entries["B.0"].weight', "0.01*frame")
        frame_set(3)
        for old in ("A.0", "B.0"):
            rig.data.bones[old].name = f"New {old}"
            bpy.context.view_layer.update()
        self.assertEqual(rig.motus.bend.entries.keys(), ["New A.0", "New B.0"])
        frame_set(30)
        weights = [entry.weight for entry in rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).motus.bend.entries]
        self.assertAlmostEqual(weights[1], 0.3, places=5)
        self.assertTrue(0.1 < weights[0] < 0.9)
        self.assert_bent(rig)


class DetachTest(BoneTestCase):
    @each_kind
    def test_leaves_nothing(self, build):
        rig = build()
        frame_set(7)
        wiring.detach(SYSTEM, rig)
        bpy.context.view_layer.update()
        self.assertEqual([obj.name for obj in bpy.data.objects if obj.name.startswith(".Motus")], [])
        self.assertEqual(len(bpy.data.meshes), 0)
        self.assertEqual([key for key in rig.keys() if key.startswith("motus_")], [])
        self.assertEqual([bone.name for bone in rig.pose.bones if bone.constraints], [])
        self.assertEqual(
            [curve.data_path for curve in rig.animation_data.drivers if "motus_" in curve.data_path or ".constraints[" in curve.data_path],
            [],
        )
        self.assertFalse(rig.motus.bend.is_active)
        self.assertEqual((rig.motus.bend.hub, len(rig.motus.bend.more_hubs), len(rig.motus.bend.targets)), (None, 0, 0))
        self.assert_untouched(rig)

    @each_kind
    def test_leaves_nothing_of_a_deleted_hub(self, build):
        rig = build()
        frame_set(7)
        for _, hub in hub_lookup.hubs(SYSTEM, rig):
            bpy.data.objects.remove(hub)
        bpy.context.view_layer.update()
        wiring.detach(SYSTEM, rig)
        self.assertEqual([bone.name for bone in rig.pose.bones if bone.constraints], [])
        self.assertEqual([curve.data_path for curve in rig.animation_data.drivers if ".constraints[" in curve.data_path], [])
        self.assertEqual(len(bpy.data.meshes), 0)
        self.assert_untouched(rig)

    @each_kind
    def test_keeps_constraints_that_are_called_alike(self, build):
        rig = build()
        names = {'LIMIT_ROTATION': "Motus Bend Rotation Limit", 'TRANSFORM': "Motus Bend Scale by hand"}
        for kind, name in names.items():
            rig.pose.bones["root"].constraints.new(kind).name = name
        rig.data.bones["A.0"].name = "Upper"
        bpy.context.view_layer.update()
        wiring.detach(SYSTEM, rig)
        self.assertEqual([one.name for one in rig.pose.bones["root"].constraints], list(names.values()))

    def test_keeps_what_is_the_users(self):
        rig = build()
        bone = rig.pose.bones["A.0"]
        bone.constraints.new('LIMIT_SCALE').name = "Mine"
        output = wiring.output_path(SYSTEM, "A.0.angle", rig)
        driver = bone.constraints["Mine"].driver_add("influence").driver
        driver.type = 'SUM'
        target = driver.variables.new().targets[0]
        target.id_type, target.id, target.data_path = 'MESH', rig.motus.bend.hub.data, output
        frame_set(4)
        wiring.refresh(SYSTEM, rig)
        self.assertEqual(bone.constraints[-1].name, "Mine")
        wiring.detach(SYSTEM, rig)
        self.assertEqual([constraint.name for constraint in bone.constraints], ["Mine"])
        self.assertEqual([curve.data_path for curve in rig.animation_data.drivers], ['pose.bones["A.0"].constraints["Mine"].influence'])

    @each_kind
    def test_attached_twice_is_attached_once(self, build):
        rig = build()
        frame_set(2)
        counts = []
        for _ in range(2):
            wiring.attach(SYSTEM, rig)
            wiring.refresh(SYSTEM, rig)
            frame_set(3)
            counts.append(([len(bone.constraints) for bone in rig.pose.bones], len(bpy.data.objects), len(rig.animation_data.drivers)))
        self.assertEqual(counts[0], counts[1])
        self.assert_alive(rig)

    @each_kind
    def test_muted_and_back(self, build):
        rig = build()
        frame_set(2)
        wiring.set_muted(SYSTEM, rig, True)
        self.assert_untouched(rig)
        wiring.refresh(SYSTEM, rig)
        self.assert_untouched(rig)
        wiring.set_muted(SYSTEM, rig, False)
        self.assert_alive(rig)

    def test_groups_are_compared(self):
        rig = build()
        groups = SYSTEM.groups(rig)
        same = signature.of(SYSTEM, rig, groups)
        self.assertEqual(rig.motus.bend.wired, same)
        rig.motus.bend.entries["A.0"]["length"] = 1
        self.assertNotEqual(signature.of(SYSTEM, rig, SYSTEM.groups(rig)), same)


class UndoTest(BoneTestCase):
    def setUp(self):
        super().setUp()
        bpy.context.preferences.edit.use_global_undo = True

    @each_lasting_kind
    def test_undo_and_redo(self, build):
        rig = build()
        frame_set(3)
        bpy.ops.ed.undo_push(message="attached")
        rig.motus.bend.entries[0].weight = 0.25
        bpy.ops.ed.undo_push(message="changed")
        wiring.detach(SYSTEM, rig)
        bpy.ops.ed.undo_push(message="detached")
        for operator, weight in ((bpy.ops.ed.undo, 0.25), (bpy.ops.ed.undo, 1.0), (bpy.ops.ed.redo, 0.25)):
            operator()
            rig = bpy.data.objects["Rig"]
            self.assertTrue(rig.motus.bend.is_active)
            if not any("weight" in curve.data_path for curve in rig.animation_data.drivers):
                self.assertEqual(rig.motus.bend.entries[0].weight, weight)
            self.assert_alive(rig)
        bpy.ops.ed.redo()
        self.assert_untouched(bpy.data.objects["Rig"])

    @each_lasting_kind
    def test_undone_copy(self, build):
        rig = build()
        frame_set(3)
        bpy.ops.ed.undo_push(message="attached")
        bpy.context.view_layer.objects.active = rig
        rig.select_set(True)
        bpy.ops.object.duplicate()
        bpy.ops.ed.undo_push(message="copied")
        bpy.context.view_layer.update()
        bpy.ops.ed.undo()
        self.assert_alive(bpy.data.objects["Rig"])
        bpy.ops.ed.redo()
        self.assert_alive(bpy.data.objects["Rig"])
        self.assert_alive(bpy.data.objects["Rig.001"])
        self.assertEqual(len(poses(bpy.data.objects["Rig.001"])), len(bpy.data.objects["Rig"].pose.bones))
