"""Every English text of the interface has a Spanish one, and nothing else has."""

import ast
import functools
import re
import string
import unittest
from pathlib import Path

import bpy

import support

IDENTIFIERS = {"text", "heading", "title"}
"""Keyword arguments of layout functions that Blender translates."""
SENTENCES = {"tr", "Problem", "Modes", "Status", "Key", "poll_message_set", "pgettext_iface", "pgettext_tip"}
"""Functions whose first string is shown to the user."""
UNTRANSLATED = {"", "Motus", "X", "Y", "Z", "-X", "-Y", "-Z"}
"""Names and letters, the same in every language."""

FRAGMENT = re.compile("(About|Across|Along|At|Before|Behind|Between|By|From|In|Of|On|Out|Over|To|Towards|Whose|Why|With) ")


def package():
    return support.addon().__name__


def registered_classes():
    """All classes the add-on has registered."""
    kinds = (bpy.types.Operator, bpy.types.Panel, bpy.types.Menu, bpy.types.PropertyGroup, bpy.types.UIList, bpy.types.AddonPreferences)
    return [
        cls
        for kind in kinds
        for cls in kind.__subclasses__()
        if cls.__module__.startswith(f"{package()}.") and getattr(cls, "is_registered", False)
    ]


def own_sense():
    return support.addon("core.translations").OWN_SENSE


def _context(cls):
    return next((vars(base)["bl_translation_context"] for base in cls.__mro__ if "bl_translation_context" in vars(base)), "*")


def class_texts(cls):
    """(context, text) of a class and its properties."""
    is_operator = issubclass(cls, bpy.types.Operator)
    if not issubclass(cls, bpy.types.PropertyGroup):
        yield ("Operator" if is_operator else _context(cls)), getattr(cls, "bl_label", "")
        yield "*", getattr(cls, "bl_description", "") or ""
    rna = getattr(bpy.ops.motus, cls.bl_idname.partition(".")[2]).get_rna_type() if is_operator else cls.bl_rna
    for one in rna.properties:
        if not one.is_runtime:
            continue
        if one.name == one.identifier:  # not named, so never shown
            continue
        yield "*", one.name
        yield "*", one.description
        for item in one.enum_items if one.type == 'ENUM' else ():
            yield "*", item.name
            yield "*", item.description


def source_texts(source):
    """(context, text) of the strings in Python code that the user reads."""
    for node in ast.walk(ast.parse(source)):
        if not isinstance(node, ast.Call):
            continue
        name = getattr(node.func, "attr", getattr(node.func, "id", ""))
        untranslated = any(word.arg == "translate" for word in node.keywords)
        if name in SENTENCES and node.args:
            yield from _constants("*", node.args[:2] if name == "Status" else node.args[:1])
        if not untranslated:
            values = [word.value for word in node.keywords if word.arg in IDENTIFIERS]
            is_own = any(word.arg == "text_ctxt" for word in node.keywords)
            yield from _constants(own_sense() if is_own else "Operator" if name == "operator" else "*", values)


def _constants(context, nodes):
    for node in nodes:
        choices = (node.body, node.orelse) if isinstance(node, ast.IfExp) else (node,)
        for choice in choices:
            if isinstance(choice, ast.Constant) and isinstance(choice.value, str):
                yield context, choice.value


@functools.cache
def english_texts():
    """Every (context, text) of the add-on that Blender or tr() translates."""
    texts = {text for cls in registered_classes() for text in class_texts(cls)}
    tools = [tool for tool in bpy.types.WorkSpaceTool.__subclasses__() if tool.__module__.startswith(f"{package()}.")]
    texts.update(("*", text) for tool in tools for text in (tool.bl_label, tool.bl_description))
    folder = Path(support.addon().__file__).parent
    for path in folder.rglob("*.py"):
        texts.update(source_texts(path.read_text(encoding="utf-8")))
    return {(context, text) for context, text in texts if text not in UNTRANSLATED}


class TooltipTest(unittest.TestCase):
    def test_a_tooltip_can_be_read_without_its_label(self):
        """A description that begins with a preposition only continues the label, which tooltips do not show before it."""
        descriptions = {
            item.description
            for cls in registered_classes()
            for prop in cls.bl_rna.properties
            for item in (prop, *(prop.enum_items if prop.type == 'ENUM' else ()))
        }
        self.assertEqual(sorted(filter(FRAGMENT.match, descriptions)), [])


class SpanishTest(unittest.TestCase):
    def setUp(self):
        self.contexts = support.addon("translations.es").CONTEXTS
        self.known = {(context, english) for context, messages in self.contexts.items() for english in messages}

    def test_complete(self):
        self.assertEqual(sorted(english_texts() - self.known), [])

    @support.in_one_blender
    def test_no_sentence_is_put_together(self):
        """An f-string has no entry to look up: sentences are templates, filled after their translation."""
        folder = Path(support.addon().__file__).parent
        for path in folder.rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Call):
                    name = getattr(node.func, "attr", getattr(node.func, "id", ""))
                    texts = node.args if name in SENTENCES | {"report"} else ()
                    for text in texts:
                        self.assertNotIsInstance(text, ast.JoinedStr, f"{path.name}:{node.lineno}")

    def test_nothing_stale(self):
        self.assertEqual(sorted(self.known - english_texts()), [])

    @support.in_one_blender
    def test_placeholders_are_kept(self):
        for messages in self.contexts.values():
            for english, spanish in messages.items():
                self.assertEqual(sorted(_placeholders(spanish)), sorted(_placeholders(english)), english)

    @support.in_one_blender
    def test_tooltips_have_no_full_stop(self):
        for messages in self.contexts.values():
            for english, spanish in messages.items():
                self.assertFalse(english.endswith(".") or spanish.endswith("."), english)
                self.assertTrue(spanish.strip(), english)

    @support.in_one_blender
    def test_one_verb_for_add(self):
        """Blender's own Spanish says "Agregar"."""
        for messages in self.contexts.values():
            for english, spanish in messages.items():
                self.assertNotRegex(spanish.lower(), r"\bañad", english)

    @support.needs_translations
    def test_blender_shows_it(self):
        view = bpy.context.preferences.view
        before = view.language
        self.addCleanup(setattr, view, "language", before)
        view.language = "es"
        view.use_translate_interface = view.use_translate_tooltips = True
        translate = bpy.app.translations.pgettext
        self.assertEqual(translate("Unbake", "Operator"), self.contexts["Operator"]["Unbake"])
        for english, spanish in self.contexts[own_sense()].items():
            self.assertEqual(translate(english, own_sense()), spanish)
        sentence = "{object} is not baked"
        self.assertEqual(support.addon("core.translations").tr(sentence), self.contexts["*"][sentence])
        view.language = "en_US"
        self.assertEqual(translate("Unbake", "Operator"), "Unbake")


def _placeholders(text):
    return [name for _, name, _, _ in string.Formatter().parse(text) if name is not None]
