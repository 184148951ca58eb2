"""Copies of wagons, wagons whose leader is gone, and what adding says about set-ups that cannot work."""

import contextlib
import logging

import bpy
import numpy as np

import support
from path.path_cases import PathTestCase


class Strays(PathTestCase):
    def setUp(self):
        super().setUp()
        self.line(100.0)
        self.wagons = [self.link(f"Wagon {index}") for index in range(3)]
        bpy.ops.motus.path_train_add(objects="Wagon 0,Wagon 1,Wagon 2", curve="Course", gap=2.0, timing='MANUAL', distance_factor=0.5)
        self.hubs = len(bpy.data.meshes)

    def copy(self, obj, name):
        copied = obj.copy()
        copied.name = name
        self.scene.collection.objects.link(copied)
        self.at(copied)
        return copied

    def assertAlong(self, obj, wanted):
        self.assertPlace(obj, np.array((wanted, 0.0, 0.0)))

    def assertFree(self, obj):
        self.assertAlong(obj, 0.0)
        self.assertEqual(len(obj.constraints), 0)
        self.assertIsNone(obj.animation_data)
        self.assertFalse(obj.is_property_set("motus"))

    def assertWhole(self):
        """The train is as it was."""
        self.assertEqual([entry.object for entry in self.wagons[0].motus.path.wagons], self.wagons[1:])
        for index, wagon in enumerate(self.wagons):
            self.assertAlong(wagon, 50.0 - 2.0 * index)

    def test_removing_a_copy_frees_the_copy_alone(self):
        copied = self.copy(self.wagons[1], "Copy")
        self.assertAlong(copied, 48.0)
        bpy.ops.motus.path_follow_remove(object="Copy")
        self.assertFree(copied)
        self.assertWhole()
        self.assertEqual(len(bpy.data.meshes), self.hubs)
        self.assertRefused("Nothing here", bpy.ops.motus.path_follow_remove, object="Copy")

    def test_a_copy_joins_the_train(self):
        copied = self.copy(self.wagons[1], "Copy")
        bpy.ops.motus.path_wagon_add(object="Wagon 0", wagon="Copy", gap=3.0)
        self.wagons.append(copied)
        self.assertEqual([entry.object for entry in self.wagons[0].motus.path.wagons], self.wagons[1:])
        self.assertEqual(len({len(wagon.constraints) for wagon in self.wagons}), 1, "no sinks on top of others")
        for wagon, wanted in zip(self.wagons, (50.0, 48.0, 46.0, 43.0)):
            self.assertAlong(wagon, wanted)
        self.assertRefused("a wagon of Wagon 0", bpy.ops.motus.path_wagon_add, object="Wagon 0", wagon="Copy")

    def test_a_copy_follows_by_itself(self):
        copied = self.copy(self.wagons[2], "Copy")
        self.follow("Copy", timing='MANUAL', distance_factor=0.9)
        self.assertAlong(copied, 90.0)
        self.assertIsNone(copied.motus.path.leader)
        self.assertEqual(len(copied.constraints), len(self.follow("New").constraints))
        self.assertWhole()

    def test_a_copy_joins_another_train(self):
        copied = self.copy(self.wagons[1], "Copy")
        self.link("Other")
        bpy.ops.motus.path_train_add(objects="Other,Copy", curve="Course", gap=5.0, timing='MANUAL', distance_factor=0.3)
        self.assertAlong(copied, 25.0)
        self.assertEqual(copied.motus.path.leader, bpy.data.objects["Other"])
        self.assertWhole()

    def test_wagons_without_their_leader(self):
        bpy.data.objects.remove(self.wagons[0])
        first, second = self.wagons[1:]
        bpy.ops.motus.path_follow_remove(object="Wagon 1")
        self.assertFree(first)
        self.follow("Wagon 2", timing='MANUAL', distance_factor=0.9)
        self.assertAlong(second, 90.0)
        self.assertEqual(len(second.constraints), len(self.follow("New").constraints))
        self.assertEqual(len(bpy.data.meshes), self.hubs - 1 + 1, "nobody reads the train's hub any more")


class Panel(PathTestCase):
    """What the panel draws, seen by a layout that writes down what it is asked for."""

    def setUp(self):
        super().setUp()
        self.line(100.0)
        for index in range(2):
            self.link(f"Wagon {index}")
        bpy.ops.motus.path_train_add(objects="Wagon 0,Wagon 1", curve="Course", gap=2.0)

    def drawn(self, obj):
        bpy.context.view_layer.objects.active = obj
        layout = _Layout()
        support.addon("path.panel").draw_main(layout, bpy.context)
        return layout

    def test_wagon(self):
        layout = self.drawn(bpy.data.objects["Wagon 1"])
        self.assertEqual(list(layout.buttons), ["motus.path_select_leader", "motus.path_follow_remove"])

    def test_copy_of_a_wagon(self):
        copied = bpy.data.objects["Wagon 1"].copy()
        self.scene.collection.objects.link(copied)
        layout = self.drawn(copied)
        self.assertIn("A copy of a wagon: it stands where", " ".join(layout.texts))
        couple = layout.buttons["motus.path_wagon_add"]
        self.assertEqual((couple.object, couple.wagon), ("Wagon 0", copied.name))
        self.assertEqual(layout.buttons["motus.path_follow_remove"].object, copied.name)

    def test_leader_gone(self):
        bpy.data.objects.remove(bpy.data.objects["Wagon 0"])
        layout = self.drawn(bpy.data.objects["Wagon 1"])
        self.assertIn("leader of this wagon is gone", " ".join(layout.texts))
        self.assertEqual(list(layout.buttons), ["motus.path_follow_remove"])


