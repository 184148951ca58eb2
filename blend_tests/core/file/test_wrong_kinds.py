"""Settings in which a script has written what they are not declared for: nothing raises, in no solver, panel, overlay or operator."""

import functools
import itertools
import tempfile
import types
from pathlib import Path

import bpy

import live_scenes
import support
from core import test_habits
from core.wiring.hubs import damaged_cases

overlay = support.addon("core.interface.overlay")
pointers = support.addon("core.file.pointers")

LEAVE_OUT = {"motus.demo_scene"}
"""Operators that make a scene of their own."""


def groups_of(group, raw):
    """Yields (group of settings, the ID properties that hold it) of a group and all those in it, as far as there are any."""
    yield group, raw
    for prop in group.bl_rna.properties:
        if prop.identifier == "rna_type" or prop.identifier not in raw or prop.is_skip_save:
            continue
        inner = getattr(group, prop.identifier)
        if prop.type == 'COLLECTION':
            for item, its in zip(inner, raw[prop.identifier]):
                yield from groups_of(item, its)
        elif isinstance(inner, bpy.types.PropertyGroup):
            yield from groups_of(inner, raw[prop.identifier])


def raw_of(owner):
    """The ID properties that hold an object's or scene's settings."""
    holder = owner.bl_system_properties_get() if hasattr(owner, "bl_system_properties_get") else owner
    return holder["motus"]


def settings():
    """(group, raw) of all settings in the file."""
    owners = [one for one in (*bpy.data.objects, *bpy.data.scenes) if one.is_property_set("motus")]
    return [pair for owner in owners for pair in groups_of(owner.motus, raw_of(owner))]


def is_pointer(prop):
    """Whether a property is a pointer to a datablock."""
    return (
        prop.type == 'POINTER'
        and prop.identifier != "rna_type"
        and hasattr(bpy.types, prop.fixed_type.identifier)
        and (issubclass(getattr(bpy.types, prop.fixed_type.identifier), bpy.types.ID))
    )


def is_choice(prop):
    return prop.type == 'ENUM' and not prop.is_enum_flag and not prop.is_skip_save


def is_plain(prop):
    """Whether a property is a number, a text, a switch or an array of such, or a choice; not the one without which nothing works."""
    return prop.type in {'INT', 'FLOAT', 'STRING', 'BOOLEAN', 'ENUM'} and not prop.is_skip_save and prop.identifier != "is_active"


def places(wanted):
    """{class of settings: {name: [(group, raw)]}} of those properties in the file that are wanted."""
    found = {}
    for group, raw in settings():
        for prop in group.bl_rna.properties:
            if wanted(prop):
                found.setdefault(type(group).__name__, {}).setdefault(prop.identifier, []).append((group, raw))
    return found


def rounds(wanted):
    """{(class, name): [(group, raw)]}, in each round another property of each class: what is wrong in one system hides nothing in others."""
    for names in itertools.zip_longest(*([(kind, name) for name in found] for kind, found in places(wanted).items())):
        yield [name for name in names if name]


def calls_of(system, shared=True):
    """Names of the operators of a system's folder, and of those that all systems share."""
    folders = {folder_of(system.settings), *(["core"] if shared else [])}
    return sorted({cls.bl_idname for cls in test_habits.operators() if folder_of(cls) in folders} - LEAVE_OUT)


def folder_of(cls):
    return cls.__module__.removeprefix(f"{test_habits.package}.").partition(".")[0]


def wrong_things():
    """Datablocks of many kinds, and objects of types that hardly any pointer is declared for."""
    data = bpy.data
    return [
        data.objects.new("Wrong", data.speakers.new("Wrong")),
        data.meshes.new("Wrong"),
        data.objects.new("Wrong empty", None),
        data.materials.new("Wrong"),
        data.armatures.new("Wrong"),
        data.actions.new("Wrong"),
        data.node_groups.new("Wrong", 'ShaderNodeTree'),
    ]


def draw_panels(registered):
    """Draws panels as Blender does, but into a Layout: sub-panels if the panel that they are in is shown. registered: of panels()."""
    shown = {}
    for cls in registered:
        shown[cls.__name__] = shown.get(getattr(cls, "bl_parent_id", ""), True) and (not hasattr(cls, "poll") or cls.poll(bpy.context))
        if shown[cls.__name__]:
            cls.draw(types.SimpleNamespace(layout=Layout()), bpy.context)


def panels():
    """All registered panels but those of presets, which Blender draws; each before its sub-panels."""
    return [
        cls
        for cls in bpy.types.Panel.__subclasses__()
        if cls.__module__.startswith(f"{test_habits.package}.")
        and getattr(cls, "is_registered", False)
        and not hasattr(cls, "preset_subdir")
    ]


