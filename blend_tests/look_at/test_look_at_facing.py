"""Where rigs of different makers face: found from their skeletons, turned by a click, and the targets that come and go with that."""

import itertools
import json
import math

import bpy
from mathutils import Matrix, Vector

import rig_samples
import support
from look_at.look_at_cases import LookAtTestCase, build_rig, direction

AXES = {
    f"{sign}_{letter}": Vector([(1.0 if sign == "POS" else -1.0) * (letter == axis) for axis in "XYZ"])
    for sign in ("POS", "NEG")
    for letter in "XYZ"
}
HIT = 5e-3  # degrees
SPINE = {
    "Hips": ("", (0, 0, 1.0), (0, 0, 1.1)),
    "Chest": ("Hips", (0, 0, 1.1), (0, 0, 1.5)),
    "Neck": ("Chest", (0, 0, 1.5), (0, 0, 1.6)),
    "Head": ("Neck", (0, 0, 1.6), (0, 0, 1.8)),
}
LEGS = {
    f"{side}{name}": ((parent and side + parent) or "Hips", (x, *head), (x, *tail))
    for side, x in (("Left", 0.1), ("Right", -0.1))
    for name, parent, head, tail in (("UpLeg", "", (0.0, 1.0), (0.0, 0.5)), ("Leg", "UpLeg", (0.0, 0.5), (0.02, 0.08)))
}
FEET = {f"{side}Foot": (f"{side}Leg", (x, 0.02, 0.08), (x, -0.1, 0.02)) for side, x in (("Left", 0.1), ("Right", -0.1))}
EYES = {f"{side}Eye": ("Head", (x, -0.08, 1.7), (x, -0.12, 1.7)) for side, x in (("Left", 0.03), ("Right", -0.03))}
NOSE = {"Nose": ("Head", (0, -0.06, 1.66), (0, -0.13, 1.66))}
SHOWING = {"eyes": EYES | LEGS | FEET, "nose": NOSE | LEGS | FEET, "feet": LEGS | FEET, "sides": LEGS, "eyes without legs": EYES}


def turns():
    """The 24 turns that carry axes to axes."""
    for forward, up in itertools.permutations(AXES, 2):
        if forward[-1] != up[-1]:
            y, z = -AXES[forward], AXES[up]
            yield forward, up, Matrix((y.cross(z), y, z)).transposed()


def carried(bones, turn, scale=1.0):
    return {name: (parent, *(scale * (turn @ Vector(place)) for place in places)) for name, (parent, *places) in bones.items()}


