"""Setting chains up and taking them back: plain functions behind the operators."""

from contextlib import contextmanager

import bpy

from ..core import actions, dependencies, entry_keys, wiring
from ..core.system import forget, registered
from .goals.placing import CONTROL_KEY
from .groups import goals


def system():
    """The registered System: the package's __init__ imports this module, not the other way round."""
    return registered["ik"]


@contextmanager
def at_once(rig):
    """Wire once at the end, instead of at every change of a setting within."""
    with rig.motus.ik.unwired() as settings:
        yield settings
    wire(rig)


def wire(rig):
    """Wire the rig as its entries are now; one without entries is left as if there had never been any."""
    settings = rig.motus.ik
    if not settings.entries:
        if settings.is_active:
            wiring.detach(system(), rig)
        forget(system(), rig)
    elif settings.is_active:
        wiring.refresh(system(), rig)
    else:
        wiring.attach(system(), rig)


def add(rig, bone, changes):
    """An entry for a bone, new or as it was, with these settings by name. Wires nothing: see at_once()."""
    entries = rig.motus.ik.entries
    entry = entries.get(bone)
    if entry is None:
        entry = entries.add()
        entry.name = bone
    for name, value in changes.items():
        setattr(entry, name, value)
    rig.motus.ik.chosen_entry = entries.find(bone)
    return entry


def would_wait_for_itself(rig, bone, changes):
    """Whether the entry with these settings would depend on what it drives. Leaves everything as it was."""
    with rig.motus.ik.unwired() as settings:
        before = settings.entries.get(bone)
        kept = {name: getattr(before, name) for name in changes} if before else {}
        chosen = settings.chosen_entry
        add(rig, bone, changes)
        level = dependencies.levels(rig).get(("ik", bone), 0)
        if before:
            add(rig, bone, kept)
        else:
            settings.entries.remove(settings.entries.find(bone))
        settings.chosen_entry = chosen
    if not settings.entries:
        forget(system(), rig)
    return level is None


def remove(rig, indices, with_controls=False):
    """Take entries back: wiring, keys and drivers of their settings; with the last one the settings themselves."""
    controls = []
    with at_once(rig) as settings:
        for index in sorted(indices, reverse=True):
            entry = settings.entries[index]
            controls += [goal for goal in (entry.target, entry.pole) if goal and CONTROL_KEY in goal]
            entry_keys.forget(rig, "motus.ik.entries", settings.entries, index)
            settings.entries.remove(index)
        settings.chosen_entry = max(0, min(settings.chosen_entry, len(settings.entries) - 1))
        if not settings.entries:
            actions.remove(rig, ("motus.ik.",))
    if with_controls:
        for control in dict.fromkeys(controls):
            if not _is_used(control):
                bpy.data.objects.remove(control)


def _is_used(control):
    # To ask an object for its settings gives it some.
    rigs = [found for found in bpy.data.objects if found.type == 'ARMATURE' and found.is_property_set("motus")]
    return any(control == goal for rig in rigs for entry in rig.motus.ik.entries for goal, _ in goals(entry))
