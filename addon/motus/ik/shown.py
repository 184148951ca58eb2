"""The chain that the panels are about."""


def shown_entry(context):
    """The chosen entry of the active rig; None without a rig or an entry."""
    rig = context.object
    if rig is None or rig.type != 'ARMATURE':
        return None
    settings = rig.motus.ik
    index = settings.active_entry
    return settings.entries[index] if 0 <= index < len(settings.entries) else None