class Facing(LookAtTestCase):
    def added(self, rig, **keywords):
        self.assertEqual(bpy.ops.motus.look_at_add(object=rig.name, **keywords), {'FINISHED'})
        bpy.context.view_layer.update()
        return rig.motus.look_at.entries[0]

    def assertMeets(self, rig, entry, forward, off=0.0):
        """The head, as it looks along this axis of the rig at rest, meets the target."""
        pose = self.pose(entry.name, rig)
        gaze = pose.to_3x3() @ rig.data.bones[entry.name].matrix_local.to_3x3().inverted() @ AXES[forward]
        self.assertAlmostEqual(math.degrees(gaze.angle(entry.target.matrix_world.translation - pose.translation)), off, delta=HIT)

    def test_every_turn_of_a_skeleton_that_stands_upright(self):
        """The object turns the skeleton back, as an importer does, so that in the world nothing differs from the figure with Z up."""
        for shown, more in SHOWING.items():
            for forward, up, turn in turns():
                with self.subTest(shown, forward=forward, up=up):
                    rig = build_rig(carried(SPINE | more, turn, 100.0))
                    rig.matrix_world = turn.inverted().to_4x4() @ Matrix.Scale(0.01, 4)
                    before = self.poses(rig)
                    entry = self.added(rig)
                    self.assertEqual((entry.forward, entry.up), (forward, up))
                    place = entry.target.matrix_world.translation
                    self.assertLess((place - Vector((0.0, -1.2, 1.6))).length, 1e-4, "six lengths of the head, in front of it")
                    self.assertSamePoses(self.poses(rig), before, 1e-3)  # of 160
                    entry.body_weight = entry.clamp = 0.0
                    entry.target.location = Vector((0.0, 0.0, 1.6)) + 3.0 * direction(40.0, 20.0)
                    bpy.context.view_layer.update()
                    self.assertMeets(rig, entry, forward)
                    self.assertAlmostEqual(math.degrees(self.told("yaw", rig=rig)), 40.0, delta=0.01)
                    self.assertAlmostEqual(math.degrees(self.told("pitch", rig=rig)), 20.0, delta=0.01)
                    support.empty_scene()

    def test_feet_show_up_however_the_object_is_turned(self):
        for forward, up, turn in turns():
            with self.subTest(forward=forward, up=up):
                rig = build_rig(carried(SPINE | LEGS | FEET, turn))
                rig.rotation_euler = (0.7, -2.0, 1.1)
                entry = self.added(rig)
                self.assertEqual((entry.forward, entry.up), (forward, up))
                bpy.data.objects.remove(rig)

    def test_a_skeleton_that_shows_nothing_follows_the_convention(self):
        """-Y with Z up, however it is turned; Z with Y up, as in files of other programs, whose object turns it."""
        rig = build_rig(SPINE)
        for turn, forward, up in (((0, 0, 0), 'NEG_Y', 'POS_Z'), ((1.2, 0.4, 2.0), 'NEG_Y', 'POS_Z')):
            rig.rotation_euler = turn
            entry = self.added(rig)
            self.assertEqual((entry.forward, entry.up), (forward, up))
            bpy.ops.motus.look_at_remove(object=rig.name)
        other = build_rig(carried(SPINE, Matrix(((1, 0, 0), (0, 0, 1), (0, -1, 0)))))
        other.rotation_euler.x = math.radians(90.0)
        entry = self.added(other)
        self.assertEqual((entry.forward, entry.up), ('POS_Z', 'POS_Y'))

    def test_other_systems_say_what_the_skeleton_does_not(self):
        rig = build_rig(SPINE)
        curve = bpy.data.objects.new("Way", bpy.data.curves.new("Way", 'CURVE'))
        self.scene.collection.objects.link(curve)
        spline = curve.data.splines.new('POLY')
        spline.points.add(1)
        spline.points[1].co = (0.0, 5.0, 0.0, 1.0)
        bpy.ops.motus.path_follow_add(object=rig.name, curve="Way", forward_axis='POS_X')
        entry = self.added(rig)
        self.assertEqual((entry.forward, entry.up), ('POS_X', 'POS_Z'))
        bpy.ops.motus.look_at_remove(object=rig.name)
        seeing = build_rig(SPINE | EYES)
        bpy.ops.motus.path_follow_add(object=seeing.name, curve="Way", forward_axis='POS_X')
        self.assertEqual(self.added(seeing).forward, 'NEG_Y', "eyes show it better")

    def test_given_axes_count(self):
        rig = build_rig(SPINE | EYES)
        entry = self.added(rig, forward='POS_X')
        self.assertEqual((entry.forward, entry.up), ('POS_X', 'POS_Z'))
        self.added(rig, up='NEG_Z')
        self.assertEqual((entry.forward, entry.up), ('POS_X', 'NEG_Z'))
        self.added(rig, weight=0.5)
        self.assertEqual((entry.forward, entry.up), ('POS_X', 'NEG_Z'), "not given, not found anew")

    def test_legs_are_no_spine_of_a_rig_with_y_up(self):
        rig = build_rig(carried(SPINE | LEGS | FEET, Matrix(((1, 0, 0), (0, 0, 1), (0, -1, 0)))))
        self.assertEqual(self.added(rig).body_length, 2, "the hips, which legs hang from, stay")

    def test_bones_that_others_turn_are_left_out_of_the_spine(self):
        rig = build_rig(SPINE | LEGS | FEET)
        rig.pose.bones["Chest"].constraints.new('COPY_ROTATION').target = self.target
        self.assertEqual(self.added(rig).body_length, 1)