class Layout(test_habits.Layout):
    """Draws the items of lists too."""

    def _inner(self, *_arguments, **_options):
        return Layout(self.drawn, self)

    row = column = box = split = grid_flow = column_flow = _inner

    def template_list(self, kind, _name, data, name, active_data, active, **_options):
        cls = getattr(bpy.types, kind)
        for index, item in enumerate(getattr(data, name)):
            cls.draw_item(types.SimpleNamespace(layout_type='DEFAULT'), bpy.context, self, data, item, 0, active_data, active, index)

    def template_ID(self, *_arguments, **_options):
        pass


@functools.cache
def live_file():
    """(path of a file with all systems, on a frame of it, what deletes it at the end)."""
    folder = tempfile.TemporaryDirectory(prefix="motus-test-")
    path = str(Path(folder.name, "live.blend"))
    live_scenes.opened()
    bpy.context.scene.frame_set(13)
    bpy.context.scene.frame_end = 3
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    return path, folder


class LiveFile(support.SceneTestCase):
    """Base of tests that spoil a file with all systems, which is open at first, time and again, and look at everything."""

    def setUp(self):
        super().setUp()
        bpy.ops.wm.open_mainfile(filepath=live_file()[0])
        bpy.context.view_layer.update()
        self.is_as_opened = True

    def reopen(self):
        """Has the file open as it is; called before each time that it is spoilt."""
        if not self.is_as_opened:
            bpy.ops.wm.open_mainfile(filepath=live_file()[0])
            bpy.context.view_layer.update()
        self.is_as_opened = False

    def look(self):
        """Evaluates everything, and draws every panel and what the viewport shows of an object of each kind."""
        for block in bpy.data.objects:
            block.update_tag()
        for frame in (14, 17):
            bpy.context.scene.frame_set(frame)
        registered = panels()
        for obj in self.one_of_each_kind():
            bpy.context.view_layer.objects.active = obj
            draw_panels(registered)
            overlay.batches(bpy.context)
            overlay.notes(bpy.context)

    @staticmethod
    def one_of_each_kind():
        """Objects that differ in their type or in the systems whose settings they have."""
        kinds = {}
        for obj in bpy.context.scene.objects:
            names = tuple(one.name for one in test_habits.system.systems() if test_habits.system.has_settings(one, obj))
            kinds[obj.type, names] = obj
        return list(kinds.values())

    def operate(self, active, calls):
        """Calls operators by their names with the active object of a name, as long as it is there."""
        for name in calls:
            obj = bpy.context.scene.objects.get(active)
            if obj is None:
                return
            # Set only if it is not so: Blender evaluates and Motus looks for what to repair before each operator that follows.
            if bpy.context.view_layer.objects.active != obj:
                bpy.context.view_layer.objects.active = obj
            if not obj.select_get():
                obj.select_set(True)
            try:
                getattr(bpy.ops.motus, name.partition(".")[2])()
            except RuntimeError as error:
                self.assertNotIn("Traceback", str(error), name)
            if bpy.context.mode != 'OBJECT':
                bpy.ops.object.mode_set(mode='OBJECT')

    def owners(self):
        """{system: names of its owners}."""
        return {
            one: [obj.name for obj in bpy.context.scene.objects if test_habits.system.is_owner(one, obj)]
            for one in test_habits.system.systems()
        }

    def write(self, name, found, values):
        """Writes the values in turn in a property's place in groups of a class. found: pairs of places()."""
        for number, (_, raw) in enumerate(found):
            if name in raw:
                del raw[name]  # or Blender refuses a value of another type
            if values:
                raw[name] = values[number % len(values)]


class WrongKinds(LiveFile):
    def each(self, wanted, values):
        """Spoils one property of each class after the other, and looks at everything."""
        for number, names in enumerate(list(rounds(wanted))):
            with self.subTest(names=names), damaged_cases.raised() as errors:
                self.reopen()
                wrong, found = values(number), places(wanted)
                for kind, name in names:
                    self.write(name, found[kind][name], wrong)
                self.look()
                self.assertEqual(errors, [])

    def test_pointers(self):
        def turned(number):
            things = wrong_things()
            return things[number % 2 :] + things[: number % 2]

        self.each(is_pointer, turned)

    @support.in_one_blender
    def test_pointers_and_every_operator(self):
        for number, (one, names) in enumerate(self.owners().items()):
            with self.subTest(system=one.name), damaged_cases.raised() as errors:
                self.reopen()
                things = wrong_things()
                for index, kind in enumerate(places(is_pointer).values()):
                    for name, found in kind.items():
                        if name not in {"hub", "leader"} or number % 2:
                            self.write(name, found, things[(index + number) % len(things) :] + things)
                self.operate(names[0], calls_of(one))
                self.assertEqual(errors, [])

    def test_choices(self):
        self.each(is_choice, lambda _number: [77, -3])

    @support.in_one_blender
    def test_values_of_another_type(self):
        values = ["x", 5, -9, [1.0, 2.0], {"x": 1}]
        for is_there in (True, False):
            with self.subTest(is_there=is_there), damaged_cases.raised() as errors:
                self.reopen()
                for kind in places(is_plain).values():
                    for number, (name, found) in enumerate(kind.items()):
                        self.write(name, found, values[number % len(values) :] + values if is_there else [])
                self.look()
                self.assertEqual(errors, [])

    @support.in_one_blender
    def test_empty_lists_and_no_active_item(self):
        """Lists that a script has emptied, and active items that there are not: for each, all panels, and operators of the system."""
        for wanted, values in (
            (lambda prop: prop.type == 'COLLECTION', []),
            (lambda prop: prop.type == 'INT' and prop.identifier.startswith("active_"), [77, -9]),
        ):
            with self.subTest(values=values), damaged_cases.raised() as errors:
                self.reopen()
                owners = self.owners()
                for kind, names in places(wanted).items():
                    for name in names:  # looked for anew: what was emptied may have held others
                        self.write(name, places(lambda prop, name=name: prop.identifier == name).get(kind, {}).get(name, ()), values)
                self.look()
                for one, names in owners.items():
                    self.operate(names[0], calls_of(one, shared=False))
                self.assertEqual(errors, [])


