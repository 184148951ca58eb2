"""Copy Settings and Paste Settings, and To All Selected for systems without lists: values and keys that reach different owners."""

import json

import bpy

import support

SHAPE = 'BEZIER', 'LINEAR', 'CONSTANT', 'ELASTIC'


class Copying(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.curve = support.link("Curve", bpy.data.curves.new("Curve", 'CURVE'))
        self.curve.data.dimensions = '3D'
        spline = self.curve.data.splines.new('POLY')
        spline.points.add(1)
        spline.points[1].co = (10.0, 0.0, 0.0, 1.0)
        self.one, self.two, self.three = (self.new_follower(name) for name in ("One", "Two", "Three"))
        self.select(self.one, self.two)

    def new_follower(self, name):
        obj = support.link(name)
        self.select(obj)
        bpy.ops.motus.path_follow_add(curve="Curve")
        return obj

    def new_ball(self, name):
        ball = support.link(name)
        bpy.ops.motus.dynamics_add(object=name)
        return ball.motus.dynamics.entries[0]

    def select(self, *objects):
        for obj in bpy.context.view_layer.objects:
            obj.select_set(obj in objects)
        bpy.context.view_layer.objects.active = objects[0]

    def text(self, system="path", source="One"):
        """What Copy Settings makes, as JSON."""
        bpy.ops.motus.settings_copy(object=source, system=system)
        copying = support.addon("core.interface.any_system.copying")
        return json.loads(copying._WITHOUT_CLIPBOARD.find(""))

    def paste(self, said, target="Two", **keywords):
        bpy.ops.motus.settings_paste(object=target, system="path", text=json.dumps(said), **keywords)

    def test_values(self):
        self.one.motus.path.speed = 7.5
        self.one.motus.path.offset = 1.25
        bpy.ops.motus.settings_copy(object="One", system="path")
        bpy.ops.motus.settings_paste(object="Two", system="path")
        self.assertEqual((self.two.motus.path.speed, self.two.motus.path.offset), (7.5, 0.0))
        bpy.ops.motus.settings_paste(object="Two", system="path", with_shot=True)
        self.assertEqual(self.two.motus.path.offset, 1.25)
        self.assertEqual(self.three.motus.path.offset, 0.0)

    def test_to_all_selected_without_a_list(self):
        self.one.motus.path.speed = 7.5
        bpy.ops.motus.to_selected(system="path")
        self.assertEqual([obj.motus.path.speed for obj in (self.one, self.two)], [7.5, 7.5])
        self.assertNotEqual(self.three.motus.path.speed, 7.5)

    def test_every_system_declares_settings_that_it_has(self):
        declare = support.addon("core.declare")
        copied = support.addon("core.settings.copied")
        for system in declare.systems():
            with self.subTest(system.name):
                names = getattr(system, "copied_settings", ())
                own = copied._item_type(system).bl_rna.properties if names else ()
                self.assertLessEqual(set(names), set(own.keys()) if names else set())
                self.assertLessEqual(set(system.shot_settings), set(names))
                self.assertTrue(names or system.name in {"pull", "pendulum_trail"} or system.name.startswith("toy"))

    def test_keys(self):
        self.one.keyframe_insert("location", frame=3)  # stays
        for frame, value in enumerate((1.0, 4.0, -2.0, 3.0)):
            self.one.motus.path.offset = value
            self.one.motus.path.keyframe_insert("offset", frame=1.0 + 7.5 * frame)
        source = support.addon("core.blender.actions").find(self.one, "motus.path.offset")
        for point, interpolation in zip(source.keyframe_points, SHAPE):
            point.interpolation = interpolation
        source.keyframe_points[0].handle_right_type = 'FREE'
        source.keyframe_points[0].handle_right = (4.0, 9.0)
        source.extrapolation = 'LINEAR'
        cycles = source.modifiers.new('CYCLES')
        cycles.cycles_after = 2
        source.update()
        self.two.motus.path.offset = 5.0
        self.two.motus.path.keyframe_insert("offset", frame=100)
        bpy.ops.motus.settings_copy(object="One", system="path")
        bpy.ops.motus.settings_paste(object="Two", system="path", with_keys=True, with_shot=True)
        made = support.addon("core.blender.actions").find(self.two, "motus.path.offset")
        self.assertEqual([made.evaluate(0.5 * step) for step in range(120)], [source.evaluate(0.5 * step) for step in range(120)])
        self.assertEqual([tuple(point.co) for point in made.keyframe_points], [tuple(point.co) for point in source.keyframe_points])
        self.assertEqual(made.extrapolation, 'LINEAR')
        self.assertIsNot(self.one.animation_data.action, self.two.animation_data.action)
        for frame in (1, 5, 12):
            support.go_to(frame)
            self.assertEqual(support.evaluated(self.two).matrix_world.translation, support.evaluated(self.one).matrix_world.translation)

    def test_keys_stay_unless_asked_for(self):
        self.two.motus.path.keyframe_insert("speed", frame=10)
        bpy.ops.motus.settings_copy(object="One", system="path")
        bpy.ops.motus.settings_paste(object="Two", system="path")
        find = support.addon("core.blender.actions").find
        self.assertIsNotNone(find(self.two, "motus.path.speed"))
        bpy.ops.motus.settings_paste(object="Two", system="path", with_keys=True)
        self.assertIsNone(find(self.two, "motus.path.speed"))

    def test_a_shared_action_stays_as_it_is(self):
        self.one.motus.path.keyframe_insert("speed", frame=10)
        self.two.animation_data_create().action = self.one.animation_data.action
        if hasattr(self.two.animation_data, "action_slot"):
            self.two.animation_data.action_slot = self.one.animation_data.action_slot
        bpy.ops.motus.settings_copy(object="Three", system="path")
        bpy.ops.motus.settings_paste(object="Two", system="path", with_keys=True)
        find = support.addon("core.blender.actions").find
        self.assertIsNotNone(find(self.one, "motus.path.speed"))
        self.assertIsNone(find(self.two, "motus.path.speed"))

    def test_entries(self):
        first, second = self.new_ball("Ball"), self.new_ball("Bell")
        first.frequency = 3.25
        first.keyframe_insert("weight", frame=4)
        bpy.ops.motus.settings_copy(object="Ball", system="dynamics")
        bpy.ops.motus.settings_paste(object="Bell", system="dynamics", with_keys=True)
        second = bpy.data.objects["Bell"].motus.dynamics.entries[0]
        self.assertEqual(second.frequency, 3.25)
        curves = support.addon("core.blender.actions").fcurves(bpy.data.objects["Bell"])
        names = support.addon("core.declare").registered["dynamics"].copied_settings
        self.assertEqual([curve.data_path for curve in curves], ["motus.dynamics.entries[0].weight"] if "weight" in names else [])

    def test_a_text_of_somebody_else(self):
        text = self.text()
        before = {name: getattr(self.two.motus.path, name) for name in ("speed", "timing", "offset")}
        point = {
            "co": [1, 1],
            "handle_left": [0, 1],
            "handle_right": [2, 1],
            "interpolation": 'LINEAR',
            "easing": 'AUTO',
            "type": 'KEYFRAME',
        }
        point |= {"handle_left_type": 'FREE', "handle_right_type": 'FREE', "back": 0.0, "amplitude": 0.0, "period": 0.0}
        curve = {"index": 0, "extrapolation": 'CONSTANT', "points": [point], "modifiers": []}
        for values, keys in (
            ({"speed": "fast"}, {}),
            ({"speed": [1.0]}, {}),
            ({"speed": True}, {}),
            ({"speed": 1e300}, {}),
            ({"speed": None}, {}),
            ({"timing": 'NOTHING'}, {}),
            ({"timing": 3}, {}),
            ({"spline": 1 << 40}, {}),
            ({}, {"speed": 1}),
            ({}, {"speed": [{}]}),
            ({}, {"speed": [curve | {"index": 1}]}),
            ({}, {"speed": [curve, curve]}),
            ({}, {"speed": [curve | {"points": []}]}),
            ({}, {"speed": [curve | {"extrapolation": 'UP'}]}),
            ({}, {"speed": [curve | {"points": [point | {"interpolation": 'NO'}]}]}),
            ({}, {"speed": [curve | {"points": [point | {"co": [1, 1e300]}]}]}),
            ({}, {"speed": [curve | {"modifiers": [{"type": 'PYTHON'}]}]}),
            ({}, {"speed": [curve | {"modifiers": [{"type": []}]}]}),
            ({}, {"speed": [curve | {"modifiers": [{"type": 'CYCLES', "cycles_after": "x"}]}]}),
        ):
            with self.subTest(values=values, keys=keys):
                said = text | {"values": text["values"] | values, "keys": keys}
                self.assertRefusedPaste("does not fit", said)
        self.assertEqual({name: getattr(self.two.motus.path, name) for name in before}, before)
        self.assertIsNone(self.two.animation_data.action if self.two.animation_data else None)

    def assertRefusedPaste(self, part, said, **keywords):
        with self.assertRaisesRegex(RuntimeError, part):
            self.paste(said, with_keys=True, with_shot=True, **keywords)

    def test_numbers_are_limited_and_strange_names_are_left_alone(self):
        text = self.text()
        hub = self.two.motus.path.hub
        self.paste(text | {"values": {"speed": -4e9, "influence": 5.0, "hub": "One", "is_baked": True, "__class__": 1}}, with_shot=True)
        self.assertEqual(self.two.motus.path.influence, 1.0)
        self.assertEqual(self.two.motus.path.hub, hub)
        self.assertFalse(self.two.motus.path.is_baked)

    def test_refusals(self):
        text = self.text()
        self.assertRefusedPaste("There are no copied settings", {"motus": 1})
        self.assertRefusedPaste("newer", text | {"motus": 2})
        self.assertRefusedPaste("settings of Dynamics", text | {"system": "dynamics"})
        self.assertRefusedPaste("settings of nothing", text | {"system": "nothing"})
        support.link("Free")
        self.assertRefusedPaste("Nothing here", text, target="Free")
        for operator in (bpy.ops.motus.settings_copy, bpy.ops.motus.settings_paste):
            with self.assertRaisesRegex(RuntimeError, "no system"):
                operator(object="One", system="hand_over")
        with self.assertRaisesRegex(RuntimeError, "no copied settings"):
            bpy.ops.motus.settings_paste(object="Two", system="path", text="import os")
        self.two.motus.bake.is_baked = True
        self.assertRefusedPaste("is baked", text)

    def test_an_f_curve_that_cannot_be_written(self):
        self.one.motus.path.keyframe_insert("speed", frame=10)
        support.addon("core.blender.actions").find(self.one, "motus.path.speed").modifiers.new('ENVELOPE')
        with self.assertRaisesRegex(RuntimeError, "Speed has no keys, or a modifier"):
            bpy.ops.motus.settings_copy(object="One", system="path")
