"""Panels of bones: the entry of the active bone is shown, and its settings and styles go to all selected bones."""

import bpy

import support

NAMES = "a", "b", "c", "d"
SYSTEMS = {"dynamics": "frequency", "ik": "softness", "look_at": "head_weight"}
"""A number of an entry's settings that *To All Selected* copies, by system."""


class BoneEntries(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.rig = self.new_rig("Rig")
        for name in NAMES[:3]:
            bpy.ops.motus.dynamics_add(object="Rig", bones=name)

    def new_rig(self, name):
        """With bones side by side."""
        rig = bpy.data.objects.new(name, bpy.data.armatures.new(name))
        bpy.context.scene.collection.objects.link(rig)
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        for number, bone in enumerate(NAMES):
            edited = rig.data.edit_bones.new(bone)
            edited.head, edited.tail = (number, 0.0, 0.0), (number, 0.0, 1.0)
        bpy.ops.object.mode_set(mode='OBJECT')
        return rig

    def pose(self, active, *others):
        """Go to Pose Mode, with these bones selected."""
        bpy.ops.object.mode_set(mode='POSE')
        for bone in self.rig.pose.bones:
            (bone if hasattr(bone, "select") else bone.bone).select = bone.name in (active, *others)
        self.rig.data.bones.active = self.rig.data.bones[active]

    def entries(self, name="dynamics"):
        return getattr(self.rig.motus, name).entries

    def test_the_active_bones_entry_is_shown(self):
        settings = self.rig.motus.dynamics
        for name in ("b", "a", "c"):
            self.pose(name)
            self.assertEqual(settings.entries[settings.active_entry].name, name)

    def test_an_entry_that_is_chosen_makes_its_bone_active(self):
        self.pose("a")
        self.rig.motus.dynamics.active_entry = 2
        self.assertEqual(self.rig.data.bones.active.name, "c")

    def test_a_bone_without_an_entry_and_object_mode_show_the_one_chosen_last(self):
        settings = self.rig.motus.dynamics
        settings.active_entry = 1
        self.assertEqual(settings.active_entry, 1)
        self.pose("d")
        self.assertEqual(settings.active_entry, 1)

    def test_to_all_selected(self):
        for system, number in SYSTEMS.items():
            if system != "dynamics":  # a bone is driven by one of them alone
                bpy.ops.object.mode_set(mode='OBJECT')
                self.rig = self.new_rig(system)
                for name in NAMES[:3]:
                    getattr(bpy.ops.motus, f"{system}_add")(object=system, bone=name)
            self.pose("a", "b")
            with self.subTest(system):
                entries = self.entries(system)
                before = getattr(entries["c"], number)
                setattr(entries["a"], number, 0.25)
                self.assertNotAlmostEqual(before, 0.25)
                self.assertEqual(bpy.ops.motus.to_selected(system=system), {'FINISHED'})
                self.assertAlmostEqual(getattr(entries["b"], number), 0.25)
                self.assertAlmostEqual(getattr(entries["c"], number), before)

    def test_by_names(self):
        self.entries()["c"].damping = 0.9
        bpy.ops.motus.to_selected(object="Rig", system="dynamics", bone="c", bones="a")
        self.assertAlmostEqual(self.entries()["a"].damping, 0.9)
        self.assertNotAlmostEqual(self.entries()["b"].damping, 0.9)

    def test_refusals(self):
        for sentence, given in (
            ("no system", {"system": "nothing"}),
            ("no system", {"system": "drivers"}),
            ("Nothing here has Follow Path", {"system": "path"}),
            ("Nothing else", {"system": "dynamics"}),
            ("no bone", {"object": "Rig", "system": "dynamics", "bone": "d", "bones": "a"}),
            ("no object", {"object": "None", "system": "dynamics"}),
        ):
            with self.subTest(sentence, **given), self.assertRaisesRegex(RuntimeError, sentence):
                bpy.ops.motus.to_selected(**given)

    def test_a_style_goes_to_all_selected(self):
        self.pose("b", "c")
        before = self.entries()["a"].style
        bpy.ops.motus.dynamics_preset_use(preset='JELLY')
        self.assertEqual([self.entries()[name].style for name in "abc"], [before, 'JELLY', 'JELLY'])

    def test_objects(self):
        balls = [bpy.data.objects.new(name, None) for name in ("One", "Two", "Three")]
        bpy.ops.object.mode_set(mode='OBJECT')
        for ball in balls:
            bpy.context.scene.collection.objects.link(ball)
            bpy.ops.motus.dynamics_add(object=ball.name)
        bpy.context.view_layer.objects.active = balls[0]
        for obj in bpy.context.scene.objects:
            obj.select_set(obj in balls[:2])
        balls[0].motus.dynamics.entries[0].response = 1.5
        bpy.ops.motus.to_selected(system="dynamics")
        self.assertEqual([ball.motus.dynamics.entries[0].response for ball in balls], [1.5, 1.5, 0.0])
