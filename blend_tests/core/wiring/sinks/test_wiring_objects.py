"""Systems with several groups whose members are objects, driven on top of their animation, location included."""

import bpy

import support
import toy_sway_system
import toy_system
from core.wiring.object_cases import ObjectTestCase, build, build_rig, each_kind, keyed, matrices, things
from core.wiring.wiring_cases import assert_playback_equals_jumps, frame_set

wiring = support.addon("core.wiring")
hub_lookup = support.addon("core.wiring.hubs.hub_lookup")
outbox = support.addon("core.wiring.hubs.outbox")
SYSTEM = toy_sway_system.SYSTEM


class EvaluationTest(ObjectTestCase):
    @each_kind
    def test_frames_in_any_order(self, build):
        self.assert_sways(build())

    @each_kind
    def test_playback_equals_jumps(self, build):
        owner = build()
        assert_playback_equals_jumps(self, lambda: matrices(owner), 0.5)

    @each_kind
    def test_influence_and_problem(self, build):
        owner = build()
        for influence in (0.4, 0.0, 1.0):
            owner.motus.sway.influence = influence
            self.assert_sways(owner, influence)
        owner.motus.sway.entries[-1].target = None
        frame_set(7)
        problem = wiring.problem(SYSTEM, owner, bpy.context.evaluated_depsgraph_get())
        self.assertIs(problem, toy_sway_system.NO_TARGET)

    def test_levels(self):
        owner = build()
        self.assertEqual(sorted(key for key, _ in hub_lookup.hubs(SYSTEM, owner)), ["", "1", "2"])
        rig = build_rig()
        self.assertEqual(sorted(key for key, _ in hub_lookup.hubs(SYSTEM, rig)), ["", "1"])

    def test_a_loop_is_left_out(self):
        owner, other = (keyed(toy_system.new_object(name)) for name in ("Owner", "Other"))
        toy_sway_system.sway(owner, (other, owner), (None, other))
        self.assertEqual(hub_lookup.hubs(SYSTEM, owner), [])

    def test_order_by_way_of_another_owner(self):
        owner, between, last = (keyed(toy_system.new_object(name)) for name in ("Owner", "Between", "Last"))
        target = toy_system.new_target()
        toy_sway_system.sway(owner, (None, target), (last, between))
        self.assertEqual(len(hub_lookup.hubs(SYSTEM, owner)), 1)
        frame_set(2)
        toy_sway_system.sway(between, (None, owner))
        bpy.context.view_layer.update()
        self.assertEqual(len(hub_lookup.hubs(SYSTEM, owner)), 2)
        self.assert_sways(owner)
        self.assert_sways(between)

    def test_a_new_parent(self):
        owner = build()
        frame_set(1)
        last = bpy.data.objects["B"]
        last.parent = bpy.data.objects["Parent"]
        bpy.context.view_layer.update()
        self.assert_sways(owner)
        last.parent = None
        bpy.context.view_layer.update()
        self.assert_sways(owner)


class EditingTest(ObjectTestCase):
    @each_kind
    def test_removal_leaves_nothing(self, build):
        owner = build()
        frame_set(5)
        wiring.detach(SYSTEM, owner)
        for obj in bpy.data.objects:
            self.assertEqual(len(obj.constraints), 0)
            self.assertNotIn("Motus", obj.name)
            if obj.is_property_set("motus"):
                self.assertIsNone(obj.motus.sway.leader)
        self.assertFalse([mesh for mesh in bpy.data.meshes if outbox.is_hub(mesh)])
        self.assert_untouched(owner)

    @each_kind
    def test_an_entry_less(self, build):
        owner = build()
        frame_set(1)
        owner.motus.sway.entries.remove(0)
        wiring.refresh(SYSTEM, owner)
        self.assert_sways(owner)
        self.assertEqual(
            len(
                [obj for obj in bpy.data.objects if obj.constraints and not obj.name.startswith(".Motus") and wiring.has_sinks(SYSTEM, obj)]
            ),
            len({thing.id_data for thing in things(owner)} & {thing for thing in things(owner) if isinstance(thing, bpy.types.Object)}),
        )

    @each_kind
    def test_release(self, build):
        owner = build()
        frame_set(1)
        thing = next(one for one in things(owner) if one.id_data != owner)
        self.assertEqual(thing.motus.sway.leader, owner)
        wiring.release(SYSTEM, thing)
        self.assertIsNone(thing.motus.sway.leader)
        self.assertFalse(wiring.has_sinks(SYSTEM, thing))

    @each_kind
    def test_copies_of_all(self, build):
        owner = build()
        bpy.ops.object.select_all(action='SELECT')
        bpy.ops.object.duplicate()
        copy = bpy.data.objects[f"{owner.name}.001"]
        frame_set(2)
        owned = {hub.data.get(outbox.OWNER_KEY) for _, hub in hub_lookup.hubs(SYSTEM, copy)}
        self.assertEqual(owned, {copy})
        self.assertTrue(all(thing.id_data.name.endswith(".001") for thing in things(copy)))
        for one in (owner, copy):
            self.assert_sways(one)
        copy.motus.sway.influence = 0.5
        self.assert_sways(copy, 0.5)
        self.assert_sways(owner)
        wiring.detach(SYSTEM, copy)
        self.assert_untouched(copy)
        self.assert_sways(owner)

    @each_kind
    def test_a_copy_of_what_is_driven(self, build):
        owner = build()
        frame_set(1)
        thing = next(one for one in things(owner) if one.id_data != owner)
        copy = thing.copy()
        bpy.context.scene.collection.objects.link(copy)
        wiring.refresh(SYSTEM, owner)
        self.assertFalse(wiring.has_sinks(SYSTEM, copy))
        self.assert_sways(owner)

    @each_kind
    def test_bake_and_unbake(self, build):
        owner = build()
        wanted = {}
        for frame in (1, 4, 8):
            frame_set(frame)
            wanted[frame] = matrices(owner)
        own = self._channels(owner)
        bpy.context.view_layer.objects.active = owner
        self.assertEqual(bpy.ops.motus.bake(object=owner.name, frame_start=1, frame_end=8), {'FINISHED'})
        for frame, found in wanted.items():
            frame_set(frame)
            for one, other in zip(matrices(owner), found):
                self.assert_same_matrix(one, other, 2e-5)
        self.assertEqual(bpy.ops.motus.unbake(object=owner.name), {'FINISHED'})
        frame_set(8)
        self.assertEqual(self._channels(owner), own)
        self.assert_sways(owner)

    @staticmethod
    def _channels(owner):
        return [(tuple(thing.location), tuple(thing.rotation_euler), tuple(thing.scale)) for thing in things(owner)]
