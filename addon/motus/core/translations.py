"""Register the add-on's translations with Blender, and translate sentences into the user's language."""

from __future__ import annotations

import bpy

OWN_SENSE = "Motus"
"""Translation context of words that Blender's interface uses in a different sense.

Without this context, Blender's own translation of the word would be shown.
"""


def register(languages: dict[str, dict[str, dict[str, str]]]) -> None:
    """Register the translations of all languages with Blender. languages: {language: {context: {English: translation}}}."""
    bpy.app.translations.register(
        _KEY,
        {
            language: {(context, english): translated for context, messages in contexts.items() for english, translated in messages.items()}
            for language, contexts in languages.items()
        },
    )


def tr(text: str) -> str:
    """Translate a report or a different sentence into the user's language. Fill {placeholders} after the translation, not before."""
    # Since Blender 4.1 the user's preferences have a separate switch for the translation of reports.
    translate = getattr(bpy.app.translations, "pgettext_rpt", bpy.app.translations.pgettext_tip)
    return translate(text)


def counted(number: int, one: str, many: str) -> str:
    """Choose a translated text for a number of things: `one` if the number is 1, otherwise `many` with {count} filled in."""
    return one if number == 1 else many.format(count=number)


def unregister() -> None:
    """Remove the add-on's translations from Blender."""
    bpy.app.translations.unregister(_KEY)


_KEY = __package__
