"""The table of repairs: each kind of change is told by its sign, is repaired once, and leaves nothing to repair."""

import contextlib
from unittest import mock

import bpy

import support
import toy_system
from core.wiring.wiring_cases import WiringTestCase, build_bone, build_object, each_kind, frame_set

repairs = support.addon("core.wiring.healing.repairs")
watch = support.addon("core.wiring.healing.watch")


@contextlib.contextmanager
def repaired():
    """Gives a list that is filled with the names of the repairs that are made."""
    made = []

    def noting(one):
        def repair(found, event):
            made.append(one.repair.__name__.lstrip("_"))
            one.repair(found, event)

        return one._replace(repair=repair)

    with mock.patch.dict(repairs.AT, {moment: tuple(map(noting, table)) for moment, table in repairs.AT.items()}):
        yield made


def settle():
    for frame in (1, 2, 3):
        frame_set(frame)
        bpy.context.view_layer.update()


class RepairsTest(WiringTestCase):
    def assert_repaired(self, name, change):
        """The change is repaired by the repair of this name, and after it there is nothing left."""
        settle()
        with repaired() as made:
            change()
            bpy.context.view_layer.update()  # as in the window, before the frame changes
            settle()
            self.assertIn(name, made)
            made.clear()
            bpy.context.scene.objects[0].update_tag()
            settle()
            self.assertEqual(made, [])

    @each_kind
    def test_nothing_to_repair(self, build):
        owner, _ = build(toy_system.new_target())
        settle()
        with repaired() as made:
            frame_set(7)
            owner.location.x += 1.0
            bpy.context.view_layer.update()
        self.assertEqual(made, [])

    def test_copied(self):
        owner, _ = build_object(toy_system.new_target())

        def copy():
            bpy.context.scene.collection.objects.link(owner.copy())

        self.assert_repaired("part_copies", copy)

    def test_animated(self):
        owner, _ = build_object(toy_system.new_target())
        self.assert_repaired("refresh_changed", lambda: owner.motus.orbit.keyframe_insert("radius", frame=1))

    def test_parented(self):
        owner, _ = build_object(toy_system.new_target())
        other = toy_system.new_object("Other")
        self.assert_repaired("refresh_order", lambda: setattr(other, "parent", owner))

    def test_bone_removed(self):
        owner, _ = build_bone(toy_system.new_target())

        def remove():
            bpy.context.view_layer.objects.active = owner
            bpy.ops.object.mode_set(mode='EDIT')
            owner.data.edit_bones.remove(owner.data.edit_bones[-1])
            bpy.ops.object.mode_set(mode='OBJECT')

        self.assert_repaired("follow_bones", remove)

    def test_helper_in_the_scene(self):
        owner, _ = build_object(toy_system.new_target())
        hub = owner.motus.orbit.hub
        bpy.context.scene.collection.objects.link(hub)
        support.addon("core.wiring.healing.heal").heal(repairs.ARRIVED)
        self.assertEqual(list(hub.users_collection), [])

    def test_every_repair_has_a_moment(self):
        self.assertEqual({one for table in repairs.AT.values() for one in table}, set(repairs.TABLE))
        self.assertEqual(len({one.change for one in repairs.TABLE}), len(repairs.TABLE))


class NoticedTest(WiringTestCase):
    def test_reset(self):
        """All that belongs to the file is forgotten with it; the number of evaluations goes on."""
        found, fresh = watch.Noticed(), watch.Noticed()
        for name, value in vars(found).items():
            if isinstance(value, set):
                value.add(("orbit", "Owner"))
            elif isinstance(value, dict):
                value["orbit", "Owner"] = 1
            else:
                setattr(found, name, 5)
        found.reset()
        self.assertEqual(found.evaluations, 5)
        fresh.evaluations = 5
        self.assertEqual(vars(found), vars(fresh))

    def test_another_file(self):
        build_object(toy_system.new_target())
        settle()
        self.assertTrue(watch.noticed.in_use)
        before = watch.evaluation()
        support.empty_scene()
        bpy.ops.wm.read_homefile(use_empty=True)
        self.assertFalse(watch.noticed.in_use)
        self.assertEqual(watch.noticed.states, {})
        self.assertGreaterEqual(watch.evaluation(), before)
