"""Former names of settings and of operators' keywords, which scripts and files of earlier versions use.

A setting that was renamed has its former name as a second property, which reads and sets the setting: of_settings() declares it. A file
that was saved before the renaming has the value under the former name, and so has a library override: move() stores the value under the
present name. An operator's former keywords are declared by of_keywords() and read by the operator (core/interface/operators.py).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def of_settings(present: Mapping[str, Any], names: Mapping[str, str]) -> dict[str, Any]:
    """Annotations of a property group that declare its settings' former names.

    present: annotations of the settings, which are numbers or switches. names: {former name: present name}.
    """
    return {former: _alias(former, name, present[name]) for former, name in names.items()}


def of_keywords(present: Mapping[str, Any], names: Mapping[str, str]) -> dict[str, Any]:
    """Annotations of an operator that declare its keywords' former names. Blender allows operators no properties that set others.

    present: annotations of the keywords. names: {former name: present name}.
    """
    return {former: _declared(former, present[name]) for former, name in names.items()}


def _declared(former: str, present: Any, **more: Any) -> Any:
    keywords = {key: value for key, value in present.keywords.items() if key != "description"}
    return present.function(**keywords | {"name": former, "options": {'HIDDEN', 'SKIP_SAVE'}} | more)


def _alias(former: str, name: str, present: Any) -> Any:
    limits = present.keywords

    def read(settings: Any) -> Any:
        stored = _stored(settings)
        return stored[former] if former in stored else getattr(settings, name)

    def write(settings: Any, value: Any) -> None:
        # Blender does not keep values within limits if a property has a `set` function.
        value = max(value, limits.get("min", value))
        value = min(value, limits.get("max", value))
        # The value is stored without a call of the setting's `update` callback, because Blender sets properties of library overrides
        # while it loads a file. If a script sets the former name, Blender calls the callback, which is declared for that name too.
        stored = _stored(settings, makes=True)
        stored[name] = value
        stored.pop(former, None)

    return _declared(former, present, get=read, set=write)


def move(settings: Any, names: Mapping[str, str]) -> bool:
    """Store values that a file has under former names under the present names. Returns whether there were any.

    settings: property group. names: {former name: present name}. No `update` callback is called.
    """
    stored = _stored(settings)
    found = [former for former in names if former in stored]
    for former in found:
        value = stored.pop(former)
        if names[former] not in stored:
            stored[names[former]] = value
    return bool(found)


def _stored(settings: Any, makes: bool = False) -> Any:
    """What a property group has stored, by names of properties; an empty dictionary if nothing is stored.

    makes: whether storage is made if there is none.
    """
    if not hasattr(settings, "bl_system_properties_get"):
        return settings
    found = settings.bl_system_properties_get(do_create=makes)
    return {} if found is None else found
