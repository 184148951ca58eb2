"""Functions that add pins to an object, bind them to vertices of its mesh, and remove them; the operators call them."""

import bpy

from ...core import wiring
from ...core.declare import registered
from ...core.lazy import numpy as np
from ...core.refusals import Refused
from ...core.settings import entries, lists
from ...core.translations import tr
from ..mesh import arrays
from . import binding, keys


def system():
    """The registered System of the pins. A top-level import is impossible, since the package's __init__ imports this module."""
    return registered["pull"]


def check(obj):
    """Raise Refused if the pins of an object cannot be changed."""
    if obj.type != 'MESH':
        raise Refused(tr("{object} is not a mesh").format(object=obj.name))
    if obj.library:
        raise Refused(tr("{object} is linked from another file: make a library override of it first").format(object=obj.name))
    if obj.override_library and obj.modifiers and not obj.motus.pull.is_active:
        raise Refused(tr("{object} is overridden and has modifiers of the library, before which pins cannot come").format(object=obj.name))
    if any(modifier.type == 'MULTIRES' for modifier in obj.modifiers):
        raise Refused(tr("{object} has a Multiresolution modifier: apply it or remove it first").format(object=obj.name))


def pin_at(obj, index):
    """Return the checked index of a pin; -1 stands for the active pin. Raises Refused if there is no such pin."""
    settings = obj.motus.pull
    found = settings.active_pin if index < 0 else index
    if not 0 <= found < len(settings.pins):
        raise Refused(tr("There is no such pull pin"))
    return found


def add(obj, vertex, name, values):
    """Add a pin at the end of the object's list; returns its index.

    vertex: index of the vertex that the pin pulls (its root). values: {name: value} of the pin's settings.
    """
    pin = _append(obj, name, values)
    bind(obj, pin, vertex)
    rewire(obj)
    return obj.motus.pull.active_pin


def add_shape(obj, offsets, name, values):
    """Add a pin that moves each vertex by its own offset.

    offsets: (n, 3) in the object's space. values: {name: value} of the pin's settings.
    """
    _append(obj, name, values | {"shape": binding.keep_shape(obj.data, offsets)})
    rewire(obj)


def check_rooted(pin):
    """Raise Refused if a pin does not pull at one vertex, since it was made of a whole stroke."""
    if pin.shape:
        raise Refused(tr("{pin} keeps the shape of a stroke and has no root").format(pin=pin.name))


def _append(obj, name, values):
    settings = obj.motus.pull
    pin = lists.add(settings.pins, _free_name(settings, name))
    # Assign all settings: foreach_get() on the list is slow for values that were never set.
    for field in [one.identifier for one in pin.bl_rna.properties if one.is_runtime and one.identifier != "name"]:
        setattr(pin, field, values.get(field, getattr(pin, field)))
    settings.active_pin = len(settings.pins) - 1
    return pin


def bind(obj, pin, vertex):
    """Make a vertex the root of a pin, that is the vertex at which the pin pulls."""
    others = _pins_of_mesh(obj.data, but=pin)
    elsewhere = {other.anchor for other in others if other.vertex != vertex}
    pin.vertex = vertex
    pin.place = arrays.positions(obj.data)[vertex]
    pin.anchor = binding.mark(obj.data, vertex, elsewhere)
    binding.unmark(obj.data, {pin.anchor, *(other.anchor for other in others)})


def remove(obj, indices):
    """Remove the pins of these indices from an object.

    When the last pin is removed, the modifier and everything else that was added to the object for pins is removed too. Raises Refused if a
    pin is from a library.
    """
    settings = obj.motus.pull
    lists.check_own(settings.pins, indices)
    left = [index for index in range(len(settings.pins)) if index not in indices]
    _follow(obj, left)
    for index in sorted(indices, reverse=True):
        lists.remove(settings.pins, index)
    settings.active_pin = max(0, min(settings.active_pin, len(settings.pins) - 1))
    kept = _pins_of_mesh(obj.data)
    binding.unmark(obj.data, {pin.anchor for pin in kept})
    binding.drop_shapes(obj.data, {pin.shape for pin in kept})
    rewire(obj)
    if not left:
        keys.drop_empty(obj)


def reorder(obj, index, place):
    """Move the pin at `index` to the position `place` in the object's list."""
    settings = obj.motus.pull
    order = list(range(len(settings.pins)))
    order.insert(place, order.pop(index))
    lists.move(settings.pins, index, place)
    _follow(obj, order)
    settings.active_pin = place
    wiring.touch(system(), obj)


def rewire(obj):
    """Add, update or remove the object's modifier and drivers for its present pins; if no pin is left, also remove the settings."""
    entries.wire(system(), obj, "pins")


def settle(obj):
    """Store in each pin of an object the present index and position of the vertex that it pulls."""
    if obj.mode != 'OBJECT':
        return
    from . import table

    positions = arrays.positions(obj.data)
    anchors, size = binding.by_number(binding.anchors(obj.data)), binding.diagonal(positions)
    for pin, row in zip(obj.motus.pull.pins, table.read(obj.motus.pull.pins)):
        root, _ = binding.root(row, positions, anchors, size) if row.is_usable and not row.shape else (None, None)
        if root is not None and np.isfinite(positions[root]).all():
            pin.vertex, pin.place = root, positions[root]


def _follow(obj, order):
    # A different pin may get a removed pin's index. So drivers of the removed pin get a path that does not exist: Blender reports it.
    keys.reorder(obj, {old: new for new, old in enumerate(order)}, wiring.absent_path(system(), "removed pin"))


def _pins_of_mesh(mesh, but=None):
    """Return the pins of all objects that use the mesh, except the pin `but`."""
    return [
        pin for obj in bpy.data.objects if obj.data == mesh and obj.is_property_set("motus") for pin in obj.motus.pull.pins if pin != but
    ]


def _free_name(settings, name):
    names = {pin.name for pin in settings.pins}
    number, found = 0, name
    while found in names:
        number += 1
        found = f"{name}.{number:03d}"
    return found
