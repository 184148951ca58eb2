"""The demo of chains: tail, ears and leash of a dog, a bridge under a spider and flags all hang, swing and hold where they are pinned."""

import unittest
from typing import NamedTuple

import bpy
import numpy as np

import support
from demo import demo_cases

bridge, dog_motion, gorge = (support.addon(f"demo.chains.{name}") for name in ("bridge", "dog_motion", "gorge"))
CHAINS = {"Dog": 4, "Bridge Deck": 2, "Bridge Rails": 2, "Flags": 2}
PINS = {"Dog": 1, "Bridge Deck": 2, "Bridge Rails": 2, "Flags": 2}
PINNED, ENTERED = 1e-3, 3e-3  # m
STEP = 4  # frames from one that is looked at to the next


class Moment(NamedTuple):
    """What a frame shows, in the world: matrices of bones by rig and name, tails of bones too, and of other things."""

    bones: dict
    tails: dict
    things: dict


class WindyBridge(unittest.TestCase):
    """All tests look at one scene, which takes some seconds to build, and at the same frames of it."""

    @classmethod
    def setUpClass(cls):
        support.empty_scene()
        cls.own = bpy.context.scene
        cls.own.frame_set(7)
        cls.result = demo_cases.build('CHAINS')
        cls.scene = bpy.context.window.scene
        cls.rigs = {name: cls.scene.objects[name] for name in CHAINS}
        cls.played = {frame: cls.moment(frame) for frame in range(1, cls.scene.frame_end + 1, STEP)}

    @classmethod
    def tearDownClass(cls):
        support.empty_scene()

    @classmethod
    def moment(cls, frame):
        cls.scene.frame_set(frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        bones, tails = {}, {}
        for name, rig in cls.rigs.items():
            posed = rig.evaluated_get(depsgraph)
            bones[name] = {bone.name: np.array(posed.matrix_world @ bone.matrix) for bone in posed.pose.bones}
            tails[name] = {bone.name: np.array(posed.matrix_world @ bone.tail) for bone in posed.pose.bones}
        things = {thing.name: np.array(thing.evaluated_get(depsgraph).matrix_world) for thing in cls.scene.objects}
        return Moment(bones, tails, things)

    def row(self, rig, stem):
        """Tails of the bones of a row, (frames, bones, 3). stem: what their names begin with, before the number."""
        stem, dot, side = stem.partition(".")
        names = [name for name in self.rigs[rig].data.bones.keys() if name.startswith(f"{stem} ") and name.endswith(dot + side)]
        return np.array(
            [[moment.tails[rig][name] for name in names if name.count(" ") == stem.count(" ") + 1] for moment in self.played.values()]
        )

    # --- the scene ------------------------------------------------------------------------------------------------

    def test_in_a_scene_of_its_own(self):
        self.assertEqual(self.result, {'FINISHED'})
        self.assertNotEqual(self.scene, self.own)
        self.assertEqual((self.own.frame_current, list(self.own.objects)), (7, []))

    def test_counts(self):
        self.assertEqual({name: len(rig.motus.chains.entries) for name, rig in self.rigs.items()}, CHAINS)
        self.assertEqual({name: len(rig.motus.chains.pins) for name, rig in self.rigs.items()}, PINS)
        self.assertTrue(all(rig.motus.chains.gusts > 0.0 for rig in self.rigs.values()))
        self.assertTrue(120 <= self.scene.frame_end <= 200)

    def test_nothing_is_wrong(self):
        """No panel has anything to complain about, while the dog walks, bows and stands."""
        wiring, systems = support.addon("core.wiring"), support.addon("core.declare").systems()
        for frame in (1, 30, dog_motion.BOW, self.scene.frame_end):
            self.scene.frame_set(frame)
            depsgraph = bpy.context.evaluated_depsgraph_get()
            for thing in self.scene.objects:
                for system in systems:
                    if getattr(thing.motus, system.name).is_active:
                        self.assertIsNone(wiring.problem(system, thing, depsgraph), (frame, thing.name, system.name))

    # --- the dog --------------------------------------------------------------------------------------------------

    def test_tail_and_ears_swing(self):
        """Their tips move on the bones that they hang on, and are elsewhere than the animation alone has them."""
        rest = self.rigs["Dog"].data.bones
        for tip, base, least in (("tail 7", "body", 0.10), ("ear 5.L", "head", 0.05), ("ear 5.R", "head", 0.05)):
            places = [
                (np.linalg.inv(moment.bones["Dog"][base]) @ np.append(moment.tails["Dog"][tip], 1.0))[:3] for moment in self.played.values()
            ]
            self.assertGreater(np.ptp(places, axis=0).max(), least, tip)
            still = np.array(rest[base].matrix_local.inverted() @ rest[tip].tail_local)
            self.assertGreater(np.abs(np.array(places) - still).max(), least, tip)

    def test_feet_do_not_slide_while_it_stands(self):
        frames = [frame for frame in self.played if frame >= dog_motion.WAY[-1][0] + 24]
        for name in ("foot 1.L", "foot 1.R", "foot 2.L", "foot 2.R"):
            places = [self.played[frame].bones["Dog"][name][:3, 3] for frame in frames]
            self.assertLess(np.ptp(places, axis=0).max(), 1e-3, name)

    def test_leash_is_tied_at_both_ends(self):
        for frame, moment in self.played.items():
            neck, first = moment.bones["Dog"]["neck"], moment.bones["Dog"]["leash 1"][:3, 3]
            at_collar = (np.linalg.inv(neck) @ np.append(first, 1.0))[:3]
            rest = self.rigs["Dog"].data.bones
            where = rest["neck"].matrix_local.inverted() @ rest["leash 1"].head_local
            self.assertLess(np.abs(at_collar - np.array(where)).max(), PINNED, frame)
            end = moment.tails["Dog"][f"leash {dog_motion.LEASH_BONES}"]
            self.assertLess(np.linalg.norm(end - moment.things["Leash Knot"][:3, 3]), PINNED, frame)

    def test_leash_lies_on_the_ground_and_in_no_ball(self):
        balls = [(name, radius) for name, (_, _, radius) in zip(self.balls(), dog_motion.BALLS)]
        links = self.row("Dog", "leash")
        thickness = dog_motion.LEASH["thickness"]
        self.assertLess(links[..., 2].min(), 0.04)
        self.assertGreater(links[..., 2].min(), self.scene.objects["Dog Ground"].location.z + thickness - ENTERED)
        for (frame, moment), places in zip(self.played.items(), links):
            for name, radius in balls:
                far = np.linalg.norm(places - moment.things[name][:3, 3], axis=1).min()
                self.assertGreater(far, radius + thickness - ENTERED, (frame, name))

    def balls(self):
        """Names of the balls of the dog, in the order of dog_motion.BALLS."""
        return [thing.name for thing in self.scene.objects if thing.name.startswith("Dog Ball")]

    # --- the bridge and the flags ---------------------------------------------------------------------------------

    def test_ropes_hold_at_both_ends(self):
        for frame, moment in self.played.items():
            for name in ("Bridge Deck", "Bridge Rails", "Flags"):
                for pin in self.rigs[name].motus.chains.pins:
                    away = moment.tails[name][pin.name] - moment.things[pin.target.name][:3, 3]
                    self.assertLess(np.linalg.norm(away), PINNED, (frame, pin.name))

    def test_ropes_keep_their_lengths(self):
        for name, stem in (("Bridge Deck", "deck.L"), ("Bridge Rails", "rail.R")):
            lengths = np.linalg.norm(np.diff(self.row(name, stem), axis=1), axis=2)
            self.assertLess(np.ptp(lengths, axis=0).max(), 1e-3, name)

    def test_bridge_is_pressed_down_and_not_entered(self):
        for name, stem in (("Bridge Deck", "deck.L"), ("Bridge Deck", "deck.R"), ("Bridge Rails", "rail.L")):
            nearest = []
            for moment, places in zip(self.played.values(), self.row(name, stem)):
                ball = moment.things[f"{name} Load"][:3, 3]
                nearest.append(np.linalg.norm(places - ball, axis=1).min() - bridge.LOAD_SIZE)
            self.assertGreater(min(nearest), -ENTERED, stem)
            self.assertLess(np.median(nearest), 0.02, stem)

    def test_planks_are_below_the_feet(self):
        way = bridge.way(200)
        for frame, moment in self.played.items():
            spider = moment.things["Spider"][:3, 3]
            if not -gorge.SPAN + 0.6 < spider[0] < -0.6:
                continue
            joints = np.array(
                [moment.tails["Bridge Deck"][f"deck {index}.{side}"] for index in range(1, bridge.COUNT + 1) for side in "LR"]
            )
            near = joints[np.abs(joints[:, 0] - spider[0]) < 0.3]
            on_way = np.interp(near[:, 0], way[:, 0], way[:, 1])
            self.assertLess(np.abs(near[:, 2] + bridge.PLANK_TOP - on_way).max(), 0.03, frame)

    def test_bridge_and_flags_sway(self):
        deck = self.row("Bridge Deck", "deck.L")[:, bridge.COUNT // 2]
        self.assertTrue(0.02 < np.ptp(deck[:, 1]) < 0.3, np.ptp(deck[:, 1]))
        flag = self.row("Flags", "Line 7 Flag")[:, -1]
        self.assertGreater(np.ptp(flag, axis=0).max(), 0.05)

    # --- in any order ---------------------------------------------------------------------------------------------

    def test_frames_in_any_order(self):
        for frame in (181, 5, 1, 97, 61):
            alone = self.moment(frame)
            for name, bones in self.played[frame].bones.items():
                for bone, matrix in bones.items():
                    np.testing.assert_array_equal(alone.bones[name][bone], matrix, f"{frame} {bone}")
