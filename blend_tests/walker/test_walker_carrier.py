"""Walkers on ground that moves: a ship, a lift, a turntable."""

import math

import bpy
import numpy as np
from mathutils import Matrix

import solved_cases
import support
from walker import walker_cases as cases


def ship(**keyed):
    """A carrier that goes, rises and turns, of any scale, with a deck that hangs on it; (carrier, deck)."""
    carrier = support.link("Ship")
    carrier.scale = (2.0, 1.0, 1.0)
    deck = cases.grid("Deck", cases.waves)
    deck.parent = carrier
    deck.scale.x = 0.5
    for frame, place, heading in ((1, (0.0, 0.0, 0.0), 0.0), (120, (3.0, -2.0, 1.0), 1.2)):
        carrier.location, carrier.rotation_euler = place, (0.1 * heading, 0.0, heading)
        for path in ("location", "rotation_euler"):
            carrier.keyframe_insert(path, frame=frame)
    support.go_to(1)
    return carrier, deck


def on_board(spider, carrier):
    """Have a spider go along with a carrier, whose scale it does not get."""
    rider = support.link("Rider", parent=carrier)
    rider.scale = (0.5, 1.0, 1.0)
    spider.parent = rider
    support.go_to(bpy.context.scene.frame_current)


def in_space(carrier, places):
    """Places (n, 3) of the world in the space of a carrier."""
    location, rotation, _ = support.evaluated(carrier).matrix_world.decompose()
    inverse = np.array((Matrix.Translation(location) @ rotation.to_matrix().to_4x4()).inverted())
    return places @ inverse[:3, :3].T + inverse[:3, 3]


class Carriers(solved_cases.Solved, cases.WalkerTestCase):
    label = "Walker"

    def test_feet_stand_on_a_deck_that_moves(self):
        carrier, deck = ship()
        spider = cases.spider(ground=deck.name, carrier=carrier.name)
        on_board(spider, carrier)
        self.assertWell(spider)
        frames = list(range(1, 121, 2))
        walker = cases.plan_of(spider).walker
        found = cases.over(frames, lambda: in_space(carrier, cases.places(spider)))
        swings = walker.swing(cases.seconds(np.array(frames, float)))
        still = (swings[1:] == 0.0) & (swings[:-1] == 0.0)
        moved = np.abs(np.diff(found, axis=0)).max(axis=2)
        self.assertGreater((moved > 0.05).sum(), 20)
        self.assertLess(np.quantile(moved[still], 0.9), 5e-6)
        standing = found[swings == 0.0]
        np.testing.assert_allclose(standing[:, 2], cases.waves(standing[:, 0], standing[:, 1]), atol=3e-3)

    def test_a_body_that_rests_on_a_turntable_does_not_step(self):
        carrier, deck = ship()
        spider = cases.spider(ahead=0.0, ground=deck.name, carrier=carrier.name)
        on_board(spider, carrier)
        steps = cases.plan_of(spider).walker.steps
        self.assertEqual(int((steps["touch"] > steps["lift"]).sum()), 0)
        support.go_to(70)
        np.testing.assert_allclose(
            in_space(carrier, cases.places(spider))[:, :2], [tuple(leg.rest)[:2] for leg in spider.motus.walker.legs], atol=2e-3
        )

    def test_who_stands_still_walks_on_a_belt(self):
        belt = support.link("Belt")
        deck = cases.grid("Deck", lambda x, y: 0.0 * x)
        deck.parent = belt
        support.key_places(belt, {1: (0.0, 0.0, 0.0), 100: (0.0, -2.0, 0.0)})
        spider = cases.spider(ahead=0.0, ground=deck.name, carrier=belt.name)
        steps = cases.plan_of(spider).walker.steps
        self.assertGreater(int((steps["touch"] > steps["lift"]).sum()), 8)
        support.go_to(50)
        np.testing.assert_allclose(cases.places(spider).mean(axis=0)[:2], (0.0, 0.0), atol=0.15)
        self.assertWell(spider)

    def test_frames_in_any_order(self):
        carrier, deck = ship()
        spider = cases.spider(ground=deck.name, carrier=carrier.name)
        on_board(spider, carrier)
        frames = sorted(set(cases.OFF_THE_FRAMES))
        played = dict(zip(frames, cases.over(frames, lambda: cases.places(spider))))
        for frame in cases.OFF_THE_FRAMES:
            support.go_to(frame)
            np.testing.assert_array_equal(cases.places(spider), played[frame])
        bpy.ops.wm.open_mainfile(filepath=self.save())
        support.go_to(57)
        np.testing.assert_array_equal(cases.places(bpy.data.objects["Spider"]), played[57])

    def test_over_time(self):
        carrier, deck = ship()
        spider = cases.spider(ground=deck.name, carrier=carrier.name)
        on_board(spider, carrier)
        spider.motus.walker.use_soles = True
        bpy.context.view_layer.update()
        for name in ("foot 2.L", "body"):
            with self.subTest(name):
                self.assertSolved(spider.pose.bones[name], 1e-4)

    def test_what_does_not_go_along_is_left_out(self):
        carrier, _ = ship()
        land = cases.grid("Land", cases.waves)
        spider = cases.spider(ground=land.name, carrier=carrier.name)
        self.assertIn("does not go along with the carrier", self.sentence(spider))

    def test_a_carrier_that_is_deleted(self):
        carrier, deck = ship()
        spider = cases.spider(ground=deck.name, carrier=carrier.name)
        bpy.ops.object.select_all(action='DESELECT')
        carrier.select_set(True)
        bpy.ops.object.delete()
        support.go_to(3)
        self.assertIn("carrier is gone", self.sentence(spider))

    def test_a_carrier_whose_motion_is_not_known(self):
        carrier, deck = ship()
        spider = cases.spider(ground=deck.name, carrier=carrier.name)
        carrier.constraints.new('COPY_LOCATION').target = support.link("Wind", location=(0.0, 0.0, 1.0))
        support.go_to(30)
        self.assertIn("carrier's motion is not known", self.sentence(spider))
        self.assertTrue(math.isfinite(cases.places(spider).sum()))

    def test_who_walks_carries_no_ground(self):
        spider = cases.spider(ahead=0.0)
        other = cases.spider(ahead=0.0)
        with self.assertRaisesRegex(RuntimeError, "carries no ground"):
            bpy.ops.motus.walker_add(object=other.name, carrier=spider.name)
