"""Pointers and choices of settings that name what they are not declared for: nothing raises, in no solver, panel or operator."""

import bpy
from core import test_habits
from core.wiring import damaged_cases
import live_scenes
import support

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


def declared(kind):
    """{(class, name): [(group, raw)]} of the pointers to datablocks, or of the choices, in all settings of the file."""
    found = {}
    for group, raw in settings():
        for prop in group.bl_rna.properties:
            is_pointer = prop.type == 'POINTER' and prop.identifier != "rna_type" and (
                not issubclass(getattr(bpy.types, prop.fixed_type.identifier, bpy.types.ID), bpy.types.PropertyGroup))
            is_choice = prop.type == 'ENUM' and not prop.is_enum_flag and not prop.is_skip_save
            if kind == 'POINTER' and is_pointer or kind == 'ENUM' and is_choice:
                found.setdefault((type(group).__name__, prop.identifier), []).append((group, raw))
    return found


def wrong_things():
    """Datablocks of many kinds, and objects of types that hardly any pointer is declared for."""
    material, action = bpy.data.materials.new("Wrong"), bpy.data.actions.new("Wrong")
    mesh, armature = bpy.data.meshes.new("Wrong"), bpy.data.armatures.new("Wrong")
    speaker = bpy.data.objects.new("Wrong", bpy.data.speakers.new("Wrong"))
    empty = bpy.data.objects.new("Wrong empty", None)
    return [mesh, armature, material, action, bpy.data.node_groups.new("Wrong", 'ShaderNodeTree'), speaker, empty]


class WrongKinds(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        live_scenes.build()
        bpy.context.scene.frame_set(13)
        bpy.context.scene.frame_end = 3
        self.path = str(self.folder / "live.blend")
        bpy.ops.wm.save_as_mainfile(filepath=self.path)

    def reopen(self):
        bpy.ops.wm.open_mainfile(filepath=self.path)
        bpy.context.view_layer.update()

    def look(self):
        """Evaluates everything, and draws every panel of every object."""
        for block in bpy.data.objects:
            block.update_tag()
        for frame in (14, 17):
            bpy.context.scene.frame_set(frame)
        panels = [cls for cls in bpy.types.Panel.__subclasses__() if cls.__module__.startswith(f"{test_habits.package}.")]
        for obj in bpy.context.scene.objects:
            bpy.context.view_layer.objects.active = obj
            for cls in panels:
                test_habits.drawn(cls)

    def operate(self):
        """Calls every operator with what is active, for an owner of each system."""
        for name in sorted({cls.bl_idname for cls in test_habits.operators()} - LEAVE_OUT):
            for obj in self.owners():
                if obj not in set(bpy.context.scene.objects):
                    continue
                bpy.context.view_layer.objects.active = obj
                obj.select_set(True)
                try:
                    getattr(bpy.ops.motus, name.partition(".")[2])()
                except RuntimeError as error:
                    self.assertNotIn("Traceback", str(error), (name, obj.name))
                if bpy.context.mode != 'OBJECT':
                    bpy.ops.object.mode_set(mode='OBJECT')

    @staticmethod
    def owners():
        found = {}
        for obj in bpy.context.scene.objects:
            for one in test_habits.system.systems():
                if test_habits.system.is_owner(one, obj):
                    found.setdefault(one.name, obj)
        return list(dict.fromkeys(found.values()))

    def write(self, places, name, values):
        for number, (_, raw) in enumerate(places):
            if name in raw:
                del raw[name]  # or Blender refuses a value of another type
            raw[name] = values[number % len(values)]

    def test_each_pointer(self):
        for place in declared('POINTER'):
            with self.subTest(pointer=place), damaged_cases.raised() as errors:
                self.reopen()
                things, found = wrong_things(), declared('POINTER').get(place, ())
                self.write(found, place[1], things)
                for group, _ in found:
                    value, kind = pointers.pointed(group, place[1]), group.bl_rna.properties[place[1]].fixed_type.identifier
                    self.assertIsInstance(value, (getattr(bpy.types, kind), type(None)))
                self.look()
                self.assertEqual(errors, [])

    def test_all_pointers_and_every_operator(self):
        for number in range(2):
            with damaged_cases.raised() as errors:
                self.reopen()
                things = wrong_things()
                for index, ((_, name), found) in enumerate(declared('POINTER').items()):
                    self.write(found, name, things[(index + 3 * number) % len(things):] + things)
                self.look()
                self.operate()
                self.assertEqual(errors, [])

    def test_each_choice(self):
        for place in declared('ENUM'):
            with self.subTest(choice=place), damaged_cases.raised() as errors:
                self.reopen()
                self.write(declared('ENUM').get(place, ()), place[1], [77])
                self.look()
                self.assertEqual(errors, [])


class Reader(support.SceneTestCase):
    def test_objects_of_other_types(self):
        """A curve that was turned into a mesh, and a camera's place that an empty has."""
        live_scenes.build()
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

    def test_pickers_offer_no_helpers(self):
        live_scenes.build()
        hidden = [obj for obj in bpy.data.objects if not obj.users_collection]
        self.assertGreater(len(hidden), 10)
        for group, _ in settings():
            for name, annotation in getattr(type(group), "__annotations__", {}).items():
                poll = getattr(annotation, "keywords", {}).get("poll")
                if poll is not None:
                    self.assertFalse(any(poll(group, obj) for obj in hidden), (type(group).__name__, name))
