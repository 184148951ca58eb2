"""Lists in settings on library overrides: what is added stays, and what the library has is neither removed nor moved."""

import re
from pathlib import Path

import bpy

import support
from dynamics import dynamics_cases
from path import path_cases
from walker import walker_cases

MACHINERY = {"more_hubs", "targets"}
"""Lists of hidden helpers, which the wiring fills by names of its own."""


def lists_of(settings, path=""):
    """Yield the data path, from settings, of each list that overrides may extend; of a list within entries that of the first entry's."""
    for prop in settings.properties:
        if prop.type == 'COLLECTION' and prop.is_overridable and prop.identifier not in MACHINERY:
            yield path + prop.identifier
            yield from lists_of(prop.fixed_type, f"{path}{prop.identifier}[0].")


def number_of(item):
    """Name of a number among the settings of an item, or None."""
    found = (
        prop.identifier
        for prop in item.bl_rna.properties
        if prop.type in {'FLOAT', 'INT'} and prop.is_overridable and not (prop.is_array or prop.is_readonly)
    )
    return next(found, None)


class TestEveryList(support.SceneTestCase):
    """Lists of all systems, filled without the systems' own operators."""

    def setUp(self):
        super().setUp()
        self.lists = support.addon("core.settings.lists")
        self.refused = support.addon("core.refusals").Refused
        registered = support.addon("core.declare").registered
        self.paths = [
            f"motus.{name}.{path}"
            for name, system in sorted(registered.items())
            if name in bpy.types.Object.bl_rna.properties["motus"].fixed_type.properties
            for path in lists_of(system.settings.bl_rna)
        ]
        owner = support.link("Owner")
        for path in self.paths:
            items = owner.path_resolve(path)
            items.add()  # as files have it that were made before items had names
            self.lists.add_numbered(items, "Item")
        self.load(self.save("library.blend"), True, "Owner").override_create(remap_local_usages=True)

    def owner(self):
        return next(obj for obj in bpy.data.objects if obj.override_library)

    def reopen(self):
        bpy.ops.wm.open_mainfile(filepath=self.save("shot.blend"))
        return self.owner()

    def told(self, items):
        number = number_of(items[0])
        return [(item.name, number and getattr(item, number)) for item in items]

    def test_all_systems_with_lists_are_here(self):
        self.assertGreaterEqual(len(self.paths), 20)
        self.assertIn("motus.look_at.entries[0].extra_targets", self.paths)

    def test_what_is_added_is_there_when_the_file_is_opened_again(self):
        wanted = {}
        for path in self.paths:
            items = self.owner().path_resolve(path)
            for index in range(3):
                item = self.lists.add_numbered(items, "Item")
                number = number_of(item)
                if number:
                    prop = item.bl_rna.properties[number]
                    value = prop.hard_min + 2 + index if prop.hard_min > -1e9 else 2 + index
                    setattr(item, number, min(value, prop.hard_max))
            wanted[path] = self.told(items)
            self.assertEqual(len({name for name, _ in wanted[path]}), 5, path)
        for _ in range(2):
            owner = self.reopen()
            for path, told in wanted.items():
                self.assertEqual(self.told(owner.path_resolve(path)), told, path)

    def test_what_the_library_has_is_neither_removed_nor_moved(self):
        for path in self.paths:
            items = self.owner().path_resolve(path)
            self.lists.add_numbered(items, "Item")
            before = self.told(items)
            for change in (
                lambda items=items: self.lists.remove(items, 1),
                lambda items=items: self.lists.move(items, 2, 0),
                lambda items=items: self.lists.replace(items, [{}], "Item"),
                lambda items=items: self.lists.replace(items, [{}, {}, {}], "Item", lambda item, _row: item.name != "Item 2"),
            ):
                with self.assertRaisesRegex(self.refused, "of Owner is from its library and cannot be removed or moved here"):
                    change()
            self.assertEqual(self.told(items), before, path)
            self.lists.remove(items, 2)
            self.assertEqual(self.told(items), before[:2], path)

    def test_a_list_that_is_replaced_is_the_new_one_when_the_file_is_opened_again(self):
        wanted = {}
        for path in self.paths:
            items = self.owner().path_resolve(path)
            for _ in range(3):
                self.lists.add_numbered(items, "Item")
            number = number_of(items[0])
            rows = [{number: items[0].bl_rna.properties[number].hard_max} if number and index else {} for index in range(3)]
            self.lists.replace(items, rows, "Item")
            wanted[path] = self.told(items)
            self.assertEqual([name for name, _ in wanted[path]], ["", "Item 2", "Item 3"], path)
        owner = self.reopen()
        for path, told in wanted.items():
            self.assertEqual(self.told(owner.path_resolve(path)), told, path)


