"""Find the chain whose settings the panels of inverse kinematics show."""


def shown_entry(context):
    """Entry that is selected in the list of chains of the active armature object; None if there is no such object or entry."""
    rig = context.object
    if rig is None or rig.type != 'ARMATURE':
        return None
    settings = rig.motus.ik
    index = settings.active_entry
    return settings.entries[index] if 0 <= index < len(settings.entries) else None
