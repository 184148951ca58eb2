import bpy

import support


class Drivers(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.drivers = support.addon("core.blender.drivers")
        self.mesh = bpy.data.meshes.new("Values")
        self.mesh["values"] = [3.0, 4.0]
        self.obj = bpy.data.objects.new("Cube", bpy.data.meshes.new("Cube"))
        bpy.context.scene.collection.objects.link(self.obj)

    def value(self, index):
        return support.addon("core.declare").Variable('MESH', self.mesh, f'["values"][{index}]')

    def evaluated(self):
        return self.obj.evaluated_get(bpy.context.evaluated_depsgraph_get())

    def test_an_element_of_an_array(self):
        self.drivers.copy_value(self.obj, "location", self.value(1), 2)
        self.assertEqual(tuple(self.evaluated().location), (0.0, 0.0, 4.0))

    def test_the_present_value_is_the_expression_that_is_not_in_use(self):
        self.obj.location.z, self.obj["rest"] = 2.5, 7
        self.drivers.copy_value(self.obj, "location", self.value(1), 2)
        self.drivers.copy_value(self.obj, '["rest"]')
        self.assertEqual([float(curve.driver.expression) for curve in self.obj.animation_data.drivers], [2.5, 7.0])

    def test_a_constraint(self):
        constraint = self.obj.constraints.new('LIMIT_LOCATION')
        constraint.use_min_x = True
        self.drivers.copy_value(constraint, "min_x", self.value(0))
        self.assertEqual(self.evaluated().matrix_world.translation.x, 3.0)

    def test_in_place_of_the_present_driver(self):
        self.drivers.copy_value(self.obj, "location", self.value(0), 0)
        self.drivers.copy_value(self.obj, "location", self.value(1), 1)
        self.drivers.copy_value(self.obj, "location", self.value(1), 0)
        self.assertEqual(len(self.obj.animation_data.drivers), 2)
        self.assertEqual(tuple(self.evaluated().location), (4.0, 4.0, 0.0))

    def test_an_expression_with_a_variable_of_each_kind(self):
        empty = bpy.data.objects.new("Empty", None)
        bpy.context.scene.collection.objects.link(empty)
        empty.location.x = 10.0
        self.obj["half"] = 0.5
        variable = support.addon("core.declare").Variable
        moved = variable('OBJECT', empty)
        variables = {"a": self.value(0), "b": variable('OBJECT', self.obj, '["half"]'), "c": moved}
        self.drivers.add(self.obj, "location", "a + b + c", variables, index=1)
        self.assertEqual(self.evaluated().location.y, 13.5)

    def test_zero_without_a_source(self):
        self.obj["rest"] = 7.0
        self.drivers.copy_value(self.obj, '["rest"]')
        self.assertEqual(self.evaluated()["rest"], 0.0)

    def test_bones_by_name_and_by_number(self):
        armature = bpy.data.armatures.new("Rig")
        rig = self.link("Rig", armature)
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        for number, name in enumerate(('A "quoted" bone', "second", "third", "still")):
            bone = armature.edit_bones.new(name)
            bone.head, bone.tail = (number, 0.0, 0.0), (number, 0.0, 1.0)
        bpy.ops.object.mode_set(mode='OBJECT')
        for bone in rig.pose.bones[:3]:
            bone.driver_add("location", 0)
        curves = rig.animation_data.drivers
        curves[1].data_path, curves[2].data_path = "pose.bones[1].rotation_euler", "pose.bones[77].scale"
        self.assertEqual(self.drivers.driven_bones(rig), {'A "quoted" bone', "second"})

    def test_without_keys_and_with_nothing_left_over(self):
        cameras = len(bpy.data.cameras)
        self.drivers.copy_value(self.obj, "location", self.value(0), 0)
        (curve,) = self.obj.animation_data.drivers
        self.assertEqual((len(curve.keyframe_points), len(curve.modifiers), len(bpy.data.cameras)), (0, 0, cameras))
