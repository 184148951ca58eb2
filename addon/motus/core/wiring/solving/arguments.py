"""Arguments of System.solve: inputs that the driver passes on, and the numbers that a system keeps for each member on the hub's mesh."""

import mathutils

from ...declare import Matrix, Setting
from ...file import stored
from ...file.stored import Damaged
from ...lazy import numpy as np
from ..hubs import outbox


def read_from_driver(system):
    """Return (position among the driver's arguments, name, class, read) for each input of a system that is not read from the settings.

    A value of this class is the input's value as it is; read(value, settings) returns the input's value for any other one.
    """
    declared = [(index, one) for index, one in enumerate(system.inputs) if not isinstance(one, Setting)]
    return [(index, one.name, mathutils.Matrix if one.read is Matrix.read else None, one.read) for index, one in declared]


def values(inputs, given, settings):
    """Return {name: value} for these inputs, read from the values of the driver's variables. Raises Damaged if there are too few values."""
    if inputs and len(given) <= inputs[-1][0]:
        raise Damaged("too few arguments")
    return {name: value if (value := given[index]).__class__ is plain else read(value, settings) for index, name, plain, read in inputs}


def member_data(system, carrier, count):
    """Return the numbers of System.member_data that are stored on a hub's mesh (carrier), (count,); None if the system has none."""
    if system.member_data is None:
        return None
    if count == 0 and not carrier.get(outbox.MEMBER_DATA_KEY):  # a custom property cannot hold an empty list of floats
        return np.empty(0)
    return np.frombuffer(stored.doubles(carrier.get(outbox.MEMBER_DATA_KEY), count))
