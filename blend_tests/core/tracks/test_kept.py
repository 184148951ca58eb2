"""What is kept of tracks: for as long as they stay what they are, and as much as there is room for."""

import functools
import mmap
import weakref

import bpy
import numpy as np

import support
from core.tracks.track_cases import TrackTestCase


class Answers(TrackTestCase):
    """When and why a marked object moves is asked once for each evaluated copy, and again after whatever may change the answer."""

    def setUp(self):
        super().setUp()
        self.thing = self.link("Thing")
        self.key(self.thing, "location", index=0)
        support.addon("core.evaluated.copies").mark(self.thing)
        self.world = support.addon("core.tracks.in_world").World

    def answers(self, obj):
        track = self.world(obj, self.scene)
        return track.reason and track.reason.sentence, track.extent, track.values(np.array([3.0, 12.5])).tolist()

    def assert_right(self, what):
        """The same answers as those about the original, of which nothing is kept."""
        with self.subTest(what):
            for _ in range(2):
                bpy.context.view_layer.update()
                self.assertEqual(self.answers(self.evaluated(self.thing)), self.answers(self.thing))

    def test_asked_once_while_frames_pass(self):
        extents = []

        class Counted(self.world):
            @property
            def _links(self):
                extents.append(self)
                return super()._links

        for frame in (1, 5, 30, 2.5):
            self.go_to(frame)
            track = Counted(self.evaluated(self.thing), self.scene)
            self.assertTrue(track.rests_on_keys)
            self.assertIsNone(track.reason)
            self.assertEqual(track.extent, self.world(self.thing, self.scene).extent)
        self.assertEqual(len(extents), 2, "once for the reason, once for the extent")

    def test_every_edit_asks_again(self):
        self.assert_right("at first")
        self.thing.location.y = 2.0
        self.assert_right("a channel without keys")
        self.thing.keyframe_insert("location", index=1, frame=70)
        self.assert_right("another key")
        curve = support.addon("core.blender.actions").find(self.thing, "location", 0)
        curve.keyframe_points[-1].co[0] += 9.0
        curve.update()
        self.assert_right("a later key")
        curve.mute = True
        self.assert_right("a muted curve")
        curve.mute = False
        constraint = self.thing.constraints.new('LIMIT_LOCATION')
        self.assert_right("a constraint")
        self.thing.constraints.remove(constraint)
        self.assert_right("no constraint")
        self.thing.driver_add("location", 2)
        self.assert_right("a driver")
        self.thing.driver_remove("location", 2)
        self.assert_right("no driver")
        self.thing.parent = self.link("Top")
        self.key(self.thing.parent, "location", index=2)
        self.assert_right("a parent that moves")
        self.thing.parent = None
        self.thing.animation_data.action = None
        self.assert_right("no action")


