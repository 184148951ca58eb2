"""What is kept of an evaluated rig from frame to frame: every way to edit it is seen all the same."""

from unittest import mock

import bpy
from mathutils import Vector

import support
from ik.ik_cases import IkTestCase, add_bone, add_chain

ARMS = 3


class Copies(IkTestCase):
    """Each test evaluates a few frames, edits, and compares with a rig of which nothing is kept."""

    def setUp(self):
        super().setUp()
        self.copies = support.addon("core.evaluated.copies")
        self.rig_object = self.crowd()
        self.settings = self.rig_object.motus.ik
        for frame in (1, 2, 3):
            self.scene.frame_set(frame)

    def crowd(self):
        def build(bones):
            for arm in range(ARMS):
                place = Vector((2.0 * arm, 0.0, 0.0))
                root = add_bone(bones, f"Root {arm}", place - Vector((0.0, 0.0, 0.4)), place)
                add_chain(bones, f"Arm {arm}.", [place, place + Vector((0.7, 0.15, 0.0)), place + Vector((1.3, 0.0, 0.0))], root)

        rig = self.rig(build)
        for arm in range(ARMS):
            target = self.target((2.0 * arm + 0.5, 0.4, 0.6), f"Target {arm}")
            target.keyframe_insert("location", frame=1)
            target.location.z -= 1.0
            target.keyframe_insert("location", frame=60)
            self.reach(f"Arm {arm}. 1", target=target.name)
        return rig

    def assertSeen(self, changes=True, frames=(4, 30.5)):
        """The poses are those of a rig that is read anew at every frame, and (unless told) not those before the edit."""
        rig = self.rig_object
        found = [self.poses(rig, frame) for frame in frames]
        if changes:
            self.assertGreater(abs(found[0] - self.before[0]).max(), 1e-4)
        self.copies.release(rig)
        rig.update_tag()
        rig.data.update_tag()
        for frame, pose in zip(frames, found):
            self.assertEqual(self.poses(rig, frame).tolist(), pose.tolist())
        self.copies.prepare(rig)

    def run_edit(self, edit, **keywords):
        self.before = [self.poses(self.rig_object, frame) for frame in (4, 30.5)]
        edit()
        self.assertSeen(**keywords)

    def entry(self, arm):
        return self.settings.entries[f"Arm {arm}. 1"]

    def test_the_copy_is_kept(self):
        depsgraph = bpy.context.evaluated_depsgraph_get()
        first = self.copies.of(self.rig_object.evaluated_get(depsgraph))
        self.scene.frame_set(10)
        self.assertIs(self.copies.of(self.rig_object.evaluated_get(depsgraph)), first)
        self.assertTrue(first.found)
        self.entry(0).position_weight = 0.5
        bpy.context.view_layer.update()
        self.assertIsNot(self.copies.of(self.rig_object.evaluated_get(depsgraph)), first)
        self.assertEqual(list(self.rig_object[self.copies.KEY]), [0])

    def test_assigned(self):
        def edit():
            self.entry(1).position_weight = 0.3

        self.run_edit(edit)

    def test_assigned_all_at_once(self):
        def edit():
            self.settings.entries.foreach_set("position_weight", [0.2] * ARMS)
            self.rig_object.update_tag()

        self.run_edit(edit)

    def test_muted(self):
        def edit():
            self.entry(2).is_muted = True

        self.run_edit(edit)

    def test_influence(self):
        def edit():
            self.settings.influence = 0.4

        self.run_edit(edit)

    def test_other_target(self):
        def edit():
            self.entry(0).target = self.target((0.2, -0.9, 0.1), "Other")

        self.run_edit(edit)

    def test_target_moved_by_hand(self):
        def edit():
            target = self.entry(0).target
            target.animation_data_clear()
            target.location = (0.1, -0.8, 0.2)

        self.run_edit(edit)

    def test_target_deleted(self):
        self.run_edit(lambda: bpy.data.objects.remove(self.entry(0).target))

    def test_target_taken_out_of_the_scene(self):
        self.run_edit(lambda: self.scene.collection.objects.unlink(self.entry(0).target))

    def test_objects_in_another_order(self):
        """The view layer's list changes, and nothing of the rig with it."""

        def edit():
            for name in ("Target 1", "Target 0"):
                obj = bpy.data.objects[name]
                self.scene.collection.objects.unlink(obj)
                self.scene.collection.objects.link(obj)

        self.run_edit(edit, changes=False)

    def test_a_crowd_comes_and_goes(self):
        before = self.poses(self.rig_object, 4)
        crowd = [self.target((9.0, place, 0.0), f"Extra {place}") for place in range(40)]

        def leave():
            for obj in crowd:
                bpy.data.objects.remove(obj)

        for edit in (lambda: None, leave):
            self.run_edit(edit, changes=False)
            self.assertEqual(self.poses(self.rig_object, 4).tolist(), before.tolist())

    def test_hidden_targets(self):
        def edit():
            bpy.data.objects["Target 1"].hide_viewport = True
            bpy.data.objects["Target 2"].hide_set(True)

        before = self.poses(self.rig_object, 4)
        self.run_edit(edit, changes=False)
        self.assertEqual(self.poses(self.rig_object, 4).tolist(), before.tolist())

    def test_in_two_scenes(self):
        """Targets stand elsewhere in the lists of the second scene, which was made after the rig was wired."""
        other = bpy.data.scenes.new("Other")
        for name in ("Target 2", "Target 0", "Rig", "Target 1"):
            other.collection.objects.link(bpy.data.objects[name])
        support.addon("core.wiring.attaching.attach").refresh(support.addon("core.declare").registered["ik"], self.rig_object)
        self.assertIn(self.copies.KEY, other)
        expected = self.poses(self.rig_object, 30.5)
        bpy.context.window.scene = other
        other.frame_set(30, subframe=0.5)
        evaluated = self.rig_object.evaluated_get(bpy.context.evaluated_depsgraph_get())
        found = [list(value) for bone in evaluated.pose.bones for value in bone.matrix]
        bpy.context.window.scene = self.scene
        self.assertEqual(found, [list(value) for pose in expected for value in pose])

    def test_entries_in_another_order(self):
        def edit():
            self.entry(0).position_weight = 0.2
            self.settings.entries.move(0, 2)
            self.rig_object.update_tag()

        self.run_edit(edit)

    def test_keyed(self):
        def edit():
            entry = self.entry(1)
            for frame, weight in ((1, 0.1), (40, 0.9)):
                entry.position_weight = weight
                entry.keyframe_insert("position_weight", frame=frame)

        self.run_edit(edit)
        self.assertGreater(abs(self.poses(self.rig_object, 5) - self.poses(self.rig_object, 39)).max(), 0.05)

    def test_keyed_where_bones_are_keyed_already(self):
        bone = self.rig_object.pose.bones["Arm 1. 0"]
        bone.keyframe_insert("rotation_quaternion", frame=1)
        for frame in (5, 6):
            self.scene.frame_set(frame)
        self.test_keyed()

    def test_a_curve_that_is_sent_elsewhere(self):
        """A curve of another channel comes to animate a setting."""
        rig = self.rig_object
        for frame, place in ((1, 0.1), (40, 0.8)):
            rig.location.x = place
            rig.keyframe_insert("location", index=0, frame=frame)
        rig.location.x = 0.0
        self.scene.frame_set(2)

        def edit():
            curve = support.addon("core.blender.actions").fcurves(rig)[0]
            curve.data_path, curve.array_index = self.settings.path_from_id() + ".influence", 0
            rig.location.x = 0.0

        self.run_edit(edit)

    def test_keys_removed(self):
        self.test_keyed()

        def edit():
            self.rig_object.animation_data_clear()
            self.entry(1).position_weight = 0.0

        self.run_edit(edit)

    def test_driven(self):
        def edit():
            self.entry(1).driver_add("position_weight").driver.expression = "0.01 * frame"

        self.run_edit(edit)

    def test_nla(self):
        self.entry(1).position_weight = 0.3
        self.entry(1).keyframe_insert("position_weight", frame=1)
        animation = self.rig_object.animation_data
        action = animation.action

        def edit():
            strip = animation.nla_tracks.new().strips.new("Strip", 1, action)
            strip.use_animated_influence = True
            strip.influence = 0.5
            animation.action = None

        self.run_edit(edit, changes=False)

    def key_root(self):
        root = self.rig_object.pose.bones["Root 1"]
        for frame, turn in ((1, 0.0), (60, 0.6)):
            root.rotation_quaternion = (1.0, 0.0, turn, 0.0)
            root.keyframe_insert("rotation_quaternion", frame=frame)
        for frame in (5, 6):
            self.scene.frame_set(frame)

    def half_reached(self):
        """The arm that the tests pose, so that its own transform shows."""
        self.entry(1).position_weight = 0.5
        return self.rig_object.pose.bones["Arm 1. 0"]

    def test_posed_under_a_keyed_root(self):
        self.key_root()
        bone = self.half_reached()

        def edit():
            bone.rotation_quaternion = (1.0, 0.3, 0.0, 0.2)

        self.run_edit(edit)

    def test_keyed_under_a_keyed_root(self):
        self.key_root()
        bone = self.half_reached()

        def edit():
            for frame, turn in ((1, 0.5), (60, -0.5)):
                bone.rotation_quaternion = (1.0, 0.0, 0.0, turn)
                bone.keyframe_insert("rotation_quaternion", frame=frame)

        self.run_edit(edit)
        action = self.rig_object.animation_data.action

        def take_away():
            for curves in support.addon("core.blender.actions").all_fcurves(action):
                for curve in [one for one in curves if "Arm 1" in one.data_path]:
                    curves.remove(curve)

        self.run_edit(take_away)

    def test_driven_under_a_driven_root(self):
        root = self.rig_object.pose.bones["Root 1"]
        root.driver_add("location", 0).driver.expression = "0.01 * frame"
        bone = self.half_reached()

        def edit():
            bone.driver_add("rotation_quaternion", 1).driver.expression = "0.02 * frame"

        self.run_edit(edit)

    def test_a_bone_that_is_animated_by_its_number(self):
        self.half_reached()
        number = list(self.rig_object.pose.bones.keys()).index("Arm 1. 0")

        def edit():
            curve = self.rig_object.pose.bones[number].driver_add("rotation_quaternion", 1)
            curve.driver.expression = "0.02 * frame"
            curve.data_path = f"pose.bones[{number}].rotation_quaternion"
            self.rig_object.update_tag()

        self.run_edit(edit)
        # Blender may evaluate the solver before a driver that the solver does not wait for.
        solvers = [curve.driver for mesh in bpy.data.meshes if mesh.animation_data for curve in mesh.animation_data.drivers]
        awaited = {variable.targets[0].data_path for driver in solvers for variable in driver.variables}
        self.assertIn('pose.bones["Arm 1. 0"].location[0]', awaited)

    def test_a_bone_with_quotes_in_its_name(self):
        bone = self.half_reached()
        bone.name = 'Arm "1" \\ upper'
        bone = self.rig_object.pose.bones[bone.name]

        def edit():
            for frame, turn in ((1, 0.5), (60, -0.5)):
                bone.rotation_quaternion = (1.0, 0.0, 0.0, turn)
                bone.keyframe_insert("rotation_quaternion", frame=frame)

        self.run_edit(edit)

    def lengthen(self):
        bpy.ops.object.mode_set(mode='EDIT')
        bone = self.rig_object.data.edit_bones["Arm 0. 1"]
        bone.tail = bone.head + (bone.tail - bone.head) * 1.5
        bpy.ops.object.mode_set(mode='OBJECT')

    def test_bone_made_longer(self):
        self.run_edit(self.lengthen, changes=False)
        self.assertNear(self.tail(self.rig_object, "Arm 0. 1"), self.evaluated(self.entry(0).target).matrix_world.translation, 1e-4)

    def read(self):
        """How often all of the rig is read anew, in some frames."""
        reading = support.addon("ik.reading")
        self.scene.frame_set(5)
        with mock.patch.object(reading, "_Source", wraps=reading._Source) as read:
            for frame in (6, 7, 8):
                self.scene.frame_set(frame)
        return read.call_count

    def test_an_armature_that_is_not_marked(self):
        """As a script may leave it."""
        self.assertEqual(self.read(), 0)
        del self.rig_object.data[self.copies.KEY]
        self.rig_object.data.update_tag()
        self.assertEqual(self.read(), 0)
        self.run_edit(self.lengthen, changes=False)

    def test_a_linked_armature(self):
        """Its library may have it from before there was a Motus."""
        data = self.rig_object.data
        self.copies.unmark(data)
        path = str(self.folder / "library.blend")
        bpy.data.libraries.write(path, {data})
        with bpy.data.libraries.load(path, link=True) as (_, wanted):
            wanted.armatures = [data.name]
        self.rig_object.data = wanted.armatures[0]
        self.assertIsNotNone(self.rig_object.data.library)
        self.assertEqual(self.read(), 0)

    def test_undo(self):
        bpy.ops.ed.undo_push(message="Before")
        before = self.poses(self.rig_object, 4)
        self.entry(0).position_weight = 0.0
        bpy.ops.ed.undo_push(message="Weight")
        self.assertGreater(abs(self.poses(self.rig_object, 4) - before).max(), 1e-3)
        bpy.ops.ed.undo()
        rig, self.scene = bpy.data.objects["Rig"], bpy.context.scene
        self.assertEqual(self.poses(rig, 4).tolist(), before.tolist())

    def test_removed_with_the_last_system(self):
        bpy.ops.motus.look_at_add(object="Rig", bone="Root 0", target="Target 0")
        for arm in range(ARMS):
            bpy.ops.motus.ik_remove(object="Rig", bone=f"Arm {arm}. 1")
        for datablock in (self.rig_object, self.rig_object.data, self.scene):
            self.assertIn(self.copies.KEY, datablock)
        bpy.ops.motus.look_at_remove(object="Rig", bone="Root 0")
        self.assertNotIn(self.copies.KEY, self.rig_object)
        self.assertNotIn(self.copies.KEY, self.rig_object.data)
        self.assertNotIn(self.copies.KEY, self.scene)
