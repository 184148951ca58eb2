"""Inputs over time that nobody knows ahead: recorded into the file, read between the samples, and checked."""

import base64
import json
import re
import types
from pathlib import Path

import bpy
import numpy as np

import support
from core.interface.test_over_frames import Recorder, stand_in
from core.tracks import toy_echo_system
from core.tracks.track_cases import TrackTestCase

WITHIN = (1.0, 2.0, 17.0, 40.0)


class RecordingCase(TrackTestCase):
    def setUp(self):
        super().setUp()
        self.goal, self.thing = self.link("Goal"), self.link("Thing")
        for path in ("location", "rotation_euler", "scale"):
            self.key(self.goal, path, low=0.5, high=2.0, frames=(1, 20, 40))
            self.key(self.thing, path, low=0.5, high=2.0, frames=(1, 20, 40))
        self.constraint = self.thing.constraints.new('CHILD_OF')
        self.constraint.target = self.goal
        self.scene.frame_start, self.scene.frame_end = 1, 40

    def record(self, **keywords):
        keywords.setdefault("datablock", "Thing")
        self.assertEqual(bpy.ops.motus.track_record(**keywords), {'FINISHED'})

    def track(self):
        return self.tracks.world_track(self.thing, self.scene)

    def assertRecorded(self, frames=WITHIN, tolerance=1e-6):
        track = self.track()
        self.assertTrue(track.is_known)
        wanted = np.array([self.world(self.thing, frame) for frame in frames])
        np.testing.assert_allclose(track.values(frames), wanted, atol=tolerance)
        evaluated = self.tracks.world_track(self.evaluated(self.thing), self.scene)
        np.testing.assert_array_equal(evaluated.values(frames), track.values(frames))

    def assertNothingLeft(self):
        self.assertFalse(self.thing.is_property_set("motus_recordings"))
        self.assertEqual(list(self.thing.keys()), [])


