"""Objects and bones that sway, in other files: reopened, appended, linked, overridden, damaged; and undone."""

import bpy

import support
import toy_sway_system
from core.wiring.object_cases import FRAMES, ObjectTestCase, build, build_driven, build_rig, matrices
from core.wiring.wiring_cases import each_of, frame_set

wiring = support.addon("core.wiring")
hub_lookup = support.addon("core.wiring.hubs.hub_lookup")
outbox = support.addon("core.wiring.hubs.outbox")
SYSTEM = toy_sway_system.SYSTEM
each_lasting_kind = each_of((build, build_driven, build_rig))


def rows(owner):
    """Matrices of all that is driven, at all FRAMES."""
    found = []
    for frame in FRAMES:
        frame_set(frame)
        found.append(matrices(owner))
    return found


class FileTest(ObjectTestCase):
    def save(self, name="sway"):
        path = str(self.folder / f"{name}.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        return path

    def bring(self, path, name, link):
        support.empty_scene()
        with bpy.data.libraries.load(path, link=link) as (there, wanted):
            wanted.objects = [one for one in there.objects if not one.startswith(".Motus")]
        for obj in wanted.objects:
            bpy.context.scene.collection.objects.link(obj)
        frame_set(2)
        return next(obj for obj in wanted.objects if obj.name == name)

    @each_lasting_kind
    def test_reopened_appended_and_linked(self, build):
        name = build().name
        live = rows(bpy.data.objects[name])
        path = self.save()
        bpy.ops.wm.open_mainfile(filepath=path)
        self.assertEqual(rows(bpy.data.objects[name]), live)
        self.assertEqual(rows(self.bring(path, name, link=False)), live)
        self.assertEqual(rows(self.bring(path, name, link=True)), live)

    @each_lasting_kind
    def test_overridden(self, build):
        name = build().name
        linked = self.bring(self.save(), name, link=True)
        owner = linked.override_create(remap_local_usages=True)
        frame_set(2)
        frame_set(3)
        index = next(place for place, entry in enumerate(owner.motus.sway.entries) if not entry.thing)
        self.assert_own_sways(owner, index)
        self.save("override")
        bpy.ops.wm.open_mainfile(filepath=str(self.folder / "override.blend"))
        owner = next(obj for obj in bpy.data.objects if obj.override_library)
        frame_set(7)
        self.assert_own_sways(owner, index)

    def assert_own_sways(self, owner, index):
        owner.motus.sway.influence = 0.5
        bpy.context.view_layer.update()
        half = matrices(owner)[index]
        owner.motus.sway.influence = 1.0
        bpy.context.view_layer.update()
        self.assertGreater((matrices(owner)[index].translation - half.translation).length, 0.01)

    @each_lasting_kind
    def test_damaged(self, build):
        for value in ({}, {"text": "["}, {"text": "[]", "version": 99}):
            support.empty_scene()
            owner = build()
            for key, hub in hub_lookup.hubs(SYSTEM, owner):
                hub.data[outbox.info_key(SYSTEM, key)] = value
                hub.data.update_tag()
            self.assert_untouched(owner)
            self.assertTrue(wiring.problem(SYSTEM, owner, bpy.context.evaluated_depsgraph_get()).blocking)
            wiring.refresh(SYSTEM, owner)
            self.assert_sways(owner)

    @each_lasting_kind
    def test_undo(self, build):
        name = build().name
        bpy.ops.ed.undo_push(message="built")
        frame_set(3)
        wiring.detach(SYSTEM, bpy.data.objects[name])
        bpy.ops.ed.undo_push(message="removed")
        bpy.ops.ed.undo()
        self.assert_sways(bpy.data.objects[name])
        bpy.ops.ed.redo()
        self.assert_untouched(bpy.data.objects[name])
