"""IK on rigs that nobody here made: where the tip really is in the evaluated pose, against where it was sent."""

import bpy
from mathutils import Matrix, Vector

import rig_samples as samples
import support
import toy_system

TOLERANCE = 2e-5  # of the chain's length: poses are single precision

CHAINS = {
    "basic_human": (("spine.003", 3), ("forearm.L", 2), ("forearm.R", 2), ("shin.L", 2), ("shin.R", 2)),
    "human": (("forearm.L", 2), ("forearm.R", 2), ("shin.L", 2), ("shin.R", 2), ("f_index.03.L", 3)),
    "basic_quadruped": (("front_shin.L", 2), ("front_shin.R", 2), ("foot.L", 3), ("foot.R", 3), ("spine", 4)),
    "bird": (("Wing.002.L", 3), ("Wing.002.R", 3), ("shin.L", 2), ("shin.R", 2), ("neck.002", 3)),
    "cat": (("forearm.L", 2), ("forearm.R", 2), ("foot.L", 3), ("foot.R", 3), ("tail.004", 4)),
    "horse": (("forefoot.L", 3), ("forefoot.R", 3), ("lower_leg.L", 2), ("lower_leg.R", 2), ("tail.005", 5)),
    "shark": (("spine", 3), ("side_fin.L.001", 2), ("side_fin.R.001", 2), ("back_fin.T.002.Bk", 3)),
    "wolf": (("front_shin.L", 2), ("front_shin.R", 2), ("foot.L", 3), ("foot.R", 3), ("spine", 4)),
}
GENERATED_CHAINS = (("forearm_fk.L", 2), ("forearm_fk.R", 2), ("shin_fk.L", 2), ("shin_fk.R", 2))


def add_ik(rig, bone, count, **keywords):
    """An IK entry with an empty of its own as the target; returns the empty."""
    target = toy_system.new_object(f"Target {bone}")
    status = bpy.ops.motus.ik_add(object=rig.name, bone=bone, target=target.name, chain_length=count, **keywords)
    assert status == {'FINISHED'}, status
    return target


class RigTestCase(support.SceneTestCase):
    def assert_reaches(self, rig, chains, generator, rounds=3, tolerance=TOLERANCE):
        """Sends the tips of (bone, count, target) to random places within reach. Those that others hang on come first."""
        for _ in range(rounds):
            for bone, count, target in chains:
                bpy.context.view_layer.update()
                target.location = samples.random_reachable(samples.joints(rig, bone, count), generator)
            bpy.context.view_layer.update()
            for bone, count, target in chains:
                size = sum(samples.lengths(samples.joints(rig, bone, count)))
                off = (samples.tip(rig, bone) - target.matrix_world.translation).length
                self.assertLessEqual(off, tolerance * size, f"{rig.name} {bone}: {off} m off, {size} m long")


