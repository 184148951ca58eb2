"""Adding walkers and taking them back: no trace, copies, names, files, baking, presets, and what is refused."""

from unittest import mock

import bpy
import numpy as np

import support
from core.test_habits import Layout
from look_at.test_look_at_setup import state
from walker import walker_cases as cases


class Add(cases.WalkerTestCase):
    def test_keywords_become_settings(self):
        given = {
            "gait": 'WAVE',
            "use_duty": True,
            "duty": 0.75,
            "stride": 0.25,
            "cadence": 2.0,
            "use_natural": True,
            "hip_height": 0.5,
            "transition": 2.0,
            "clearance": 0.125,
            "minimum_step": 0.0625,
            "reach_up": 0.375,
            "reach_down": 0.625,
            "use_plane": True,
            "plane_height": -1.0,
            "body_height": 0.5,
            "body_tilt": 0.25,
            "frequency": 3.0,
            "damping": 0.5,
            "ankle": 0.125,
            "use_soles": True,
            "heel": 0.0625,
            "toe": 0.25,
            "strike": 0.5,
            "push": 0.75,
            "jump": 2.5,
            "forward_axis": 'NEG_Y',
            "up_axis": 'POS_Z',
            "influence": 0.75,
        }
        self.assertEqual(set(given), set(support.addon("walker.properties").KEYWORDS))
        spider = cases.spider(ahead=0.0, **given)
        self.assertEqual({name: getattr(spider.motus.walker, name) for name in given}, given)

    def test_an_armature_by_its_chains(self):
        spider = cases.spider(ahead=0.0)
        rests = [tuple(leg.rest) for leg in spider.motus.walker.legs]
        bpy.ops.motus.walker_remove(object=spider.name)
        self.assertEqual(bpy.ops.motus.walker_add(object=spider.name), {'FINISHED'})
        settings = spider.motus.walker
        self.assertEqual(len(settings.legs), 8)
        self.assertEqual(settings.body_bone, "body")
        np.testing.assert_allclose([tuple(leg.rest) for leg in settings.legs], rests, atol=1e-6)
        for leg in settings.legs:
            upper = spider.data.bones[leg.name.replace("foot", "upper")]
            self.assertAlmostEqual(leg.length, upper.length + upper.children[0].length, places=5)
            np.testing.assert_allclose(leg.hip, upper.head_local, atol=1e-6)

    def reaching(self, name):
        """A spider that does not walk, and the object of this name that its first leg reaches for."""
        spider = cases.spider(ahead=0.0)
        bpy.ops.motus.walker_remove(object=spider.name)
        foot = support.link(name, location=spider.data.bones["foot 1.L"].head_local)
        entry = spider.motus.ik.entries["lower 1.L"]
        entry.target, entry.target_bone = foot, ""
        return spider, foot

    def test_chains_that_reach_for_objects(self):
        spider, foot = self.reaching("Foot")
        bpy.ops.motus.walker_add(object=spider.name)
        legs = {leg.foot: leg.name for leg in spider.motus.walker.legs}
        self.assertIn(foot, legs)
        support.key_places(spider, {1: (0.0, 0.0, 0.0), 60: (0.0, 2.0, 0.0)})
        support.go_to(60)
        support.go_to(110)
        self.assertGreater(support.evaluated(foot).matrix_world.translation.y, 1.5)

    def test_named_bones(self):
        spider = cases.spider(ahead=0.0)
        bpy.ops.motus.walker_remove(object=spider.name)
        bpy.ops.motus.walker_add(object=spider.name, feet="foot 1.L, foot 1.R, foot 4.L, foot 4.R", body="abdomen", gait='PACE')
        settings = spider.motus.walker
        self.assertEqual([leg.name for leg in settings.legs], ["foot 1.L", "foot 1.R", "foot 4.L", "foot 4.R"])
        self.assertEqual(settings.body_bone, "abdomen")
        self.assertGreater(settings.legs[0].length, 0.5)
        self.assertWell(spider)

    def test_selected_objects_are_the_feet(self):
        body, _, feet = cases.cross()
        cases.select(body, feet)
        self.assertEqual(bpy.ops.motus.walker_add(), {'FINISHED'})
        self.assertEqual([leg.foot for leg in body.motus.walker.legs], feet)
        np.testing.assert_allclose([tuple(leg.rest) for leg in body.motus.walker.legs], [tuple(foot.location) for foot in feet], atol=1e-6)

    def test_selected_children_are_the_feet(self):
        """But where others are selected too: then a child is the body that leans."""
        body, shell, feet = cases.cross()
        for chosen in ((shell, *feet), feet):
            for foot in feet:
                foot.parent = body if shell not in chosen else None
            cases.select(body, chosen)
            self.assertEqual(bpy.ops.motus.walker_add(), {'FINISHED'})
            self.assertEqual([leg.foot for leg in body.motus.walker.legs], feet)
            self.assertWell(body)
            bpy.ops.motus.walker_remove(object=body.name)

    def test_a_bone_and_an_object_of_one_name(self):
        spider, _ = self.reaching("foot 1.R")
        self.assertEqual(bpy.ops.motus.walker_add(object=spider.name), {'FINISHED'})
        self.assertEqual(len(spider.motus.walker.legs), 8)
        entry = spider.motus.ik.entries["lower 2.L"]
        entry.target_bone = "foot 2.R"
        bpy.ops.motus.walker_remove(object=spider.name)
        self.assertRefused("foot 2.R would be the foot of two legs", bpy.ops.motus.walker_add, object=spider.name)

    def test_again_changes_what_is_given(self):
        spider = cases.spider(stride=0.3)
        rests = [tuple(leg.rest) for leg in spider.motus.walker.legs]
        support.go_to(50)
        bpy.ops.motus.walker_add(object=spider.name, gait='TRIPOD')
        settings = spider.motus.walker
        self.assertEqual((settings.gait, round(settings.stride, 6)), ('TRIPOD', 0.3))
        np.testing.assert_allclose([tuple(leg.rest) for leg in settings.legs], rests, atol=1e-6)

    def test_again_with_other_feet_leaves_the_body(self):
        body, shell, feet = cases.cross()
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), body=shell.name)
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet[:3]))
        self.assertEqual(body.motus.walker.body, shell)
        self.assertTrue(shell.constraints)
        self.assertFalse(feet[3].constraints or feet[3].is_property_set("motus"))
        spider = cases.spider(ahead=0.0)
        bpy.ops.motus.walker_add(object=spider.name, body="abdomen")
        bpy.ops.motus.walker_add(object=spider.name, feet="foot 1.L,foot 1.R,foot 4.L,foot 4.R")
        self.assertEqual(spider.motus.walker.body_bone, "abdomen")

    def test_again_with_other_feet_selected(self):
        body, shell, feet = cases.cross()
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet[:3]), body=shell.name, gait='OWN')
        body.motus.walker.legs[1].phase = 0.25
        add = bpy.ops.motus.walker_add
        for chosen, wanted in (((shell,), feet[:3]), (feet, feet), (feet[1:], feet[1:])):
            cases.select(body, chosen)
            self.assertEqual(add(object=body.name), {'FINISHED'})  # a script says what it means
            before = [leg.foot for leg in body.motus.walker.legs]
            self.assertEqual(add(), {'FINISHED'})
            self.assertEqual([leg.foot for leg in body.motus.walker.legs], wanted)
            self.assertEqual({leg.foot: leg.phase for leg in body.motus.walker.legs}[feet[1]], 0.25)
            self.assertEqual(body.motus.walker.body, shell)
            self.assertWell(body)
        self.assertEqual(before, feet)
        self.assertFalse(feet[0].constraints or feet[0].is_property_set("motus"))

    def test_again_when_a_foot_is_gone(self):
        body, _, feet = cases.cross()
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet))
        bpy.data.objects.remove(feet[1])
        bpy.context.view_layer.update()
        bpy.ops.motus.walker_add(object=body.name)
        self.assertEqual([leg.foot for leg in body.motus.walker.legs], [feet[0], *feet[2:]])
        self.assertWell(body)
        spider = cases.spider(ahead=0.0)
        length = spider.motus.walker.legs[2].length
        spider.motus.walker.legs[3].name = "nothing"
        self.assertIn("add the walker again", self.sentence(spider))
        bpy.ops.motus.walker_add(object=spider.name)
        self.assertEqual(len(spider.motus.walker.legs), 7)
        self.assertAlmostEqual(spider.motus.walker.legs[2].length, length)
        self.assertWell(spider)

    def test_refusals(self):
        add = bpy.ops.motus.walker_add
        self.assertRefused("no object Nobody", add, object="Nobody")
        body, shell, feet = cases.cross()
        for obj in self.scene.objects:
            obj.select_set(False)
        self.assertRefused("Name the objects that are the feet", add, object=body.name)
        self.assertRefused("its own foot", add, object=body.name, feet=body.name)
        self.assertRefused("Foot 0 would be the foot of two legs", add, object=body.name, feet=f"{feet[0].name},{feet[0].name}")
        self.assertRefused("no child of Body", add, object=body.name, feet=cases.names(feet), body=feet[0].name)
        self.assertRefused("no mesh", add, object=body.name, feet=cases.names(feet), ground=shell.name)
        self.assertRefused("no collection Nowhere", add, object=body.name, feet=cases.names(feet), grounds="Nowhere")
        self.assertRefused("finite", add, object=body.name, feet=cases.names(feet), stride=float("inf"))
        self.assertRefused("Nothing here walks", bpy.ops.motus.walker_remove, object=body.name)
        self.assertFalse(any(obj.constraints for obj in feet))
        spider = cases.spider(ahead=0.0)
        self.assertRefused("walks itself", add, object=body.name, feet=cases.names(feet), ground=f"{spider.name} Mesh")
        self.assertRefused("no bone Tail", add, object=spider.name, feet="Tail")
        bare = support.link("Bare", bpy.data.armatures.new("Bare"))
        self.assertRefused("no chain of Inverse Kinematics", add, object=bare.name)
        other, _, _ = cases.cross("Other")
        add(object=body.name, feet=cases.names(feet))
        self.assertRefused("part of Body, which walks already", add, object=other.name, feet=feet[0].name)
        self.assertRefused("part of Body, which walks already", add, object=feet[0].name, feet=other.name)

    def test_what_walks_is_no_part_of_others(self):
        body, _, feet = cases.cross()
        other, shell, others = cases.cross("Other")
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet))
        body.parent = other
        refused = "Body walks itself, and can be no part of Other"
        self.assertRefused(refused, bpy.ops.motus.walker_add, object=other.name, feet=cases.names([body, *others]))
        self.assertRefused(refused, bpy.ops.motus.walker_add, object=other.name, feet=cases.names(others), body=body.name)
        self.assertFalse(other.is_property_set("motus"))
        # A file in which it is so already.
        bpy.ops.motus.walker_add(object=other.name, feet=cases.names(others), body=shell.name)
        other.motus.walker.legs[0].foot = body
        bpy.ops.motus.walker_remove(object=other.name)
        self.assertEqual([leg.foot for leg in body.motus.walker.legs], feet)
        bpy.ops.motus.walker_remove(object=body.name)
        for obj in (body, other, shell, *feet, *others):
            self.assertFalse(obj.constraints or obj.is_property_set("motus"), obj.name)

    def test_a_foot_is_no_body(self):
        body, shell, feet = cases.cross()
        feet[0].parent = body
        refused = "cannot be the body, and a foot too"
        self.assertRefused(refused, bpy.ops.motus.walker_add, object=body.name, feet=cases.names(feet), body=feet[0].name)
        self.assertFalse(body.is_property_set("motus"))
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), body=shell.name)
        self.assertRefused(refused, bpy.ops.motus.walker_add, object=body.name, body=feet[0].name)
        self.assertEqual(body.motus.walker.body, shell)
        body.motus.walker.body = feet[0]
        self.assertEqual([len(foot.constraints) for foot in feet], 4 * [len(feet[1].constraints)])
        self.assertIn("left alone", self.sentence(body))
        spider = cases.spider(ahead=0.0)
        self.assertRefused(refused, bpy.ops.motus.walker_add, object=spider.name, body="foot 1.L")
        bpy.ops.motus.walker_remove(object=spider.name)
        self.assertRefused(refused, bpy.ops.motus.walker_add, object=spider.name, body="foot 1.L")
        self.assertFalse(spider.motus.walker.is_active)

    def test_axes_along_each_other(self):
        spider = cases.spider(ahead=0.0, forward_axis='POS_Z')
        self.assertIn("must be perpendicular", self.sentence(spider))


