"""Operators on linked data: they refuse, and what is linked goes on as it was."""

import bpy
import numpy as np

import live_scenes
import support


class LinkedTestCase(support.SceneTestCase):
    """The live scenes, linked from a library."""

    def setUp(self):
        super().setUp()
        path = live_scenes.saved()
        support.empty_scene()
        with bpy.data.libraries.load(path, link=True) as (found, wanted):
            wanted.objects = [name for name in found.objects if not name.startswith(".Motus")]
        for obj in wanted.objects:
            bpy.context.scene.collection.objects.link(obj)
        self.wanted = live_scenes.states()

    def assert_as_before(self, msg, frames=live_scenes.FRAMES):
        for frame, found in live_scenes.states(frames).items():
            self.assertEqual(support.differ(found, self.wanted[frame], 1e-6, 1e-7), set(), f"{msg}, on frame {frame}")


class RefreshTest(LinkedTestCase):
    def test_refused_with_a_sentence(self):
        for system, name in (("path", "Car"), ("path", "Engine"), ("ik", "Arm"), ("look_at", "Figure")):
            with self.subTest(name), self.assertRaisesRegex(RuntimeError, f"{name} is linked from another file"):
                bpy.ops.motus.refresh(object=name, system=system)
            self.assert_as_before(f"refresh of {system} on {name}")
        with self.assertRaisesRegex(RuntimeError, "Grid is linked from another file"):
            bpy.ops.motus.pin_restore(object="Grid")
        self.assert_as_before("pin_restore")

    def test_a_setting_changed_by_a_script_does_not_wire_it_anew(self):
        bpy.data.objects["Car"].motus.path.orientation = bpy.data.objects["Car"].motus.path.orientation
        bpy.data.objects["Arm"].motus.ik.entries[0].chain_length = 2
        self.assert_as_before("a setting")


class OperatorsTest(LinkedTestCase):
    def test_nothing_that_is_called_with_a_linked_object_changes_it(self):
        """Every operator that takes the name of an object, with its defaults."""
        called = 0
        for name in sorted(dir(bpy.ops.motus)):
            operator = getattr(bpy.ops.motus, name)
            keywords = {one.identifier for one in operator.get_rna_type().properties} & {"object", "objects"}
            for keyword in sorted(keywords):
                for obj in ("Car", "Wagon 1", "Engine", "Arm", "Figure", "Grid", "Ball", "Ball Lattice"):
                    bpy.context.view_layer.objects.active = bpy.data.objects[obj]
                    try:
                        operator(**{keyword: obj})
                    except RuntimeError:
                        pass  # refused
                    called += 1
                    self.assertEqual(bpy.context.mode, 'OBJECT', f"{name} of {obj}")
            if keywords:
                self.assert_as_before(name, frames=(25.5,))
        self.assert_as_before("all of them")
        self.assertGreater(called, 100)


class SameNameTest(support.SceneTestCase):
    """A local owner and a linked one of the same name."""

    def setUp(self):
        super().setUp()
        live_scenes.opened()
        path = str(self.folder / "library.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
        with bpy.data.libraries.load(path, link=True) as (_, wanted):
            wanted.objects = ["Keyed", "Grid", "Arm", "Target"]
        for obj in wanted.objects:
            bpy.context.scene.collection.objects.link(obj)
        self.linked = {obj.name: obj for obj in wanted.objects}
        self.states = live_scenes.states((1, 30))

    def local(self, name):
        return bpy.data.objects[name, None]

    def place(self, obj):
        return obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.translation.copy()

    def test_driven_later(self):
        """The local one is wired anew for it, the linked one goes on as it was."""
        car, linked = self.local("Keyed"), self.linked["Keyed"]
        support.addon("core.blender.actions").remove(car, ("motus.path.",))
        car.driver_add("motus.path.distance_factor").driver.expression = "0.01 * frame"
        depsgraph = bpy.context.evaluated_depsgraph_get()
        course = bpy.data.objects["Course"].evaluated_get(depsgraph)
        curve = support.addon("path.curves").read_evaluated(course, depsgraph, 0).curve
        for frame in (50, 20, 70, 30):
            bpy.context.scene.frame_set(frame)
            wanted = curve.position(curve.t_at_length(0.01 * frame * curve.length()))
            np.testing.assert_allclose(self.place(car), np.ravel(wanted), atol=1e-4, err_msg=f"frame {frame}")
        driven = [curve.data_path for curve in linked.animation_data.drivers]
        self.assertEqual([path for path in driven if path.startswith("motus.")], [])

    def test_deleted(self):
        """Of a linked target and a local one that was deleted only the second counts as gone."""
        deleted = support.addon("core.file.deleted")
        bpy.context.scene.frame_set(2)
        bpy.context.scene.collection.objects.unlink(self.local("Target"))
        bpy.context.view_layer.update()
        self.assertTrue(deleted.is_deleted(self.local("Target")))
        self.assertFalse(deleted.is_deleted(self.linked["Target"]))

    def test_what_they_hang_on(self):
        """Each is compared with what it hung on itself."""
        relations = support.addon("core.wiring.healing.relations")
        found = []

        def note(_scene, depsgraph):
            found.append(relations.have_changed(depsgraph))

        bpy.app.handlers.depsgraph_update_post.insert(0, note)
        self.addCleanup(bpy.app.handlers.depsgraph_update_post.remove, note)
        for obj in (self.linked["Target"], self.local("Target")):
            obj.update_tag()
            bpy.context.view_layer.update()
            obj.parent_type = 'OBJECT'
            obj.parent = bpy.data.objects["Gauge"]
            obj.update_tag()
            bpy.context.view_layer.update()
        self.assertEqual(found, [False, True, False, True])
