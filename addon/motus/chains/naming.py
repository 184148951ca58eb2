"""Names of entries: one of bones has that of its topmost bone, to which the names of rows and splines give way, as they do to each other."""

from ..core.file.pointers import pointed
from ..core.settings import entry_keys
from ..core.settings.entries import unwired
from .properties import is_bone

PATH = "motus.chains.entries"


def of_row(owner, things):
    """Return the name of the entry for a row of objects on an owner: that which it has, or else a free one like that of its first object."""
    return _of(owner, things[0].name, lambda entry: entry.spline < 0 and entry.links and pointed(entry.links[0], "object") == things[0])


def of_spline(owner, index):
    """Return the name of the entry for a spline of an owner: that which it has, or else a free one."""
    return _of(owner, f"Spline {index + 1}", lambda entry: entry.spline == index)


def give_way(settings, name):
    """Give the entry of a row or spline another name, if it has that of a bone whose chain is about to have it. settings: of the owner."""
    entry = settings.entries.get(name)
    if entry is None or is_bone(entry):
        return
    owner = settings.id_data
    new = _free(owner, name)
    entry_keys.rename(owner, PATH, name, new)
    entry.name = new


def bone_renamed(owner, rig, old, new):
    """Rename a bone in the owner's entries and pins after the user has renamed the bone. The wiring is renewed separately.

    rig: armature object of the bone. old, new: names of the bone.
    """
    with unwired(owner.motus.chains) as settings:
        entry = settings.entries.get(old)
        if rig == owner and entry is not None and is_bone(entry):
            give_way(settings, new)
            entry.name = new
        for pin in settings.pins:
            if rig == owner and pin.name == old:
                pin.name = new
            if pointed(pin, "target") == rig and pin.target_bone == old:
                pin.target_bone = new


def _of(owner, name, is_meant):
    entries = owner.motus.chains.entries if owner.is_property_set("motus") else ()
    return next((entry.name for entry in entries if is_meant(entry)), None) or _free(owner, name)


def _free(owner, wanted):
    """Return the name `wanted`, with a number if an entry or a bone of an owner has that name."""
    taken = {
        *(owner.motus.chains.entries.keys() if owner.is_property_set("motus") else ()),
        *(owner.pose.bones.keys() if owner.pose else ()),
    }
    name, number = wanted, 1
    while name in taken:
        name, number = f"{wanted}.{number:03}", number + 1
    return name
