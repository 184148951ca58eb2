"""The chain that the panels are about."""


def shown_entry(context):
    """Its entry, or None."""
    rig = context.object
    if rig is None or rig.type != 'ARMATURE':
        return None
    settings = rig.motus.ik
    index = settings.active_entry
    return settings.entries[index] if 0 <= index < len(settings.entries) else None