class Turning(LookAtTestCase):
    def setUp(self):
        super().setUp()
        self.plain = build_rig(SPINE)
        bpy.ops.motus.look_at_add(object=self.plain.name)
        (self.entry,) = self.plain.motus.look_at.entries
        bpy.context.view_layer.update()
        self.before = self.poses(self.plain)

    def turn(self):
        self.assertEqual(bpy.ops.motus.look_at_turn(object=self.plain.name), {'FINISHED'})
        bpy.context.view_layer.update()

    def test_four_clicks_go_round_with_the_new_target(self):
        for forward in ('POS_X', 'POS_Y', 'NEG_X', 'NEG_Y'):
            self.turn()
            self.assertEqual(self.entry.forward, forward)
            wanted = Vector((0.0, 0.0, 1.6)) + 1.2 * AXES[forward]
            self.assertLess((self.entry.target.matrix_world.translation - wanted).length, 1e-5)
            self.assertSamePoses(self.poses(self.plain), self.before, 2e-6)

    def test_a_target_that_was_moved_stays(self):
        self.entry.body_weight = self.entry.clamp = 0.0
        self.entry.target.location = (1.0, 1.0, 1.6)
        bpy.context.view_layer.update()
        self.turn()
        self.assertEqual(tuple(self.entry.target.location), (1.0, 1.0, 1.6000000238418579))
        head = self.pose("Head", self.plain)
        gaze = head.to_3x3() @ self.plain.data.bones["Head"].matrix_local.to_3x3().inverted() @ Vector((1.0, 0.0, 0.0))
        self.assertLess(math.degrees(gaze.angle(self.entry.target.location - head.translation)), HIT)

    def test_about_the_up_axis(self):
        facing = support.addon("look_at.facing")
        for forward, up, _ in turns():
            left = AXES[up].cross(AXES[forward])
            self.assertEqual(AXES[facing.turned(forward, up)], left)
            self.assertIn(facing.turned(up, up), AXES)
            self.assertNotEqual(facing.turned(up, up)[-1], up[-1])


class Eyes(LookAtTestCase):
    def build(self, left, right):
        """Eyes along these local axes of the world, Y first: (Y, Z) each."""
        rig = build_rig(SPINE | EYES)
        bpy.ops.object.mode_set(mode='EDIT')
        for name, (along, roll) in (("LeftEye", left), ("RightEye", right)):
            bone = rig.data.edit_bones[name]
            bone.tail = bone.head + 0.04 * Vector(along)
            bone.align_roll(Vector(roll))
        bpy.ops.object.mode_set(mode='OBJECT')
        return rig

    def assertEyesMeet(self, rig):
        for name in ("LeftEye", "RightEye"):
            pose = self.pose(name, rig)
            gaze = pose.to_3x3() @ rig.data.bones[name].matrix_local.to_3x3().inverted() @ Vector((0, -1, 0))
            self.assertLess(math.degrees(gaze.angle(self.target.location - pose.translation)), HIT, name)

    MIRRORED = {
        "outwards": (((1, 0, 0), (0, 0, 1)), ((-1, 0, 0), (0, 0, 1))),
        "rolled": (((0, 0, 1), (0, -1, 0)), ((0, 0, 1), (0, 1, 0))),
        "one ahead, one backwards": (((0, -1, 0), (0, 0, 1)), ((0, 1, 0), (0, 0, 1))),
    }

    def test_eyes_that_mirror_each_other(self):
        self.target.location = (0.3, -1.0, 1.75)
        for name, sides in self.MIRRORED.items():
            with self.subTest(name):
                rig = self.build(*sides)
                self.look(rig.name, eyes_weight=1.0, eyes_limit=math.pi, head_weight=0.0, body_weight=0.0, clamp=0.0)
                bpy.context.view_layer.update()
                self.assertEyesMeet(rig)
                bpy.data.objects.remove(rig)

    def test_a_chosen_axis_of_eyes_that_mirror_each_other(self):
        """Along Z of one eye and -Z of the other: the first one's axis was chosen."""
        self.target.location = (0.3, -1.0, 1.75)
        rig = self.build(((1, 0, 0), (0, -1, 0)), ((1, 0, 0), (0, 1, 0)))
        self.look(rig.name, eyes_weight=1.0, eyes_limit=math.pi, head_weight=0.0, body_weight=0.0, clamp=0.0, eyes_forward='POS_Z')
        bpy.context.view_layer.update()
        self.assertEyesMeet(rig)


