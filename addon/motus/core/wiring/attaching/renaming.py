"""Bones that were renamed since an owner was wired: the system is told, and keys and drivers of its settings go along."""

import bpy

from ...blender import actions
from ...declare import of_owner
from ..sinks import finding, property_sink
from . import solver_driver


def renamed(system, owner):
    """(rig, old name, new name) of bones that were renamed since the owner was wired."""
    driven = [(owner, *names) for names in (*finding.renamed_bones(system, owner), *property_sink.renamed_bones(system, owner))]
    return list(dict.fromkeys(driven + solver_driver.renamed_reads(system, owner)))


def follow(system, owner):
    """Tell the system of its renamed bones. Called before the owner is wired anew, until which the bones count as renamed."""
    bones = renamed(system, owner) if system.bone_renamed else ()
    # By way of names that no bone has: bones may have exchanged theirs.
    steps = [(rig, old, f"\n{number}") for number, (rig, old, _) in enumerate(bones)]
    steps += [(rig, f"\n{number}", new) for number, (rig, _, new) in enumerate(bones)]
    if not steps:
        return
    settings = of_owner(system, owner)
    settings.is_active = False  # or settings that are given other names would have it wired in between
    try:
        for step in steps:
            system.bone_renamed(owner, *step)
    finally:
        settings.is_active = True
    for rig, old, new in steps:
        if rig == owner:
            _rename_paths(system, owner, old, new)


def _rename_paths(system, owner, old, new):
    """Let keys, in NLA strips too, and drivers of the settings of an entry, which is named like a bone, go on to animate it."""
    old, new = (f'["{bpy.utils.escape_identifier(name)}"]' for name in (old, new))
    prefix = of_owner(system, owner).path_from_id() + "."

    def names_it(path):
        return path.startswith(prefix) and old in path

    animation = owner.animation_data
    for curves in (*actions.own_curves(owner, names_it), animation.drivers if animation else ()):
        for curve in curves:
            if names_it(curve.data_path):
                curve.data_path = curve.data_path.replace(old, new)
