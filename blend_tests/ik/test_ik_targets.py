"""Targets of inverse kinematics: bones, what moves by itself, what is gone; and what is told of the result."""

import bpy
import numpy as np
from mathutils import Matrix, Vector

import support
from ik.ik_cases import ARM, REACHABLE, IkTestCase, add_bone, add_chain, tentacle, turn


class Targets(IkTestCase):
    def test_bones_of_the_rig_itself_and_of_another(self):
        def build(bones):
            add_chain(bones, "Bone", ARM)
            add_bone(bones, "Control", REACHABLE, (0.6, 0.3, 1.6))

        rig = self.rig(build)
        entry = self.reach(target="Rig", target_bone="Control")
        rig.pose.bones["Control"].location = (0.1, -0.2, 0.05)
        wanted = self.head(rig, "Control")
        self.assertGreater((wanted - Vector(REACHABLE)).length, 0.2)
        self.assertNear(self.tail(rig), wanted)
        other = self.rig(build, "Other")
        other.location = (0.0, 0.2, -0.1)
        other.pose.bones["Control"].location = (-0.1, 0.2, 0.05)
        entry.target = other
        self.assertNear(self.tail(rig), self.head(other, "Control"))
        other.location = (0.0, 0.0, 0.1)
        self.assertNear(self.tail(rig), self.head(other, "Control"))

    def test_target_with_constraints_and_parents(self):
        rig = self.arm()
        carrier = self.target((0.0, 0.3, 0.2), "Carrier")
        target = self.target((0.5, 0.0, 1.1))
        target.parent = carrier
        mover = self.target((0.1, 0.1, 0.1), "Mover")
        copied = target.constraints.new('COPY_LOCATION')
        copied.target, copied.use_offset = mover, True
        self.reach()
        for place in ((0.1, 0.1, 0.1), (0.0, -0.2, 0.2)):
            mover.location = place
            wanted = self.evaluated(target).matrix_world.translation.copy()
            self.assertNear(self.tail(rig), wanted)

    def test_no_target(self):
        rig = self.arm()
        turn(rig.pose.bones["Bone 0"], (1.0, 0.0, 0.0), 0.4)
        before = self.poses(rig)
        entry = self.reach()
        entry.target = None
        self.assertSamePose(rig, before)
        self.assertEqual(self.sentence(rig), "Bone 1 has no target: choose one")
        entry.target = bpy.data.objects["Target"]
        self.assertNear(self.tail(rig), REACHABLE)

    def test_one_deleted_target_leaves_the_other_chains(self):
        rig = self.arm(tentacle(4, 0.5))
        self.target((0.3, 0.2, 0.8), "First")
        self.target((0.5, 0.6, 1.6), "Second")
        self.reach("Bone 1", target="First")
        self.reach("Bone 3", target="Second")
        self.assertNear(self.tail(rig, "Bone 3"), (0.5, 0.6, 1.6), 5e-6)
        bpy.data.objects.remove(bpy.data.objects["First"])
        self.assertNear(self.tail(rig, "Bone 3"), (0.5, 0.6, 1.6), 5e-6)
        self.assertIn("Bone 1 has no target", self.sentence(rig, "Bone 1"))
        self.assertEqual(self.sentence(rig, "Bone 3"), "")
        problem = self.wiring.problem(self.system, rig, bpy.context.evaluated_depsgraph_get())
        self.assertFalse(problem.blocking)

    def test_target_deleted_by_the_user(self):
        """Delete in the interface takes an object out of its collections; the pointer keeps it in the file."""
        rig = self.arm()
        before = self.poses(rig)
        self.reach()
        self.assertNear(self.tail(rig), REACHABLE)
        self.scene.collection.objects.unlink(bpy.data.objects["Target"])
        self.assertSamePose(rig, before, frame=2)
        self.assertIn("Target is in no collection any more", self.sentence(rig))

    def test_deleted_target_in_another_process(self):
        """Deleted here, the target is deleted wherever the saved file is opened."""
        rig = self.arm()
        before = self.tail(rig)
        self.reach()
        self.tail(rig)
        self.scene.collection.objects.unlink(bpy.data.objects["Target"])
        self.assertNear(self.tail(rig), before)
        path = str(self.folder / "deleted.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        status, output = support.run_beside(f"""
import bpy
bpy.ops.wm.open_mainfile(filepath={path!r})
rig = bpy.data.objects["Rig"]
print("TAIL", *rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones["Bone 1"].tail)
bpy.context.scene.collection.objects.link(bpy.data.objects["Target"])
bpy.context.view_layer.update()
print("BACK", *rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones["Bone 1"].tail)
""")
        self.assertEqual(status, 0, output)
        found = {line.split()[0]: list(map(float, line.split()[1:])) for line in output.splitlines() if line.startswith(("TAIL", "BACK"))}
        self.assertNear(found["TAIL"], before)
        self.assertNear(found["BACK"], REACHABLE)

    def test_a_new_object_of_a_deleted_name(self):
        """It came along with something and never stood in a collection: that counts, as for Blender's own constraints."""
        rig = self.arm()
        entry = self.reach()
        self.tail(rig)
        bpy.data.objects.remove(bpy.data.objects["Target"])
        self.tail(rig)
        target = bpy.data.objects.new("Target", None)
        target.location = REACHABLE
        entry.target = target
        self.assertNear(self.tail(rig), REACHABLE)

    def test_excluded_target_counts(self):
        rig = self.arm()
        target = self.target()
        self.reach()
        collection = bpy.data.collections.new("Hidden")
        self.scene.collection.children.link(collection)
        collection.objects.link(target)
        self.scene.collection.objects.unlink(target)
        bpy.context.view_layer.layer_collection.children["Hidden"].exclude = True
        self.assertNear(self.tail(rig), REACHABLE)
        self.assertEqual(self.sentence(rig), "")

    def test_hidden_target_counts(self):
        rig = self.arm()
        target = self.target()
        self.reach()
        target.hide_viewport = True
        target.location = (0.5, 0.2, 1.3)
        self.assertNear(self.tail(rig, frame=2), (0.5, 0.2, 1.3))
        target.hide_viewport = False
        target.hide_set(True)
        target.location = (0.4, 0.2, 1.3)
        self.assertNear(self.tail(rig, frame=3), (0.4, 0.2, 1.3))

    def test_many_other_objects(self):
        """In a large scene a deleted target is found by another way."""
        rig = self.arm()
        for index in range(40):
            self.link(f"Other {index}")
        target = self.target()
        before = self.poses(rig)
        self.reach()
        self.assertNear(self.tail(rig, frame=2), REACHABLE)
        self.assertNear(self.tail(rig, frame=3), REACHABLE)
        self.scene.collection.objects.unlink(target)
        self.assertSamePose(rig, before, frame=4)

    def test_bone_of_the_target_that_is_gone(self):
        rig = self.arm()
        self.arm(name="Other")
        before = self.poses(rig)
        entry = self.reach(target="Other", target_bone="Hand")
        entry.target_bone = "Nose"
        self.assertSamePose(rig, before)
        self.assertEqual(self.sentence(rig), "Other has no bone Nose")

    def test_muted(self):
        rig = self.arm()
        turn(rig.pose.bones["Bone 0"], (1.0, 0.0, 0.0), 0.4)
        before = self.poses(rig)
        entry = self.reach()
        entry.is_muted = True
        self.assertSamePose(rig, before)
        self.assertEqual(self.sentence(rig), "")
        entry.is_muted = False
        self.assertNear(self.tail(rig), REACHABLE)

    def test_dependent_chains(self):
        """An arm on a spine that reaches itself, and an arm that reaches for the other one's hand."""

        def build(bones):
            spine = add_chain(bones, "Spine", ((0, 0, 0), (0, 0.05, 0.5), (0, 0, 1.0)))
            for side, sign in (("L", 1.0), ("R", -1.0)):
                add_chain(bones, f"Arm {side}", ((0, 0, 1.0), (0.4 * sign, 0.1, 1.0), (0.8 * sign, 0, 1.0)), spine)

        rig = self.rig(build)
        chest = self.target((0.2, 0.3, 0.8), "Chest")
        hand = self.target((0.5, 0.4, 1.2), "Left")
        self.reach("Arm R 1", target="Rig", target_bone="Arm L 1")
        self.reach("Arm L 1", target="Left")
        self.reach("Spine 1", target="Chest")
        for place, reached in (((0.2, 0.3, 0.8), (0.5, 0.4, 1.2)), ((-0.2, 0.1, 0.9), (0.1, 0.5, 1.3))):
            chest.location, hand.location = place, reached
            self.assertNear(self.tail(rig, "Spine 1"), place)
            self.assertNear(self.tail(rig, "Arm L 1"), reached)
            self.assertNear(self.tail(rig, "Arm R 1"), self.head(rig, "Arm L 1"))
        bpy.ops.motus.ik_remove(object="Rig", bone="Spine 1")
        self.assertNear(self.tail(rig, "Arm L 1"), reached)


class Outputs(IkTestCase):
    def two_arms(self):
        """One rig with two chains, the first one's target keyed."""

        def build(bones):
            for name, place in (("Left", (0.0, 0.0, 0.0)), ("Right", (0.0, 2.0, 0.0))):
                add_chain(bones, name, [Vector(place) + Vector(joint) for joint in ARM])

        rig = self.rig(build)
        left, right = self.target(REACHABLE, "Left Target"), self.target(Vector(REACHABLE) + Vector((0.0, 2.0, 0.0)), "Right Target")
        for frame, height in ((1, 1.4), (20, 1.0)):
            left.location.z = height
            left.keyframe_insert("location", frame=frame)
        self.reach("Left 1", target="Left Target")
        self.reach("Right 1", target="Right Target")
        self.evaluated(rig)
        return rig, right

    def test_a_target_that_comes_to_hang_on_another_chain(self):
        """Afterwards, by a parent or a constraint: the second chain is solved after the first one from then on."""

        def parent(rig, right):
            right.parent, right.parent_type, right.parent_bone = rig, 'BONE', "Left 1"
            right.matrix_world = Matrix.Translation((0.4, 1.5, 1.2))

        def constrain(rig, right):
            constraint = right.constraints.new('CHILD_OF')
            constraint.target, constraint.subtarget = rig, "Left 1"
            right.location = (0.0, 2.2, 0.0)

        for hang in (parent, constrain):
            with self.subTest(hang.__name__):
                support.empty_scene()
                self.setUp()
                rig, right = self.two_arms()
                hang(rig, right)
                bpy.context.view_layer.update()
                for frame in (1, 20, 10, 1):
                    evaluated = self.evaluated(right, frame)
                    self.assertNear(self.tail(rig, "Right 1"), evaluated.matrix_world.translation, 5e-6)
                right.parent = None
                right.constraints.clear()
                right.location = Vector(REACHABLE) + Vector((0.0, 2.0, 0.0))
                self.assertNear(self.tail(rig, "Right 1"), right.location)

    def test_a_target_that_comes_to_hang_on_its_own_chain(self):
        rig, right = self.two_arms()
        own = self.pose(rig, "Right 0", frame=1)
        constraint = right.constraints.new('COPY_LOCATION')
        constraint.target, constraint.subtarget = rig, "Right 1"
        bpy.context.view_layer.update()
        first = self.poses(rig, frame=1)
        self.poses(rig, frame=20)
        self.assertNear(self.poses(rig, frame=1), first, 0.0)
        self.assertIn("moves with the chain itself", self.sentence(rig, "Right 1"))
        right.constraints.clear()
        bpy.context.view_layer.update()
        self.assertNear(self.pose(rig, "Right 0", frame=1), own)

    def test_another_property_can_be_driven_by_the_residual(self):
        rig = self.arm()
        target = self.target((0.0, 0.0, 4.0))
        self.reach()
        left = self.output(rig, "Bone 1.residual")
        tip = self.tail(rig)
        self.assertAlmostEqual(left, (tip - Vector((0.0, 0.0, 4.0))).length, places=5)
        target.location = REACHABLE
        self.assertLess(self.output(rig, "Bone 1.residual"), 1e-6)
        self.assertEqual(self.output(rig, "Bone 1.reason"), 0.0)

    def test_overlay(self):
        rig = self.arm()
        self.target((0.0, 0.0, 4.0))
        self.target((0.5, -3.0, 1.5), "Pole")
        self.reach(pole="Pole")
        self.evaluated(rig)
        overlay = support.addon("ik.overlay")
        kinds = [(batch.kind, len(batch.points)) for batch in overlay.overlay(bpy.context, rig)]
        self.assertEqual(kinds[0], ('LINE_STRIP', 65))
        self.assertEqual(kinds[-2:], [('LINES', 2), ('LINES', 2)])
        outer = overlay.overlay(bpy.context, rig)[0].points
        radii = np.linalg.norm(outer - np.array(ARM[0]), axis=1)
        reach = sum(rig.data.bones[name].length for name in ("Bone 0", "Bone 1"))
        self.assertNear(radii, np.full(65, reach), 1e-5)
        bpy.context.scene.motus.show_reach = False
        bpy.context.scene.motus.show_residual = False
        self.assertEqual(len(overlay.overlay(bpy.context, rig)), 1)
        self.assertEqual(overlay.overlay(bpy.context, bpy.data.objects["Target"]), [])

    def test_overlay_of_what_is_left(self):
        """To the target that Blend stands on; nothing under way, or where the animation alone counts."""
        rig = self.arm()
        self.target()
        entry = self.reach()
        extra = entry.extra_targets.add()
        extra.object = self.target((0.0, 0.0, 4.0), "Far")
        overlay = support.addon("ik.overlay")

        def residuals():
            self.evaluated(rig)
            return [batch.points for batch in overlay.overlay(bpy.context, rig) if batch.kind == 'LINES']

        self.assertEqual(residuals(), [])
        entry.target_blend = 1.0
        (line,) = residuals()
        self.assertNear(line, (self.tail(rig), (0.0, 0.0, 4.0)))
        entry.target_blend = 0.5
        self.assertEqual(residuals(), [])
        entry.target_blend, entry.position_weight = 1.0, 0.0
        self.assertEqual(residuals(), [])

    def test_overlay_of_a_rig_scaled_to_nothing(self):
        rig = self.arm()
        self.reach()
        rig.scale = (0.0, 0.0, 0.0)
        self.evaluated(rig)
        overlay = support.addon("ik.overlay")
        self.assertEqual([batch.kind for batch in overlay.overlay(bpy.context, rig)], ['LINES'])  # to the target
        rig.scale = (1.0, 1.0, 1.0)
        self.evaluated(rig)
        self.assertIn('LINE_STRIP', [batch.kind for batch in overlay.overlay(bpy.context, rig)])

    def test_overlay_of_reach_has_no_stretch(self):
        rig = self.arm()
        self.target((0.0, 0.0, 4.0))
        self.reach(stretch=1.0)
        self.evaluated(rig)
        circle = support.addon("ik.overlay").overlay(bpy.context, rig)[0].points
        reach = sum(rig.data.bones[name].length for name in ("Bone 0", "Bone 1"))
        self.assertNear(np.linalg.norm(circle - np.array(ARM[0]), axis=1), np.full(65, reach), 1e-5)

    def test_matrices_stay_rigid(self):
        rig = self.arm()
        self.reach("Hand", use_tail=False, rotation_weight=1.0)
        for name in ("Bone 0", "Bone 1", "Hand"):
            axes = self.pose(rig, name).to_3x3()
            self.assertNear(axes.transposed() @ axes, Matrix.Identity(3))
