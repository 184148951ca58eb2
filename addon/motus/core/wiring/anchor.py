"""The anchor: a hidden empty that stands still, as the target that relative sinks of own carriers need to have.

One serves a whole file. It stands in no collection and is known by a custom property. A constraint does not count as a user
of its target, so the settings of those it serves point to it too, as they do to the proxies.
"""

import bpy

NAME = "Motus Anchor"
KEY = "motus_anchor"


def of(settings):
    """The file's anchor, made where there is none, kept alive by an owner's settings."""
    found = _find_or_make()
    keep(settings, "", found)
    return found


def keep(settings, name, obj):
    """Let an owner's settings keep a hidden object alive. name: of the bone it is for, by which overrides know it."""
    if all(entry.object != obj for entry in settings.targets):
        entry = settings.targets.add()
        entry.name, entry.object = name or NAME, obj
    if settings.id_data.override_library:
        # What an override points to from here, Blender does not save.
        obj.use_fake_user = True


def _find_or_make():
    for candidate in bpy.data.objects:
        if KEY in candidate and candidate.library is None:
            return candidate
    made = bpy.data.objects.new(NAME, None)
    made[KEY] = True
    return made


def release(settings):
    """Let go of the hidden objects; the last one to do so removes them."""
    kept = {entry.object for entry in settings.targets if entry.object}
    settings.targets.clear()
    for one in kept:
        if one.users == int(one.use_fake_user) and one.library is None:
            bpy.data.objects.remove(one)
