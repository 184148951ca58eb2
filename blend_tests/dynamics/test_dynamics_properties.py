"""Single properties that follow their own animation."""

import math
from unittest import mock

import bpy
import numpy as np

import support
from dynamics import dynamics_cases as cases

BOUNCY = 2.0, 0.3, 0.0
ROWS = {1: 0.0, 10: 0.0, 20: 1.0}


def lamp(rows=None):
    """A light whose power and colour are keyed."""
    data = bpy.data.lights.new("Lamp", 'POINT')
    data.color = (1.0, 1.0, 1.0)
    obj = cases.link("Lamp", data)
    cases.key(data, "energy", rows or ROWS)
    return obj


def keyed(id_data, path, index=-1):
    """What the property is by its keys alone at frames."""
    track = support.addon("core.tracks").property_track(id_data, path, index, is_beneath_driver=True)
    return track.values


def value(id_data, frame, path="energy"):
    return id_data.evaluated_get(cases.go_to(frame)).path_resolve(path)


def custom(holder, name):
    """A custom property that is keyed."""
    for frame, number in ROWS.items():
        holder[name] = number
        holder.keyframe_insert(f'["{name}"]', frame=frame)


class DynamicsPropertiesTest(support.SceneTestCase):
    def add(self, obj, path, **keywords):
        bpy.ops.motus.dynamics_add(object=obj.name, data_path=path, **keywords)
        bpy.context.view_layer.update()
        return obj.motus.dynamics.entries[obj.motus.dynamics.active_entry]

    def test_it_is_the_filter_of_its_keys(self):
        obj = lamp()
        self.add(obj, "data.energy", style='BOUNCY')
        self.assertIsNone(cases.problem(obj))
        for frame in cases.FRAMES:
            wanted = cases.filtered(keyed(obj.data, "energy"), BOUNCY, frame)
            self.assertAlmostEqual(value(obj.data, frame), wanted, delta=3e-4)
        first = {frame: value(obj.data, frame) for frame in cases.FRAMES}
        for frame in reversed(cases.FRAMES):
            self.assertEqual(value(obj.data, frame), first[frame])

    def test_arrays_and_numbers_of_them(self):
        obj = lamp()
        cases.key(obj.data, "color", {1: (0.2, 0.2, 0.2), 20: (0.8, 0.5, 0.2)})
        cases.key(obj, "location", cases.STEP)
        self.add(obj, "data.color", style='BOUNCY')
        self.add(obj, "location[2]", style='BOUNCY')
        self.assertEqual([(entry.data_path, entry.index) for entry in obj.motus.dynamics.entries], [("data.color", -1), ("location", 2)])
        for frame in (14, 22, 31.25):
            wanted = [cases.filtered(keyed(obj.data, "color", index), BOUNCY, frame) for index in range(3)]
            np.testing.assert_allclose(value(obj.data, frame, "color"), wanted, atol=3e-4)
            place = cases.place(obj, frame)
            wanted = [float(keyed(obj, "location", axis)([frame])[0]) for axis in range(2)]
            np.testing.assert_allclose(place[:2], wanted, atol=1e-5)
            self.assertAlmostEqual(place[2], cases.filtered(keyed(obj, "location", 2), BOUNCY, frame), delta=3e-4)

    def test_the_object_its_property_and_a_material(self):
        obj = cases.moved("Cube")
        custom(obj, "glow")
        cases.add(obj, style='BOUNCY')
        self.add(obj, '["glow"]', frequency=1.0, damping=0.5, response=0.0)
        self.assertEqual(len(obj.motus.dynamics.entries), 2)
        for frame in (16, 24):
            self.assertAlmostEqual(
                value(obj, frame, '["glow"]'), cases.filtered(keyed(obj, '["glow"]'), (1.0, 0.5, 0.0), frame), delta=3e-4
            )
            wanted = cases.filtered(lambda frames: cases.own(obj)(frames).locations, BOUNCY, frame)
            np.testing.assert_allclose(cases.place(obj, frame), wanted, atol=3e-4)

    def test_modifiers_materials_and_constraints(self):
        obj = cases.link("Cube", bpy.data.meshes.new("Cube"))
        obj.modifiers.new("Displace", 'DISPLACE')
        material = bpy.data.materials.new("Paint")
        if not material.use_nodes:
            material.use_nodes = True
        obj.data.materials.append(material)
        obj.constraints.new('LIMIT_LOCATION')
        socket = material.node_tree.nodes["Principled BSDF"].inputs["Roughness"]
        cases.key(obj.modifiers["Displace"], "strength", ROWS)
        cases.key(socket, "default_value", ROWS)
        cases.key(obj.constraints[0], "influence", ROWS)
        paths = (
            'modifiers["Displace"].strength',
            f"material_slots[0].material.node_tree.{socket.path_from_id()}.default_value",
            'constraints["Limit Location"].influence',
        )
        for path in paths:
            self.add(obj, path, style='BOUNCY')
        self.assertIsNone(cases.problem(obj))
        wanted = cases.filtered(keyed(obj, 'modifiers["Displace"].strength'), BOUNCY, 22)
        self.assertGreater(wanted, 1.01)
        self.assertAlmostEqual(value(obj, 22, paths[0]), wanted, delta=3e-4)
        found = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).material_slots[0].material.node_tree
        self.assertAlmostEqual(found.nodes["Principled BSDF"].inputs["Roughness"].default_value, wanted, delta=3e-4)
        self.assertAlmostEqual(
            value(obj, 14, paths[1]), cases.filtered(keyed(material.node_tree, paths[1].partition("node_tree.")[2]), BOUNCY, 14), delta=3e-4
        )
        self.assertLess(value(obj, 14, paths[2]), 0.3)

    def test_weight_influence_mute_delay_loop_and_teleport(self):
        obj = lamp()
        entry = self.add(obj, "data.energy", style='BOUNCY')
        full = value(obj.data, 22)
        entry.weight = 0.5
        self.assertAlmostEqual(value(obj.data, 22), 0.5 * (full + 1.0), places=5)
        obj.motus.dynamics.influence = 0.5
        self.assertAlmostEqual(value(obj.data, 22), 0.25 * full + 0.75, places=5)
        entry.weight, obj.motus.dynamics.influence, entry.is_muted = 1.0, 1.0, True
        self.assertAlmostEqual(value(obj.data, 22), 1.0, places=6)
        entry.is_muted, entry.delay = False, 0.25
        self.assertAlmostEqual(value(obj.data, 28), full, places=5)
        entry.delay = 0.0
        cases.key(obj.data, "energy", {40: 0.0})
        entry.use_loop, entry.loop_start, entry.loop_end = True, 1, 40
        self.assertAlmostEqual(value(obj.data, 1), value(obj.data, 40), places=4)
        self.assertGreater(abs(value(obj.data, 1)), 1e-3)
        entry.use_loop, entry.jump = False, 0.3
        for curve in support.addon("core.blender.actions").fcurves(obj.data):
            for point in curve.keyframe_points:
                point.interpolation = 'CONSTANT'
        obj.data.update_tag()
        self.assertAlmostEqual(value(obj.data, 21), 1.0, places=5)

    def test_edits_of_keys_and_settings_count_at_once(self):
        obj = lamp()
        entry = self.add(obj, "data.energy", style='BOUNCY')
        before = value(obj.data, 22)
        cases.key(obj.data, "energy", {20: 5.0})
        after = value(obj.data, 22)
        self.assertGreater(abs(after - before), 1.0)
        entry.style = 'CRITICAL'
        bpy.context.view_layer.update()
        self.assertGreater(abs(value(obj.data, 22) - after), 0.1)

    def test_removed_it_leaves_nothing(self):
        obj = lamp()
        before = {frame: value(obj.data, frame) for frame in cases.FRAMES}
        self.add(obj, "data.energy")
        bpy.ops.motus.dynamics_remove(object="Lamp", data_path="data.energy")
        for frame, wanted in before.items():
            self.assertEqual(value(obj.data, frame), wanted)
        self.assertFalse(obj.data.animation_data.drivers)
        self.assertFalse(obj.is_property_set("motus"))
        self.assertEqual([one.name for one in bpy.data.objects], ["Lamp"])
        with self.assertRaisesRegex(RuntimeError, "Nothing here"):
            bpy.ops.motus.dynamics_remove(object="Lamp", data_path="data.energy")

    def test_a_value_without_keys_comes_back(self):
        obj = lamp()
        obj["still"] = 3.0
        self.add(obj, '["still"]')
        self.assertEqual(value(obj, 30, '["still"]'), 3.0)
        bpy.ops.motus.dynamics_remove(object="Lamp")
        self.assertEqual(obj["still"], 3.0)

    def test_bake_and_unbake(self):
        obj = lamp()
        self.add(obj, "data.energy", style='BOUNCY')
        live = {frame: value(obj.data, frame) for frame in (5, 15, 22, 30)}
        bpy.ops.motus.bake(object="Lamp", frame_start=1, frame_end=40)
        for frame, wanted in live.items():
            self.assertAlmostEqual(value(obj.data, frame), wanted, places=5)
        bpy.ops.motus.unbake(object="Lamp")
        for frame, wanted in live.items():
            self.assertAlmostEqual(value(obj.data, frame), wanted, places=6)

    def test_saved_opened_and_copied(self):
        obj = lamp()
        self.add(obj, "data.energy", style='BOUNCY')
        wanted = value(obj.data, 22)
        path = str(self.folder / "property.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        obj = bpy.data.objects["Lamp"]
        self.assertEqual(value(obj.data, 22), wanted)
        copy = obj.copy()
        copy.data = obj.data.copy()
        bpy.context.scene.collection.objects.link(copy)
        bpy.context.view_layer.update()
        cases.go_to(21)
        self.assertEqual(value(copy.data, 22), wanted)

    def test_properties_of_bones_whose_names_change(self):
        rig = cases.rope(1)
        custom(rig.pose.bones["Root"], "curl")
        self.add(rig, 'pose.bones["Root"]["curl"]', style='BOUNCY')
        wanted = value(rig, 22, 'pose.bones["Root"]["curl"]')
        self.assertGreater(wanted, 1.01)
        rig.data.bones["Root"].name = "Base"
        bpy.context.view_layer.update()
        self.assertEqual(rig.motus.dynamics.entries[0].data_path, 'pose.bones["Base"]["curl"]')
        self.assertAlmostEqual(value(rig, 22, 'pose.bones["Base"]["curl"]'), wanted, places=6)

    def test_what_is_refused(self):
        obj = lamp()
        obj["whole"], obj["name"], obj["many"] = 3, "text", [0.5] * 40
        self.add(obj, "data.energy")
        obj.data.driver_add("specular_factor")
        for path, sentence in (
            ("name", "no number"),
            ("data.type", "no decimal"),
            ('["whole"]', "no decimal"),
            ('["name"]', "no number"),
            ("data.gone", "no number"),
            ('["many"]', "first 32"),
            ('["many"][35]', "first 32"),
            ("data.specular_factor", "has a driver"),
            ("motus.dynamics.influence", "themselves"),
            ("data.color[7]", "no number"),
            ("matrix_world", "no number"),
        ):
            with self.subTest(path=path), self.assertRaisesRegex(RuntimeError, sentence):
                self.add(obj, path)
        for keywords in ({"channels": {'SCALE'}}, {"follow": 'WORLD'}, {"whole_chains": True}, {"chain_delay": 0.1}, {"bones": "Bone"}):
            with self.subTest(**keywords), self.assertRaisesRegex(RuntimeError, "single property"):
                self.add(obj, "data.energy", **keywords)
        with self.assertRaisesRegex(RuntimeError, "finite"):
            self.add(obj, "data.energy", frequency=math.nan)
        self.assertEqual(len(obj.motus.dynamics.entries), 1)
        self.assertEqual(self.add(obj, "data.energy", delay=0.5).delay, 0.5)
        self.assertEqual(len(obj.motus.dynamics.entries), 1)

    def test_an_image_that_an_empty_shows(self):
        """Blender animates no images: the menu of a property of one has no entry, and nothing else to say."""
        image = bpy.data.images.new("Card", 4, 4)
        obj = cases.link("Card")
        obj.empty_display_type, obj.data = 'IMAGE', image
        bpy.context.view_layer.objects.active = obj
        menu = support.addon("dynamics.menu")
        with (
            mock.patch.object(menu.hovered, "find", return_value=(image, "generated_color", 0)),
            mock.patch.object(menu, "MOTUS_OT_dynamics_add") as offered,
        ):
            menu._draw(mock.Mock(), bpy.context)
        self.assertFalse(offered.mock_calls)
        with self.assertRaisesRegex(RuntimeError, "can be driven"):
            self.add(obj, "data.generated_color")
        self.assertFalse(obj.is_property_set("motus"))

    def test_linked_data_is_refused(self):
        lamp()
        path = str(self.folder / "library.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        support.empty_scene()
        with bpy.data.libraries.load(path, link=True) as (_, wanted):
            wanted.lights = ["Lamp"]
        obj = cases.link("Mine", bpy.data.lights["Lamp"])
        with self.assertRaisesRegex(RuntimeError, "linked"):
            self.add(obj, "data.energy")
        self.assertFalse(obj.is_property_set("motus"))

    def test_a_property_that_is_gone(self):
        obj = lamp()
        obj["glow"] = 0.0
        obj.keyframe_insert('["glow"]', frame=1)
        self.add(obj, '["glow"]')
        del obj["glow"]
        bpy.context.view_layer.update()
        cases.go_to(5)
        self.assertIn("gone", cases.problem(obj).sentence)
        bpy.ops.motus.dynamics_remove(object="Lamp")
        self.assertFalse(obj.is_property_set("motus"))

    def test_two_properties_that_follow_each_other(self):
        """Each follows its own keys, so that no loop comes about by what reads the other one's."""
        obj = lamp()
        cases.key(obj.data, "specular_factor", {1: 0.0, 20: 0.5})
        self.add(obj, "data.energy", style='BOUNCY')
        bpy.ops.motus.driver_add(collection="lights", datablock=obj.data.name, data_path="specular_factor", function='SECOND_ORDER')
        self.assertTrue(math.isfinite(value(obj.data, 22)) and math.isfinite(value(obj.data, 23, "specular_factor")))

    def test_strips_that_are_mixed_are_named(self):
        obj = lamp()
        action = obj.data.animation_data.action
        obj.data.animation_data.nla_tracks.new().strips.new("Strip", 1, action)
        obj.data.animation_data.nla_tracks[0].is_solo = True
        obj.data.animation_data.action = None
        self.add(obj, "data.energy")
        cases.go_to(5)
        self.assertIn("cannot be recorded", cases.problem(obj).sentence)
        told = support.addon("dynamics.told")
        self.assertIn("Power", told.sentence(obj, cases.problem(obj), bpy.context.scene))
