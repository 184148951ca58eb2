"""The manual from Blender: each operator and each setting has its place there, and the place is opened in the user's language."""

import ast
import importlib
import sys
import unittest
import webbrowser
from pathlib import Path
from unittest import mock

import bpy

import support
import test_translations


def module():
    return support.addon("core.interface.manual")


def places():
    """{what Blender asks for: place in the manual}."""
    return dict(module().manual_map()[1])


def site(name):
    """A module of the manual's site, which is plain Python."""
    with mock.patch.object(sys, "path", [str(support.CLONE / "docs" / "site"), *sys.path]):
        return importlib.import_module(name)


def groups():
    """Names of all classes of the add-on that hold settings, in lower case, and their RNA properties without those that are hidden."""
    for cls in test_translations.registered_classes():
        if issubclass(cls, (bpy.types.PropertyGroup, bpy.types.AddonPreferences)):
            yield cls.__name__.lower(), [prop for prop in cls.bl_rna.properties if prop.is_runtime and not prop.is_hidden]


class PlacesTest(support.SceneTestCase):
    def test_each_operator_has_its_section(self):
        found, anchors = places(), site("content").anchors(support.CLONE)
        for name in dir(bpy.ops.motus):
            place = found[f"bpy.ops.motus.{name}"]
            self.assertEqual(place, f"operators.html#motus.{name}")
            self.assertTrue(place in anchors or 'INTERNAL' in getattr(bpy.types, f"MOTUS_OT_{name}").bl_options, name)

    def test_each_setting_has_its_row(self):
        found, anchors = places(), site("content").anchors(support.CLONE)
        for struct, properties in groups():
            for prop in properties:
                place = found.get(f"bpy.types.{struct}.{prop.identifier}")
                if place is not None:
                    self.assertIn(place, anchors)
                else:
                    self.assertTrue(self.needs_none(struct, prop), f"{struct}.{prop.identifier} has no place, and is not hidden")

    def needs_none(self, struct, prop):
        """Whether the interface does not show a property by itself: a list, the index of its active line, or what only operators hold."""
        return prop.type in {'POINTER', 'COLLECTION'} or prop.identifier.startswith("active_") or struct in OF_OPERATORS

    @support.in_one_blender
    def test_the_pages_that_come_along_have_the_places(self):
        files = site("plain").files(support.CLONE)
        for asked, place in places().items():
            page, _, anchor = place.partition("#")
            operator = getattr(bpy.types, f"MOTUS_OT_{asked.removeprefix('bpy.ops.motus.')}", None)
            if operator is None or 'INTERNAL' not in operator.bl_options:
                self.assertTrue(f'id="{anchor}"' in files[f"en/{page}"], place)

    def test_each_panels_page_comes_along(self):
        pages = {support.addon("core.declare").page(feature) for feature in support.addon("core.declare").registered.values()}
        names = {Path(name).stem for name in site("plain").files(support.CLONE) if name.startswith("en/")}
        self.assertEqual({*pages, module().START, module().GENERAL} - names, set())

    @support.in_one_blender
    def test_what_panels_draw_is_not_hidden(self):
        operators = [getattr(bpy.ops.motus, name).get_rna_type() for name in dir(bpy.ops.motus)]
        seen = {prop.identifier for properties in (*dict(groups()).values(), *(one.properties for one in operators)) for prop in properties}
        hidden = {
            prop.identifier
            for cls in test_translations.registered_classes()
            if issubclass(cls, bpy.types.PropertyGroup)
            for prop in cls.bl_rna.properties
            if prop.is_hidden
        }
        folder = Path(support.addon().__file__).parent
        drawn = {name for path in folder.rglob("*.py") for name in drawn_names(path.read_text(encoding="utf-8"))}
        self.assertEqual(sorted(drawn & hidden - seen), [])
        self.assertIn("duration", drawn)


OF_OPERATORS = {"motus_pg_dab", "motus_pg_pull_record"}
"""What is in no list of settings: strokes that operators are given."""


