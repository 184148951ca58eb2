"""Write arrays of numbers to attributes of the mesh of a hub, a hidden object with a solver's results, or get an attribute's memory."""

import math

from ...file.stored import Damaged
from ...lazy import numpy as np

_FORMS = {
    'FLOAT': ("value", "<f4", ()),
    'INT': ("value", "<i4", ()),
    'FLOAT_VECTOR': ("vector", "<f4", (3,)),
    'FLOAT_COLOR': ("color", "<f4", (4,)),
    'QUATERNION': ("value", "<f4", (4,)),
    'INT32_2D': ("value", "<i4", (2,)),
    'FLOAT4X4': ("value", "<f4", (16,)),
}
"""Data type of an attribute -> (name of an item's property, numpy type of its numbers, shape of one item's value)."""


def write(mesh, name, data_type, values):
    """Fill a point attribute of a mesh with a float32 array, one row for each point. mesh: original or evaluated, linked or local.

    Raises Damaged if the mesh has no point attribute with this name, data type and length.
    """
    data, count = _data(mesh, name, data_type, 'POINT'), len(values)
    if len(data) != count or len(mesh.vertices) != count:
        raise Damaged("another number of points")
    if count == 0:
        return
    field = _FORMS[data_type][0]
    if not mesh.is_evaluated or mesh.original.library is None:
        data.foreach_set(field, values.reshape(-1))
        return
    # On linked data foreach_set writes nothing (Blender 5.2). Assigning an item stops the array from being shared with the original.
    setattr(data[0], field, getattr(data[0], field))
    found = memory(mesh, name, data_type)
    found[...] = values.reshape(found.shape)


def memory(mesh, name, data_type, domain='POINT'):
    """Return an array whose memory is that of an attribute's data, one row for each item, to be read and written.

    The attribute's data must not be shared with a different mesh. Raises Damaged if the mesh has no attribute with this name, data type and
    domain, or if the items are not contiguous.
    """
    _, numbers, shape = _FORMS[data_type]
    found = items(_data(mesh, name, data_type, domain), numbers, shape)
    if not found.flags.c_contiguous:
        raise Damaged("items that lie otherwise in memory")
    return found


def made(mesh, name, data_type, count):
    """Return the memory of an attribute that a mesh has just been given, as memory() does, without asking for its type and domain.

    Raises Damaged if the attribute has another number of items than `count`, or if they are not contiguous.
    """
    _, numbers, shape = _FORMS[data_type]
    data = mesh.attributes[name].data
    if count == 0 or len(data) != count:
        return memory(mesh, name, data_type)
    start, size = data[0].as_pointer(), 4 * math.prod(shape)
    if data[count - 1].as_pointer() != start + (count - 1) * size:
        raise Damaged("items that lie otherwise in memory")
    import ctypes

    return np.ndarray((count, *shape), numbers, (ctypes.c_byte * (count * size)).from_address(start))


def items(data, numbers, shape):
    """Return an array over the memory of a Blender collection, with the numbers with which each item's struct begins.

    data: the collection. numbers: numpy type of the numbers. shape: shape of an item's numbers. Raises Damaged if the items are not equally
    spaced in memory.
    """
    count = len(data)
    if count == 0:
        return np.empty((0, *shape), numbers)
    start, size = data[0].as_pointer(), 4 * math.prod(shape)
    step = data[1].as_pointer() - start if count > 1 else size
    if step < size or data[count - 1].as_pointer() != start + (count - 1) * step:
        raise Damaged("items that do not lie one behind the other")
    return np.asarray(_Memory(start, (count, *shape), step, numbers))


class _Memory:
    """Object with numpy's array interface, from which np.asarray() makes an array of existing memory without a copy."""

    def __init__(self, start, shape, step, numbers):
        steps = (step, *(4 * math.prod(shape[place:]) for place in range(2, len(shape) + 1)))
        self.__array_interface__ = {"data": (start, False), "shape": shape, "strides": steps, "typestr": numbers, "version": 3}


def _data(mesh, name, data_type, domain):
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.domain != domain or attribute.data_type != data_type:
        raise Damaged("another attribute")
    return attribute.data
