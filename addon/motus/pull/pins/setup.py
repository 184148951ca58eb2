"""Adding pins to an object, binding them to its mesh, and taking them away: plain functions under the operators."""

import bpy

from ...core import wiring
from ...core.declare import registered
from ...core.file import libraries
from ...core.lazy import numpy as np
from ...core.refusals import Refused
from ...core.settings import entries
from ...core.translations import tr
from ..mesh import arrays
from . import binding, keys


def system():
    """The system that this folder declares."""
    return registered["pull"]


def check(obj):
    """Refuse an object whose pins cannot be changed."""
    if obj.type != 'MESH':
        raise Refused(tr("{object} is not a mesh").format(object=obj.name))
    if obj.library:
        raise Refused(
            tr("{object} is linked from another file: make a library override of it first").format(object=obj.name))
    if obj.override_library and obj.modifiers and not obj.motus.pull.is_active:
        raise Refused(tr("{object} is overridden and has modifiers of the library, before which pins cannot come").format(
            object=obj.name))
    if any(modifier.type == 'MULTIRES' for modifier in obj.modifiers):
        raise Refused(tr("{object} has a Multiresolution modifier: apply it or remove it first").format(object=obj.name))


def pin_at(obj, index):
    """The index of a pin, where -1 is the active one. Raises Refused where there is none."""
    settings = obj.motus.pull
    found = settings.active_pin if index < 0 else index
    if not 0 <= found < len(settings.pins):
        raise Refused(tr("There is no such pull pin"))
    return found


def add(obj, vertex, name, values):
    """A new pin at the end of the list, with the root `vertex` and these settings; returns its index."""
    pin = _append(obj, name, values)
    bind(obj, pin, vertex)
    rewire(obj)
    return obj.motus.pull.active_pin


def add_shape(obj, offsets, name, values):
    """A new pin that moves each vertex by its own offset, (n, 3) in the object."""
    _append(obj, name, values | {"shape": binding.keep_shape(obj.data, offsets)})
    rewire(obj)


def check_rooted(pin):
    """Refuse a pin that has no root."""
    if pin.shape:
        raise Refused(tr("{pin} keeps the shape of a stroke and has no root").format(pin=pin.name))


def _append(obj, name, values):
    settings = obj.motus.pull
    pin = settings.pins.add()
    pin.name = _free_name(settings, name)
    # All are set, so that no default is left for Blender to guess at when the list is read column by column.
    for field in [one.identifier for one in pin.bl_rna.properties if one.is_runtime and one.identifier != "name"]:
        setattr(pin, field, values.get(field, getattr(pin, field)))
    settings.active_pin = len(settings.pins) - 1
    return pin


def bind(obj, pin, vertex):
    """Let a vertex be the root of a pin."""
    others = _pins_of_mesh(obj.data, but=pin)
    elsewhere = {other.anchor for other in others if other.vertex != vertex}
    pin.vertex = vertex
    pin.place = arrays.positions(obj.data)[vertex]
    pin.anchor = binding.mark(obj.data, vertex, elsewhere)
    binding.unmark(obj.data, {pin.anchor, *(other.anchor for other in others)})


def remove(obj, indices):
    """Remove pins; with the last one all that was added to the object for them."""
    settings = obj.motus.pull
    if min(indices) < libraries.count_from_library(obj, "motus.pull.pins"):
        raise Refused(tr("A pin of {object} is from its library and cannot be removed here: mute it").format(object=obj.name))
    left = [index for index in range(len(settings.pins)) if index not in indices]
    _follow(obj, left)
    for index in sorted(indices, reverse=True):
        settings.pins.remove(index)
    settings.active_pin = max(0, min(settings.active_pin, len(settings.pins) - 1))
    kept = _pins_of_mesh(obj.data)
    binding.unmark(obj.data, {pin.anchor for pin in kept})
    binding.drop_shapes(obj.data, {pin.shape for pin in kept})
    rewire(obj)
    if not left:
        keys.drop_empty(obj)


def reorder(obj, index, place):
    """Let a pin act at another place in the order."""
    settings = obj.motus.pull
    order = list(range(len(settings.pins)))
    order.insert(place, order.pop(index))
    settings.pins.move(index, place)
    _follow(obj, order)
    settings.active_pin = place
    wiring.touch(system(), obj)


def rewire(obj):
    """Wire an object for the pins it has now."""
    entries.wire(system(), obj, "pins")


def settle(obj):
    """Let pins remember where their roots stand now."""
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
    # A pin's number may soon be another's: who reads a pin that is gone reads what is never there, and Blender says so.
    keys.reorder(obj, {old: new for new, old in enumerate(order)}, wiring.absent_path(system(), "removed pin"))


def _pins_of_mesh(mesh, but=None):
    """The pins, but for one, of all objects that have the mesh."""
    return [pin for obj in bpy.data.objects if obj.data == mesh and obj.is_property_set("motus")
            for pin in obj.motus.pull.pins if pin != but]


def _free_name(settings, name):
    names = {pin.name for pin in settings.pins}
    number, found = 0, name
    while found in names:
        number += 1
        found = f"{name}.{number:03d}"
    return found
