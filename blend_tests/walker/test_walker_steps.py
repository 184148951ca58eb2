"""Steps that are dragged, turned and locked by hand: where the feet stand then, and what follows."""

import math
from unittest import mock

import bpy
import numpy as np
from mathutils import Quaternion, Vector

import support
from walker import walker_cases as cases
from walker.test_walker_carrier import on_board, ship
from walker.test_walker_soles import OWN, biped, slope, turn_of

FOOT, FRAME = "foot 2.L", 50
MOVED = Vector((-0.12, 0.07, 0.0))


def edit(owner, **changes):
    return bpy.ops.motus.walker_step(object=owner.name, **{"foot": FOOT, "frame": FRAME, **changes})


def foot_of(owner, name=FOOT):
    """Where a foot of a walker is on this frame."""
    return Vector(cases.places(owner)[[support.addon("walker.legs").label(leg) for leg in owner.motus.walker.legs].index(name)])


def stand(owner, name=FOOT, frame=FRAME):
    """A frame in the middle of the stand, or of the stand after the swing, that a foot has on a frame."""
    leg = [support.addon("walker.legs").label(leg) for leg in owner.motus.walker.legs].index(name)
    steps = cases.plan_of(owner).walker.steps
    row = np.flatnonzero((steps["leg"] == leg) & (steps["lift"] <= cases.seconds(frame)))[-1]
    return float(steps["middle"][row] / cases.seconds(1.0))


def height(x, y):
    return float(cases.waves(np.array(x), np.array(y)))


