"""Presets of one's own as assets: kept in this file or in a library, and given to objects and bones; what somebody else has made is checked."""

import array
import json
from unittest import mock

import bpy

import support

CATALOGUES = "# A file of the user.\nVERSION 1\n\n11111111-2222-3333-4444-555555555555:Motus/Dynamics:Mine"


class Presets(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.held = support.addon("core.interface.assets.held")
        self.one, self.two = self.new_ball("One"), self.new_ball("Two")
        self.entry("One").frequency = 3.25

    def new_ball(self, name):
        ball = support.link(name)
        bpy.ops.motus.dynamics_add(object=name)
        return ball

    def entry(self, name):
        return bpy.data.objects[name].motus.dynamics.entries[0]

    def select(self, *objects):
        for obj in bpy.context.view_layer.objects:
            obj.select_set(obj in objects)
        bpy.context.view_layer.objects.active = objects[0] if objects else None

    def keep(self, name="Bouncy", **keywords):
        return bpy.ops.motus.asset_keep(object="One", system="dynamics", name=name, **keywords)

    def new_library(self):
        """An asset library in the preferences, for this test; returns its folder."""
        folder = self.folder / "Library"
        folder.mkdir()
        libraries = bpy.context.preferences.filepaths.asset_libraries
        bpy.ops.preferences.asset_library_add(directory=str(folder))
        libraries[-1].name = "Mine"
        self.addCleanup(lambda: bpy.ops.preferences.asset_library_remove(index=libraries.find("Mine")))
        return folder


class Keeping(Presets):
    def test_in_this_file(self):
        self.assertEqual(self.keep(), {'FINISHED'})
        holder = bpy.data.objects["Bouncy"]
        self.assertEqual((holder.type, list(holder.users_collection), holder.use_fake_user), ('EMPTY', [], True))
        self.assertEqual({tag.name for tag in holder.asset_data.tags}, {"Motus", "Dynamics"})
        self.assertEqual(json.loads(holder[self.held.TEXT])["values"]["frequency"], 3.25)
        self.keep("")
        self.assertIsNotNone(bpy.data.objects["Dynamics"].asset_data)
        for taken in ("Bouncy", "One"):
            self.assertRefused("There is an object", self.keep, name=taken)

    def own(self):
        """Names of the objects, without those that Motus hides."""
        return {obj.name for obj in bpy.data.objects if not obj.name.startswith(".")}

    def test_in_a_library(self):
        folder, before = self.new_library(), self.own()
        self.keep(library="Mine")
        written = folder / "Motus" / "Bouncy.blend"
        kept = written.read_bytes()
        self.assertEqual(self.own(), before)
        self.entry("One").frequency = 5.0
        self.assertRefused("exists already", self.keep, library="Mine")
        self.assertEqual(written.read_bytes(), kept)
        bpy.ops.motus.asset_give(name="Bouncy", path=str(written), object="Two")
        self.assertEqual(self.entry("Two").frequency, 3.25)
        self.assertEqual((self.own(), list(bpy.data.libraries)), (before, []))
        with bpy.data.libraries.load(str(written), link=False, assets_only=True) as (there, _):
            self.assertEqual(there.objects, ["Bouncy"])

    def test_a_library_that_is_not_there(self):
        folder = self.new_library()
        self.assertRefused("no asset library", self.keep, library="Other")
        (folder / "Motus").write_text("a file of somebody else")
        self.assertRefused("exists already", self.keep, library="Mine")
        self.assertEqual([path.name for path in folder.iterdir()], ["Motus"])
        (folder / "Motus").unlink()
        folder.rmdir()
        self.assertRefused("has no folder", self.keep, library="Mine")

    def test_catalogues(self):
        folder, catalogues = self.new_library(), support.addon("core.interface.assets.catalogues")
        self.keep(library="Mine")
        self.keep("Second", library="Mine")
        system = support.addon("core.declare").registered["dynamics"]
        (line,) = [line for line in (folder / catalogues.FILE).read_text().splitlines() if "Motus" in line]
        self.assertEqual(line, f"{catalogues.identifier(system)}:Motus/Dynamics:Motus-Dynamics")
        with bpy.data.libraries.load(str(folder / "Motus" / "Second.blend")) as (_, wanted):
            wanted.objects = ["Second"]
        self.assertEqual(wanted.objects[0].asset_data.catalog_id, catalogues.identifier(system))

    def test_catalogues_of_the_user_stay(self):
        folder, catalogues = self.new_library(), support.addon("core.interface.assets.catalogues")
        registered, file = support.addon("core.declare").registered, folder / catalogues.FILE
        file.write_bytes(CATALOGUES.encode())
        self.assertEqual(catalogues.entered(registered["dynamics"], folder), "11111111-2222-3333-4444-555555555555")
        self.assertEqual(file.read_bytes(), CATALOGUES.encode())
        own = catalogues.entered(registered["chains"], folder)
        self.assertEqual(file.read_text(), f"{CATALOGUES}\n{own}:Motus/Chains:Motus-Chains\n")
        for strange in (b"\xff\xfe\x00", b"no-number:Motus/Dynamics:x\n"):
            file.write_bytes(strange)
            self.assertEqual(catalogues.entered(registered["dynamics"], folder), catalogues.identifier(registered["dynamics"]))
            self.assertTrue(file.read_bytes().startswith(strange))

    def test_the_picture_is_kept_in_the_file(self):
        folder, picture = self.new_library(), support.addon("core.interface.assets.picture")
        count = 4 * picture.SIZE**2
        drawn = array.array('f', (index % 256 / 255.0 for index in range(count)))
        with mock.patch.object(picture, "draw", lambda *_: drawn):
            self.keep(library="Mine")
        with bpy.data.libraries.load(str(folder / "Motus" / "Bouncy.blend")) as (_, wanted):
            wanted.objects = ["Bouncy"]
        preview = wanted.objects[0].preview
        self.assertEqual(tuple(preview.image_size), (picture.SIZE, picture.SIZE))
        found = array.array('f', [0.0]) * count
        preview.image_pixels_float.foreach_get(found)
        self.assertLess(max(abs(one - other) for one, other in zip(found, drawn)), 1.0 / 255.0)


class Giving(Presets):
    def test_values_and_keys(self):
        self.entry("One").keyframe_insert("weight", frame=4)
        self.keep()
        bpy.ops.motus.asset_give(name="Bouncy", object="Two", with_keys=True)
        self.assertEqual(self.entry("Two").frequency, 3.25)
        curves = support.addon("core.blender.actions").fcurves(self.two)
        self.assertEqual([curve.data_path for curve in curves], ["motus.dynamics.entries[0].weight"])

    def test_all_that_is_selected(self):
        self.keep()
        three = self.new_ball("Three")
        self.select(self.two, three)
        bpy.ops.motus.asset_give(name="Bouncy")
        self.assertEqual([self.entry(name).frequency for name in ("Two", "Three")], [3.25, 3.25])
        self.select()
        self.assertRefused("Select what", bpy.ops.motus.asset_give, name="Bouncy")

    def test_a_missing_system_is_added(self):
        self.keep()
        support.link("Free")
        bpy.ops.motus.asset_give(name="Bouncy", object="Free")
        self.assertEqual(self.entry("Free").frequency, 3.25)

    def test_a_system_that_needs_more_is_not_added(self):
        curve = support.link("Curve", bpy.data.curves.new("Curve", 'CURVE'))
        curve.data.splines.new('POLY').points.add(1)
        curve.data.splines[0].points[1].co = (5.0, 0.0, 0.0, 1.0)
        for obj in (self.one, self.two):
            bpy.ops.motus.path_follow_add(object=obj.name, curve="Curve")
        self.one.motus.path.speed = 7.5
        bpy.ops.motus.asset_keep(object="One", system="path", name="Fast")
        free = support.link("Free")
        self.assertRefused("Free has no Follow Path", bpy.ops.motus.asset_give, name="Fast", object="Free")
        self.select(free, self.two)
        bpy.ops.motus.asset_give(name="Fast")  # to the one that has it
        self.assertEqual(self.two.motus.path.speed, 7.5)
        self.assertFalse(free.motus.path.is_active)

    def test_an_object_that_the_system_cannot_work_on(self):
        camera = support.link("Camera", bpy.data.cameras.new("Camera"))
        self.select(camera)
        bpy.ops.motus.stereo_rig_add(object="Camera")
        bpy.ops.motus.asset_keep(object="Camera", system="stereo", name="Eyes")
        self.assertRefused("is no camera|not a camera", bpy.ops.motus.asset_give, name="Eyes", object="Two")
        other = support.link("Other", bpy.data.cameras.new("Other"))
        bpy.ops.motus.asset_give(name="Eyes", object="Other")
        self.assertTrue(other.motus.stereo.is_active)

    def new_rig(self, name):
        rig = support.link(name, bpy.data.armatures.new(name))
        self.select(rig)
        bpy.ops.object.mode_set(mode='EDIT')
        for number in range(3):
            bone = rig.data.edit_bones.new(f"Tail {number}")
            bone.head, bone.tail = (number, 0.0, 0.0), (number, 1.0, 0.0)
        bpy.ops.object.mode_set(mode='POSE')
        return rig

    def test_bones(self):
        rig = self.new_rig("Rig")
        bpy.ops.motus.chains_add(object="Rig", bones="Tail 0")
        rig.motus.chains.entries["Tail 0"].damping = 0.75
        bpy.ops.motus.asset_keep(object="Rig", system="chains", entry="Tail 0", name="Loose")
        bpy.ops.motus.asset_give(name="Loose", object="Rig", bones="Tail 1")
        self.assertEqual({entry.name: entry.damping for entry in rig.motus.chains.entries}, {"Tail 0": 0.75, "Tail 1": 0.75})
        self.assertRefused("no bone Nose", bpy.ops.motus.asset_give, name="Loose", object="Rig", bones="Nose")
        for bone in rig.pose.bones:
            (bone if hasattr(bone, "select") else bone.bone).select = bone.name != "Tail 0"
        rig.motus.chains.entries["Tail 1"].damping = 0.1
        bpy.ops.motus.asset_give(name="Loose")
        self.assertEqual([entry.damping for entry in rig.motus.chains.entries], [0.75] * 3)

    def test_linked_and_baked_owners_are_refused(self):
        self.keep()
        self.two.motus.bake.is_baked = True
        self.assertRefused("is baked", bpy.ops.motus.asset_give, name="Bouncy", object="Two")
        self.two.motus.bake.is_baked = False
        self.select(self.one, self.two)
        linked = self.load(self.save(), True, "Two")
        with mock.patch.object(self.held, "read", lambda _place: json.dumps({"motus": 1, "system": "dynamics", "values": {}, "keys": {}})):
            self.assertRefused("linked", bpy.ops.motus.asset_give, name="Bouncy", object=linked.name)


class OfSomebodyElse(Presets):
    """Nothing that a file may have in the place of an asset changes anything."""

    def assertGivenNothing(self, part, **place):
        free = bpy.data.objects.get("Free") or support.link("Free")
        before = self.entry("Two").frequency, set(bpy.data.objects), len(bpy.data.libraries)
        self.select(self.two, free)
        self.assertRefused(part, bpy.ops.motus.asset_give, with_keys=True, with_shot=True, **place)
        self.assertEqual((self.entry("Two").frequency, set(bpy.data.objects), len(bpy.data.libraries)), before)
        self.assertFalse(free.motus.dynamics.is_active)

    def test_texts(self):
        self.keep()
        holder = bpy.data.objects["Bouncy"]
        text = json.loads(holder[self.held.TEXT])
        for part, content in (
            ("holds no settings", None),
            ("holds no settings", 3),
            ("holds no settings", [1.0, 2.0]),
            ("holds no settings", {"motus": 1}),
            ("holds no settings", "import os"),
            ("holds no settings", "[" * 100000),
            ("holds no settings", " " * (1 << 22) + "1"),
            ("holds no settings", json.dumps(text | {"more": 1})),
            ("newer version", json.dumps(text | {"motus": 2})),
            ("no system", json.dumps(text | {"system": "x" * 1000})),
            ("no system", json.dumps(text | {"system": "hand_over"})),
            ("does not fit", json.dumps(text | {"values": {"frequency": "fast"}})),
            ("does not fit", json.dumps(text | {"keys": {"frequency": [1]}})),
        ):
            with self.subTest(part, content=str(content)[:40]):
                del holder[self.held.TEXT]
                if content is not None:
                    holder[self.held.TEXT] = content
                self.assertGivenNothing(part, name="Bouncy")
                holder[self.held.TEXT] = ""

    def test_files(self):
        self.keep()
        path = self.save()
        bpy.data.objects.remove(bpy.data.objects["Bouncy"])
        self.assertGivenNothing("holds no settings", name="Bouncy")
        self.assertGivenNothing("holds no settings", name="Two", path=path)
        self.assertGivenNothing("holds no settings", name="Nobody", path=path)
        self.assertGivenNothing("cannot be read", name="Bouncy", path=str(self.folder / "gone.blend"))
        strange = self.folder / "strange.blend"
        strange.write_text("no file of Blender")
        self.assertGivenNothing("cannot be read", name="Bouncy", path=str(strange))
        self.assertGivenNothing("cannot be read", name="Bouncy", path=str(self.folder))
        bpy.ops.motus.asset_give(name="Bouncy", path=path, object="Two")
        self.assertEqual(self.entry("Two").frequency, 3.25)


class OfAShelf(Presets):
    """Which asset a shelf means, by what it tells an operator."""

    def place(self, kind, library, relative):
        giving = support.addon("core.interface.assets.giving").Giving
        made = mock.Mock(asset_library_type=kind, asset_library_identifier=library, relative_asset_identifier=relative)
        return giving._place(made, mock.Mock(asset=None, asset_file_handle=None, preferences=bpy.context.preferences))

    def test_places(self):
        folder = self.new_library()
        self.assertEqual(self.place('LOCAL', "", "Object/Bouncy"), ("Bouncy", ""))
        self.assertEqual(
            self.place('CUSTOM', "Mine", "Motus/Bouncy.blend/Object/Bouncy"), ("Bouncy", str(folder / "Motus" / "Bouncy.blend"))
        )
        self.assertEqual(self.place('CUSTOM', "Mine", "a.blend\\Object\\Bouncy"), ("Bouncy", str(folder / "a.blend")))
        for strange in (
            ("CUSTOM", "Gone", "a.blend/Object/B"),
            ("ESSENTIALS", "", "a.blend/Object/B"),
            ("", "", ""),
            ("CUSTOM", "Mine", "x"),
        ):
            self.assertIsNone(self.place(*strange))


class Registration(support.SceneTestCase):
    def test_the_shelf_is_hidden_until_it_is_switched_on(self):
        shelf = getattr(bpy.types, "MOTUS_AST_presets", None)
        has = support.addon("core.blender.capabilities").has_asset_shelves()
        self.assertEqual(shelf is not None, has)
        if not has:
            return
        with mock.patch.object(support.addon("core.interface.view.preferences"), "own", lambda _context: None):
            self.assertFalse(shelf.poll(bpy.context))
        for is_on in (False, True):
            own = mock.Mock(show_preset_shelf=is_on)
            with mock.patch.object(support.addon("core.interface.view.preferences"), "own", lambda _context, own=own: own):
                self.assertEqual(shelf.poll(bpy.context), is_on)
