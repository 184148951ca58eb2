"""What is made of what is followed is kept from frame to frame, until something of that is edited."""

import contextlib
from unittest import mock

import bpy
import numpy as np
from mathutils import Matrix

import support
from dynamics import dynamics_cases as cases


def course():
    """A curve 10 m long."""
    curve = bpy.data.curves.new("Course", 'CURVE')
    curve.dimensions = '3D'
    spline = curve.splines.new('POLY')
    spline.points.add(1)
    spline.points[1].co = 10.0, 0.0, 0.0, 1.0
    cases.link("Course", curve)
    return spline


class DynamicsKeptTest(support.SceneTestCase):
    def made(self, act):
        """How often all of a group is made anew meanwhile."""
        solve = support.addon("dynamics.solve")
        with mock.patch.object(solve, "_make", wraps=solve._make) as made:
            act()
        return made.call_count

    def assertKept(self):
        cases.go_to(2)
        self.assertEqual(self.made(lambda: [cases.go_to(frame) for frame in (3, 4.5, 7)]), 0)

    def assertSeen(self, rig, bone, before, frame):
        """An edit counts at once, as if nothing had been kept."""
        edited = cases.matrix(rig, frame, bone)
        self.assertGreater(np.abs(edited - before).max(), 1e-3)
        rig.update_tag()
        np.testing.assert_array_equal(cases.matrix(rig, frame, bone), edited)

    def test_the_course_of_the_rig(self):
        """Its tails follow, also those that no bone carries."""
        for name in ("Tail 0 0", "Root"):
            with self.subTest(name):
                support.empty_scene()
                spline, rig = course(), cases.rope(2)
                bpy.ops.motus.path_follow_add(object="Rope", curve="Course", duration=2.0)
                cases.add(rig, bones=name, style='FLOPPY')
                self.assertIsNone(cases.problem(rig))
                self.assertKept()
                before = cases.matrix(rig, 24, name)
                spline.points[1].co = 4.0, 8.0, 3.0, 1.0
                spline.id_data.update_tag()
                bpy.context.view_layer.update()
                self.assertSeen(rig, name, before, 24)

    def read(self, act):
        """How often an object's input is sampled meanwhile."""
        inputs = support.addon("dynamics.inputs")
        with contextlib.ExitStack() as stack:
            kinds = inputs.OwnInput, inputs.WorldInput
            counted = [stack.enter_context(mock.patch.object(one, "samples", autospec=True, side_effect=one.samples)) for one in kinds]
            act()
            bpy.context.view_layer.update()
        return sum(one.call_count for one in counted)

    def test_what_an_object_follows_while_its_filter_is_edited(self):
        carrier, ball = cases.moved("Carrier"), cases.moved("Ball")
        carrier.location.z, ball.parent = 1.0, carrier
        (entry,) = cases.add(ball, follow='WORLD', frequency=1.0, damping=0.2, channels={'LOCATION'})
        cases.go_to(24)
        for name, value in (("frequency", 2.0), ("damping", 0.4), ("weight", 0.5), ("delay", 0.1)):
            before = cases.matrix(ball, 24)
            self.assertEqual(self.read(lambda name=name, value=value: setattr(entry, name, value)), 0, name)
            self.assertGreater(np.abs(cases.matrix(ball, 24) - before).max(), 1e-4, name)
        edits = {
            "keys of the parent": lambda: cases.key(carrier, "location", {22: (5.0, 1.0, 0.0)}),
            "its own keys": lambda: cases.key(ball, "location", {22: (0.0, 1.0, 4.0)}),
            "how it hangs": lambda: setattr(ball, "matrix_parent_inverse", Matrix.Rotation(1.0, 4, 'X')),
            "what follows": lambda: setattr(entry, "channels", {'LOCATION', 'ROTATION'}),
            "what is a jump": lambda: setattr(entry, "jump", 0.1),
            "what it follows": lambda: setattr(entry, "follow", 'OWN'),
        }
        for what, edit in edits.items():
            with self.subTest(what):
                self.assertGreater(self.read(edit), 0)
                edited = cases.matrix(ball, 24)
                support.addon("core.keeping").forget_file()
                ball.update_tag()
                np.testing.assert_array_equal(cases.matrix(ball, 24), edited)

    def test_what_the_rig_hangs_on(self):
        rig, carrier = cases.rope(2), cases.moved("Carrier")
        rig.parent = carrier
        cases.add(rig, bones="Root", style='FLOPPY')
        self.assertKept()
        before = cases.matrix(rig, 24, "Root")
        cases.key(carrier, "location", {20: (0.0, 3.0, 0.0)})
        self.assertSeen(rig, "Root", before, 24)

    def test_what_has_to_be_recorded(self):
        """It is not followed until it is known, and asked for nothing meanwhile."""
        carrier, ball = cases.link("Carrier"), cases.link("Ball")
        carrier.constraints.new('CHILD_OF').target = cases.moved("Guide")
        rig = cases.rope(2)
        rig.parent = ball.parent = carrier
        cases.add(rig, bones="Root", follow='OWN')
        self.assertKept()
        cases.add(ball, follow='WORLD', style='BOUNCY')
        self.assertKept()
        cases.add(rig, bones="Tail 0 0, Tail 0 1", style='BOUNCY')
        self.assertKept()
        self.assertIn("record", cases.problem(ball).sentence)
        before, hanging = cases.matrix(rig, 22, "Tail 0 1"), cases.matrix(ball, 22)
        for names in ({"datablock": "Carrier"}, {"datablock": "Rope"}, {"datablock": "Rope", "bone": "Root"}):
            bpy.ops.motus.track_record(transform='WORLD', frame_start=1, frame_end=60, **names)
        self.assertIsNone(cases.problem(ball))
        self.assertSeen(rig, "Tail 0 1", before, 22)
        self.assertGreater(np.abs(cases.matrix(ball, 22) - hanging).max(), 1e-3)
        self.assertKept()

    def test_a_base_that_comes_to_be_known(self):
        """By an edit of what a bone reaches for, which tells nothing of the rig."""
        rig, goal, guide = cases.rope(3), cases.link("Goal"), cases.moved("Guide")
        bpy.ops.motus.ik_add(object="Rope", bone="Tail 0 0", target="Goal", chain_length=1)
        wild = goal.constraints.new('COPY_LOCATION')
        wild.target = guide
        cases.add(rig, bones="Tail 0 2", style='FLOPPY')
        self.assertIn("record", cases.problem(rig).sentence)
        self.assertKept()
        before = cases.matrix(rig, 24, "Tail 0 2")
        goal.constraints.remove(wild)
        cases.key(goal, "location", {1: (0.0, 0.0, 2.0), 20: (3.0, 0.0, 1.0)})
        self.assertSeen(rig, "Tail 0 2", before, 24)
        self.assertIsNone(cases.problem(rig))

    def test_a_linked_armature(self):
        """Its library may have it from before there was a Motus; whoever loads that again has it edited."""
        cases.rope(2)
        path = self.save("library.blend")
        support.empty_scene()
        with bpy.data.libraries.load(path, link=True) as (_, wanted):
            wanted.armatures = ["Rope"]
        rig = cases.link("Mine", bpy.data.armatures["Rope"])
        cases.key(rig, "location", cases.STEP)
        cases.add(rig, bones="Tail 0 0, Tail 0 1", style='BOUNCY')
        self.assertIsNone(cases.problem(rig))
        self.assertKept()
        before = cases.matrix(rig, 22, "Tail 0 1")
        edit = (
            "import bpy; from dynamics import dynamics_cases as cases; "
            f"bpy.ops.wm.open_mainfile(filepath={path!r}); rig = bpy.data.objects['Rope']; "
            "bpy.context.view_layer.objects.active = rig; bpy.ops.object.mode_set(mode='EDIT'); "
            "rig.data.edit_bones['Tail 0 1'].tail = 0.4, 0.2, 1.7; bpy.ops.object.mode_set(mode='OBJECT'); "
            f"bpy.ops.wm.save_as_mainfile(filepath={path!r})"
        )
        status, output = support.run_beside(edit)
        self.assertEqual(status, 0, output)
        bpy.data.libraries[0].reload()
        self.assertSeen(bpy.data.objects["Mine"], "Tail 0 1", before, 22)

    def test_the_tails_while_settings_are_edited(self):
        """Their positions do not depend on frequencies; they are computed anew after an edit of keys or of the rest pose."""
        rig = cases.rope(3)
        cases.add(rig, bones="Tail 0 0", whole_chains=True, chain_delay=0.1, style='FLOPPY')
        inputs, entries = support.addon("dynamics.inputs"), rig.motus.dynamics.entries
        cases.go_to(24)

        def computed(act):
            with mock.patch.object(inputs.TailInput, "places", autospec=True, side_effect=inputs.TailInput.places) as tails:
                act()
                bpy.context.view_layer.update()
            return tails.call_count

        before = cases.matrix(rig, 24, "Tail 0 2")
        self.assertEqual(computed(lambda: setattr(entries["Tail 0 0"], "frequency", 3.7)), 0)
        self.assertSeen(rig, "Tail 0 2", before, 24)
        before = cases.matrix(rig, 24, "Tail 0 2")
        self.assertGreater(
            computed(lambda: cases.key(rig.pose.bones["Tail 0 1"], "location", {1: (0.0, 0.0, 0.0), 20: (0.0, 1.0, 0.0)})), 0
        )
        self.assertSeen(rig, "Tail 0 2", before, 24)
        before = cases.matrix(rig, 24, "Tail 0 2")
        self.assertGreater(computed(lambda: self.lengthen(rig)), 0)
        self.assertSeen(rig, "Tail 0 2", before, 24)

    def test_what_an_edit_of_a_setting_looks_through(self):
        """Neither keys nor bones nor what drives them, since all that is the same: one filter is made."""
        rig = cases.rope(3)
        cases.add(rig, bones="Tail 0 0", whole_chains=True, chain_delay=0.1, style='FLOPPY')
        keys, groups, entries = support.addon("core.animation.keys"), support.addon("dynamics.groups"), rig.motus.dynamics.entries
        tracks, filters = support.addon("core.tracks"), support.addon("dynamics.filters")
        for frequency in (3.5, 3.6):
            entries["Tail 0 0"].frequency = frequency
            bpy.context.view_layer.update()
        with (
            mock.patch.object(keys, "extent", wraps=keys.extent) as extents,
            mock.patch.object(keys, "bounds", wraps=keys.bounds) as bounds,
            mock.patch.object(groups, "_tail_units", wraps=groups._tail_units) as chains,
            mock.patch.object(tracks, "own_track", wraps=tracks.own_track) as bones,
            mock.patch.object(filters, "second_order", wraps=filters.second_order) as made,
        ):
            entries["Tail 0 0"].frequency = 3.7
            bpy.context.view_layer.update()
        counts = (one.call_count for one in (extents, bounds, chains, bones, made))
        self.assertEqual(tuple(counts), (0, 0, 0, 0, 1))

    def test_an_edit_of_a_pose(self):
        """It counts at once, whichever number of the bone it sets, also beside a number that has keys."""
        rig = cases.rope(3)
        cases.add(rig, bones="Tail 0 0", whole_chains=True, chain_delay=0.1, style='FLOPPY')
        bone = rig.pose.bones["Tail 0 1"]
        bone.rotation_mode = 'XYZ'
        for frame, angle in ((1, 0.0), (20, 0.4)):
            bone.rotation_euler.x = angle
            bone.keyframe_insert("rotation_euler", index=0, frame=frame)
        cases.go_to(24)
        edits = {
            "location": lambda: setattr(bone, "location", (0.0, 0.3, 0.1)),
            "a rotation beside keys": lambda: setattr(bone.rotation_euler, "z", 0.7),
            "scale": lambda: setattr(bone, "scale", (1.0, 1.5, 1.0)),
            "rotation mode": lambda: setattr(bone, "rotation_mode", 'QUATERNION'),
            "quaternion": lambda: setattr(bone, "rotation_quaternion", (0.8, 0.0, 0.6, 0.0)),
        }
        for name, edit in edits.items():
            with self.subTest(name):
                before = cases.matrix(rig, 24, "Tail 0 2")
                edit()
                self.assertSeen(rig, "Tail 0 2", before, 24)

    def test_a_driver_that_comes_and_goes(self):
        rig = cases.rope(3)
        cases.add(rig, bones="Tail 0 0", whole_chains=True, style='FLOPPY')
        bone = rig.pose.bones["Tail 0 1"]
        bone.rotation_mode = 'XYZ'
        before = cases.matrix(rig, 24, "Tail 0 2")
        bone.driver_add("rotation_euler", 2).driver.expression = "0.02 * frame"
        rig.update_tag()
        self.assertSeen(rig, "Tail 0 2", before, 24)
        before = cases.matrix(rig, 24, "Tail 0 2")
        bone.driver_remove("rotation_euler", 2)
        bone.rotation_euler.z = 0.0
        self.assertSeen(rig, "Tail 0 2", before, 24)

    def lengthen(self, rig):
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        rig.data.edit_bones["Tail 0 0"].tail.x += 0.3
        bpy.ops.object.mode_set(mode='OBJECT')
