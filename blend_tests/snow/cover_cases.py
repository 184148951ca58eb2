"""Shared by the tests of lying snow: adding it, its layer as evaluated, and forgetting what was worked out."""

import bpy
import numpy as np

import support
from snow.snow_cases import SnowTestCase

SQUARE = [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)]
FALLING = {"rate": 300.0, "start_speed": 2.0, "lifetime": 4.0, "emitter_radius": 1.9, "location": (0.0, 0.0, 3.0), "seed": 3}
LUMP = 0.1
COARSE = {"lump": LUMP, "resolution": 0.5}


def cover_system():
    return support.addon("snow").COVER


def forget_work():
    """Let all be computed as if nothing had been before."""
    support.addon("snow.cover.work")._done.clear()
    support.addon("snow.cover.ground")._grounds.clear()
    support.addon("snow.flakes")._snows.clear()


def layer(cover):
    """Positions (n, 3), depths (n,) and triangles (m, 3) of the layer, in world space."""
    mesh = cover.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    positions = np.empty(3 * len(mesh.vertices), np.float32)
    depths = np.empty(len(mesh.vertices), np.float32)
    triangles = np.empty(3 * len(mesh.polygons), np.int32)
    mesh.vertices.foreach_get("co", positions)
    mesh.loops.foreach_get("vertex_index", triangles)
    if len(depths):
        mesh.attributes["depth"].data.foreach_get("value", depths)
    return positions.reshape(-1, 3), depths, triangles.reshape(-1, 3)


def state(cover):
    return b"".join(array.tobytes() for array in layer(cover))


def volume(found):
    """m^3 between a layer and the plane z = 0."""
    positions, _, triangles = found
    a, b, c = (positions[triangles[:, corner]].astype(float) for corner in range(3))
    return float((np.cross(b - a, c - a)[:, 2] * (a + b + c)[:, 2]).sum() / 6.0)


class CoverTestCase(SnowTestCase):
    def setUp(self):
        super().setUp()
        forget_work()

    def square(self, name="Meadow", place=(0.0, 0.0, 0.0)):
        return self.mesh(name, SQUARE, [(0, 1, 2, 3)], place)

    def cover(self, surfaces="Meadow", **keywords):
        """The snow that lies on surfaces."""
        self.assertEqual(bpy.ops.motus.snow_cover_add(surfaces=surfaces, **(COARSE | keywords)), {'FINISHED'})
        return bpy.context.object

    def output(self, cover, name):
        return support.addon("core.wiring").output(cover_system(), cover, name, bpy.context.evaluated_depsgraph_get())

    def cover_sentence(self, cover):
        bpy.context.view_layer.update()
        problem = support.addon("core.wiring").problem(cover_system(), cover, bpy.context.evaluated_depsgraph_get())
        return problem.sentence if problem else ""
