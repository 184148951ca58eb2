"""Add, change and remove the entries of chains: functions that the operators of inverse kinematics call, and that need no window."""

from ..core import wiring
from ..core.declare import registered
from ..core.declare.forgetting import forget
from ..core.settings import entries, lists


def system():
    """The registered System of inverse kinematics.

    It is looked up by name: the package's __init__, which defines it, imports this module, so this module cannot import it.
    """
    return registered["ik"]


def at_once(rig):
    """Context manager for several changes of a rig's settings: the rig is wired once at the end, not at every change."""
    return entries.at_once(system(), rig)


def add(rig, bone, changes):
    """Add an entry for a bone, or take its present entry, and change its settings. Returns the entry.

    changes: {name: value} of settings. The rig is not wired: call this within at_once().
    """
    chains = rig.motus.ik.entries
    entry = chains.get(bone) or lists.add(chains, bone)
    for name, value in changes.items():
        setattr(entry, name, value)
    rig.motus.ik.chosen_entry = chains.find(bone)
    return entry


def would_wait_for_itself(rig, bone, changes):
    """Whether the entry of a bone would depend on what it drives if its settings were changed. All settings stay as they are.

    changes: {name: value} of settings.
    """
    with entries.unwired(rig.motus.ik) as settings:
        before = settings.entries.get(bone)
        kept = {name: getattr(before, name) for name in changes} if before else {}
        chosen = settings.chosen_entry
        add(rig, bone, changes)
        level = wiring.levels(rig).get(("ik", bone), 0)
        if before:
            add(rig, bone, kept)
        else:
            lists.remove(settings.entries, settings.entries.find(bone))
        settings.chosen_entry = chosen
    if not settings.entries:
        forget(system(), rig)
    return level is None


def remove(rig, indices):
    """Remove the entries at these indices from a rig, with keys and drivers of their settings."""
    entries.remove(system(), rig, indices, "chosen_entry")
