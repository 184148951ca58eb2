"""What is left alone: by solvers the file, which the main thread may be editing; by handlers files without Motus."""

import sys
import threading
from unittest import mock

import bpy

import live_scenes
import support

EVENTS = ("depsgraph_update_pre", "depsgraph_update_post", "frame_change_pre", "frame_change_post")


class Untouchable:
    """Stands for bpy in one module of the add-on, and notes who asks for bpy.data while a solver runs."""

    def __init__(self, solving, asked):
        self._solving, self._asked = solving, asked

    def __getattr__(self, name):
        if name == "data" and threading.get_ident() in self._solving:
            self._asked.add(sys._getframe(1).f_code.co_name)
        return getattr(bpy, name)


class SolversTest(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        live_scenes.opened()

    def test_nothing_of_the_file_is_read_while_solving(self):
        solving, asked, calls = set(), set(), []
        solve = bpy.app.driver_namespace["motus_solve"]

        def solve_watched(*arguments):
            solving.add(threading.get_ident())
            calls.append(arguments[1])
            try:
                return solve(*arguments)
            finally:
                solving.discard(threading.get_ident())

        watch = Untouchable(solving, asked)
        modules = [
            module
            for name, module in list(sys.modules.items())
            if name.startswith(support.module_name() + ".") and getattr(module, "bpy", None) is bpy
        ]
        with mock.patch.dict(bpy.app.driver_namespace, motus_solve=solve_watched):
            # Blender keeps compiled what it has found in the namespace already.
            support.addon("core.wiring.healing.revival").revive()
            for module in modules:
                module.bpy = watch
            try:
                for hidden in (False, True):
                    for name in ("Course", "Target"):
                        bpy.data.objects[name].hide_viewport = hidden
                    live_scenes.states()
                bpy.context.scene.collection.objects.unlink(bpy.data.objects["Course"])
                bpy.context.scene.collection.objects.unlink(bpy.data.objects["Target"])
                live_scenes.states()
            finally:
                for module in modules:
                    module.bpy = bpy
        support.addon("core.wiring.healing.revival").revive()
        self.assertEqual(
            {name.partition(".")[0] for name in calls},
            {
                "path",
                "layers",
                "ik",
                "look_at",
                "dynamics",
                "chains",
                "pendulum",
                "pendulum_trail",
                "snow",
                "snow_cover",
                "stereo",
                "walker",
            },
        )
        self.assertEqual(asked, set())


class HubsTest(support.SceneTestCase):
    """An evaluated hub's mesh is freed memory until the geometry of the hub is evaluated, for which no other solver waits."""

    def setUp(self):
        super().setUp()
        live_scenes.opened()

    def test_whose_a_sink_is_is_asked_of_the_original(self):
        wiring, systems = support.addon("core.wiring"), support.addon("core.declare").systems()
        depsgraph = bpy.context.evaluated_depsgraph_get()
        evaluated = [obj.evaluated_get(depsgraph) for obj in bpy.context.scene.objects]
        found = [(system.name, carrier) for system in systems for obj in evaluated for _, _, carrier, _ in wiring.on_object(system, obj)]
        self.assertLessEqual({"path", "ik", "look_at", "layers", "dynamics"}, {name for name, _ in found})
        self.assertEqual([name for name, carrier in found if carrier.is_evaluated], [])


class NestedTest(support.SceneTestCase):
    """A solver that Blender runs within another one's to_curve(), as it may do while modifiers are computed in parallel."""

    def setUp(self):
        super().setUp()
        live_scenes.build_paths()
        for name, length in (("Outer", 2.0), ("Inner", 3.0)):
            course = bpy.data.objects["Course"].copy()
            course.data = course.data.copy()
            course.name, course.scale = name, (length, 1.0, 1.0)
            course.modifiers.new("Lattice", 'LATTICE')
            bpy.context.scene.collection.objects.link(course)
        bpy.context.view_layer.update()

    def test_both_are_right(self):
        curves, arrays = support.addon("path.curves"), support.addon("core.evaluated.per_thread")._ARRAYS
        depsgraph = bpy.context.evaluated_depsgraph_get()
        outer, inner = (bpy.data.objects[name].evaluated_get(depsgraph) for name in ("Outer", "Inner"))
        wanted = [curves.read_evaluated(one, depsgraph, 0).curve.length() for one in (outer, inner)]
        found = {}

        class Nesting:
            """The outer curve, in whose to_curve() another solver reads the inner one."""

            def __getattr__(self, name):
                return getattr(outer, name)

            def to_curve(self, *arguments, **keywords):
                found["inner"] = curves.read_evaluated(inner, depsgraph, 0).curve.length()
                found["kept"] = arrays.here().made("test", lambda: "inner")
                return outer.to_curve(*arguments, **keywords)

        def solve():
            self.assertEqual(arrays.here().made("test", lambda: "outer"), "outer")
            found["outer"] = curves.read_evaluated(Nesting(), depsgraph, 0).curve.length()
            found["still kept"] = arrays.here().made("test", lambda: "other")

        thread = threading.Thread(target=solve, daemon=True)
        thread.start()
        thread.join(timeout=30)
        self.assertEqual(found, {"outer": wanted[0], "inner": wanted[1], "kept": "inner", "still kept": "outer"})


class DeletedTest(support.SceneTestCase):
    """Objects that pointers keep in the file: noticed in the evaluation that follows, however they went."""

    def setUp(self):
        super().setUp()
        live_scenes.build_paths()
        self.apart = bpy.data.collections.new("Apart")
        bpy.context.scene.collection.children.link(self.apart)
        self.course = bpy.data.objects["Course"]
        bpy.context.scene.collection.objects.unlink(self.course)
        self.apart.objects.link(self.course)
        bpy.context.scene.frame_set(20)

    def place(self):
        car = bpy.data.objects["Car"]
        return car.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.translation.copy()

    def assert_follows(self, follows, msg=None):
        self.assertEqual(self.place().length > 0.1, follows, msg)

    def test_by_an_update(self):
        self.assert_follows(True)
        self.apart.objects.unlink(self.course)
        bpy.context.view_layer.update()
        self.assert_follows(False)
        self.apart.objects.link(self.course)
        bpy.context.view_layer.update()
        self.assert_follows(True)

    def test_by_a_change_of_the_frame(self):
        self.apart.objects.unlink(self.course)
        bpy.context.scene.frame_set(21)
        self.assert_follows(False)
        self.apart.objects.link(self.course)
        bpy.context.scene.frame_set(22)
        self.assert_follows(True)

    def test_with_its_collection(self):
        bpy.data.collections.remove(self.apart)
        bpy.context.view_layer.update()
        self.assert_follows(False)

    def test_excluded_and_hidden_is_not_deleted(self):
        for layer in bpy.context.view_layer.layer_collection.children:
            layer.exclude = True
        bpy.context.scene.frame_set(23)
        self.assert_follows(True)

    def test_saved_and_opened(self):
        self.apart.objects.unlink(self.course)
        path = str(self.folder / "scene.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        for _ in range(2):
            bpy.ops.wm.open_mainfile(filepath=path)
            bpy.context.scene.frame_set(24)
            self.assert_follows(False)
            bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.context.scene.collection.objects.link(bpy.data.objects["Course"])
        bpy.ops.wm.save_as_mainfile(filepath=path)
        self.assertNotIn("motus_deleted", bpy.data.objects["Course"])
        bpy.ops.wm.open_mainfile(filepath=path)
        bpy.context.scene.frame_set(24)
        self.assert_follows(True)

    def test_another_object_of_the_name(self):
        self.apart.objects.unlink(self.course)
        bpy.context.view_layer.update()
        self.course.name = "Old"
        bpy.data.objects["Driven"].name = "Course"
        bpy.context.view_layer.update()
        self.assertFalse(support.addon("core.file.deleted").is_deleted(bpy.data.objects["Course"]))

    def test_another_threads_handler_does_nothing(self):
        """Animations are rendered in a thread, in which Blender calls the handlers of the frame."""
        deleted = support.addon("core.file.deleted")
        with mock.patch.object(deleted, "look") as look:
            thread = threading.Thread(target=deleted._updated)
            thread.start()
            thread.join()
        look.assert_not_called()


class HandlersTest(support.SceneTestCase):
    def events(self):
        """How much of Python runs in the add-on's handlers, after an update: calls, of Python and C, and lines."""
        depsgraph, count = bpy.context.evaluated_depsgraph_get(), [0]

        def note(*_):
            count[0] += 1
            return note

        ours = [one for name in EVENTS for one in getattr(bpy.app.handlers, name) if support.module_name() in one.__module__]
        self.assertGreater(len(ours), 5)
        before = sys.gettrace(), sys.getprofile()
        sys.settrace(note)
        sys.setprofile(note)
        try:
            for one in ours:
                one(bpy.context.scene, depsgraph)
        finally:
            sys.settrace(before[0])
            sys.setprofile(before[1])
        return count[0]

    def add(self, count):
        for _ in range(count):
            bpy.context.scene.collection.objects.link(bpy.data.objects.new("Thing", None))
        bpy.context.view_layer.update()

    def test_a_file_without_motus_costs_nothing_however_large(self):
        self.add(1)
        few = self.events()
        self.add(500)
        after_adding = self.events()
        bpy.data.objects["Thing"].location.x = 1.0
        bpy.context.view_layer.update()
        self.assertEqual((after_adding, self.events()), (few, few))
        self.assertLess(few, 60)

    def test_and_does_again_when_motus_is_in_it(self):
        self.add(1)
        few = self.events()
        live_scenes.build()
        self.assertGreater(self.events(), few)
        support.empty_scene()
        self.add(1)
        self.assertEqual(self.events(), few)