class Recording(RecordingCase):
    def test_transform(self):
        self.go_to(7.5)
        self.assertIn("Needs recording: Thing has the constraint Child Of", self.track().sentence)
        self.record()
        self.assertEqual((self.scene.frame_current, self.scene.frame_subframe), (7, 0.5))
        self.assertIn("Recorded 1-40 by steps of 1", self.track().sentence)
        self.assertRecorded()
        before, after = self.track().values((-5.0, 90.0))
        np.testing.assert_array_equal(before, self.track().values((1.0,))[0])
        np.testing.assert_array_equal(after, self.track().values((40.0,))[0])

    def test_between_the_samples(self):
        self.record(step=0.25)
        self.assertRecorded((*WITHIN, 3.25, 38.75))
        between = self.track().values((3.0, 3.125, 3.25))
        np.testing.assert_allclose(between[1], 0.5 * (between[0] + between[2]), atol=1e-3)
        self.assertTrue({1.0, 1.25, 40.0} <= set(self.track().bounds(1.0, 40.0)))
        self.assertIn("Recorded 1-40 by steps of 0.25", self.track().sentence)

    def test_a_turn_between_the_samples_keeps_lengths(self):
        for path in ("location", "rotation_euler", "scale"):
            self.goal.keyframe_delete(path, frame=20)
        self.thing.animation_data_clear()
        self.goal.animation_data_clear()
        self.goal.driver_add("rotation_euler", 2).driver.expression = "frame"
        self.goal.scale = self.thing.scale = 1.0, 1.0, 1.0
        self.record()
        matrices = self.track().values(np.linspace(1.0, 40.0, 200))
        np.testing.assert_allclose(np.linalg.det(matrices[:, :3, :3]), 1.0, atol=1e-5)

    def test_range_and_time_mapping(self):
        self.scene.render.frame_map_old, self.scene.render.frame_map_new = 100, 200
        self.record(frame_start=10, frame_end=30)
        self.assertIn("Recorded 5-15 by steps of 0.5", self.track().sentence)
        np.testing.assert_allclose(self.track().values((10.0,))[0], self.world(self.thing, 20), atol=1e-6)

    def test_number_and_own_transform(self):
        self.thing.driver_add("location", 0).driver.expression = "frame * 0.1"
        self.record(data_path="location", index=0)
        track = self.tracks.property_track(self.thing, "location", 0)
        np.testing.assert_allclose(track.values((1.0, 3.5, 40.0, 50.0)), (0.1, 0.35, 4.0, 4.0), atol=1e-6)
        self.assertFalse(self.tracks.own_track(self.thing).is_known)
        self.record(transform='OWN')
        own = self.tracks.own_track(self.thing).values((3.0, 7.0))
        np.testing.assert_allclose(own.locations[:, 0], (0.3, 0.7), atol=1e-6)
        self.go_to(7)
        np.testing.assert_allclose(own.scales[1], self.evaluated(self.thing).scale, atol=1e-6)
        np.testing.assert_allclose(
            np.abs(own.rotations[1] @ np.array(self.evaluated(self.thing).rotation_euler.to_quaternion())), 1.0, atol=1e-6
        )

    def test_bone_and_other_datablocks(self):
        rig = self.rig()
        constraint = rig.pose.bones["Bone.1"].constraints.new('COPY_ROTATION')
        constraint.target = self.goal
        self.record(datablock="Rig", bone="Bone.2")
        bone = rig.pose.bones["Bone.2"]
        wanted = self.world(bone, 17)
        np.testing.assert_allclose(self.tracks.world_track(bone, self.scene).values((17.0,))[0], wanted, atol=1e-6)
        self.assertFalse(self.tracks.world_track(rig.pose.bones["Bone.1"], self.scene).is_known)
        material = bpy.data.materials.new("Material")
        material["value"] = 1.0
        driver = material.driver_add('["value"]').driver
        driver.expression = "frame"
        mesh = bpy.data.meshes.new("Mesh")
        mesh.materials.append(material)
        self.link("Mesh", mesh)
        self.record(datablock="Material", collection="materials", data_path='["value"]')
        self.assertEqual(list(self.tracks.property_track(material, '["value"]').values((3.0, 40.0))), [3.0, 40.0])

    def test_what_has_nothing_between(self):
        self.thing.driver_add("hide_render").driver.expression = "frame >= 3"
        self.record(data_path="hide_render")
        track = self.tracks.property_track(self.thing, "hide_render")
        self.assertEqual(list(track.values((0.0, 2.0, 2.75, 3.0, 3.5, 40.0, 99.0))), [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0])

    def test_it_goes_along_in_the_file(self):
        self.record()
        wanted = self.track().values(WITHIN)
        copy = self.thing.copy()
        self.scene.collection.objects.link(copy)
        np.testing.assert_array_equal(self.tracks.world_track(copy, self.scene).values(WITHIN), wanted)
        path = str(self.folder / "file.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        np.testing.assert_array_equal(self.tracks.world_track(bpy.data.objects["Thing"], self.scene).values(WITHIN), wanted)
        support.empty_scene()
        with bpy.data.libraries.load(path, link=True) as (_, wanted_objects):
            wanted_objects.objects = ["Thing"]
        linked = bpy.data.objects["Thing"]
        bpy.context.scene.collection.objects.link(linked)
        np.testing.assert_array_equal(self.tracks.world_track(linked, self.scene).values(WITHIN), wanted)
        with self.assertRaisesRegex(RuntimeError, "linked"):
            bpy.ops.motus.track_record(datablock="Thing")

    def test_library_override(self):
        """Its recordings are its own, and stay; one that its library has can be replaced and cleared."""
        path, again = str(self.folder / "library.blend"), str(self.folder / "file.blend")
        for is_recorded in (False, True):
            if is_recorded:
                self.record(frame_end=9)
            bpy.ops.wm.save_as_mainfile(filepath=path)
            support.empty_scene()
            with bpy.data.libraries.load(path, link=True) as (_, wanted):
                wanted.objects = ["Thing"]
            thing = bpy.data.objects["Thing"].override_create()
            bpy.context.scene.collection.objects.link(thing)
            bpy.context.view_layer.update()
            self.assertEqual(self.tracks.world_track(thing, bpy.context.scene).is_known, is_recorded)
            self.assertEqual(bpy.ops.motus.track_record(datablock="Thing", frame_end=30), {'FINISHED'})
            for operator, sentence in ((None, "Recorded 1-30"), (bpy.ops.motus.track_clear, "Needs recording")):
                if operator:
                    self.assertEqual(operator(datablock="Thing"), {'FINISHED'})
                bpy.ops.wm.save_as_mainfile(filepath=again)
                bpy.ops.wm.open_mainfile(filepath=again)
                (thing,) = (one for one in bpy.data.objects if one.override_library)
                with self.subTest(sentence, is_recorded=is_recorded):
                    self.assertIn(sentence, self.tracks.world_track(thing, bpy.context.scene).sentence)
            bpy.ops.wm.open_mainfile(filepath=path)
            self.thing = bpy.data.objects["Thing"]

    def test_clear(self):
        self.record()
        self.assertEqual(bpy.ops.motus.track_clear(datablock="Thing"), {'FINISHED'})
        self.assertFalse(self.track().is_known)
        self.assertNothingLeft()
        with self.assertRaisesRegex(RuntimeError, "Nothing was recorded"):
            bpy.ops.motus.track_clear(datablock="Thing")

    def test_what_is_exact_again_is_not_read_from_the_recording(self):
        self.record()
        self.thing.constraints.remove(self.constraint)
        self.assertWorld(self.thing)

    def test_refusals(self):
        for keywords, part in (
            ({"datablock": "Nobody"}, "no Nobody"),
            ({"datablock": "Goal"}, "known at any frame"),
            ({"collection": "nothing"}, "no Thing in nothing"),
            ({"data_path": "name"}, "no number"),
            ({"bone": "Bone"}, "no bone Bone"),
            ({"collection": "scenes", "datablock": "Scene"}, "data path"),
            ({"frame_start": 1, "frame_end": 30_000}, "too many for a file"),
            ({"frame_start": 9, "frame_end": 1}, "empty"),
            ({"step": float("nan")}, "finite"),
        ):
            with self.subTest(**keywords), self.assertRaisesRegex(RuntimeError, part):
                bpy.ops.motus.track_record(**{"datablock": "Thing", **keywords})
        self.assertNothingLeft()

    def test_escape_leaves_nothing(self):
        operator = support.addon("core.interface.tracks.operators").MOTUS_OT_track_record
        self.go_to(3)
        made = stand_in(operator, lambda: operator._record(made, bpy.context, self.thing, [10.0, 11.0, 12.0]))
        made._samples, made.bone, made.data_path, made.transform, made.index = [], "", "", 'WORLD', -1
        context = Recorder()
        self.assertEqual(made.invoke(context, None), {'RUNNING_MODAL'})
        self.assertEqual(self.scene.frame_current, 10)
        self.assertEqual(made.modal(context, types.SimpleNamespace(type='ESC')), {'CANCELLED'})
        self.assertTrue(context.is_tidy)
        self.assertEqual(self.scene.frame_current, 3)
        self.assertNothingLeft()

    def test_the_example_of_the_manual(self):
        page = Path(__file__).resolve().parents[3] / "docs" / "tracks.md"
        code = re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)[0]
        self.thing.name = "Cube"
        rig = self.rig()
        rig.data.bones[1].name = "hand.L"
        bone = rig.pose.bones["hand.L"]
        rig.driver_add(f"{bone.path_from_id()}.location", 0)
        clay = bpy.data.materials.new("Clay")
        clay["age"] = 1.0
        clay.driver_add('["age"]').driver.expression = "frame"
        rig.data["clay"] = clay  # so that Blender evaluates it
        exec(compile(code, "tracks.md", "exec"), {"bpy": bpy})
        for track in (self.track(), self.tracks.own_track(bone), self.tracks.property_track(clay, '["age"]')):
            self.assertIn("Recorded 1-", track.sentence)