class Kept(TrackTestCase):
    """What a solver keeps of a track lasts until the track changes."""

    def setUp(self):
        super().setUp()
        self.top, self.thing = self.link("Top"), self.link("Thing")
        self.thing.parent = self.top
        self.key(self.top, "location")
        self.key(self.thing, "location", index=0)
        self.made = 0

    def make(self):
        self.made += 1
        return self.made

    def asked(self, frame):
        """How often it was made, when asked for on a frame."""
        self.go_to(frame)
        self.tracks.kept(self.tracks.world_track(self.evaluated(self.thing), self.scene), "test", self.make)
        self.tracks.kept(self.tracks.own_track(self.evaluated(self.thing)), "own", self.make)
        return self.made

    def test_frames_change_nothing(self):
        self.assertEqual(self.asked(1), 2)
        for frame in (5, 30, 2.5, 100):
            self.assertEqual(self.asked(frame), 2)

    def test_edits_do(self):
        self.asked(1)
        curve = support.addon("core.blender.actions").find(self.top, "location", 1)
        curve.keyframe_points[1].co[1] += 1.0
        bpy.context.view_layer.update()
        self.assertEqual(self.asked(7), 3, "a key of the parent")
        self.thing.scale[1] = 3.0
        self.assertEqual(self.asked(8), 5, "a value without keys")
        self.thing.location[0] = 3.0
        self.assertEqual(self.asked(9), 5, "a value that keys set")
        self.thing.parent = None
        self.assertEqual(self.asked(10), 6, "the parent")
        self.thing.animation_data_clear()
        self.assertEqual(self.asked(10), 8, "the keys")

    def test_second_order_dynamics_of_keys(self):
        """What a solver of dynamics does: a native track of samples, made once, and evaluated on each frame."""
        native = support.addon("core.native").module
        filter = native.SecondOrder(2.0, 0.4, 0.0)

        def make(track):
            self.made += 1
            times = track.bounds(1.0, 60.0)
            return native.Track(filter, np.array(times) / 24.0, track.values(times))

        found = []
        for frame in (40.0, 10.0, 25.5, 60.0):
            self.go_to(frame)
            track = self.tracks.property_track(self.evaluated(self.top), "location", 1)
            found.append(self.tracks.kept(track, (2.0, 0.4, 0.0), functools.partial(make, track)).evaluate(frame / 24.0))
        self.assertEqual(self.made, 1)
        original = self.tracks.property_track(self.top, "location", 1)
        np.testing.assert_array_equal(found, [make(original).evaluate(frame / 24.0) for frame in (40.0, 10.0, 25.5, 60.0)])

    def test_originals_are_read_anew(self):
        track = self.tracks.world_track(self.thing, self.scene)
        for wanted in (1, 2):
            self.assertEqual(self.tracks.kept(track, "test", self.make), wanted)


class Room(support.SceneTestCase):
    def test_no_more_is_kept_than_there_is_room_for(self):
        track = support.addon("core.tracks.track")
        quarter = track.LARGEST_MEMORY // 4
        made = []

        def make():
            found = np.frombuffer(mmap.mmap(-1, quarter), np.uint8)  # it takes none of the machine's, as nobody writes it
            made.append(weakref.ref(found))
            return found, None

        for number in range(12):
            track.kept_by("stamp", ("test", number), make)
        self.assertEqual([number for number, one in enumerate(made) if one() is not None], [8, 9, 10, 11])
        track.kept_by("stamp", ("test", 11), make)
        self.assertEqual(len(made), 12)
        for number in range(track.LARGEST_CACHE):
            track.kept_by("stamp", ("small", number), lambda: None)
        self.assertEqual([one for one in made if one() is not None], [])

    def test_what_is_in_use_stays(self):
        track, made = support.addon("core.tracks.track"), []
        for number in range(2 * track.LARGEST_CACHE):
            track.kept_by("stamp", ("other", number), lambda: None)
            track.kept_by("stamp", "in use", lambda: made.append(1))
        self.assertEqual(made, [1])

    def test_nothing_stays_when_another_file_is_opened(self):
        track, meshes = support.addon("core.tracks.track"), support.addon("core.scenery.meshes")
        self.assertIsNotNone(meshes.faces(self._face()))
        self.assertGreater(len(meshes._faces), 0)
        made = []
        for _ in range(2):
            track.kept_by("stamp", "file", lambda: made.append(1))
            support.empty_scene()
        self.assertEqual(made, [1, 1])
        self.assertEqual(len(meshes._faces), 0)

    def _face(self):
        mesh = bpy.data.meshes.new("Face")
        mesh.from_pydata([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)], [], [(0, 1, 2)])
        obj = bpy.data.objects.new("Face", mesh)
        bpy.context.scene.collection.objects.link(obj)
        bpy.context.view_layer.update()
        return obj.evaluated_get(bpy.context.evaluated_depsgraph_get())

    def test_three_thousand_properties_are_kept_from_frame_to_frame(self):
        track, made = support.addon("core.tracks.track"), []
        for _ in range(2):
            for number in range(3000):
                track.kept_by("stamp", ("property", number), lambda number=number: made.append(number))
        self.assertEqual(made, list(range(3000)))

    def test_native_tracks_tell_their_memory(self):
        track, module = support.addon("core.tracks.track"), support.addon("core.native").module
        times = np.arange(1000.0)
        made = module.Track(module.SecondOrder(1.0, 0.5, 0.0), times, times)
        self.assertGreaterEqual(track._bytes((made, times)), 8 * (1000 + 1000 + 2000) + times.nbytes)