class _Layout:
    def __init__(self):
        self.texts, self.buttons = [], {}

    def box(self, **_options):
        return self

    column = row = box

    def label(self, text="", **_options):
        self.texts.append(text)

    def operator(self, name, **_options):
        return self.buttons.setdefault(name, type("Properties", (), {})())


class Said(PathTestCase):
    """What cannot work is said at once: refused where it is plain before, a warning where it shows after."""

    def test_warnings(self):
        code = (
            "import bpy\n"
            "from path import path_cases\n"
            "case = path_cases.PathTestCase()\n"
            "case.setUp()\n"
            "case.line(10.0)\n"
            "case.follow(timing='PINS')\n"
            "case.follow(timing='SPEED')\n"
            "case.points('POLY', [(1, 2, 3)], 'Point')\n"
            "case.follow('Two', 'Point')\n"
            "case.link('Three')\n"
            "bpy.ops.motus.path_train_add(objects='Two,Three', curve='Course', timing='PINS')\n"
            "bpy.ops.motus.path_pin_add(object='Two', frame=7, fraction=0.5)\n"
            "bpy.ops.motus.path_pin_add(object='Two', frame=7, fraction=0.6)\n"
        )
        status, output = support.run_beside(code)
        self.assertEqual(status, 0, output)
        said = [line for line in output.splitlines() if line.startswith(("Info: ", "Warning: ", "Error: "))]
        self.assertEqual(
            said,
            [
                "Info: Car follows Course",
                "Warning: Add a pin: a frame and the place to be at",
                "Info: Car follows Course",
                "Info: Two follows Point",
                "Warning: A spline needs two points at least",
                "Info: 2 objects follow Course",
                "Warning: Add a pin: a frame and the place to be at",
                "Info: Replaced the pin at frame 7",
            ],
        )

    def test_refused_settings_change_nothing(self):
        self.line(10.0)
        self.link("Wagon")
        car = self.follow(speed=3.0)
        before = len(car.constraints)
        for part, given in (
            ("perpendicular", {"forward_axis": 'NEG_Z'}),
            ("no spline", {"spline": 1}),
            ("more than 1", {"ease_in": 0.6, "ease_out": 0.6}),
            ("offset is not a finite", {"offset": float("nan")}),
            ("speed is not a finite", {"speed": float("inf")}),
        ):
            with self.subTest(part):
                self.assertRefused(part, bpy.ops.motus.path_follow_add, object="Car", curve="Course", duration=9.0, **given)
                self.assertRefused(part, bpy.ops.motus.path_train_add, objects="Car,Wagon", curve="Course", duration=9.0, **given)
        settings = car.motus.path
        self.assertEqual((settings.duration, settings.speed, settings.offset), (5.0, 3.0, 0.0))
        self.assertEqual((len(car.constraints), len(settings.wagons)), (before, 0))
        nan = float("nan")
        self.assertRefused("gap is not a finite", bpy.ops.motus.path_wagon_add, object="Car", wagon="Wagon", gap=nan)
        for name in ("frame", "fraction", "distance"):
            self.assertRefused(f"{name} is not", bpy.ops.motus.path_pin_add, object="Car", **{name: nan})
        self.assertEqual((len(settings.pins), settings.timing), (0, 'DURATION'))

    def test_splines_of_modifiers_are_not_refused(self):
        curve = self.line(10.0)
        curve.modifiers.new("Nodes", 'NODES')
        car = self.follow(spline=1)
        self.assertIn("no spline of this index", self.sentence(car))

    def test_settings_that_are_no_numbers(self):
        self.line(10.0)
        self.link("Wagon")
        car = self.follow()
        car.location.x = -3.0
        bpy.context.view_layer.objects.active = car
        overlay = support.addon("core.interface.overlay")
        nan = float("nan")
        for name in ("offset", "duration", "speed", "start_frame", "distance_factor", "bank_strength", "gravity", "lag_rate", "influence"):
            with self.subTest(name), self.assertNoLogs():
                good = getattr(car.motus.path, name)
                setattr(car.motus.path, name, nan)
                self.assertEqual(self.sentence(car, 30), "A setting is not a finite number")
                self.assertPlace(car, np.array((-3.0, 0.0, 0.0)))
                overlay.batches(bpy.context)
                setattr(car.motus.path, name, good)
                self.assertIsNone(self.sentence(car))
        car.motus.path.timing = 'PINS'
        bpy.ops.motus.path_pin_add(object="Car", frame=1.0, fraction=0.5)
        bpy.ops.motus.path_pin_add(object="Car", frame=20.0, fraction=0.7)
        with self.assertNoLogs():
            car.motus.path.pins[0].fraction = nan
            self.assertEqual(self.sentence(car), "A setting is not a finite number")
            car.motus.path.pins[0].fraction = 0.2
            car.motus.path.pins[1].frame = nan
            self.assertEqual(self.sentence(car), "A setting is not a finite number")
        car.motus.path.timing = 'DURATION'
        bpy.ops.motus.path_wagon_add(object="Car", wagon="Wagon", gap=1.0)
        with self.assertNoLogs():
            car.motus.path.wagons[0].gap = nan
            self.assertEqual(self.sentence(car), "A setting is not a finite number")

    @contextlib.contextmanager
    def assertNoLogs(self):
        """unittest has one of its own only since Python 3.10."""
        heard = []
        handler = logging.Handler()
        handler.emit = heard.append
        logging.getLogger().addHandler(handler)
        try:
            yield
        finally:
            logging.getLogger().removeHandler(handler)
        self.assertEqual([record.getMessage() for record in heard], [])
