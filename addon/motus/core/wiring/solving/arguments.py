"""Arguments of System.solve: inputs that the driver passes on, and the numbers that a system keeps for each member on the hub's mesh."""

import bpy
import mathutils

from ...declare import Matrix, Setting, Splines
from ...file import stored
from ...file.stored import Damaged
from ...lazy import numpy as np
from ..hubs import outbox

NO_TARGET = 0.0
"""What Blender passes for a driver variable whose target is gone."""
_NUMBERS = (float, int)
_PLAIN = (Matrix.read, mathutils.Matrix), (Splines.read, bpy.types.bpy_prop_collection)
"""Pairs of a function that reads inputs, and the class of which it returns every value unchanged."""


def read_from_driver(system):
    """Return (index, name, plain, read) for each input of a system that the solver's driver passes on: for all but Settings.

    index: position among the values that the driver passes. name: name of the input. plain: class; a passed value of this class is used
    unchanged (None: never). read: function (passed value, settings) that converts any other passed value into the input's value.
    """
    declared = [(index, one) for index, one in enumerate(system.inputs) if not isinstance(one, Setting)]
    return [(index, one.name, next((kind for read, kind in _PLAIN if one.read is read), None), one.read) for index, one in declared]


def read(inputs, given, settings, into):
    """Put {name: value} for inputs that the driver passes into a dictionary. Raises Damaged if the driver passes none of them.

    inputs: result of read_from_driver(). given: the passed values; a driver of an earlier version passes fewer, and the inputs that it does
    not know are as those without a target. settings: the owner's settings, for inputs that need them.
    """
    count = len(given)
    if inputs and count <= inputs[0][0]:
        raise Damaged("too few arguments")
    for index, name, plain, convert in inputs:
        value = given[index] if index < count else NO_TARGET
        kind = value.__class__
        # What has a plain class is None without a target, for which Blender passes a number.
        into[name] = value if kind is plain else None if plain is not None and kind in _NUMBERS else convert(value, settings)


def member_data(system, carrier, count):
    """Return the array of the numbers that System.member_data has stored on a hub's mesh; None if the system has no member data.

    carrier: the mesh. count: number of members, which is the length of the array.
    """
    if system.member_data is None:
        return None
    if count == 0 and not carrier.get(outbox.MEMBER_DATA_KEY):  # a custom property cannot hold an empty list of floats
        return np.empty(0)
    return np.frombuffer(stored.doubles(carrier.get(outbox.MEMBER_DATA_KEY), count))