class OtherOwners(support.SceneTestCase):
    """Settings that a script has given to an object that the system cannot work on."""

    def test_copied_to_objects_of_other_types(self):
        live_scenes.opened()
        system = test_habits.system
        owners = {one: next(obj for obj in bpy.context.scene.objects if system.is_owner(one, obj)) for one in system.systems()}
        made = {'MESH': bpy.data.meshes, 'ARMATURE': bpy.data.armatures, 'LATTICE': bpy.data.lattices, 'CAMERA': bpy.data.cameras}
        others = [
            (one, obj, bpy.data.objects.new(f"{one.name} {kind}", data.new(kind) if data else None))
            for one, obj in owners.items()
            for kind, data in (*made.items(), ('EMPTY', None))
            if kind != obj.type
        ]
        with damaged_cases.raised() as errors:
            for one, obj, other in others:
                bpy.context.scene.collection.objects.link(other)
                getattr(other.motus, one.name).is_active = True
                values = raw_of(obj)[one.name].to_dict()
                del raw_of(other)[one.name]
                raw_of(other)[one.name] = values
            for frame in (14, 17):
                bpy.context.scene.frame_set(frame)
            for one, _, other in others:
                bpy.context.view_layer.objects.active = other
                draw_panels(panels())
                self.assertFalse(system.is_owner(one, other) and one.owner_types and other.type not in one.owner_types, other.name)
            self.assertEqual(errors, [])


class Reader(support.SceneTestCase):
    def test_objects_of_other_types(self):
        """A curve that was turned into a mesh, and a camera's place that an empty has."""
        live_scenes.opened()
        follower, course = bpy.data.objects["Car"], bpy.data.objects["Course"]
        self.assertEqual(pointers.pointed(follower.motus.path, "curve"), course)
        bpy.context.view_layer.objects.active = course
        for obj in bpy.context.scene.objects:
            obj.select_set(obj == course)
        bpy.ops.object.convert(target='MESH')
        self.assertEqual(bpy.data.objects["Course"].type, 'MESH')
        self.assertIsNone(pointers.pointed(follower.motus.path, "curve"))
        snow = bpy.data.objects["Snow"].motus.snow
        snow.camera = bpy.data.objects["Target"]
        self.assertIsNone(pointers.pointed(snow, "camera"))
        snow.camera = bpy.data.objects["Eyes"]
        self.assertEqual(pointers.pointed(snow, "camera"), bpy.data.objects["Eyes"])

    def test_wrong_datablocks(self):
        live_scenes.opened()
        things, found = wrong_things(), 0
        for kind, names in places(is_pointer).items():
            for name, pairs in names.items():
                for number, (group, raw) in enumerate(pairs):
                    if name in raw:
                        del raw[name]
                    raw[name] = things[number % len(things)]
                    value = pointers.pointed(group, name)
                    declared = getattr(bpy.types, group.bl_rna.properties[name].fixed_type.identifier)
                    self.assertIsInstance(value, (declared, type(None)), (kind, name))
                    found += 1
        self.assertGreater(found, 100)

    def test_pickers_offer_no_helpers(self):
        live_scenes.opened()
        hidden = [obj for obj in bpy.data.objects if not obj.users_collection]
        self.assertGreater(len(hidden), 10)
        for group, _ in settings():
            for name, annotation in getattr(type(group), "__annotations__", {}).items():
                poll = getattr(annotation, "keywords", {}).get("poll")
                if poll is not None:
                    self.assertFalse(any(poll(group, obj) for obj in hidden), (type(group).__name__, name))
