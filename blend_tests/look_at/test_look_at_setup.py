"""Look At's operators: what they find by themselves, removing without a trace, problems, and what is refused."""

import math
import sys

import bpy
from mathutils import Euler

import rig_samples
import support
from look_at.look_at_cases import BODY, EYES, FAR, LookAtTestCase, build_rig, direction


def state(rig):
    """All of a rig that a system could leave a trace in."""
    animation = rig.animation_data
    action = animation and animation.action
    return {
        "matrix": rig.matrix_world.copy(),
        "properties": sorted(rig.keys()),
        "constraints": [(bone.name, c.type, c.name) for bone in rig.pose.bones for c in bone.constraints],
        "own": [tuple(bone.matrix_basis.col[i]) for bone in rig.pose.bones for i in range(4)],
        "drivers": [curve.data_path for curve in animation.drivers] if animation else None,
        "action": action.name if action else None,
        "settings": rig.is_property_set("motus"),
        "data": (len(bpy.data.meshes), len(bpy.data.objects)),
    }


class Add(LookAtTestCase):
    def test_keywords_become_settings(self):
        given = {
            "weight": 0.75,
            "body_weight": 0.25,
            "head_weight": 0.5,
            "eyes_weight": 0.125,
            "clamp": 0.0625,
            "body_limit": 0.5,
            "head_limit": 1.0,
            "eyes_limit": 0.25,
            "head_left_limit": 0.75,
            "eyes_down_limit": 0.125,
            "head_forward": 'NEG_Z',
            "eyes_forward": 'POS_Y',
            "body_length": 2,
        }
        entry = self.look(eyes="Eye.R", **given)
        self.assertEqual({name: getattr(entry, name) for name in given}, given)
        self.assertEqual([eye.name for eye in entry.eyes], ["Eye.R"])
        self.assertEqual(entry.target, self.target)

    def test_defaults_are_unitys(self):
        entry = self.look()
        self.assertEqual((entry.weight, entry.head_weight, entry.eyes_weight, entry.clamp), (1.0, 1.0, 0.0, 0.5))
        self.assertAlmostEqual(entry.body_weight, 0.3, places=6)

    def test_the_figure_is_found_by_itself(self):
        bpy.ops.motus.look_at_add(object="Rig")
        (entry,) = self.rig.motus.look_at.entries
        self.assertEqual((entry.name, entry.body_length), ("Head", len(BODY)))
        self.assertEqual([eye.name for eye in entry.eyes], list(EYES), "the lid is no eye")

    def test_a_target_is_made_in_front_and_moves_nothing(self):
        self.rig.location, self.rig.rotation_euler, self.rig.scale = (3, 1, 2), (0.2, -0.1, 1.0), (2, 2, 2)
        self.rig.pose.bones["Chest"].rotation_quaternion = Euler((0.1, 0.3, 0.0)).to_quaternion()
        bpy.context.view_layer.update()
        before = self.poses()
        bpy.ops.motus.look_at_add(object="Rig", bone="Head")
        target = self.rig.motus.look_at.entries[0].target
        bpy.context.view_layer.update()
        self.assertSamePoses(self.poses(), before, 2e-6)
        way = target.matrix_world.translation - self.pose("Head").translation
        self.assertAlmostEqual(way.length, 3.0, places=4, msg="six lengths of the head bone, in the world")
        self.assertIn(self.rig.users_collection[0], target.users_collection)

    def test_again_changes_only_what_is_given(self):
        entry = self.look(body_weight=0.5, eyes="Eye.L", body_length=1)
        constraints = [len(bone.constraints) for bone in self.rig.pose.bones]
        bpy.ops.motus.look_at_add(object="Rig", bone="Head", head_weight=0.25)
        (entry,) = self.rig.motus.look_at.entries
        self.assertEqual((entry.body_weight, entry.head_weight, entry.body_length), (0.5, 0.25, 1))
        self.assertEqual(([eye.name for eye in entry.eyes], entry.target), (["Eye.L"], self.target))
        self.assertEqual([len(bone.constraints) for bone in self.rig.pose.bones], constraints)

    def test_by_selection_in_pose_mode(self):
        bpy.context.view_layer.objects.active = self.rig
        self.rig.select_set(True)
        self.target.select_set(True)
        bpy.ops.object.mode_set(mode='POSE')
        self.rig.data.bones.active = self.rig.data.bones["Neck"]
        self.assertEqual(bpy.ops.motus.look_at_add(), {'FINISHED'})
        (entry,) = self.rig.motus.look_at.entries
        self.assertEqual((entry.name, entry.target), ("Neck", self.target))
        self.assertEqual(bpy.ops.motus.look_at_remove(), {'FINISHED'})
        self.assertFalse(self.rig.motus.look_at.is_active)
        bpy.ops.object.mode_set(mode='EDIT')
        self.assertFalse(bpy.ops.motus.look_at_add.poll())

    def test_several_heads_at_once(self):
        bones = {
            "Hips": ("", (0, 0, 1), (0, 0, 1.2)),
            "Chest": ("Hips", (0, 0, 1.2), (0, 0, 1.5)),
            "HeadA": ("Chest", (0.2, 0, 1.5), (0.2, 0, 1.7)),
            "HeadB": ("Chest", (-0.2, 0, 1.5), (-0.2, 0, 1.7)),
        }
        rig = build_rig(bones, "Hydra")
        bpy.ops.motus.look_at_add(object="Hydra", bones="HeadA, HeadB")
        heads = rig.motus.look_at.entries
        self.assertEqual([(head.name, head.body_length) for head in heads], [("HeadA", 1), ("HeadB", 0)], "one of them has the chest")
        self.assertNotEqual(heads[0].target, heads[1].target)
        for head in ("HeadA", "HeadB"):
            bpy.ops.motus.look_at_remove(object="Hydra", bone=head)
        self.assertRefused(
            "driven from HeadA and from HeadB", bpy.ops.motus.look_at_add, object="Hydra", bones="HeadA,HeadB", body_length=1
        )
        self.assertFalse(rig.motus.look_at.entries)
        self.assertRefused("has no bone Nose", bpy.ops.motus.look_at_add, object="Hydra", bones="HeadA,Nose")

    def test_no_eyes(self):
        self.assertEqual(len(self.look(eyes="").eyes), 0)

    def test_eyes_are_added_and_removed(self):
        self.aim(30)
        entry = self.look(eyes="", body_weight=0.0, head_weight=0.0, eyes_weight=1.0)
        self.assertEqual(self.yaw("Eye.L"), 0.0)
        bpy.ops.motus.look_at_eye_add(object="Rig", bone="Head", eye="Eye.L")
        bpy.context.view_layer.update()
        self.assertGreater(self.yaw("Eye.L"), 25.0)
        bpy.ops.motus.look_at_eye_remove(object="Rig", bone="Head", eye="Eye.L")
        bpy.context.view_layer.update()
        self.assertEqual((len(entry.eyes), abs(self.yaw("Eye.L")) < 1e-5), (0, True))
        self.assertFalse(self.rig.pose.bones["Eye.L"].constraints)
        self.assertRefused("not below Head", bpy.ops.motus.look_at_eye_add, object="Rig", bone="Head", eye="Chest")
        self.assertRefused("no eye of Head", bpy.ops.motus.look_at_eye_remove, object="Rig", bone="Head", eye="Eye.R")

    def test_two_heads_on_one_body(self):
        bones = {
            "Hips": ("", (0, 0, 1), (0, 0, 1.2)),
            "Chest": ("Hips", (0, 0, 1.2), (0, 0, 1.5)),
            "HeadA": ("Chest", (0.2, 0, 1.5), (0.2, 0, 1.7)),
            "HeadB": ("Chest", (-0.2, 0, 1.5), (-0.2, 0, 1.7)),
        }
        rig = build_rig(bones, "Hydra")
        other = self.link("Other")
        self.target.location, other.location = (1.0, -2.0, 1.5), (-2.0, -2.0, 1.7)
        self.look("Hydra", bone="HeadA", body_length=1)
        self.assertRefused("Chest is driven", bpy.ops.motus.look_at_add, object="Hydra", bone="HeadB", body_length=1)
        # The second head stands on what the first one turns, so it is solved after it.
        self.look("Hydra", bone="HeadB", body_length=0, target="Other")
        for name, goal in (("HeadA", self.target), ("HeadB", other)):
            way = goal.location - self.pose(name, rig).translation
            self.assertLess(math.degrees(self.gaze(name, rig=rig).angle(way)), 2e-3, name)
        bpy.ops.motus.look_at_remove(object="Hydra", bone="HeadA")
        bpy.context.view_layer.update()
        self.assertEqual([entry.name for entry in rig.motus.look_at.entries], ["HeadB"])
        way = other.location - self.pose("HeadB", rig).translation
        self.assertLess(math.degrees(self.gaze("HeadB", rig=rig).angle(way)), 2e-3)


