"""Hands the add-on's translations to Blender, and gives sentences in the user's language."""

from __future__ import annotations

import bpy

OWN_SENSE = "Motus"
"""Context of words that Blender has too, in another sense: without it they come out in Blender's translation."""


def register(languages: dict[str, dict[str, dict[str, str]]]) -> None:
    """Register languages: {language: {context: {English: translation}}}."""
    bpy.app.translations.register(
        _KEY,
        {
            language: {(context, english): translated for context, messages in contexts.items() for english, translated in messages.items()}
            for language, contexts in languages.items()
        },
    )


def tr(text: str) -> str:
    """A report or other sentence in the user's language; fill its {placeholders} afterwards."""
    # Reports have a preference of their own since 4.1.
    translate = getattr(bpy.app.translations, "pgettext_rpt", bpy.app.translations.pgettext_tip)
    return translate(text)


def counted(number: int, one: str, many: str) -> str:
    """A translated text for a number of things: `one` for 1, else `many` with the number for its {count}."""
    return one if number == 1 else many.format(count=number)


def unregister() -> None:
    """Forget all languages."""
    bpy.app.translations.unregister(_KEY)


_KEY = __package__
