"""Setting chains up and taking them back: plain functions behind the operators."""

from ..core import wiring
from ..core.declare import registered
from ..core.declare.forgetting import forget
from ..core.settings import entries


def system():
    """The registered System: the package's __init__ imports this module, not the other way round."""
    return registered["ik"]


def at_once(rig):
    """A context: wire once at the end, instead of at every change of a setting within."""
    return entries.at_once(system(), rig)


def add(rig, bone, changes):
    """An entry for a bone, new or as it was, with these settings by name. Wires nothing: see at_once()."""
    chains = rig.motus.ik.entries
    entry = chains.get(bone)
    if entry is None:
        entry = chains.add()
        entry.name = bone
    for name, value in changes.items():
        setattr(entry, name, value)
    rig.motus.ik.chosen_entry = chains.find(bone)
    return entry


def would_wait_for_itself(rig, bone, changes):
    """Whether the entry with these settings would depend on what it drives. Leaves everything as it was."""
    with entries.unwired(rig.motus.ik) as settings:
        before = settings.entries.get(bone)
        kept = {name: getattr(before, name) for name in changes} if before else {}
        chosen = settings.chosen_entry
        add(rig, bone, changes)
        level = wiring.levels(rig).get(("ik", bone), 0)
        if before:
            add(rig, bone, kept)
        else:
            settings.entries.remove(settings.entries.find(bone))
        settings.chosen_entry = chosen
    if not settings.entries:
        forget(system(), rig)
    return level is None


def remove(rig, indices):
    """Take entries back."""
    entries.remove(system(), rig, indices, "chosen_entry")
