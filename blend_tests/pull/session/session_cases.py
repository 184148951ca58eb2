"""Shared by the tests of sessions: making one on an object, strokes of dabs at vertices, and a mesh's positions as bytes."""

import sys

import bpy
import numpy as np

import support
from pull.pull_cases import PullTestCase

DOWN = (0.0, 0.0, -1.0)


class SessionTestCase(PullTestCase):
    def setUp(self):
        super().setUp()
        package = support.addon("pull").__name__
        names = "session.dab", "brush", "session.history"
        self.dab, self.brushes, self.history = (sys.modules[f"{package}.{name}"] for name in names)

    def session(self, obj, **changes):
        values = {"radius": 0.5, "strength": 0.2, "direction": 'Z', **changes}
        return self.dab.Session(bpy.context, obj, self.brushes.Brush(**values))

    def stroke(self, session, *vertices):
        session.begin_stroke()
        for vertex in vertices:
            self.assertTrue(session.pull(vertex, session.displacement(vertex)))

    def bits(self, obj):
        found = np.empty(3 * len(obj.data.vertices), np.float32)
        obj.data.vertices.foreach_get("co", found)
        return found.tobytes()
