"""Follow the renaming of bones after an owner was wired: inform the system, and adapt F-curves and drivers of the settings.

The owner is the object whose settings the system solves. Its settings contain a list of entries, one for each bone, named after the bone.
"""

import bpy

from ...blender import actions
from ...declare import of_owner
from ..sinks import finding, property_sink
from . import solver_driver


def renamed(system, owner):
    """Return (armature object, old name, new name) for each bone that an owner drives or reads and that was renamed.

    Names are compared with those at the time when the owner was wired.
    """
    driven = [(owner, *names) for names in (*finding.renamed_bones(system, owner), *property_sink.renamed_bones(system, owner))]
    return list(dict.fromkeys(driven + solver_driver.renamed_reads(system, owner)))


def follow(system, owner):
    """Inform the system about the renamed bones of an owner, and put the new names into F-curves and drivers of the settings.

    This has to be done before the owner is wired again, because the new wiring stores the new names, and the old ones are then unknown.
    """
    bones = renamed(system, owner) if system.bone_renamed else ()
    # Each bone is first given a temporary name that no bone can have, because two bones may have exchanged their names.
    steps = [(rig, old, f"\n{number}") for number, (rig, old, _) in enumerate(bones)]
    steps += [(rig, f"\n{number}", new) for number, (rig, _, new) in enumerate(bones)]
    if not steps:
        return
    settings = of_owner(system, owner)
    settings.is_active = False  # else the update callbacks of the renamed settings would wire the owner in between
    try:
        for step in steps:
            system.bone_renamed(owner, *step)
    finally:
        settings.is_active = True
    for rig, old, new in steps:
        if rig == owner:
            _rename_paths(system, owner, old, new)


def _rename_paths(system, owner, old, new):
    """Replace a bone's old name by its new one in the data paths of F-curves and drivers that animate the owner's settings.

    F-curves of NLA strips are included. The settings have a list with one entry for each bone, named after the bone.
    """
    old, new = (f'["{bpy.utils.escape_identifier(name)}"]' for name in (old, new))
    prefix = of_owner(system, owner).path_from_id() + "."

    def names_it(path):
        return path.startswith(prefix) and old in path

    animation = owner.animation_data
    for curves in (*actions.own_curves(owner, names_it), animation.drivers if animation else ()):
        for curve in curves:
            if names_it(curve.data_path):
                curve.data_path = curve.data_path.replace(old, new)
