"""What is kept of tracks: as much as there is room for."""

import weakref

import numpy as np
import support


class Kept(support.SceneTestCase):
    def test_no_more_is_kept_than_there_is_room_for(self):
        track = support.addon("core.tracks.track")
        quarter = track.LARGEST_MEMORY // 4
        made = []

        def make():
            found = np.zeros(quarter, np.uint8)  # memory that nobody writes takes none
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

    def test_native_tracks_tell_their_memory(self):
        track, module = support.addon("core.tracks.track"), support.addon("core.native").module
        times = np.arange(1000.0)
        made = module.Track(module.SecondOrder(1.0, 0.5, 0.0), times, times)
        self.assertGreaterEqual(track._bytes((made, times)), 8 * (1000 + 1000 + 2000) + times.nbytes)
