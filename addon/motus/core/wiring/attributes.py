"""How an array of numbers gets into an attribute of a hub's mesh."""

from ..stored import Damaged

_FIELDS = {'FLOAT4X4': "value", 'FLOAT_VECTOR': "vector"}


def write(mesh, name, data_type, values):
    """Fill an attribute, one a point, with a float32 array: a row a point. mesh: original or evaluated, linked or not.

    Raises Damaged where the mesh has no attribute of that name, type, domain and length.
    """
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.domain != 'POINT' or attribute.data_type != data_type:
        raise Damaged("another attribute")
    data, count = attribute.data, len(values)
    if len(data) != count or len(mesh.vertices) != count:
        raise Damaged("another number of points")
    if count == 0:
        return
    field = _FIELDS[data_type]
    if not mesh.is_evaluated or mesh.original.library is None:
        data.foreach_set(field, values.reshape(-1))
        return
    import ctypes
    # On linked data foreach_set writes nothing (5.2). Assigning an item un-shares the array from the original.
    setattr(data[0], field, getattr(data[0], field))
    start, size = data[0].as_pointer(), values.nbytes // count
    if data[count - 1].as_pointer() != start + (count - 1) * size:
        raise Damaged("points that lie otherwise in memory")
    ctypes.memmove(start, values.ctypes.data, values.nbytes)
