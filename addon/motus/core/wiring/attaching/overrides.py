"""Detect library overrides whose wiring, the set-up that Motus has added to them, Blender has lost when the file was loaded.

Of an overridden object Blender saves the properties and list items that are declared overridable, and added constraints and modifiers.
Everything else is the library's again when the file is loaded: custom properties (the arrays of results among them), and drivers that were
added or given different variables, if the library's object has drivers. Changed settings would then meet wiring that was made for the
library's settings.

To detect this, each object gets a mark: a custom property with a hash of what was wired on it. Blender loses the mark together with the
wiring. If the mark does not match the settings, the owner (the object whose settings a system solves) is wired again (see the folder
healing).
"""

import hashlib

import bpy
from bpy.app.handlers import persistent

from ...declare import groups_of, input_variables, of_owner, registered
from . import override_drivers, signature

_known = {}
"""(name of the mark's custom property, name of the override) -> value of the mark when it was last read; None if there was none."""


def mark(system, owner, groups):
    """Record how an owner is wired: the signature in its settings, and a mark on the owner and on the overrides that it drives.

    A mark is a custom property with a hash of the wiring. Blender loses the mark together with the wiring of an override.
    """
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
    """Remove from an object the mark of a system: the custom property with a hash of the object's wiring.

    On an override the mark comes back if its library is loaded again.
    """
    obj.pop(_key(system), None)
    _known.pop((_key(system), obj.name), None)
    if obj.override_library and not obj.library:
        _known[_key(system), obj.name] = None


def is_lost(system, owner):
    """Whether Blender has lost the wiring of a library override, which is either the owner or an object that the owner drives.

    The wiring is lost if the override's mark, a custom property with a hash of its wiring, does not match the owner's settings.
    """
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
    """Whether the marks of any library overrides are known, so that has_new_marks() has something to compare.

    A mark is a custom property with a hash of what Motus has wired on an override.
    """
    return bool(_known)


def has_new_marks():
    """Whether the mark of any library override differs from its last known value, as after reloading a library or undoing an edit.

    A mark is a custom property with a hash of what Motus has wired on the override.
    """
    for (key, name), digest in _known.items():
        obj = bpy.data.objects.get((name, None))
        if obj and obj.get(key) != digest:
            return True
    return False


def forget():
    """Forget the known values of the marks of all library overrides; the marks, which are custom properties, stay."""
    _known.clear()


def complete_reference(owner):
    """Give the linked object from which a library override was made all groups of Motus settings that the override has.

    If only the override has a group (PropertyGroup), Blender 5 mistakes the group for an overridden pointer: Blender can write such a
    pointer to a file but cannot read it again. owner: the override; the linked object is its override_library.reference.
    """
    reference = owner.override_library.reference
    for name in [one.name for one in registered.values() if one.settings is not None]:
        if reference and owner.is_property_set("motus") and owner.motus.is_property_set(name):
            # Reading the attribute creates the group in memory; linked data is not saved.
            getattr(reference.motus, name)


@persistent
def complete_references(*_):
    """Call complete_reference() for all library overrides in the file.

    The linked object from which each override was made gets all groups of Motus settings that the override has.
    """
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
