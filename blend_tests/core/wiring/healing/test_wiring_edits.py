"""What users do to a scene that is wired: copies, new names, deletions, undo, and taking the system off again."""

import bpy

import support
import toy_system
from core.wiring.wiring_cases import WiringTestCase, build_bone, build_followers, build_object, each_kind, frame_set

wiring = support.addon("core.wiring")
FRAMES = (10, 33.5)


class EditTest(WiringTestCase):
    def assert_alive(self, owner, things):
        for frame in FRAMES:
            frame_set(frame)
            self.assert_follows(owner, things)

    def assert_at_rest(self, things):
        """All stand at their own transforms."""
        for frame in FRAMES:
            frame_set(frame)
            for thing in things:
                wanted = (
                    thing.matrix_basis if isinstance(thing, bpy.types.Object) else (thing.id_data.matrix_basis @ thing.bone.matrix_local)
                )
                self.assert_same_matrix(toy_system.world_matrix(thing), wanted)


class CopyTest(EditTest):
    def test_copied_object_has_its_own_settings(self):
        owner, _ = build_object(toy_system.new_target())
        copy = owner.copy()
        bpy.context.scene.collection.objects.link(copy)
        copy.motus.orbit.radius = 7.0
        self.assert_alive(owner, [owner])
        self.assert_alive(copy, [copy])

    def test_duplicated_by_the_operator(self):
        owner, _ = build_object(toy_system.new_target())
        bpy.context.view_layer.objects.active = owner
        owner.select_set(True)
        bpy.ops.object.duplicate()
        copy = bpy.context.view_layer.objects.active
        self.assertIsNot(copy, owner)
        copy.motus.orbit.speed = 2.0
        self.assert_alive(owner, [owner])
        self.assert_alive(copy, [copy])

    def test_copied_rig(self):
        owner, bones = build_bone(toy_system.new_target())
        copy = owner.copy()
        copy.data = owner.data.copy()
        bpy.context.scene.collection.objects.link(copy)
        copy.motus.orbit.radius = 7.0
        self.assert_alive(owner, bones)
        self.assert_alive(copy, [copy.pose.bones[bones[0].name]])

    def test_detached_copy_leaves_the_first(self):
        for build in (build_object, build_followers):
            with self.subTest(build.__name__):
                support.empty_scene()
                owner, things = build(toy_system.new_target())
                copy = owner.copy()
                bpy.context.scene.collection.objects.link(copy)
                wiring.detach(toy_system.SYSTEM, copy)
                self.assert_alive(owner, things)


class RenameTest(EditTest):
    @each_kind
    def test_renamed(self, build):
        owner, things = build(toy_system.new_target())
        frame_set(1)
        owner.name, owner.motus.orbit.target.name = "Sun", "Moon"
        for index, thing in enumerate(things):
            thing.name = f"Planet {index}"
            for constraint in thing.constraints:
                constraint.name = f"Mine {constraint.name}"
        self.assert_alive(owner, things)
        self.assertEqual(len(wiring.sinks(toy_system.SYSTEM, owner)), sum(len(one.constraints) for one in things))

    @each_kind
    def test_renamed_then_detached(self, build):
        owner, things = build(toy_system.new_target())
        for thing in things:
            for constraint in thing.constraints:
                constraint.name = f"Mine {constraint.name}"
        wiring.detach(toy_system.SYSTEM, owner)
        self.assertEqual([list(thing.constraints) for thing in things], [[] for _ in things])


class DeleteTest(EditTest):
    @each_kind
    def test_target_deleted_by_the_user(self, build):
        target = toy_system.new_object("Target")
        owner, things = build(target)
        self.assert_alive(owner, things)
        with bpy.context.temp_override(selected_objects=[target]):
            bpy.ops.object.delete()
        self.assert_at_rest(things)

    @each_kind
    def test_target_removed(self, build):
        target = toy_system.new_object("Target")
        owner, things = build(target)
        self.assert_alive(owner, things)
        bpy.data.objects.remove(target)
        self.assert_at_rest(things)

    def test_member_deleted(self):
        owner, followers = build_followers(toy_system.new_target())
        bpy.data.objects.remove(followers.pop(2))
        frame_set(12)
        for index, follower in zip((0, 1, 3, 4), followers):
            self.assert_close(toy_system.world_matrix(follower).translation, toy_system.expected(owner, index)[0])
        wiring.refresh(toy_system.SYSTEM, owner)
        self.assert_alive(owner, followers)

    def test_owner_of_many_deleted(self):
        owner, followers = build_followers(toy_system.new_target())
        with bpy.context.temp_override(selected_objects=[owner]):
            bpy.ops.object.delete()
        for frame in FRAMES:
            frame_set(frame)
            self.assertTrue(all(toy_system.world_matrix(one).translation.length < 1e3 for one in followers))


