"""Things that systems drive are known at any times: shared by the tests of the systems that say where."""

import bpy
import numpy as np

import support
from support import evaluated


def track(thing):
    return support.addon("core.tracks").world_track(thing, bpy.context.scene)


def world(thing, frame):
    """World matrix of an Object or PoseBone on a frame."""
    support.go_to(frame)
    found = evaluated(thing)
    return np.array(found.id_data.matrix_world @ found.matrix if found != found.id_data else found.matrix_world)


class Solved:
    """Mixin of test cases. label: of the system that is asked."""

    label = ""
    frames = (-3.0, 1.0, 2.5, 13.0, 24.25, 60.0, 120.0)

    def assertSolved(self, thing, tolerance=5e-6):
        """Blender itself comes to what is said of the thing at all times, and the evaluated thing says the same."""
        found = track(thing)
        self.assertEqual(found.kind, support.addon("core.tracks").Kind.SOLVED, found.sentence)
        self.assertIn(self.label, found.sentence)
        wanted = np.array([world(thing, frame) for frame in self.frames])
        values = track(thing).values(self.frames)
        np.testing.assert_allclose(values, wanted, atol=tolerance * max(1.0, np.abs(wanted).max()))
        np.testing.assert_array_equal(track(evaluated(thing)).values(self.frames), values)

    def assertUnknown(self, thing, part):
        self.assertEqual(track(thing).kind, support.addon("core.tracks").Kind.RECORDED)
        self.assertIn(part, track(thing).sentence)
