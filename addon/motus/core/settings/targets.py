"""Empties that Motus makes as targets of settings, and deletes again along with these settings if nothing else needs them."""

import bpy

from ..blender import needed
from ..file import libraries


def new_empty(context, beside, name, mark):
    """Make an empty in a collection of the original object `beside`. mark: custom property by which Motus knows the empty again."""
    empty = bpy.data.objects.new(name, None)
    empty[mark] = True
    libraries.collection_for(context, beside).objects.link(empty)
    return empty


def remove_unneeded(target, mark):
    """Delete a target that Motus has made if nothing uses the object, and it has no animation data. target: an object or None.

    mark: custom property that new_empty() has given it.
    """
    if target and mark in target and target.animation_data is None and not needed.is_needed(target):
        bpy.data.objects.remove(target)
