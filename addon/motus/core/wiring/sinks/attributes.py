"""How arrays of numbers get into the attributes of a hub's mesh."""

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
"""Type of an attribute -> (name of an item's property, type of its numbers, shape of what one item holds)."""


def write(mesh, name, data_type, values):
    """Fill an attribute, one a point, with a float32 array: a row a point. mesh: original or evaluated, linked or not.

    Raises Damaged where the mesh has no attribute of that name, type, domain and length.
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
    # On linked data foreach_set writes nothing (5.2). Assigning an item un-shares the array from the original.
    setattr(data[0], field, getattr(data[0], field))
    found = memory(mesh, name, data_type)
    found[...] = values.reshape(found.shape)


def memory(mesh, name, data_type, domain='POINT'):
    """The array itself in which Blender holds an attribute, a row an item, which is to be one that nothing else shares.

    Raises Damaged as write() does.
    """
    _, numbers, shape = _FORMS[data_type]
    found = items(_data(mesh, name, data_type, domain), numbers, shape)
    if not found.flags.c_contiguous:
        raise Damaged("items that lie otherwise in memory")
    return found


def items(data, numbers, shape):
    """The memory of what each item of a collection of Blender's begins with: numbers of a type, in a shape."""
    count = len(data)
    if count == 0:
        return np.empty((0, *shape), numbers)
    start, size = data[0].as_pointer(), 4 * math.prod(shape)
    step = data[1].as_pointer() - start if count > 1 else size
    if step < size or data[count - 1].as_pointer() != start + (count - 1) * step:
        raise Damaged("items that do not lie one behind the other")
    return np.asarray(_Memory(start, (count, *shape), step, numbers))


class _Memory:
    """What numpy makes an array of without a copy."""

    def __init__(self, start, shape, step, numbers):
        steps = (step, *(4 * math.prod(shape[place:]) for place in range(2, len(shape) + 1)))
        self.__array_interface__ = {"data": (start, False), "shape": shape, "strides": steps, "typestr": numbers, "version": 3}


def _data(mesh, name, data_type, domain):
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.domain != domain or attribute.data_type != data_type:
        raise Damaged("another attribute")
    return attribute.data