def drawn_names(source):
    """Names of the properties that Python code draws by prop() and prop_search(), or declares as rows."""
    for node in ast.walk(ast.parse(source)):
        if not isinstance(node, ast.Call):
            continue
        called = getattr(node.func, "attr", getattr(node.func, "id", ""))
        for argument in node.args[DRAWS[called] : DRAWS[called] + 1] if called in DRAWS else ():
            for name in ast.walk(argument):
                if isinstance(name, ast.Constant) and isinstance(name.value, str):
                    yield name.value


DRAWS = {"prop": 1, "prop_search": 1, "Row": 0, "Rows": 0}
"""Which argument of what is called names properties."""


class AddressTest(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.pages = self.folder / "a place für pages"
        patch = mock.patch.object(module(), "PAGES", self.pages)
        patch.start()
        self.addCleanup(patch.stop)

    def write(self, *names):
        for name in names:
            path = self.pages / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("", encoding="utf-8")

    def asked(self, name):
        """What Blender opens for a setting or an operator."""
        with mock.patch.object(webbrowser, "open") as opened:
            bpy.ops.wm.doc_view_manual(doc_id=name)
        return opened.call_args[0][0]

    def read(self, address):
        """The text of a page that was written to be opened."""
        path = Path(bpy.app.tempdir, "motus_manual.html")
        self.assertEqual(address, path.as_uri())
        return path.read_text(encoding="utf-8")

    def test_a_setting_leads_to_its_paragraph(self):
        self.write("en/path.html", "en/operators.html")
        wanted = f'url={(self.pages / "en" / "path.html").as_uri()}#motus_pg_path.duration"'
        self.assertIn(wanted, self.read(self.asked("MOTUS_PG_path.duration")))
        self.assertNotIn(" für", wanted)
        self.assertIn('path.html#motus_pg_path"', self.read(self.asked("MOTUS_PG_path.active_pin")))
        for name in ("motus.path_follow_add", "MOTUS_OT_path_follow_add.duration"):
            self.assertIn('operators.html#motus.path_follow_add"', self.read(self.asked(name)))

    def test_blenders_own_settings_lead_where_they_did(self):
        self.assertIn("docs.blender.org", self.asked("Object.location"))

    def test_the_site_is_opened_if_there_is_one(self):
        self.write("en/path.html", "es/path.html", "en/operators.html")
        with mock.patch.object(module(), "SITE", "https://motus.example/"):
            self.assertEqual(self.asked("MOTUS_PG_path.duration"), "https://motus.example/path.html#motus_pg_path.duration")
            with mock.patch.object(module(), "_is_spanish", lambda: True):
                self.assertEqual(self.asked("MOTUS_PG_path.duration"), "https://motus.example/es/path.html#motus_pg_path.duration")
                self.assertEqual(self.asked("motus.bake"), "https://motus.example/operators.html#motus.bake")

    @support.needs_translations
    def test_spanish_pages_where_there_are_any(self):
        self.write("en/path.html", "es/path.html", "en/operators.html")
        view = bpy.context.preferences.view
        self.addCleanup(setattr, view, "language", view.language)
        view.language = "es"
        view.use_translate_interface = True
        self.assertIn("/es/path.html#", self.read(self.asked("MOTUS_PG_path.duration")))
        self.assertIn("/en/operators.html#", self.read(self.asked("motus.bake")))

    def test_without_pages_a_sentence_says_so(self):
        self.assertIn("has no manual", self.read(self.asked("MOTUS_PG_path.duration")))
        self.assertRefused("has no manual", bpy.ops.motus.manual, page="path")

    def test_the_help_button_opens_a_page(self):
        self.write("en/path.html")
        with mock.patch.object(webbrowser, "open") as opened:
            self.assertEqual(bpy.ops.motus.manual(page="path"), {'FINISHED'})
        self.assertIn('/en/path.html"', self.read(opened.call_args[0][0]))


class MapTest(unittest.TestCase):
    def test_it_is_taken_back(self):
        own = [True for beginning, _ in bpy.utils.manual_map() if not isinstance(beginning, str)]
        self.assertEqual(len(own), 1)
        support.disable()
        self.addCleanup(support.enable)
        self.assertTrue(all(isinstance(beginning, str) for beginning, _ in bpy.utils.manual_map()))