class Makers(LookAtTestCase):
    """Names of bones as rigs of several makers have them: (name, parent) of head, what it hangs on, and what is below."""

    HEADS = {
        "Mixamo": ("mixamorig:Head", ["mixamorig:HeadTop_End", "mixamorig:LeftEye", "mixamorig:RightEye"]),
        "glTF": ("mixamorig:Head", ["mixamorig:HeadTop_End", "mixamorig:HeadTop_End_end"]),
        "3ds Max": ("Bip01 Head", ["Bip01 HeadNub"]),
        "leaf bones": ("Head", ["Head_end"]),
        "VRM": ("J_Bip_C_Head", ["J_Adj_L_FaceEye", "J_Adj_R_FaceEye"]),
        "AdvancedSkeleton": ("Head_M", ["HeadEnd_M", "Eye_L", "Eye_R"]),
        "Daz": ("head", ["lEye", "rEye"]),
        "Unreal": ("head", []),
    }

    def test_heads_and_eyes_by_their_names(self):
        for maker, (head, below) in self.HEADS.items():
            with self.subTest(maker):
                bones = {"Body": ("", (0, 0, 1), (0, 0, 1.5)), head: ("Body", (0, 0, 1.5), (0, 0, 1.7))}
                for name in below:
                    parent = name[:-4] if name.endswith("_end") and name[:-4] in bones else head
                    side = 0.03 * (1 if name.split(":")[-1][0] in "lL" or "_L" in name else -1) if "Eye" in name else 0.0
                    bones[name] = (parent, (side, -0.05, 1.6), (side, -0.09, 1.62))
                rig = build_rig(bones)
                bpy.ops.motus.look_at_add(object=rig.name, target="Target")
                (entry,) = rig.motus.look_at.entries
                self.assertEqual(entry.name, head)
                self.assertEqual({eye.name for eye in entry.eyes}, {name for name in below if "Eye" in name})
                bpy.data.objects.remove(rig)

    def test_the_rig_that_rigify_makes(self):
        rig_samples.enable_rigify()
        self.addCleanup(rig_samples.disable_rigify)
        rig = rig_samples.generated_human()
        bpy.ops.motus.look_at_add(object=rig.name)
        (entry,) = rig.motus.look_at.entries
        self.assertEqual((entry.name, entry.forward, entry.up), ("head", 'NEG_Y', 'POS_Z'))
        head = rig.data.bones["head"]
        entry.body_weight = entry.clamp = 0.0
        entry.target.location = head.head_local + 2.0 * direction(40.0, 10.0)
        bpy.context.view_layer.update()
        # The head's control, and the bone that deforms, which it carries.
        for name in ("head", "DEF-spine.006"):
            pose, rest = self.pose(name, rig), rig.data.bones[name].matrix_local
            gaze = pose.to_3x3() @ rest.to_3x3().inverted() @ Vector((0, -1, 0))
            self.assertLess(math.degrees(gaze.angle(entry.target.location - pose.translation)), 0.05, name)


class Targets(LookAtTestCase):
    def made(self):
        bpy.ops.motus.look_at_add(object="Rig", bone="Head")
        return self.rig.motus.look_at.entries[0].target.name

    def remove(self):
        bpy.ops.motus.look_at_remove(object="Rig", bone="Head")

    def test_a_made_target_goes_with_its_head(self):
        name = self.made()
        self.remove()
        self.assertNotIn(name, bpy.data.objects)

    def test_a_target_that_was_there_stays(self):
        self.look()
        self.remove()
        self.assertIn("Target", bpy.data.objects)

    def test_a_made_target_goes_when_another_one_is_given(self):
        name = self.made()
        bpy.ops.motus.look_at_add(object="Rig", bone="Head", target="Target")
        self.assertNotIn(name, bpy.data.objects)

    def test_what_is_needed_stays(self):
        def child(made):
            self.target.parent = made

        def constraint(made):
            self.target.constraints.new('COPY_LOCATION').target = made

        def second_head(made):
            bpy.ops.motus.look_at_add(object="Rig", bone="Thigh.L", target=made.name, body_length=0, eyes="")

        def keys(made):
            made.keyframe_insert("location", frame=1)

        for use in (child, constraint, second_head, keys):
            with self.subTest(use.__name__):
                self.setUp()
                name = self.made()
                use(bpy.data.objects[name])
                self.remove()
                self.assertIn(name, bpy.data.objects)
                bpy.context.view_layer.update()


class OlderFiles(LookAtTestCase):
    def test_what_older_versions_noted_gives_the_same_poses(self):
        """They noted one axis for all eyes of a head, and knew no up."""
        self.aim(30, 10, 2.0)
        self.look(eyes_weight=0.5, body_weight=0.4)
        bpy.context.view_layer.update()
        wanted = self.poses()
        noted = self.rig.motus.look_at.hub.data["motus_look_at_info"]
        values = json.loads(noted["text"])
        data = next(value for value in values if isinstance(value, dict) and "plan" in value)
        plan = json.loads(data["plan"])
        for head in plan["heads"]:
            self.assertEqual(len(head["eyes_forward"]), 2)
            head["eyes_forward"] = head["eyes_forward"][0]
            del head["up"]
        data["plan"] = json.dumps(plan)
        noted["text"] = json.dumps(values)
        self.rig.motus.look_at.hub.data.update_tag()
        self.go_to(2)
        self.assertSamePoses(self.poses(), wanted, 0.0)
        self.assertIsNone(self.sentence())
        self.assertNotEqual(self.yaw("Eye.L"), 0.0)