class Remove(cases.WalkerTestCase):
    def test_no_trace_on_a_rig(self):
        spider = cases.spider(ahead=0.0)
        bpy.ops.motus.walker_remove(object=spider.name)
        bpy.context.view_layer.update()
        before = state(spider)
        bpy.ops.motus.walker_add(object=spider.name, body_tilt=0.25)
        spider.motus.walker.keyframe_insert("influence", frame=3)
        bpy.ops.motus.walker_remove(object=spider.name)
        bpy.context.view_layer.update()
        self.assertEqual(state(spider), before)

    def test_no_trace_on_objects(self):
        body, shell, feet = cases.cross()
        seen = {obj: (obj.matrix_world.copy(), obj.is_property_set("motus"), sorted(obj.keys())) for obj in (body, shell, *feet)}
        counts = len(bpy.data.objects), len(bpy.data.meshes)
        land = cases.grid("Land", cases.waves)
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), body=shell.name, ground=land.name)
        support.go_to(5)
        bpy.ops.motus.walker_remove(object=feet[0].name)
        bpy.context.view_layer.update()
        for obj, wanted in seen.items():
            self.assertEqual((obj.matrix_world, obj.is_property_set("motus"), sorted(obj.keys())), wanted, obj.name)
            self.assertFalse(obj.constraints)
        bpy.data.objects.remove(land)
        self.assertEqual((len(bpy.data.objects), len([mesh for mesh in bpy.data.meshes if mesh.users])), counts)

    def test_no_trace_on_a_body_that_was_exchanged_or_unparented(self):
        for is_exchanged in (True, False):
            with self.subTest(is_exchanged=is_exchanged):
                support.empty_scene()
                body, shell, feet = cases.cross()
                other = support.link("Other Shell", parent=body)
                bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), body=shell.name)
                if is_exchanged:
                    body.motus.walker.body = other
                else:
                    shell.parent = None
                for _ in range(2):
                    bpy.context.view_layer.update()
                bpy.ops.motus.walker_remove(object=body.name)
                for obj in (body, shell, other, *feet):
                    self.assertFalse(obj.constraints or obj.is_property_set("motus"), obj.name)

    def test_others_keep_their_settings(self):
        body, _, feet = cases.cross()
        other = support.link("Other")
        other.motus.walker.gait = 'WAVE'
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet))
        bpy.ops.motus.walker_remove(object=body.name)
        self.assertEqual(other.motus.walker.gait, 'WAVE')

    def test_what_is_taken_amiss_leaves_the_walk_on(self):
        body, _, feet = cases.cross()
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet))
        setup = support.addon("walker.setup")
        with mock.patch.object(setup.Leg, "matrix", side_effect=ReferenceError), self.assertRaises(ReferenceError):
            setup.take_rests(bpy.context, body)
        self.assertFalse(any(constraint.mute for foot in feet for constraint in foot.constraints))