class OutOfDate(RecordingCase):
    def assertOutdated(self, outdated, message=""):
        bpy.context.view_layer.update()
        self.assertEqual(self.track_panel.is_outdated(self.track()), outdated, message)

    def test_frames_are_no_edits(self):
        self.constraint.influence = 0.5
        self.constraint.keyframe_insert("influence", frame=3)
        self.record()
        for frame in (1, 20, 37.5):
            self.go_to(frame)
            self.assertOutdated(False)

    def test_edits(self):
        self.goal["pace"] = 1.0
        driver = self.constraint.driver_add("influence").driver
        variable = driver.variables.new()
        variable.targets[0].id, variable.targets[0].data_path = self.goal, '["pace"]'
        driver.expression = "var"
        curve = support.addon("core.blender.actions").find(self.goal, "rotation_euler", 2)
        helper = self.link("Helper")

        def move_key():
            curve.keyframe_points[1].co[1] += 0.5

        def set_pace():
            self.goal["pace"] = 0.5
            self.goal.update_tag()

        for index, edit in enumerate(
            (
                move_key,
                lambda: setattr(self.constraint, "use_scale_x", False),
                set_pace,
                lambda: setattr(self.goal, "parent", helper),
                lambda: setattr(helper, "location", (1.0, 2.0, 3.0)),
                lambda: setattr(driver, "expression", "var * 2"),
                lambda: setattr(curve.modifiers.new('NOISE'), "strength", 2.0),
                lambda: setattr(self.thing, "delta_scale", (2.0, 1.0, 1.0)),
            )
        ):
            self.record()
            self.assertOutdated(False, index)
            edit()
            self.assertOutdated(True, index)

    def test_damaged(self):
        self.record()
        (entry,) = self.thing.motus_recordings
        head, data = entry.head, entry.data
        version, start, step, stamp, digest = json.loads(head)
        most = support.addon("core.tracks.recordings").LARGEST

        def numbers(values):
            return base64.b64encode(np.array(values, "<f4").tobytes()).decode()

        heads = [
            [99, start, step, stamp, digest],
            [version, start, step, stamp],
            [version, "1", step, stamp, digest],
            [version, start, 0.0, stamp, digest],
            [version, start, -1.0, stamp, digest],
            {},
            3,
            [version, float("inf"), step, stamp, digest],
            [version, start, step, 1, digest],
            [version, start, step, stamp, [1]],
        ]
        for spoilt in (*map(json.dumps, heads), "text", "[" * 100_000):
            with self.subTest(spoilt[:60]):
                entry.head = spoilt
                self.assertDamaged()
        for index, spoilt in enumerate(
            (
                "",
                "text",
                "ä",
                data[:-4],
                data[:-1],
                numbers([0.0] * 13),
                numbers([float("nan")] * 12),
                numbers([0.0] * (12 * (most // 12 + 1))),
            )
        ):
            with self.subTest(spoilt[:60]):
                entry.head, entry.data = json.dumps([version, start, step, f"{index}", digest]), spoilt
                self.assertDamaged()
        entry.head, entry.data = head, data
        self.assertTrue(self.track().is_known)

    def assertDamaged(self):
        self.assertFalse(self.track().is_known)
        self.assertIn("Needs recording", self.track().sentence)
        self.assertFalse(self.track_panel.is_outdated(self.track()))


class Consumer(RecordingCase):
    """A system that shows where another object was ten frames ago."""

    def setUp(self):
        toy_echo_system.register()
        self.addCleanup(toy_echo_system.unregister)
        super().setUp()
        self.wiring = support.addon("core.wiring")
        self.owner = self.link("Owner")

    def place(self, frame):
        return self.world(self.owner, frame)[:3, 3]

    def problem(self):
        return self.wiring.problem(toy_echo_system.SYSTEM, self.owner, bpy.context.evaluated_depsgraph_get())

    def assertEcho(self, target, frames=(30.0, 5.0, 26.5, 11.0, 12.25), tolerance=2e-6):
        wanted = [self.world(target, frame - toy_echo_system.AGO)[:3, 3] for frame in frames]
        found = [self.place(frame) for frame in frames]
        self.assertIsNone(self.problem())
        np.testing.assert_allclose(found, wanted, atol=tolerance)
        np.testing.assert_array_equal([self.place(frame) for frame in frames[::-1]][::-1], found)

    def test_keyed(self):
        toy_echo_system.echo(self.owner, self.goal)
        self.assertEcho(self.goal)
        self.goal.scale[0] = 7.0
        curve = support.addon("core.blender.actions").find(self.goal, "location", 0)
        curve.keyframe_points[1].co[1] += 3.0
        self.assertEcho(self.goal)

    def test_parented(self):
        child = self.link("Child")
        child.parent, child.location = self.goal, (1.0, 2.0, 3.0)
        toy_echo_system.echo(self.owner, child)
        self.assertEcho(child, tolerance=1e-5)

    def test_constrained(self):
        toy_echo_system.echo(self.owner, self.thing)
        self.place(30)
        self.assertIn("has to be recorded", self.problem().sentence)
        self.record()
        self.assertEcho(self.thing, (30.0, 15.0, 11.0))
        bpy.ops.motus.track_clear(datablock="Thing")
        self.place(30)
        self.assertIn("has to be recorded", self.problem().sentence)

    def test_solved(self):
        """What follows a path, and what hangs on it."""
        data = bpy.data.curves.new("Course", 'CURVE')
        data.dimensions = '3D'
        spline = data.splines.new('BEZIER')
        spline.bezier_points.add(1)
        spline.bezier_points[1].co = 9.0, 3.0, 1.0
        self.link("Course", data)
        self.assertEqual(bpy.ops.motus.path_follow_add(object="Goal", curve="Course", duration=1.5), {'FINISHED'})
        child = self.link("Child")
        child.parent, child.location = self.goal, (1.0, 2.0, 3.0)
        toy_echo_system.echo(self.owner, child)
        self.assertEqual(self.tracks.world_track(child, self.scene).kind, self.tracks.Kind.SOLVED)
        self.assertEcho(child, tolerance=5e-6)

    def test_many_at_once(self):
        """Blender evaluates them in threads; each reads what the others read."""
        self.record()
        owners = [self.link(f"Owner {index}") for index in range(24)]
        for owner, target in zip(owners, (self.goal, self.thing) * 12):
            toy_echo_system.echo(owner, target)
        for frame in (30.0, 15.5, 11.0):
            self.go_to(frame)
            depsgraph = bpy.context.evaluated_depsgraph_get()
            places = [tuple(owner.evaluated_get(depsgraph).matrix_world.translation) for owner in owners]
            self.assertEqual(len(set(places)), 2)
            np.testing.assert_allclose(places[0], self.world(self.goal, frame - 10.0)[:3, 3], atol=2e-6)


class Panel(RecordingCase):
    def drawn(self, track, **keywords):
        layout = Layout()
        self.track_panel.draw(layout, track, **keywords)
        return layout

    def test_what_is_said(self):
        shown = self.drawn(self.tracks.world_track(self.goal, self.scene), datablock="Goal")
        self.assertIn("read from keys", shown.text)
        self.assertEqual(list(shown.buttons), [])
        shown = self.drawn(self.track(), datablock="Thing")
        self.assertIn("Needs recording", shown.text)
        self.assertEqual(list(shown.buttons), ["motus.track_record"])
        self.assertEqual(shown.buttons["motus.track_record"].datablock, "Thing")
        self.record()
        shown = self.drawn(self.track(), datablock="Thing")
        self.assertIn("Recorded 1-40", shown.text)
        self.assertNotIn("out of date", shown.text)
        self.assertEqual(list(shown.buttons), ["motus.track_record", "motus.track_clear"])
        self.goal.parent = self.link("Helper")
        bpy.context.view_layer.update()
        self.assertIn("out of date", self.drawn(self.track(), datablock="Thing").text)


class Layout:
    """Notes what is drawn."""

    def __init__(self):
        self.texts, self.buttons = [], {}

    @property
    def text(self):
        return " ".join(self.texts)

    def box(self, **_options):
        return self

    column = row = box

    def label(self, text="", **_options):
        self.texts.append(text)

    def operator(self, name, **_options):
        return self.buttons.setdefault(name, types.SimpleNamespace())
