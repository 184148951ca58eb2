"""What operators report: whole phrases, with numbers that agree with their nouns."""

import support

SCRIPT = """
import bpy, support
support.enable()
support.empty_scene()

def rig(name, bones):
    made = bpy.data.objects.new(name, bpy.data.armatures.new(name))
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    bpy.ops.object.mode_set(mode='EDIT')
    parent = None
    for number, bone in enumerate(bones):
        edited = made.data.edit_bones.new(bone)
        edited.head, edited.tail, edited.parent = (0.1 * (number % 2), 0, number), (0.1 * ((number + 1) % 2), 0, number + 1), parent
        parent = edited
    bpy.ops.object.mode_set(mode='OBJECT')
    return made

rig("Body", ("body_L", "body_L.001", "body_L.002"))
bpy.ops.motus.ik_add(object="Body", bone="body_L.002", make_control_bone=True)
rig("Tail", "abcd")
bpy.ops.motus.dynamics_add(object="Tail", bones="a, b, c, d")
bpy.ops.motus.dynamics_remove(object="Tail")
bpy.ops.motus.dynamics_add(object="Tail", bones="c")
lamp = bpy.data.objects.new("Lamp", None)
bpy.context.scene.collection.objects.link(lamp)
bpy.ops.motus.driver_add(datablock="Lamp", channel='ROTATION_Z', function='PENDULUM')
lamp["glow"] = 1.0
bpy.ops.motus.driver_add(datablock="Lamp", data_path='["glow"]', function='NOISE')
bpy.ops.motus.spider_add(legs=4)
spider = bpy.context.object
bpy.ops.motus.walker_rest(object=spider.name)
course = bpy.data.curves.new("Course", 'CURVE')
course.splines.new('POLY').points.add(1)
glider = bpy.data.objects.new("Glider", None)
for obj in (bpy.data.objects.new("Course", course), glider):
    bpy.context.scene.collection.objects.link(obj)
bpy.ops.motus.path_follow_add(object="Glider", curve="Course")
bpy.ops.motus.bake(object="Glider", frame_start=3, frame_end=3)
bpy.ops.motus.unbake(object="Glider")
bpy.ops.motus.bake(object="Glider", frame_start=3, frame_end=4)
"""
SAID = (
    "IK added: body_L.002 follows bone Target body_L.002",
    "Dynamics added to 4 bones",
    "Dynamics added to c",
    "Rotation Z is now driven by Pendulum",
    "glow is now driven by Noise",
    "Rest positions of 4 feet updated",
    "Baked 1 object, 1 frame: 3-3",
    "Unbaked 1 object",
    "Baked 1 object, 2 frames: 3-4",
)


class Reports(support.SceneTestCase):
    @support.in_one_blender
    def test_what_is_said(self):
        status, output = support.run_beside(SCRIPT)
        self.assertEqual(status, 0, output)
        said = [line.partition(": ")[2] for line in output.splitlines() if line.startswith("Info: ")]
        for sentence in SAID:
            with self.subTest(sentence):
                self.assertIn(sentence, said)