class Edits(cases.WalkerTestCase):
    def test_rest_places_are_taken(self):
        body, _, feet = cases.cross()
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), use_plane=True)
        feet[0].location = (0.7, 0.9, 0.1)
        bpy.context.view_layer.update()
        self.assertEqual(bpy.ops.motus.walker_rest(object=body.name), {'FINISHED'})
        np.testing.assert_allclose(body.motus.walker.legs[0].rest, (0.7, 0.9, 0.1), atol=1e-6)
        bpy.context.view_layer.update()
        np.testing.assert_allclose(cases.places(body)[0], (0.7, 0.9, 0.0), atol=1e-5)

    def test_renamed_bones(self):
        spider = cases.spider()
        spider.data.bones["foot 2.L"].name = "toe"
        spider.data.bones["body"].name = "trunk"
        bpy.context.view_layer.update()
        bpy.context.view_layer.update()
        settings = spider.motus.walker
        self.assertIn("toe", [leg.name for leg in settings.legs])
        self.assertEqual(settings.body_bone, "trunk")
        self.assertWell(spider)

    def test_a_copy_walks_by_itself(self):
        spider = cases.spider()
        other = spider.copy()
        other.animation_data_clear()
        self.scene.collection.objects.link(other)
        for _ in range(3):
            bpy.context.view_layer.update()
        other.location = (5.0, 0.0, 0.0)
        bpy.context.view_layer.update()
        support.go_to(60)
        np.testing.assert_allclose(cases.places(other), cases.rests(other), atol=1e-5)
        self.assertGreater(cases.places(spider)[:, 1].mean(), 0.5)
        self.assertWell(spider)

    def test_the_copy_of_a_body_leaves_feet_to_the_first(self):
        body, shell, feet = cases.cross()
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), body=shell.name)
        other = body.copy()
        other.location.x = 9.0
        self.scene.collection.objects.link(other)
        for _ in range(3):
            bpy.context.view_layer.update()
        self.assertLess(np.abs(cases.places(body)).max(), 2.0)
        self.assertIn("no foot any more", self.sentence(other))

    def test_appended_and_linked(self):
        spider = cases.spider()
        support.go_to(50)
        wanted = cases.places(spider)
        path = self.save()
        for link in (False, True):
            with self.subTest(link=link):
                found = self.load(path, link, "Spider")
                bpy.context.view_layer.update()
                support.go_to(50)
                np.testing.assert_allclose(cases.places(found), wanted, atol=1e-5)

    def test_an_override_walks(self):
        cases.spider()
        path = self.save()
        linked = self.load(path, True, "Spider")
        local = linked.override_create(remap_local_usages=True)
        bpy.context.view_layer.update()
        local.motus.walker.gait = 'WAVE'
        for _ in range(2):
            bpy.context.view_layer.update()
        support.go_to(50)
        walker = cases.plan_of(local).walker
        np.testing.assert_allclose(cases.places(local), walker.feet(cases.seconds(50)), atol=1e-5)

    def test_baked_and_unbaked(self):
        spider = cases.spider()
        wanted = cases.over((20, 50, 80), lambda: cases.tips(spider))
        bpy.context.view_layer.objects.active = spider
        spider.select_set(True)
        self.assertEqual(bpy.ops.motus.bake(frame_start=1, frame_end=120), {'FINISHED'})
        self.assertTrue(spider.motus.walker.is_baked)
        np.testing.assert_allclose(cases.over((20, 50, 80), lambda: cases.tips(spider)), wanted, atol=1e-4)
        self.assertEqual(bpy.ops.motus.unbake(), {'FINISHED'})
        np.testing.assert_allclose(cases.over((20, 50, 80), lambda: cases.tips(spider)), wanted, atol=1e-5)

    def test_presets(self):
        spider = cases.spider(ahead=0.0)
        for preset in support.addon("walker.presets").BROUGHT:
            with self.subTest(preset.identifier):
                self.assertEqual(bpy.ops.motus.walker_preset_use(preset=preset.identifier), {'FINISHED'})
                for name, value in preset.values.items():
                    found = getattr(spider.motus.walker, name)
                    self.assertTrue(found == value or abs(found - value) < 1e-6, name)
                self.assertWell(spider)


class Panel(cases.WalkerTestCase):
    def labels(self, owner):
        """What the panel's main part says."""
        bpy.context.view_layer.objects.active = owner
        bpy.context.view_layer.update()
        layout = Layout()
        support.addon("walker.panel").draw_main(layout, bpy.context)
        return " ".join(layout.named("label"))

    def test_how_the_motion_is_known(self):
        still, moving = cases.spider(ahead=0.0), cases.spider()
        unknown = cases.spider(ahead=0.0)
        unknown.constraints.new('COPY_LOCATION').target = still
        self.assertNotIn("Exact", self.labels(still))
        self.assertIn("Exact at any frame", self.labels(moving))
        self.assertIn("Needs recording", self.labels(unknown))

    def test_keys_are_not_gone_through_at_each_redraw(self):
        spider = cases.spider()
        self.labels(spider)
        keys = support.addon("core.animation.keys")
        with mock.patch.object(keys, "extent", wraps=keys.extent) as asked:
            self.assertIn("Exact at any frame", self.labels(spider))
        self.assertEqual(asked.call_count, 0)
