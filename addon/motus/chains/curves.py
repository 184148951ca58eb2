"""Points of curves as objects of a row: a hidden empty for each, the anchor, which a Hook modifier has its point follow.

Hooks act on the control points of a curve before anything else, a bevel included, which Geometry Nodes do not reach: to these a curve with a
bevel is a mesh. The anchors are children of the curve, so that it takes them along.
"""

import itertools

import bpy
from mathutils import Matrix

from ..core.blender import datablocks, helpers
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.settings import lists
from ..core.settings.entries import unwired
from ..core.translations import tr

FEWEST = 2
"""How many points a spline has at least whose points hang."""
IN_BEZIER = 3
"""How many points a hook counts for a Bezier point: its handles before and behind it."""


def points(owner, index):
    """Return the points of a spline of the original of a curve object; () if there is no such spline, or the object is no curve."""
    curve = owner.original.data  # an evaluated curve may be freed while it is read
    if owner.type != 'CURVE' or not 0 <= index < len(curve.splines):
        return ()
    spline = curve.splines[index]
    return spline.bezier_points if spline.type == 'BEZIER' else spline.points


def places(owner, index):
    """Return where the points of a spline of a curve object are in its own space, (n, 3) float32; () if there is no such spline."""
    found = points(owner, index)
    if not len(found):
        return ()
    size = len(found[0].co)
    flat = np.empty(len(found) * size, np.float32)
    found.foreach_get("co", flat)
    return flat.reshape(-1, size)[:, :3]


def are_moved(owner):
    """Whether points of an owner's splines were moved since its anchors were put to them."""
    for entry in owner.motus.chains.entries:
        anchored = anchors(owner, entry) if entry.spline >= 0 else ()
        if anchored and places(owner, entry.spline).tobytes() != np.array([one.location for one in anchored], np.float32).tobytes():
            return True
    return False


def splines_of(curve, index):
    """List the indices of the splines of a curve object that shall hang: that with an index, or all for -1. Raises Refused if one cannot."""
    found = range(len(curve.data.splines)) if index < 0 else [index]
    for one in found:
        if len(points(curve, one)) < FEWEST:
            raise Refused(tr("{object} has no spline {number} with two points and more").format(object=curve.name, number=one + 1))
        if curve.data.splines[one].use_cyclic_u:
            raise Refused(tr("Spline {number} of {object} is closed: open it first").format(object=curve.name, number=one + 1))
    if not found:
        raise Refused(tr("{object} has no spline {number} with two points and more").format(object=curve.name, number=1))
    return list(found)


def anchors(owner, entry):
    """List the anchors of a spline's entry, the first point's first; [] if they are not those of the owner's points, or if one point is left."""
    found = [pointed(link, "object") for link in entry.links]
    is_whole = all(one is not None and helpers.is_helper(one) and one.parent == owner for one in found)
    return found if is_whole and len(found) == len(points(owner, entry.spline)) >= FEWEST else []


def prepare(owner):
    """Give each spline of an owner that hangs its anchors, where its points are now, and hooks."""
    if owner.type != 'CURVE' or owner.motus.chains.is_baked:
        return
    with unwired(owner.motus.chains) as settings:
        for entry in [one for one in settings.entries if one.spline >= 0]:
            found = places(owner, entry.spline)
            if len(found) < max(FEWEST, lists.count_from_library(entry.links)):
                continue
            if not anchors(owner, entry):
                _make_anchors(owner, entry, len(found))
            for link, place in zip(entry.links, found):
                link.object.location = place
    tidy(owner)
    for place, (anchor, indices) in enumerate(_hooked(owner, settings)):
        _hook(owner, anchor, indices, place)


def tidy(owner):
    """Remove hooks and anchors of an owner that none of its entries needs; of a copied owner those that are its first one's."""
    needed = {anchor for entry in owner.motus.chains.entries for anchor in anchors(owner, entry)}
    for one in [one for one in owner.modifiers if _is_hook(one) and one.object not in needed]:
        owner.modifiers.remove(one)
    for obj in [obj for obj in bpy.data.objects if obj.parent == owner and helpers.is_helper(obj) and obj not in needed]:
        bpy.data.objects.remove(obj)


def _is_hook(one):
    return one.type == 'HOOK' and one.object is not None and helpers.is_helper(one.object)


def _make_anchors(owner, entry, count):
    made = [helpers.make(f"Motus Chains {owner.name} {entry.name} {index + 1}") for index in range(count)]
    for anchor in made:
        anchor.parent = owner
    lists.replace(entry.links, [{"name": str(index), "object": anchor} for index, anchor in enumerate(made)])


def _hooked(owner, settings):
    """Yield (anchor, indices of its point as hooks count them) for each point of the owner that hangs."""
    by_spline = {entry.spline: anchors(owner, entry) for entry in settings.entries if entry.spline >= 0}
    first = 0
    for index, spline in enumerate(owner.data.splines):
        size = IN_BEZIER if spline.type == 'BEZIER' else 1
        count = len(points(owner, index))
        for place, anchor in itertools.islice(enumerate(by_spline.get(index, ())), 1, None):
            yield anchor, range(first + place * size, first + (place + 1) * size)
        first += count * size


def _hook(owner, anchor, indices, place):
    """Have an anchor take a point along; its hook stands at a place of the stack, before all that the user has made."""
    found = next((one for one in owner.modifiers if one.type == 'HOOK' and one.object == anchor), None)
    if found is None:
        found = owner.modifiers.new(anchor.name.removeprefix(".Motus "), 'HOOK')
        found.object = anchor
        found.show_expanded = found.show_in_editmode = False
        found.falloff_type = 'NONE'
    found.vertex_indices_set(indices)
    found.matrix_inverse = Matrix.Translation(-anchor.location)
    datablocks.move_modifier(owner, found, place)