class Rigify(LookAtTestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rig_samples.enable_rigify()
        cls.addClassCleanup(rig_samples.disable_rigify)

    def test_heads_of_all_metarigs(self):
        """Six of the eight have no bone that is called head."""
        heads = {
            "basic_human": "spine.006",
            "human": "spine.006",
            "basic_quadruped": "spine.011",
            "bird": "head",
            "cat": "spine.006",
            "horse": "head",
            "shark": "spine.007",
            "wolf": "spine.011",
        }
        self.assertEqual(set(heads), set(rig_samples.METARIGS))
        for name, head in heads.items():
            with self.subTest(name):
                self.setUp()
                rig = rig_samples.metarig(name)
                self.target.location = rig.data.bones[head].head_local + 5.0 * direction(20.0, 5.0)
                bpy.ops.motus.look_at_add(object=rig.name, target="Target")
                (entry,) = rig.motus.look_at.entries
                self.assertEqual(entry.name, head)
                bpy.context.view_layer.update()
                self.assertLess(self.off(head, rig=rig), 2e-3)

    def test_two_necks_are_not_guessed(self):
        rig = rig_samples.metarig("basic_human")
        rig.pose.bones["upper_arm.L"].rigify_type = "spines.super_head"
        self.assertRefused("Choose the bone of the head", bpy.ops.motus.look_at_add, object=rig.name)

    def test_a_neck_ends_where_it_forks(self):
        rig = rig_samples.metarig("basic_human")
        bpy.ops.object.mode_set(mode='EDIT')
        rig.data.edit_bones["heel.02.L"].use_connect = True
        bpy.ops.object.mode_set(mode='OBJECT')
        rig.pose.bones["spine.004"].rigify_type, rig.pose.bones["thigh.L"].rigify_type = "", "spines.super_head"
        bpy.ops.motus.look_at_add(object=rig.name, target="Target")
        self.assertEqual(rig.motus.look_at.entries[0].name, "foot.L")

    def test_metarig_without_rigify(self):
        """From Blender 5 on nobody else can read what Rigify noted, but for the numbers of the spine."""
        rig = rig_samples.metarig("wolf")
        rig_samples.disable_rigify()
        self.addCleanup(rig_samples.enable_rigify)
        bpy.ops.motus.look_at_add(object=rig.name, target="Target")
        self.assertEqual(rig.motus.look_at.entries[0].name, "spine.011")

    def test_spine_of_the_human(self):
        rig = rig_samples.metarig("basic_human")
        bpy.ops.motus.look_at_add(object=rig.name, bone="spine.006", target="Target")
        (entry,) = rig.motus.look_at.entries
        # Neck (two bones) and the two upper ones of the spine; the shoulders' bone among them, not the hips.
        self.assertEqual(entry.body_length, 4)

    def test_eyes_of_the_human(self):
        rig = rig_samples.metarig("human")
        bpy.ops.motus.look_at_add(object=rig.name, bone="spine.006", target="Target")
        self.assertEqual({eye.name for eye in rig.motus.look_at.entries[0].eyes}, {"eye.L", "eye.R"})


class Remove(LookAtTestCase):
    def test_nothing_is_left(self):
        for bone in self.rig.pose.bones:
            bone.rotation_quaternion = Euler((0.1, 0.2, -0.1)).to_quaternion()
        self.rig.pose.bones["Head"].constraints.new('COPY_SCALE').name = "Own"
        bpy.context.view_layer.update()
        before, poses = state(self.rig), self.poses()
        self.aim(40)
        entry = self.look(eyes_weight=1.0)
        entry.keyframe_insert("weight", frame=1)
        bpy.context.view_layer.update()
        self.assertNotEqual(state(self.rig), before)
        self.assertEqual(bpy.ops.motus.look_at_remove(object="Rig", bone="Head"), {'FINISHED'})
        bpy.context.view_layer.update()
        self.assertEqual(state(self.rig), before)
        self.assertSamePoses(self.poses(), poses, 0.0)

    def test_nothing_is_left_of_driven_settings(self):
        bpy.context.view_layer.update()
        before, poses = state(self.rig), self.poses()
        self.aim(40)
        self.look().driver_add("clamp").driver.expression = "0.5"
        for _ in range(2):
            bpy.context.view_layer.update()
        bpy.ops.motus.look_at_remove(object="Rig", bone="Head")
        bpy.context.view_layer.update()
        after = state(self.rig)
        self.assertFalse(self.rig.motus.look_at.is_active or self.rig.motus.look_at.entries)
        for left_open in ("settings", "properties"):  # to ask an object for its settings gives it empty ones
            del before[left_open], after[left_open]
        self.assertEqual(after, before)
        self.assertSamePoses(self.poses(), poses, 0.0)

    def test_own_keys_stay(self):
        bone = self.rig.pose.bones["Head"]
        bone.keyframe_insert("rotation_quaternion", frame=1)
        self.rig.driver_add("scale", 0).driver.expression = "2.0"
        bpy.context.view_layer.update()
        before = state(self.rig)
        entry = self.look()
        entry.keyframe_insert("weight", frame=1)
        bpy.ops.motus.look_at_remove(object="Rig")
        bpy.context.view_layer.update()
        after = state(self.rig)
        self.assertEqual(after, before)

    def test_keys_of_the_entries_behind_stay_with_them(self):
        bones = {
            "Body": ("", (0, 0, 0), (0, 0, 1)),
            "HeadA": ("Body", (0.2, 0, 1), (0.2, 0, 1.2)),
            "HeadB": ("Body", (-0.2, 0, 1), (-0.2, 0, 1.2)),
        }
        rig = build_rig(bones, "Two")
        for name, weight in (("HeadA", 0.25), ("HeadB", 0.75)):
            entry = self.look("Two", bone=name, weight=weight)
            entry.keyframe_insert("weight", frame=1)
        bpy.ops.motus.look_at_remove(object="Two", bone="HeadA")
        self.go_to(2)
        self.assertEqual([entry.weight for entry in rig.motus.look_at.entries], [0.75])
        self.assertEqual([curve.data_path for curve in self.curves(rig)], ["motus.look_at.entries[0].weight"])

    def test_keys_in_strips_stay_with_their_heads(self):
        bones = {
            "Body": ("", (0, 0, 0), (0, 0, 1)),
            "HeadA": ("Body", (0.2, 0, 1), (0.2, 0, 1.2)),
            "HeadB": ("Body", (-0.2, 0, 1), (-0.2, 0, 1.2)),
        }
        rig = build_rig(bones, "Two")
        for name, weight in (("HeadA", 0.25), ("HeadB", 0.75)):
            self.look("Two", bone=name, weight=weight).keyframe_insert("weight", frame=1)
        animation = rig.animation_data
        strip = animation.nla_tracks.new().strips.new("Strip", 1, animation.action)
        animation.action = None
        bpy.ops.motus.look_at_remove(object="Two", bone="HeadA")
        self.go_to(2)
        self.assertEqual([entry.weight for entry in rig.motus.look_at.entries], [0.75])
        paths = [curve.data_path for curve in support.addon("core.blender.actions").curves_of(strip)]
        self.assertEqual(paths, ["motus.look_at.entries[0].weight"])

    @staticmethod
    def curves(rig):
        return support.addon("core.blender.actions").fcurves(rig)

    def test_baking_and_back(self):
        self.aim(40)
        self.look(eyes_weight=0.5)
        bpy.context.view_layer.update()
        before = self.poses()
        bpy.ops.motus.bake(object="Rig", frame_start=1, frame_end=3)
        self.assertRefused("baked", bpy.ops.motus.look_at_remove, object="Rig")
        self.assertRefused("baked", bpy.ops.motus.look_at_add, object="Rig", bone="Head", weight=0.5)
        self.target.location.x -= 5.0 * FAR
        self.go_to(2)
        self.assertSamePoses(self.poses(), before, 1e-5)
        bpy.ops.motus.unbake(object="Rig")
        self.go_to(3)
        self.assertLess(sum(self.yaw(name) for name in (*BODY, "Head")), 0.0)


class EditedArmature(LookAtTestCase):
    def test_an_inserted_bone(self):
        self.aim(40)
        self.look()
        bpy.context.view_layer.objects.active = self.rig
        bpy.ops.object.mode_set(mode='EDIT')
        bones = self.rig.data.edit_bones
        bones["Head"].head.z += 0.05
        bone = bones.new("Atlas")
        bone.head, bone.tail, bone.parent = bones["Neck"].tail, bones["Head"].head, bones["Neck"]
        bones["Head"].parent = bone
        bpy.ops.object.mode_set(mode='OBJECT')
        bpy.context.view_layer.update()
        bpy.ops.motus.refresh(object="Rig", system="look_at")
        self.aim(-30)
        bpy.context.view_layer.update()
        self.assertLess(self.off("Head"), 2e-3)
        self.assertTrue(self.rig.pose.bones["Atlas"].constraints)
        self.assertFalse(self.rig.pose.bones["Spine"].constraints)

    def test_renamed_bones(self):
        self.aim(40)
        self.look(eyes_weight=1.0, head_weight=0.5)
        bpy.context.view_layer.objects.active = self.rig
        for old, new in (("Head", "Kopf"), ("Eye.L", "Auge.L"), ("Chest", "Brust")):
            bpy.ops.object.mode_set(mode='EDIT')
            self.rig.data.edit_bones[old].name = new
            bpy.ops.object.mode_set(mode='OBJECT')
        bpy.context.view_layer.update()
        (entry,) = self.rig.motus.look_at.entries
        self.assertEqual((entry.name, [eye.name for eye in entry.eyes]), ("Kopf", ["Auge.L", "Eye.R"]))
        self.target.location.x += 0.1 * FAR
        bpy.context.view_layer.update()
        self.assertLess(self.off("Auge.L"), 2e-3)


class Keeping(LookAtTestCase):
    def test_saved_and_opened(self):
        self.aim(30, 10, 2.0)
        self.look(eyes_weight=1.0)
        bpy.context.view_layer.update()
        before = self.poses()
        path = str(self.folder / "looking.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        self.rig, self.target = bpy.data.objects["Rig"], bpy.data.objects["Target"]
        self.assertSamePoses(self.poses(), before, 1e-6)
        self.target.location.x = -1.0
        bpy.context.view_layer.update()
        self.assertLess(self.off("Head"), 2e-3)


class Presets(LookAtTestCase):
    def test_kept_and_taken_up_again(self):
        self.aim(40)
        self.look(body_weight=0.2, clamp=0.7, weight=0.9)
        bpy.context.view_layer.objects.active = self.rig
        take_up = self.keep_preset("look_at")
        entry = self.look(body_weight=0.5, clamp=0.0, weight=0.4)
        take_up()
        self.assertAlmostEqual(entry.body_weight, 0.2)
        self.assertAlmostEqual(entry.clamp, 0.7)
        self.assertAlmostEqual(entry.weight, 0.4, msg="belongs to the shot, not to the preset")


class Manual(LookAtTestCase):
    def test_the_scripted_example_looks_at_the_lantern(self):
        from test_docs import DOCS, examples

        (scripted,) = [code for code in examples(DOCS / "look_at.md") if "bpy.ops.motus" in code]
        seen = []
        scope = {"print": seen.append}
        exec(compile(scripted, "look_at.md", "exec"), scope)
        (off,) = seen
        self.assertLess(off, 2e-3)
        self.assertFalse(scope["puppet"].motus.look_at.is_active)

    def test_the_native_example_runs(self):
        from test_docs import DOCS, examples

        (code,) = [code for code in examples(DOCS / "look_at.md") if "import motus_native" in code]
        sys.modules["motus_native"] = support.addon("core.native").module
        self.addCleanup(sys.modules.pop, "motus_native")
        scope = {}
        exec(compile(code, "look_at.md", "exec"), scope)
        self.assertEqual(scope["turns"].eyes.shape, (1, 4))
