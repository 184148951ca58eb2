"""The section of a system's page that lists every setting: name, tooltip, values, and the name for scripts, each with an anchor for Blender's manual."""

import re

import markdown_text

WORDS = {
    "en": {"title": "Every setting", "head": ("Setting", "What it does", "Values"), "default": "default"},
    "es": {"title": "Todos los ajustes", "head": ("Ajuste", "Para qué sirve", "Valores"), "default": "por defecto"},
}
KINDS = {
    "number": "número",
    "whole number": "número entero",
    "switch": "interruptor",
    "choice": "elección",
    "choices": "elecciones",
    "object": "objeto",
    "text": "texto",
    "collection": "colección",
    "vector": "vector",
    "action": "acción",
    "color": "color",
    "material": "material",
    "image": "imagen",
    "on": "activado",
    "off": "desactivado",
}
"""In Spanish: kinds of values, and values of switches."""


def anchors(groups):
    """Names of the places that the section has."""
    return {
        *(["every-setting"] if groups else ()),
        *(group["struct"].lower() for group in groups),
        *(_anchor(group, setting) for group in groups for setting in group["settings"]),
    }


def section(groups, language):
    """The section's Markdown."""
    words = WORDS[language]
    parts = [f"\n## {words['title']} {{#every-setting}}\n"]
    for group in groups:
        parts.append(
            f"\n### {_word(group, 'title', language)} {{#{group['struct'].lower()}}}\n\n<div class=\"motus-rows motus-settings\" markdown>\n"
        )
        parts.append(f"| {' | '.join(words['head'])} |\n|---|---|---|")
        parts += [_row(group, setting, language, words["default"]) for setting in group["settings"]]
        parts.append("\n</div>\n")
    return "\n".join(parts)


def _anchor(group, setting):
    """What Blender's manual map names a property, in lower case."""
    return f"{group['struct']}.{setting['id']}".lower()


def _word(thing, key, language):
    """A text of the add-on in a language; English where it has none in the other."""
    return markdown_text.escaped(re.sub(r"\s*\n\s*", " ", (language == "es" and thing.get(f"{key}_es")) or thing[key]))


def _row(group, setting, language, default):
    name = f'<a id="{_anchor(group, setting)}"></a>**{_word(setting, "name", language)}**<br>`{setting["id"]}`'
    does = [_word(setting, "text", language)]
    does += [
        f"**{_word(choice, 'name', language)}** `{choice['id']}`" + (f": {_word(choice, 'text', language)}" if choice["text"] else "")
        for choice in setting.get("choices", ())
    ]
    words = KINDS if language == "es" else {}
    values = [markdown_text.escaped(words.get(setting[key], setting[key])) for key in ("kind", "range", "unit") if setting[key]]
    values = [value.replace(" ", "\N{NO-BREAK SPACE}") for value in values]
    first = [f"{default} `{words.get(setting['default'], setting['default'])}`"] if setting["default"] else []
    return f"| {name} | {'<br>'.join(does)} | {'<br>'.join((', '.join(values), *first))} |"
