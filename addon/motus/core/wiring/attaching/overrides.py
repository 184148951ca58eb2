"""Library overrides: what Blender forgets of their wiring, and how that is noticed.

Of an overridden object Blender saves the properties and list entries that are declared overridable, and constraints and
modifiers that were added. All else is the library's again when the file is loaded: custom properties (so outboxes and what
lies beside them), and drivers that were added, or given other variables, where the library's object has drivers. Settings
that were changed would then meet a wiring that knows nothing of them. So each object is marked with what was wired on it,
by a custom property, which is forgotten along with the rest; where it does not say what the settings ask for, the owner is
wired again (see healing).
"""

import hashlib

import bpy
from bpy.app.handlers import persistent

from ...declare import groups_of, input_variables, of_owner, registered
from . import override_drivers, signature

_known = {}
"""(name of the mark, name of the override) -> what it said when it was last looked at, None where there was none."""


def mark(system, owner, groups):
    """Note what is wired now: in the owner's settings, and on the owner and the overrides that it drives."""
    of_owner(system, owner).wired = signature.of(system, owner, groups)
    digest = _digest(system, owner, groups)
    overridden = _overridden(owner, groups)
    for obj in {owner, *overridden}:
        obj[_key(system)] = digest
    for obj in overridden:
        _known[_key(system), obj.name] = digest
        override_drivers.align(obj)
        complete_reference(obj)


def unmark(system, obj):
    """Take the note away. On an override it comes back when its library is loaded again."""
    obj.pop(_key(system), None)
    _known.pop((_key(system), obj.name), None)
    if obj.override_library and not obj.library:
        _known[_key(system), obj.name] = None


def is_lost(system, owner):
    """Whether the owner, or one whom it drives, is an override that is not wired as the settings ask for."""
    groups = groups_of(system, owner)
    overridden = _overridden(owner, groups)
    if not overridden:
        return False
    digest = _digest(system, owner, groups)
    if any(obj.get(_key(system)) != digest for obj in overridden):
        return True
    _known.update({(_key(system), obj.name): digest for obj in overridden})
    return False


def has_marks():
    """Whether there is anything to compare."""
    return bool(_known)


def has_new_marks():
    """Whether any mark is another than when it was last looked at: a library was reloaded, or there was an undo."""
    for (key, name), digest in _known.items():
        obj = bpy.data.objects.get((name, None))
        if obj and obj.get(key) != digest:
            return True
    return False


def forget():
    """Know of no marks any more."""
    _known.clear()


def complete_reference(owner):
    """Let the library's object have the groups of settings that its override has.

    Blender 5 takes a group that only the override has for a pointer that was replaced, which it can write but not read.
    """
    reference = owner.override_library.reference
    for name in [one.name for one in registered.values() if one.settings is not None]:
        if reference and owner.is_property_set("motus") and owner.motus.is_property_set(name):
            # To ask an object for its settings gives it some, in memory: linked data is not saved.
            getattr(reference.motus, name)


@persistent
def complete_references(*_):
    """Let the library's objects of all overrides of the file have the groups of settings that these have."""
    for owner in bpy.data.objects:
        if owner.override_library and not owner.library:
            complete_reference(owner)


def _key(system):
    return f"motus_{system.name}_wired"


def _overridden(owner, groups):
    touched = {
        owner,
        *(member.thing.id_data for group in groups for member in group.members),
        *(one.object for group in groups for one in group.properties),
    }
    return {obj for obj in touched if obj.override_library and not obj.library}


def _digest(system, owner, groups):
    variables = [
        variable and (variable.id_type, variable.id != owner and variable.id.name, variable.data_path)
        for _, variable in input_variables(system, owner)
    ]
    members = [
        (member.thing.id_data.name, member.thing.name, sorted(member.channels))
        for group in groups
        for member in group.members
        if member.thing.id_data != owner
    ]
    text = repr((signature.of(system, owner, groups), members, variables))
    return hashlib.sha1(text.encode()).hexdigest()
