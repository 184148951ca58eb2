"""Footprints: a mark for each step, there from the frame on which the foot touches the ground."""

import math

import bpy
import numpy as np

import support
from walker import walker_cases as cases
from walker.test_walker_carrier import on_board, ship
from walker.test_walker_soles import biped, slope

CORNERS = 33
"""Points of a mark."""


def add(owner, **keywords):
    assert bpy.ops.motus.walker_prints(object=owner.name, **keywords) == {'FINISHED'}
    return bpy.data.objects[f"{owner.name} Footprints"]


def marks(obj):
    """Points (n, points of a mark, 3) in the world of the marks that are there on this frame."""
    seen = support.evaluated(obj)
    found = np.array([tuple(seen.matrix_world @ vertex.co) for vertex in seen.data.vertices])
    return found.reshape(-1, CORNERS, 3)


class Footprints(cases.WalkerTestCase):
    def test_marks_lie_where_feet_have_stood_so_far(self):
        land = cases.grid("Land", slope)
        body, _ = biped(ground=land.name)
        walker = cases.plan_of(body).walker
        prints = add(body)
        steps = walker.steps
        normal = np.array((-0.2, 0.15, 1.0)) / math.sqrt(1.0 + 0.2**2 + 0.15**2)
        for frame in (60, 1, 20.5, 118, 40):
            support.go_to(frame)
            found = marks(prints)
            rows = np.flatnonzero(steps["touch"] <= cases.seconds(frame))
            self.assertEqual(len(found), len(rows))
            # The middle of a sole from 6 cm behind the ankle to 15 cm ahead of it, on the ground under it.
            for mark, row in zip(found, rows):
                away = mark[0] - (steps["end"][row] - 0.1 * normal)
                self.assertAlmostEqual(np.linalg.norm(away - (away @ normal) * normal), 0.045, delta=2e-3)
                self.assertAlmostEqual(np.ptp(mark @ _ahead(steps["turn"][row])), 0.21, delta=3e-3)
                height = mark[:, 2] - slope(mark[:, 0], mark[:, 1])
                self.assertTrue((height > 0.0).all() and (height < 0.01).all(), height)

    def test_sizes(self):
        body, _, feet = cases.cross()
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), stride=0.5, use_plane=True)
        body.scale = 3 * [2.0]
        support.key_places(body, {1: (0.0, 0.0, 0.0), 90: (0.0, 4.0, 0.0)})
        support.go_to(100)
        first = add(body)
        np.testing.assert_allclose(np.ptp(marks(first)[0], axis=0)[:2], (0.4 * 0.3, 0.3), rtol=0.03)
        bpy.data.objects.remove(first)
        np.testing.assert_allclose(np.ptp(marks(add(body, length=0.8, width=0.2))[0], axis=0)[:2], (0.2, 0.8), rtol=0.03)

    def test_on_a_carrier_marks_go_along(self):
        carrier, deck = ship()
        spider = cases.spider(ground=deck.name, carrier=carrier.name)
        on_board(spider, carrier)
        prints = add(spider)
        walker = cases.plan_of(spider).walker
        for frame in (90, 118):
            support.go_to(frame)
            steps = cases.plan_of(spider).walker.steps_at(cases.seconds(frame))
            rows = np.flatnonzero(walker.steps["touch"] <= cases.seconds(frame))
            found = marks(prints)
            self.assertEqual(len(found), len(rows))
            self.assertLess(np.linalg.norm(found[:, 0] - steps["end"][rows], axis=1).max(), 0.03)

    def test_a_body_that_does_not_walk_is_refused(self):
        with self.assertRaisesRegex(RuntimeError, "Nothing here walks"):
            bpy.ops.motus.walker_prints(object=support.link("Stone").name)


def _ahead(turn):
    w, x, y, z = turn
    return np.array((2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)))
