"""Pins of chains: where they hold, for how long, what they hold to, and how they are added and removed."""

import bpy
import numpy as np

import solved_cases
import support
from chains import chain_cases as cases
from dynamics import dynamics_cases

FRAMES = (1, 8, 13.5, 20, 26, 31.25, 90)
LIMP = {"frequency": 0.0, "drag": 1.0}


def catenary(count, length, span):
    """Joints (count + 1, 2), along and up, of links of one length that hang between two places at one height.

    Each joint weighs the same, so the tangents of the links' slopes rise by equal steps.
    """
    steps = np.arange(count) - (count - 1) / 2.0
    least, most = 0.0, 1e3
    for _ in range(200):
        step = (least + most) / 2.0
        if length * np.cos(np.arctan(step * steps)).sum() > span:
            least = step
        else:
            most = step
    slopes = np.arctan(least * steps)
    links = length * np.stack([np.cos(slopes), np.sin(slopes)], axis=1)
    return np.concatenate([np.zeros((1, 2)), np.cumsum(links, axis=0)])


def pin(rig, **keywords):
    bpy.ops.motus.chains_pin(object=rig.name, **keywords)
    bpy.context.view_layer.update()
    return rig.motus.chains.pins[rig.motus.chains.active_pin]


class ChainsPinsTest(support.SceneTestCase):
    def bridge(self, count=20, span=4.0):
        """A limp rope that hangs from its root to a post at the same height."""
        rig = cases.still_rope(count)
        post = support.link("Post", location=cases.place(rig, 1, "Tail 0 0") + (span, 0.0, 0.0))
        cases.add(rig, **LIMP, settle=60.0)
        return rig, post, pin(rig, target="Post")

    def test_between_two_ends_it_hangs_as_the_catenary(self):
        rig, post, held = self.bridge()
        self.assertEqual((held.name, held.target, held.weight), ("Tail 0 19", post, 1.0))
        self.assertIsNone(cases.problem(rig))
        root = cases.place(rig, 1, "Tail 0 0")
        along = catenary(20, cases.LENGTH, 4.0)
        wanted = root + np.stack([along[:, 0], np.zeros(21), along[:, 1]], axis=1)
        for frame in (1, 100):
            found = [root, *cases.tails(rig, frame, cases.chain(rig))]
            np.testing.assert_allclose(found, wanted, atol=1e-3 * 20 * cases.LENGTH)
        self.assertGreater(np.ptp(wanted[:, 2]), 1.0)

    def test_any_frame_in_any_order(self):
        rig, post, _ = self.bridge(6, 1.2)
        dynamics_cases.key(post, "location", {1: post.location, 30: post.location + post.location.normalized()})
        first = {frame: cases.matrix(rig, frame, "Tail 0 5").tobytes() for frame in FRAMES}
        support.addon().forget_all()
        for frame in reversed(FRAMES):
            self.assertEqual(cases.matrix(rig, frame, "Tail 0 5").tobytes(), first[frame])

    def test_it_follows_what_holds_it(self):
        rig, post, _ = self.bridge(6, 1.2)
        start = np.array(post.location)
        dynamics_cases.key(post, "location", {1: start, 10: start, 20: start + (0.2, 0.3, -0.1)})
        for frame in (1, 14, 15.5, 20, 60):
            np.testing.assert_allclose(cases.tail(rig, frame, "Tail 0 5"), cases.place(post, frame), atol=2e-3)
        # Without a target bone it is the origin of a rig, with one the head of the bone.
        other = cases.rope(2, name="Other")
        other.location = start
        held = rig.motus.chains.pins[0]
        held.target = other
        np.testing.assert_allclose(cases.tail(rig, 1, "Tail 0 5"), start, atol=2e-3)
        other.location -= other.matrix_world.to_3x3() @ other.data.bones["Tail 0 0"].head_local
        held.target_bone = "Tail 0 0"
        bpy.context.view_layer.update()
        np.testing.assert_allclose(cases.tail(rig, 1, "Tail 0 5"), cases.place(other, 1, "Tail 0 0"), atol=2e-3)

    def test_without_weight_it_holds_nothing(self):
        rig, _, held = self.bridge(6, 1.2)
        root = cases.place(rig, 1, "Tail 0 0")
        straight = root - (0.0, 0.0, 6 * cases.LENGTH)
        self.assertGreater(np.linalg.norm(cases.tail(rig, 1, "Tail 0 5") - straight), 1.0)
        held.weight = 0.0
        np.testing.assert_allclose(cases.tail(rig, 1, "Tail 0 5"), straight, atol=5e-3)
        held.weight, held.is_muted = 1.0, True
        np.testing.assert_allclose(cases.tail(rig, 1, "Tail 0 5"), straight, atol=5e-3)
        held.is_muted = False
        self.assertGreater(np.linalg.norm(cases.tail(rig, 1, "Tail 0 5") - straight), 1.0)

    def test_a_keyed_weight_lets_go(self):
        rig, post, held = self.bridge(6, 1.2)
        for frame, weight in ((1, 1.0), (20, 1.0), (21, 0.0)):
            held.weight = weight
            held.keyframe_insert("weight", frame=frame)
        self.assertIsNone(cases.problem(rig))
        for frame in (1, 10, 20):
            np.testing.assert_allclose(cases.tail(rig, frame, "Tail 0 5"), cases.place(post, frame), atol=2e-3)
        heights = [cases.tail(rig, frame, "Tail 0 5")[2] for frame in (20, 24, 28)]
        self.assertLess(heights[1], heights[0] - 0.05)
        self.assertLess(heights[2], heights[1] - 0.3)
        found = cases.tail(rig, 28, "Tail 0 5")
        support.addon().forget_all()
        np.testing.assert_array_equal(cases.tail(rig, 28, "Tail 0 5"), found)

    def told(self, rig):
        problem = cases.problem(rig)
        return problem and support.addon("chains.told").sentence(rig, problem, bpy.context.scene)

    def test_what_is_not_known(self):
        rig, post, held = self.bridge(3, 0.5)
        curve = held.driver_add("weight")
        curve.driver.expression = "frame"
        cases.go_to(3)
        self.assertIn("weight of a pin", self.told(rig))
        held.driver_remove("weight")
        rig.update_tag()
        post.constraints.new('COPY_LOCATION').target = support.link("Leader")
        cases.go_to(4)
        self.assertIn("what holds a pin", self.told(rig))
        bpy.ops.motus.track_record(datablock="Post", transform='WORLD', frame_start=1, frame_end=30)
        cases.go_to(5)
        self.assertIsNone(self.told(rig))

    def test_pins_without_a_target_and_of_no_bone_hold_nothing(self):
        rig, post, held = self.bridge(3, 0.5)
        plain = {}
        other = cases.still_rope(2, name="Other")
        for change, words in (
            ({"target": None}, "without a target"),
            ({"name": "Nobody"}, "belongs to no chain"),
            ({"name": "Root"}, "belongs to no chain"),
            ({"target": other, "target_bone": "Gone"}, "holds to is gone"),
        ):
            for name, value in ({"target": post, "name": "Tail 0 2", "target_bone": ""} | change).items():
                setattr(held, name, value)
            plain[str(change)] = cases.tail(rig, 1, "Tail 0 2")
            self.assertIn(words, self.told(rig))
            held.is_muted = True
            bpy.context.view_layer.update()
            self.assertIsNone(self.told(rig))
            held.is_muted = False
        for found in plain.values():
            np.testing.assert_array_equal(found, cases.tail(rig, 1, "Tail 0 2"))
        held.name, held.target, held.target_bone = "Tail 0 2", post, "Nobody"
        np.testing.assert_allclose(cases.tail(rig, 1, "Tail 0 2"), post.location, atol=2e-3)
        other = rig.motus.chains.pins.add()  # two pins of a bone: the first one holds
        other.name, other.target = "Tail 0 2", support.link("Second", location=(5.0, 5.0, 5.0))
        np.testing.assert_allclose(cases.tail(rig, 1, "Tail 0 2"), post.location, atol=2e-3)
        bpy.data.objects.remove(post)
        bpy.context.view_layer.update()
        self.assertGreater(np.linalg.norm(cases.tail(rig, 1, "Tail 0 2") - cases.place(rig, 1, "Tail 0 0")), 0.5)

    def test_a_pin_holds_no_object_with_the_name_of_its_bone(self):
        rig = cases.still_rope(4)
        cases.add(rig, **LIMP)
        things = [support.link(name, location=(0.0, index, 0.0)) for index, name in enumerate(("Tail 0 3", "Below"))]
        bpy.ops.motus.chains_add(objects=f"{rig.name}, Tail 0 3, Below", frequency=0.0)
        cases.go_to(30)
        wanted = [tuple(map(tuple, support.evaluated(thing).matrix_world)) for thing in things]
        pin(rig, bones="Tail 0 3", target=support.link("Post", location=(0.0, 0.0, 5.0)).name)
        cases.go_to(31)
        cases.go_to(30)
        self.assertEqual([tuple(map(tuple, support.evaluated(thing).matrix_world)) for thing in things], wanted)
        bpy.ops.motus.chains_remove(object="Below")  # its row alone, and no pin
        self.assertEqual([entry.name for entry in rig.motus.chains.entries], ["Tail 0 0"])
        self.assertEqual([one.name for one in rig.motus.chains.pins], ["Tail 0 3"])

    def test_a_chain_waits_for_the_chain_that_it_is_pinned_to(self):
        rig = cases.rope(4, chains=2)
        cases.add(rig, "Tail 0 0, Tail 1 0", **LIMP)
        pin(rig, bones="Tail 1 3", target=rig.name, target_bone="Tail 0 2")
        keys = [group.key for group in support.addon("chains.groups").groups(rig)]
        self.assertEqual(keys, ["", "1"])
        self.assertIsNone(cases.problem(rig))
        for frame in (1, 14, 22.5, 60):
            np.testing.assert_allclose(cases.tail(rig, frame, "Tail 1 3"), cases.place(rig, frame, "Tail 0 2"), atol=5e-3, err_msg=frame)
        with self.assertRaisesRegex(RuntimeError, "Rope: Tail 1 0 moves with the chain of Tail 0 3"):
            pin(rig, bones="Tail 0 3", target=rig.name, target_bone="Tail 1 0")
        held = rig.motus.chains.pins.add()
        held.name, held.target, held.target_bone = "Tail 0 3", rig, "Tail 1 0"
        cases.go_to(5)
        self.assertIn("move with what they follow", self.told(rig))

    def test_added_from_the_selection_with_empties_of_its_own(self):
        rig = cases.still_rope(3, chains=2)
        cases.add(rig, "Tail 0 0, Tail 1 0", **LIMP)
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='POSE')
        for name in ("Tail 0 1", "Tail 1 2"):
            bone = rig.pose.bones[name]
            (bone if hasattr(bone, "select") else bone.bone).select = True
        places = {name: cases.tail(rig, 1, name) for name in ("Tail 0 1", "Tail 1 2")}
        bpy.ops.motus.chains_pin(weight=0.5)
        held = rig.motus.chains.pins
        self.assertEqual({one.name: one.weight for one in held}, dict.fromkeys(places, 0.5))
        for one in held:
            np.testing.assert_allclose(one.target.location, places[one.name], atol=1e-5)
        bpy.ops.motus.chains_pin(weight=0.25)  # once more keeps the targets
        self.assertEqual(len(bpy.context.scene.objects), 3)
        self.assertEqual([one.weight for one in held], [0.25, 0.25])
        bpy.ops.motus.chains_unpin(index=0)
        self.assertEqual((len(held), len(bpy.context.scene.objects)), (1, 2))
        held[0].target.keyframe_insert("location", frame=1)
        bpy.ops.object.mode_set(mode='OBJECT')
        bpy.ops.motus.chains_unpin()
        self.assertEqual((len(held), len(bpy.context.scene.objects)), (0, 2), "an empty that is animated stays")

    def test_refusals(self):
        rig = cases.still_rope(3)
        with self.assertRaisesRegex(RuntimeError, "has no chains"):
            pin(rig)
        cases.add(rig)
        with self.assertRaisesRegex(RuntimeError, "There is no such pin"):
            bpy.ops.motus.chains_unpin(object=rig.name)
        for keywords, words in (
            ({"bones": "Root"}, "Root belongs to no chain"),
            ({"bones": "Nobody"}, "has no bone Nobody"),
            ({"target": "Nobody"}, "There is no object Nobody"),
            ({"target_bone": "Arm"}, "Name the armature of the bone Arm"),
            ({"target": rig.name, "target_bone": "Nobody"}, "has no bone Nobody"),
        ):
            with self.assertRaisesRegex(RuntimeError, words):
                pin(rig, **keywords)
        self.assertFalse(rig.motus.chains.pins)

    def test_removal_leaves_nothing(self):
        rig = cases.rope(3, chains=2)
        before = {frame: cases.matrix(rig, frame, "Tail 0 2").tobytes() for frame in FRAMES}
        cases.add(rig, "Tail 0 0, Tail 1 0")
        for bone in ("Tail 0 2", "Tail 1 2"):
            held = pin(rig, bones=bone)
            held.keyframe_insert("weight", frame=1)
        self.assertEqual(len(bpy.context.scene.objects), 3)
        bpy.ops.motus.chains_remove(object=rig.name, bones="Tail 0 0")
        self.assertEqual([one.name for one in rig.motus.chains.pins], ["Tail 1 2"])
        curves = support.addon("core.blender.actions").fcurves(rig)
        self.assertEqual([one.data_path for one in curves if "pins" in one.data_path], ["motus.chains.pins[0].weight"])
        bpy.ops.motus.chains_remove(object=rig.name)
        self.assertFalse(rig.motus.is_property_set("chains"))
        self.assertEqual(len(bpy.context.scene.objects), 1)
        self.assertFalse([one for one in support.addon("core.blender.actions").fcurves(rig) if "pins" in one.data_path])
        self.assertEqual({frame: cases.matrix(rig, frame, "Tail 0 2").tobytes() for frame in FRAMES}, before)

    def test_a_bone_that_is_renamed(self):
        rig, _, held = self.bridge(3, 0.5)
        other = cases.still_rope(2, 1)
        other.name = "Other"
        held.target, held.target_bone = other, "Tail 0 1"
        found = cases.tail(rig, 4, "Tail 0 2")
        rig.data.bones["Tail 0 2"].name = "End"
        other.data.bones["Tail 0 1"].name = "Hook"
        bpy.context.view_layer.update()
        self.assertEqual((held.name, held.target_bone), ("End", "Hook"))
        np.testing.assert_allclose(cases.tail(rig, 4, "End"), found, atol=1e-6)

    def test_bake_and_unbake(self):
        rig, _, _ = self.bridge(4, 0.8)
        live = {frame: cases.matrix(rig, frame, "Tail 0 3") for frame in (1, 15, 30)}
        bpy.context.view_layer.objects.active = rig
        bpy.ops.motus.bake(frame_start=1, frame_end=30)
        for frame, wanted in live.items():
            np.testing.assert_allclose(cases.matrix(rig, frame, "Tail 0 3"), wanted, atol=1e-5)
        with self.assertRaisesRegex(RuntimeError, "is baked"):
            pin(rig)
        bpy.ops.motus.unbake()
        for frame, wanted in live.items():
            np.testing.assert_array_equal(cases.matrix(rig, frame, "Tail 0 3"), wanted)

    def test_opened_again_linked_and_copied(self):
        rig, _, _ = self.bridge(4, 0.8)
        wanted = cases.matrix(rig, 20, "Tail 0 3")
        copy = rig.copy()
        bpy.context.scene.collection.objects.link(copy)
        bpy.context.view_layer.update()
        np.testing.assert_array_equal(cases.matrix(copy, 20, "Tail 0 3"), wanted)
        path = self.save()
        bpy.ops.wm.open_mainfile(filepath=path)
        np.testing.assert_array_equal(cases.matrix(bpy.data.objects["Rope"], 20, "Tail 0 3"), wanted)
        rig = self.load(path, True, "Rope")
        bpy.context.view_layer.update()
        self.assertIsNone(cases.problem(rig))
        np.testing.assert_array_equal(cases.matrix(rig, 20, "Tail 0 3"), wanted)


class ChainsPinsOverTime(solved_cases.Solved, support.SceneTestCase):
    label = "Chains"

    def test_bones_of_a_pinned_chain(self):
        rig = cases.rope(4)
        cases.add(rig, frequency=1.0)
        post = dynamics_cases.moved("Post", {1: cases.tail(rig, 1, "Tail 0 3"), 25: cases.tail(rig, 1, "Tail 0 3") + (0.4, 0.0, 0.3)})
        pin(rig, target="Post")
        flag = support.link("Flag", parent=rig)
        flag.parent_type, flag.parent_bone = 'BONE', "Tail 0 3"
        for thing in (rig.pose.bones["Tail 0 0"], flag):
            self.assertSolved(thing, 1e-4)
        post.constraints.new('COPY_LOCATION').target = support.link("Leader")
        self.assertUnknown(flag, "Post")