class TestOperators(support.SceneTestCase):
    """Operators that add, change and remove items, on overrides."""

    def override(self, *names):
        owner = self.load(self.save("library.blend"), True, *names).override_create(remap_local_usages=True)
        bpy.context.view_layer.update()
        return owner

    def reopen(self, name):
        bpy.ops.wm.open_mainfile(filepath=self.save("shot.blend"))
        bpy.context.view_layer.update()
        return next(obj for obj in bpy.data.objects if obj.override_library and obj.name == name)

    def follower(self):
        course = path_cases.curve_data("Course")
        path_cases.add_bezier(course, path_cases.cubic_knots(path_cases.CLIMB))
        support.link("Course", course)
        support.link("Car")
        bpy.ops.motus.path_follow_add(object="Car", curve="Course")

    def test_pins_of_a_path(self):
        def told(car):
            return [(pin.frame, pin.fraction) for pin in car.motus.path.pins]

        self.follower()
        bpy.ops.motus.path_pin_add(object="Car", frame=1, fraction=0.0)
        car = self.override("Car", "Course")
        for frame, fraction in ((10, 0.25), (20, 0.5), (30, 1.0), (1, 0.125), (20, 0.75)):
            bpy.ops.motus.path_pin_add(object="Car", frame=frame, fraction=fraction)
        wanted = [(1.0, 0.125), (10.0, 0.25), (30.0, 1.0), (20.0, 0.75)]
        self.assertEqual((told(car), car.motus.path.active_pin), (wanted, 3))
        car = self.reopen("Car")
        self.assertEqual(told(car), wanted)
        self.assertRefused("Pin 1 of Car is from its library", bpy.ops.motus.path_pin_remove, object="Car", index=0)
        bpy.ops.motus.path_pin_remove(object="Car", index=1)
        self.assertEqual(told(self.reopen("Car")), [wanted[0], *wanted[2:]])

    def test_speeds_of_a_path(self):
        def told(car):
            return [(speed.distance, speed.speed) for speed in car.motus.path.speeds]

        self.follower()
        for distance in (0.0, 1.0):
            bpy.ops.motus.path_speed_add(object="Car", distance=distance, speed=3.0)
        car = self.override("Car", "Course")
        bpy.ops.motus.path_speed_add(object="Car", distance=1.0, speed=5.0)
        bpy.ops.motus.path_speed_add(object="Car", distance=2.0, speed=7.0)
        self.assertEqual(told(car), [(0.0, 3.0), (1.0, 5.0), (2.0, 7.0)])
        self.assertRefused("Speed 2 of Car is from its library", bpy.ops.motus.path_speed_remove, object="Car", index=1)
        bpy.ops.motus.path_speeds_from_bends(object="Car", top_speed=4.0)
        found = told(car)
        self.assertGreater(len(found), 3)
        self.assertEqual([place for place, _ in found], sorted({place for place, _ in found}))
        self.assertEqual(told(self.reopen("Car")), found)

    def test_steps_of_a_walker(self):
        def told(walker):
            return [(step.leg, step.frame, step.turn, step.use_lift, step.lift) for step in walker.motus.walker.steps]

        name = walker_cases.spider().name
        walker = self.override(name)
        first, second = walker_cases.foot_bones(walker)[:2]
        for frame in (30, 50, 70):
            bpy.ops.motus.walker_step(object=name, foot=first, frame=frame, turn=0.004 * frame)
            bpy.ops.motus.walker_step_time(object=name, foot=second, frame=frame, lift=frame + 2)
        found = told(walker)
        self.assertEqual(len(found), 6)
        self.assertEqual(told(self.reopen(name)), found)

    def test_dynamics_of_properties_follow_their_own_entries(self):
        def told(box):
            return [(entry.data_path, entry.index) for entry in box.motus.dynamics.entries]

        box = support.link("Box")
        dynamics_cases.key(box, "scale", {1: (1.0, 1.0, 1.0), 20: (2.0, 2.0, 2.0)})
        support.key_places(box, {1: (0.0, 0.0, 0.0), 10: (1.0, 0.0, 0.0)})
        box = self.override("Box")
        wanted = [("", -1), ("scale", -1), ("location", 0)]
        bpy.ops.motus.dynamics_add(object="Box")
        for path, index in wanted[1:]:
            bpy.ops.motus.dynamics_add(object="Box", data_path=path, index=index)
        self.assertEqual(told(box), wanted)
        box = self.reopen("Box")
        self.assertEqual(told(box), wanted)
        bpy.ops.motus.dynamics_add(object="Box", data_path="scale", frequency=3.0)
        self.assertEqual((told(box), box.motus.dynamics.entries[1].frequency), (wanted, 3.0))

    def test_legs_whose_feet_are_objects(self):
        body, shell, feet = walker_cases.cross("Robot")
        bpy.ops.motus.walker_add(object=body.name, feet=walker_cases.names(feet), body=shell.name)
        legs = support.addon("walker.legs")
        self.assertEqual([legs.label(leg) for leg in body.motus.walker.legs], [foot.name for foot in feet])
        self.assertEqual([legs.bone(leg) for leg in body.motus.walker.legs], [""] * len(feet))
        self.assertEqual([foot.thing for foot in legs.feet(body)], feet)
        for leg in body.motus.walker.legs:  # as files have it that were made before these legs had names
            leg.name = ""
        feet[0].name = "Renamed"
        self.assertEqual(legs.label(body.motus.walker.legs[0]), "Renamed")
        self.assertEqual([foot.thing for foot in legs.feet(body)], feet)

    def test_colours_of_snow(self):
        def told(emitter):
            return [stop.position for stop in emitter.motus.snow.stops]

        bpy.ops.motus.snow_add(preset='GENTLE')
        name = bpy.context.object.name
        bpy.ops.motus.snow_stop_add(object=name)
        emitter = self.override(name)
        for _ in range(3):
            bpy.ops.motus.snow_stop_add(object=name)
        found = told(emitter)
        self.assertEqual(len(found), 5)
        emitter = self.reopen(name)
        self.assertEqual(told(emitter), found)
        speed = emitter.motus.snow.start_speed
        self.assertRefused("Color 2 of .* is from its library", bpy.ops.motus.snow_preset, object=name, preset='BLIZZARD')
        self.assertEqual((told(emitter), emitter.motus.snow.start_speed), (found, speed))
        bpy.ops.motus.snow_preset(object=name, preset='SPARKS')
        self.assertEqual(told(emitter), [0.0, 1.0])


class TestOneWay(support.SceneTestCase):
    @support.in_one_blender
    def test_systems_change_lists_by_the_module_of_lists_alone(self):
        kinds = [one.settings.bl_rna for one in support.addon("core.declare").registered.values() if getattr(one, "settings", None)]
        names = {path.rpartition(".")[2] for kind in kinds for path in lists_of(kind)}
        self.assertIn("extra_targets", names)
        # Trees of nodes have links too, and core.settings.entries has a function remove(), whose first argument is a system.
        change = re.compile(rf"(?<!tree\.)\b({'|'.join(sorted(names))})\.(add|clear|remove|move)\((?!(setup\.)?system\()")
        folder = Path(support.addon().__file__).parent
        for path in folder.rglob("*.py"):
            found = [line.strip() for line in path.read_text(encoding="utf-8").splitlines() if change.search(line)]
            self.assertEqual(found, [], path)