class TestRigify(RigTestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        samples.enable_rigify()
        cls.addClassCleanup(samples.disable_rigify)

    def test_metarigs_reach_random_targets(self):
        for name, chains in CHAINS.items():
            with self.subTest(name):
                support.empty_scene()
                generator = samples.new_generator(name)
                rig = samples.metarig(name)
                samples.pose_at_random(rig, generator)
                samples.place_at_random(rig, generator, scale=(1.7, 1.7, 1.7))
                targets = [(bone, count, add_ik(rig, bone, count)) for bone, count in chains]
                self.assert_reaches(rig, targets, generator)

    def test_metarigs_come_back_exactly(self):
        for name, chains in CHAINS.items():
            with self.subTest(name):
                support.empty_scene()
                rig = samples.metarig(name)
                samples.pose_at_random(rig, samples.new_generator(name))
                bpy.context.view_layer.update()
                before = samples.pose_of(rig)
                for bone, count in chains:
                    add_ik(rig, bone, count)
                bpy.context.view_layer.update()
                self.assertNotEqual(before, samples.pose_of(rig))
                bpy.ops.motus.ik_remove(object=rig.name)
                bpy.context.view_layer.update()
                self.assertEqual(before, samples.pose_of(rig))
                self.assertFalse([bone.name for bone in rig.pose.bones if bone.constraints])

    def test_generated_human_reaches_random_targets(self):
        generator = samples.new_generator("generated")
        rig = samples.generated_human()
        for bone in ("torso", "chest", "hips"):
            rig.pose.bones[bone].rotation_mode = 'QUATERNION'
            rig.pose.bones[bone].rotation_quaternion = samples.random_rotation(generator, 0.5)
        rig.pose.bones["root"].scale = (1.3, 1.3, 1.3)
        targets = [(bone, count, add_ik(rig, bone, count)) for bone, count in GENERATED_CHAINS]
        self.assert_reaches(rig, targets, generator)

    def test_generated_human_by_its_own_controls(self):
        generator = samples.new_generator("controls")
        rig = samples.generated_human()
        for side in "LR":
            status = bpy.ops.motus.ik_add(
                object=rig.name, bone=f"forearm_fk.{side}", target=rig.name, target_bone=f"hand_ik.{side}", chain_length=2
            )
            self.assertEqual(status, {'FINISHED'})
        for _ in range(5):
            for side in "LR":
                rig.pose.bones[f"hand_ik.{side}"].location = [generator.uniform(-0.15, 0.15) for _ in range(3)]
            bpy.context.view_layer.update()
            for side in "LR":
                joints = samples.joints(rig, f"forearm_fk.{side}", 2)
                world, control = samples.evaluated_bone(rig, f"hand_ik.{side}")
                target = world @ control.matrix.translation
                reach = sum(samples.lengths(joints))
                short = max(0.0, (target - joints[0]).length - reach)
                self.assertAlmostEqual((joints[-1] - target).length, short, delta=TOLERANCE * reach + 1e-4 * short)


class TestRandomRigs(RigTestCase):
    def test_inherit_scale_modes_under_uniform_scale(self):
        for mode in samples.INHERIT_SCALES:
            for is_connected in (True, False):
                with self.subTest(mode, connected=is_connected):
                    support.empty_scene()
                    generator = samples.new_generator(mode)
                    rig = samples.random_rig(generator, 3, mode, is_connected)
                    rig.pose.bones["Parent"].scale = (1.6, 1.6, 1.6)
                    samples.place_at_random(rig, generator, (0.5, 0.5, 0.5))
                    self.assert_reaches(rig, [("Chain.2", 3, add_ik(rig, "Chain.2", 3))], generator)

    def test_inherit_scale_modes_under_non_uniform_scale(self):
        # Lengths depend on the pose here; the targets keep well within reach.
        for mode in samples.INHERIT_SCALES:
            with self.subTest(mode):
                support.empty_scene()
                generator = samples.new_generator(f"{mode} sheared")
                rig = samples.random_rig(generator, 2, mode)
                rig.pose.bones["Parent"].scale = (1.0, 1.35, 0.8)
                rig.pose.bones["Chain.0"].scale = (0.9, 1.1, 1.2)
                target = add_ik(rig, "Chain.1", 2)
                for _ in range(6):
                    joints = samples.joints(rig, "Chain.1", 2)
                    reach = sum(samples.lengths(joints))
                    direction = Vector([generator.gauss(0.0, 1.0) for _ in range(3)]).normalized()
                    target.location = joints[0] + generator.uniform(0.45, 0.65) * reach * direction
                    bpy.context.view_layer.update()
                    off = (samples.tip(rig, "Chain.1") - target.location).length
                    self.assertLessEqual(off, 1e-4 * reach)

    def test_what_a_strongly_sheared_chain_can_reach_it_does(self):
        for scaled, scale in (("Parent", (1.0, 2.0, 0.7)), ("Chain.0", (1.0, 2.0, 1.0)), ("Chain.0", (1.5, 1.0, 0.6))):
            with self.subTest(scaled, scale=scale):
                support.empty_scene()
                generator = samples.new_generator(f"{scaled} {scale}")
                rig = samples.random_rig(generator, 2)
                rig.pose.bones[scaled].scale = scale
                for bone in rig.pose.bones:
                    bone.rotation_mode = 'QUATERNION'
                places = []
                for _ in range(12):
                    for bone in ("Chain.0", "Chain.1"):
                        rig.pose.bones[bone].rotation_quaternion = samples.random_rotation(generator, 1.5)
                    bpy.context.view_layer.update()
                    places.append(samples.tip(rig, "Chain.1"))
                for bone in ("Chain.0", "Chain.1"):
                    rig.pose.bones[bone].rotation_quaternion = (1.0, 0.0, 0.0, 0.0)
                target = add_ik(rig, "Chain.1", 2)
                missed = []
                for place in places:
                    target.location = place
                    bpy.context.view_layer.update()
                    missed.append((samples.tip(rig, "Chain.1") - place).length > 1e-4)
                self.assertEqual(sum(missed), 0)

    def test_mirrored_and_stretched_armature_objects(self):
        for scale in ((-1.0, 1.0, 1.0), (-1.0, -1.0, -1.0), (2.0, 0.5, 1.0), (1e-3, 1e-3, 1e-3)):
            with self.subTest(scale):
                support.empty_scene()
                generator = samples.new_generator(str(scale))
                rig = samples.random_rig(generator, 2)
                samples.place_at_random(rig, generator, scale)
                target = add_ik(rig, "Chain.1", 2)
                for _ in range(5):
                    # Chosen in the armature's own space, where reach is a sphere.
                    _, bone = samples.evaluated_bone(rig, "Chain.0")
                    direction = Vector([generator.gauss(0.0, 1.0) for _ in range(3)]).normalized()
                    parts = [rig.data.bones[name].length for name in ("Chain.0", "Chain.1")]
                    near, far = abs(parts[0] - parts[1]), sum(parts)
                    place = bone.matrix.translation + (near + generator.uniform(0.1, 0.95) * (far - near)) * direction
                    target.location = rig.matrix_world @ place
                    bpy.context.view_layer.update()
                    self.assertLessEqual(
                        (samples.tip(rig, "Chain.1") - target.location).length, TOLERANCE * max(abs(part) for part in scale) * far + 1e-6
                    )

    def test_mirrored_parent_bone(self):
        generator = samples.new_generator("mirrored bone")
        rig = samples.random_rig(generator, 2)
        rig.pose.bones["Parent"].scale = (-1.0, 1.0, 1.0)
        self.assert_reaches(rig, [("Chain.1", 2, add_ik(rig, "Chain.1", 2))], generator, rounds=6)

    def test_rotation_modes_and_locations(self):
        for mode in ('QUATERNION', 'XYZ', 'ZYX', 'AXIS_ANGLE'):
            with self.subTest(mode):
                support.empty_scene()
                generator = samples.new_generator(mode)
                rig = samples.random_rig(generator, 3, is_connected=False)
                for bone in rig.pose.bones:
                    bone.rotation_mode = mode
                    bone.matrix_basis = samples.random_rotation(generator, 0.7).to_matrix().to_4x4()
                    bone.location = [generator.uniform(-0.1, 0.1) for _ in range(3)]
                target = add_ik(rig, "Chain.2", 3)
                bpy.context.view_layer.update()
                points = samples.joints(rig, "Chain.2", 3)
                for share in (0.3, 0.5, 0.7):
                    target.location = points[0] + share * sum(samples.lengths(points)) * samples.random_rotation(
                        generator
                    ).to_matrix() @ Vector((1.0, 0.0, 0.0))
                    bpy.context.view_layer.update()
                    self.assertLessEqual((samples.tip(rig, "Chain.2") - target.location).length, 1e-4)

    def test_flags_of_inheritance(self):
        for flag in ("use_inherit_rotation", "use_local_location"):
            with self.subTest(flag):
                support.empty_scene()
                generator = samples.new_generator(flag)
                rig = samples.random_rig(generator, 2, is_connected=False)
                setattr(rig.data.bones["Chain.1"], flag, False)
                rig.pose.bones["Chain.1"].location = (0.05, 0.1, -0.05)
                rig.pose.bones["Parent"].rotation_mode = 'QUATERNION'
                rig.pose.bones["Parent"].rotation_quaternion = samples.random_rotation(generator, 0.8)
                target = add_ik(rig, "Chain.1", 2)
                bpy.context.view_layer.update()
                head = samples.joints(rig, "Chain.1", 2)[0]
                for _ in range(4):
                    target.location = head + 0.6 * (samples.random_rotation(generator).to_matrix() @ Vector((1.0, 0.0, 0.0)))
                    bpy.context.view_layer.update()
                    self.assertLessEqual((samples.tip(rig, "Chain.1") - target.location).length, 1e-4)


class TestLinkedRigs(RigTestCase):
    def build_library(self, with_ik):
        """Saves a rig, with or without IK, in a collection; returns the file."""
        generator = samples.new_generator("library")
        rig = samples.random_rig(generator, 2)
        rig.name = "Linked Rig"
        collection = bpy.data.collections.new("Linked")
        bpy.context.scene.collection.children.link(collection)
        collection.objects.link(rig)
        if with_ik:
            target = add_ik(rig, "Chain.1", 2)
            target.name = "Linked Target"
            target.location = (0.9, 0.8, 0.9)
            collection.objects.link(target)
        path = self.folder / f"library{int(with_ik)}.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(path))
        support.empty_scene()
        return path

    def link(self, path):
        """Links the library's collection into the scene."""
        with bpy.data.libraries.load(str(path), link=True) as (_, wanted):
            wanted.collections = ["Linked"]
        bpy.context.scene.collection.children.link(wanted.collections[0])
        bpy.context.view_layer.update()
        return wanted.collections[0]

    def test_linked_rig_reaches(self):
        collection = self.link(self.build_library(with_ik=True))
        rig = collection.objects["Linked Rig"]
        self.assertLessEqual((samples.tip(rig, "Chain.1") - Vector((0.9, 0.8, 0.9))).length, 1e-5)

    def test_linked_rig_is_refused_in_a_sentence(self):
        self.link(self.build_library(with_ik=False))
        target = toy_system.new_object("Target")
        with self.assertRaisesRegex(RuntimeError, "linked"):
            bpy.ops.motus.ik_add(object="Linked Rig", bone="Chain.1", target=target.name)

    def override(self, collection):
        made = collection.override_hierarchy_create(bpy.context.scene, bpy.context.view_layer)
        bpy.context.view_layer.update()
        return made.objects["Linked Rig"], made.objects.get("Linked Target")

    def test_overridden_rig_follows_its_own_target(self):
        rig, target = self.override(self.link(self.build_library(with_ik=True)))
        self.assertIsNone(rig.library)
        for place in ((0.9, 0.8, 0.9), (0.5, 0.3, 1.2), (0.8, -0.2, 0.5)):
            target.location = place
            bpy.context.view_layer.update()
            bpy.context.view_layer.update()
            self.assertLessEqual((samples.tip(rig, "Chain.1") - Vector(place)).length, 1e-5)

    def test_overridden_weight(self):
        rig, _ = self.override(self.link(self.build_library(with_ik=True)))
        before = samples.tip(rig, "Chain.1")
        rig.motus.ik.entries[0].position_weight = 0.0
        bpy.context.view_layer.update()
        bpy.context.view_layer.update()
        self.assertGreater((samples.tip(rig, "Chain.1") - before).length, 0.05)

    def test_overridden_rig_takes_a_new_entry(self):
        rig, _ = self.override(self.link(self.build_library(with_ik=False)))
        generator = samples.new_generator("override")
        self.assert_reaches(rig, [("Chain.1", 2, add_ik(rig, "Chain.1", 2))], generator)

    def test_appended_rig_reaches(self):
        path = self.build_library(with_ik=True)
        with bpy.data.libraries.load(str(path)) as (_, wanted):
            wanted.objects = ["Linked Rig"]
        rig = wanted.objects[0]
        bpy.context.scene.collection.objects.link(rig)
        target = bpy.data.objects["Linked Target"]
        if target.name not in bpy.context.scene.objects:
            bpy.context.scene.collection.objects.link(target)
        bpy.context.view_layer.update()
        self.assertLessEqual((samples.tip(rig, "Chain.1") - Vector((0.9, 0.8, 0.9))).length, 1e-5)


class TestPoseIsKept(RigTestCase):
    def test_bones_outside_the_chain_stand_still(self):
        generator = samples.new_generator("outside")
        rig = samples.random_rig(generator, 4)
        before = samples.pose_of(rig)
        target = add_ik(rig, "Chain.3", 2)
        target.location = samples.random_reachable(samples.joints(rig, "Chain.3", 2), generator)
        bpy.context.view_layer.update()
        after = samples.pose_of(rig)
        for name in ("Parent", "Chain.0", "Chain.1"):
            self.assertTrue(samples.same_matrix(after[name], before[name]), name)
        self.assertFalse(samples.same_matrix(after["Chain.3"], before["Chain.3"]))

    def test_own_channels_are_never_written(self):
        generator = samples.new_generator("channels")
        rig = samples.random_rig(generator, 3)
        samples.pose_at_random(rig, generator, scale=0.2)
        kept = {bone.name: Matrix(bone.matrix_basis) for bone in rig.pose.bones}
        self.assert_reaches(rig, [("Chain.2", 2, add_ik(rig, "Chain.2", 2))], generator, tolerance=1e-2)
        self.assertEqual(kept, {bone.name: Matrix(bone.matrix_basis) for bone in rig.pose.bones})