class Steps(cases.WalkerTestCase):
    def walking(self, **keywords):
        spider = cases.spider_on_waves(**keywords)
        middle = stand(spider)
        support.go_to(middle)
        return spider, middle

    def all_places(self, owner):
        return cases.over(sorted(cases.OFF_THE_FRAMES), lambda: cases.places(owner))

    def test_a_dragged_foot_stands_on_the_ground_there(self):
        spider, middle = self.walking()
        before, others = foot_of(spider), self.all_places(spider)
        self.assertEqual(edit(spider, location=before + MOVED), {'FINISHED'})
        for frame in (middle, middle - 1.0, middle + 0.25):
            support.go_to(frame)
            now = foot_of(spider)
            self.assertAlmostEqual(now.x, before.x + MOVED.x, delta=2e-4)
            self.assertAlmostEqual(now.y, before.y + MOVED.y, delta=2e-4)
            self.assertAlmostEqual(now.z, height(now.x, now.y), delta=3e-3)
        frames = sorted(cases.OFF_THE_FRAMES)
        changed = np.abs(self.all_places(spider) - others).max(axis=2) > 1e-6
        rows = [frame for frame, row in zip(frames, changed) if row.any()]
        self.assertTrue(rows and all(abs(frame - middle) < 40 for frame in rows), rows)
        self.assertEqual(np.flatnonzero(changed.any(axis=0)).tolist(), [cases.foot_bones(spider).index(FOOT)])
        self.assertWell(spider)
        # Once more, the same step: it keeps its entry.
        support.go_to(middle)
        edit(spider, location=before, frame=middle - 2.0)
        self.assertEqual(len(spider.motus.walker.steps), 1)
        self.assertLess((foot_of(spider) - before).length, 2e-3)

    def test_after_a_script_has_cleared_the_list(self):
        spider, middle = self.walking()
        before = foot_of(spider)
        edit(spider, location=before + MOVED)
        support.go_to(middle)
        spider.motus.walker.steps.clear()
        self.assertEqual(edit(spider, turn=0.3), {'FINISHED'})
        support.go_to(middle)
        self.assertEqual([round(step.turn, 6) for step in spider.motus.walker.steps], [0.3])
        self.assertLess((foot_of(spider) - before).length, 2e-3)

    def test_frames_in_any_order(self):
        spider, _ = self.walking()
        edit(spider, location=foot_of(spider) + MOVED)
        edit(spider, foot="foot 3.R", frame=30, lock=True)
        frames = sorted(set(cases.OFF_THE_FRAMES))
        played = dict(zip(frames, cases.over(frames, lambda: cases.places(spider))))
        for frame in cases.OFF_THE_FRAMES:
            support.go_to(frame)
            np.testing.assert_array_equal(cases.places(spider), played[frame])
        self.assertStands(spider, range(1, 100))

    def test_a_locked_foot_stays_whatever_body_and_ground_do(self):
        spider, middle = self.walking()
        before = foot_of(spider)
        edit(spider, lock=True)
        self.assertLess((foot_of(spider) - before).length, cases.SINGLE)
        spider.motus.walker.ground.location.z = 0.05
        support.key_places(spider, {90: (0.1, 2.0, 0.0)})
        support.go_to(1)
        support.go_to(middle)
        self.assertLess((foot_of(spider) - before).length, cases.SINGLE)
        # On nothing at all.
        edit(spider, frame=middle, location=before + Vector((0.0, 0.0, 0.2)))
        self.assertLess((foot_of(spider) - before - Vector((0.0, 0.0, 0.2))).length, cases.SINGLE)
        edit(spider, frame=middle, lock=False)
        self.assertAlmostEqual(foot_of(spider).z, height(before.x, before.y) + 0.05, delta=3e-3)

    def test_an_unlocked_foot_goes_on_from_where_it_stands(self):
        spider, middle = self.walking(location=(0.3, 0.0, 0.0))
        spider.rotation_euler.z = 0.4
        support.go_to(middle)
        before = foot_of(spider)
        edit(spider, frame=middle, lock=True)
        edit(spider, frame=middle, location=(before.x - 0.1, before.y, height(before.x - 0.1, before.y)))
        locked = foot_of(spider)
        edit(spider, frame=middle, lock=False)
        self.assertLess((foot_of(spider) - locked).length, 2e-3)
        self.assertFalse(spider.motus.walker.steps[0].is_locked)

    def test_a_turned_foot(self):
        body, feet = biped(ground=cases.grid("Land", slope).name)
        middle = stand(body, feet[0].name)
        support.go_to(middle)
        flat = Quaternion(turn_of(feet[0])) @ OWN.inverted()
        edit(body, foot=feet[0].name, frame=middle, turn=0.5)
        up = flat @ Vector((0.0, 0.0, 1.0))
        wanted = Quaternion(up, 0.5) @ flat @ OWN
        self.assertLess(wanted.rotation_difference(turn_of(feet[0])).angle % (2.0 * math.pi), 5e-5)
        edit(body, foot=feet[0].name, frame=middle, lock=True)
        self.assertLess(wanted.rotation_difference(turn_of(feet[0])).angle % (2.0 * math.pi), 5e-5)
        self.assertAlmostEqual(body.motus.walker.steps[0].turn, 0.5)
        self.assertWell(body)

    def test_settings_arrive(self):
        spider, _ = self.walking()
        native = support.addon("core.native").module
        edit(spider, turn=0.25, location=foot_of(spider) + MOVED)
        edit(spider, foot="foot 1.R", lock=True)
        entries = spider.motus.walker.steps
        with mock.patch.object(native, "Walker", wraps=native.Walker) as made:
            entries[0].turn = 0.5
            bpy.context.view_layer.update()
        moved, locked = made.call_args.kwargs["chosen"]
        self.assertEqual(
            moved, (cases.foot_bones(spider).index(FOOT), cases.seconds(entries[0].frame), tuple(entries[0].offset), 0.5, None, None, None)
        )
        self.assertEqual(locked[4], (tuple(entries[1].place), tuple(entries[1].rotation)))
        self.assertEqual(locked[2], (0.0, 0.0, 0.0))
        for name, wrong in (("frame", math.inf), ("turn", math.nan), ("offset", (math.nan, 0.0, 0.0)), ("place", (0.0, math.inf, 0.0))):
            before = getattr(entries[1], name)
            before = tuple(before) if name in {"offset", "place"} else before
            setattr(entries[1], name, wrong)
            self.assertEqual(self.sentence(spider), "Changed Steps is not a finite number")
            setattr(entries[1], name, before)
        self.assertWell(spider)

    def test_removing_restores_exactly(self):
        spider, _ = self.walking()
        before = self.all_places(spider)
        edit(spider, location=foot_of(spider) + MOVED)
        edit(spider, foot="foot 1.R", lock=True)
        self.assertEqual(bpy.ops.motus.walker_step_remove(object=spider.name, index=0), {'FINISHED'})
        self.assertEqual(len(spider.motus.walker.steps), 1)
        self.assertEqual(bpy.ops.motus.walker_step_remove(object=spider.name), {'FINISHED'})
        np.testing.assert_array_equal(self.all_places(spider), before)
        with self.assertRaisesRegex(RuntimeError, "No step of Spider was changed"):
            bpy.ops.motus.walker_step_remove(object=spider.name)

    def test_a_drag_that_is_given_up_leaves_nothing(self):
        spider, middle = self.walking()
        before = foot_of(spider)
        chosen = support.addon("walker.steps.chosen")
        leg = cases.foot_bones(spider).index(FOOT)
        made = chosen.Edit(bpy.context, spider, chosen.step_at(bpy.context, spider, leg, middle))
        self.assertEqual(len(spider.motus.walker.steps), 0)
        made.move(before + MOVED)
        made.restore()
        self.assertEqual(len(spider.motus.walker.steps), 0)
        edit(spider, location=before + MOVED, turn=0.2)
        entry = spider.motus.walker.steps[0]
        kept = tuple(entry.offset), entry.turn
        again = chosen.Edit(bpy.context, spider, chosen.step_at(bpy.context, spider, leg, middle))
        again.turn(1.0)
        again.lock()
        again.move(before)
        again.restore()
        self.assertEqual((tuple(entry.offset), entry.turn, entry.is_locked), (*kept, False))

    def test_steps_follow_their_feet_when_legs_change(self):
        body, _, feet = cases.cross(legs=4)
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names(feet), gait='TROT')
        support.key_places(body, {1: (0.0, 0.0, 0.0), 90: (0.0, 4.0, 0.0)})
        support.go_to(40)
        for foot in feet[1:3]:
            edit(body, foot=foot.name, frame=40, turn=0.1)
        bpy.ops.motus.walker_add(object=body.name, feet=cases.names([feet[3], feet[2], feet[0]]))
        self.assertEqual([(step.leg, step.is_locked) for step in body.motus.walker.steps], [(1, False)])
        self.assertWell(body)

    def test_a_copy_has_its_own(self):
        spider, middle = self.walking()
        edit(spider, location=foot_of(spider) + MOVED)
        copy = spider.copy()
        copy.data = spider.data.copy()
        bpy.context.scene.collection.objects.link(copy)
        bpy.context.view_layer.update()
        spider.motus.walker.steps[0].offset.x -= 0.05
        support.go_to(1)
        support.go_to(middle)
        self.assertAlmostEqual((foot_of(copy) - foot_of(spider)).length, 0.05, delta=2e-2)

    def test_on_a_carrier(self):
        carrier, deck = ship()
        spider = cases.spider(ground=deck.name, carrier=carrier.name)
        on_board(spider, carrier)
        middle = stand(spider)
        support.go_to(middle)
        before = foot_of(spider)
        ahead = support.evaluated(carrier).matrix_world.to_quaternion() @ Vector((0.1, 0.05, 0.0))
        edit(spider, location=before + ahead)
        now = foot_of(spider)
        self.assertLess((now - before - ahead).length, 0.04)
        edit(spider, lock=True)
        self.assertLess((foot_of(spider) - now).length, 1e-5)

    def test_refusals(self):
        spider, _ = self.walking()
        for changes, sentence in (
            ({}, "Say what to change of the step: location, turn or lock is missing"),
            ({"foot": "Tail", "turn": 1.0}, "Spider has no foot Tail"),
            ({"turn": math.nan}, "(?i)turn"),
            ({"location": (math.inf, 0.0, 0.0)}, "(?i)location"),
        ):
            with self.assertRaisesRegex(RuntimeError, sentence):
                edit(spider, **changes)
        self.assertEqual(len(spider.motus.walker.steps), 0)
        edit(spider, turn=1.0)
        with self.assertRaisesRegex(RuntimeError, "Spider has no such step"):
            bpy.ops.motus.walker_step_remove(object=spider.name, index=7)
        spider.scale = (0.0, 0.0, 0.0)
        support.go_to(FRAME)
        with self.assertRaisesRegex(RuntimeError, "scaled to nothing"):
            edit(spider, location=(0.0, 0.0, 0.0))
