"""What the tools of inverse kinematics refuse, and that nothing has changed then."""

import math

import bpy

from ik.ik_cases import IkTestCase, counts, state
from ik.matching.ik_match_cases import MatchTestCase

FRAMES = {"frame_start": 1, "frame_end": 3}
HIDDEN = "Rig is not evaluated: show it in the viewport first"


class Unposed(MatchTestCase):
    """The rig stands elsewhere than Blender says, or Blender does not know where it stands."""

    def setUp(self):
        super().setUp()
        self.rigged = self.animated_arm()
        self.reach()
        self.tools = {
            "ik_match_fk": FRAMES,
            "fk_match_ik": {"switch": True, **FRAMES},
            "ik_check": FRAMES,
            "ik_drag": {"bone": "Bone 1", "location": (0.8, 0.2, 1.3)},
            "bake": FRAMES,
        }

    def assertAllRefuse(self, sentence):
        before = state(self.rigged), counts()
        for name, keywords in self.tools.items():
            with self.subTest(name):
                self.assertRefused(sentence, getattr(bpy.ops.motus, name), object="Rig", **keywords)
                self.assertEqual((state(self.rigged), counts()), before)

    def excluded(self):
        """The rig's collection, which is not in the view layer any more."""
        collection = bpy.data.collections.new("Excluded")
        self.scene.collection.children.link(collection)
        collection.objects.link(self.rigged)
        self.scene.collection.objects.unlink(self.rigged)
        bpy.context.view_layer.layer_collection.children["Excluded"].exclude = True
        return collection

    def test_hidden(self):
        self.rigged.hide_viewport = True
        self.assertAllRefuse(HIDDEN)

    def test_in_an_excluded_collection(self):
        self.excluded()
        self.assertAllRefuse(HIDDEN)

    def test_needed_by_something_visible(self):
        """Blender evaluates some of its bones then."""
        self.target(name="Child").constraints.new('COPY_LOCATION').target = self.rigged
        bpy.data.objects["Child"].constraints[0].subtarget = "Shoulder"
        self.excluded()
        bpy.context.view_layer.update()
        self.assertTrue(self.rigged.evaluated_get(bpy.context.view_layer.depsgraph).is_evaluated)
        self.assertAllRefuse(HIDDEN)

    def test_in_another_scene(self):
        self.addCleanup(setattr, bpy.context.window, "scene", self.scene)
        bpy.context.window.scene = bpy.data.scenes.new("Other")
        del self.tools["bake"]  # which has a sentence of its own
        self.assertAllRefuse(HIDDEN)

    def test_in_rest_position(self):
        self.rigged.data.pose_position = 'REST'
        self.assertAllRefuse("Rig is in Rest Position: switch to Pose Position first")

    def test_hidden_by_the_eye_alone(self):
        """Blender evaluates it as ever."""
        self.rigged.hide_set(True)
        for name, keywords in self.tools.items():
            self.assertEqual(getattr(bpy.ops.motus, name)(object="Rig", **keywords), {'FINISHED'})

    def test_a_target_in_rest_position(self):
        other = self.arm(name="Other")
        self.reach(target="Other", target_bone="Shoulder")
        other.data.pose_position = 'REST'
        self.assertRefused("Other is in Rest Position", bpy.ops.motus.ik_match_fk, object="Rig", **FRAMES)


class Keywords(IkTestCase):
    def test_a_step_that_is_no_number(self):
        rig = self.arm()
        self.reach()
        before = state(rig), counts()
        for name in ("ik_check", "ik_match_fk", "fk_match_ik", "bake"):
            with self.subTest(name):
                operator = getattr(bpy.ops.motus, name)
                for step in (math.nan, math.inf):
                    self.assertRefused("step is not a finite number", operator, object="Rig", step=step, **FRAMES)
        self.assertEqual((state(rig), counts()), before)

    def test_no_such_object(self):
        self.arm()
        motus = bpy.ops.motus
        for operator in (
            motus.ik_add,
            motus.ik_remove,
            motus.refresh,
            motus.ik_target_add,
            motus.ik_target_remove,
            motus.ik_match_fk,
            motus.fk_match_ik,
            motus.ik_check,
            motus.ik_drag,
            motus.ik_switch_target,
            motus.look_at_add,
            motus.look_at_remove,
            motus.look_at_eye_add,
            motus.look_at_eye_remove,
        ):
            with self.subTest(operator):
                self.assertRefused("There is no object Nope", operator, object="Nope")