class DetachTest(EditTest):
    @each_kind
    def test_leaves_nothing(self, build):
        target = toy_system.new_target()
        frame_set(1)
        before = self._everything()
        owner, things = build(target)
        added = self._everything() - before
        wiring.detach(toy_system.SYSTEM, owner)
        self.assertEqual(
            self._everything() - before,
            {entry for entry in added if entry[0] in ("object", "armature") and not entry[1].startswith(".Motus")},
        )
        for one in {thing.id_data for thing in things} | {owner}:
            self.assertIsNone(one.animation_data)
            self.assertEqual([key for key in one.keys() if key.startswith("motus_")], [])
            self.assertFalse(one.motus.orbit.is_active)
            self.assertIsNone(one.motus.orbit.leader)
        self.assertEqual([list(thing.constraints) for thing in things], [[] for _ in things])
        self.assert_at_rest(things)

    @staticmethod
    def _everything():
        return {
            (kind, one.name)
            for kind, blocks in (
                ("object", bpy.data.objects),
                ("armature", bpy.data.armatures),
                ("mesh", bpy.data.meshes),
                ("action", bpy.data.actions),
            )
            for one in blocks
        }

    @each_kind
    def test_keeps_what_is_the_users(self, build):
        owner, things = build(toy_system.new_target())
        for thing in things:
            thing.constraints.new('LIMIT_SCALE').name = "Mine"
            thing.constraints["Mine"].driver_add("influence").driver.expression = "0.5"
        owner["mine"] = 3.0
        owner.keyframe_insert("scale", frame=1)
        wiring.detach(toy_system.SYSTEM, owner)
        self.assertEqual([[constraint.name for constraint in thing.constraints] for thing in things], [["Mine"] for _ in things])
        self.assertEqual(owner["mine"], 3.0)
        self.assertIsNotNone(owner.animation_data.action)
        drivers = [curve for one in {thing.id_data for thing in things} for curve in one.animation_data.drivers]
        self.assertEqual(len(drivers), len(things))

    @each_kind
    def test_attached_twice_is_attached_once(self, build):
        owner, things = build(toy_system.new_target())
        counts = []
        for _ in range(2):
            wiring.attach(toy_system.SYSTEM, owner)
            wiring.refresh(toy_system.SYSTEM, owner)
            counts.append(([len(thing.constraints) for thing in things], len(bpy.data.objects), len(bpy.data.meshes)))
        self.assertEqual(counts[0], counts[1])
        self.assert_alive(owner, things)

    @each_kind
    def test_muted_and_back(self, build):
        owner, things = build(toy_system.new_target())
        wiring.set_muted(toy_system.SYSTEM, owner, True)
        self.assert_at_rest(things)
        wiring.refresh(toy_system.SYSTEM, owner)
        self.assert_at_rest(things)
        wiring.set_muted(toy_system.SYSTEM, owner, False)
        self.assert_alive(owner, things)


class UndoTest(EditTest):
    def setUp(self):
        super().setUp()
        bpy.context.preferences.edit.use_global_undo = True

    @each_kind
    def test_undo_and_redo(self, build):
        owner, things = build(toy_system.new_object("Target"))
        name, names = owner.name, [(thing.id_data.name, thing.name) for thing in things]
        bpy.ops.ed.undo_push(message="attached")
        owner.motus.orbit.radius = 6.0
        bpy.data.objects["Target"].location.x = 5.0
        bpy.ops.ed.undo_push(message="changed")
        for operator, radius in ((bpy.ops.ed.undo, 2.0), (bpy.ops.ed.redo, 6.0)):
            operator()
            owner = bpy.data.objects[name]
            self.assertEqual(owner.motus.orbit.radius, radius)
            self.assert_alive(owner, self._find(names))

    @each_kind
    def test_undone_detach(self, build):
        owner, things = build(toy_system.new_object("Target"))
        name, names = owner.name, [(thing.id_data.name, thing.name) for thing in things]
        bpy.ops.ed.undo_push(message="attached")
        wiring.detach(toy_system.SYSTEM, owner)
        bpy.ops.ed.undo_push(message="detached")
        bpy.ops.ed.undo()
        self.assert_alive(bpy.data.objects[name], self._find(names))
        bpy.ops.ed.redo()
        self.assert_at_rest(self._find(names))

    @staticmethod
    def _find(names):
        objects = bpy.data.objects
        return [objects[name] if name == own else objects[name].pose.bones[own] for name, own in names]
