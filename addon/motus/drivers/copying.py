"""Copy a motion driver to the same property of everything that is selected."""

import re

from ..core.refusals import Refused, check_local
from . import expressions, history, places

_BONE = re.compile(r'pose\.bones\["(?:[^"\\]|\\.)*"\]')


def targets(context, datablock, path):
    """[(datablock, data path)] of the same property on further selected objects, in the order of their names.

    The property may belong to an object, to its data, shape keys or materials, or, in Pose Mode, to a bone: the targets are selected bones then.
    """
    bone = _BONE.match(path)
    if bone and context.selected_pose_bones:
        rest = path[bone.end() :]
        found = {(one.id_data, one.path_from_id() + rest) for one in context.selected_pose_bones}
    else:
        selected = context.selected_objects
        roles = {role for obj in (context.object, *selected) if obj for role, one in places.holders(obj).items() if one == datablock}
        found = {(holder, path) for obj in selected for role, holder in places.holders(obj).items() if role in roles}
    found.discard((datablock, path))
    return sorted(found, key=lambda one: (one[0].name, one[1]))


def copies(sources, target, changed):
    """[(Place, expression)] of the copies on one target; [] if it does not have the property, or has another driver on it.

    sources: Places of the property that is copied. target: arguments of places.find(). changed: function from the keywords of a motion and
    the Place of its copy to the keywords of the copy.
    """
    try:
        check_local(target[0])
        found = places.find(*target)
        if len(found) != len(sources):
            return []
        return [
            (place, _expression(source, place, changed)) for source, place in zip(sources, found) if source.is_moved and _is_free(place)
        ]
    except Refused:
        return []


def _is_free(place):
    return place.curve is None or place.is_moved


def _expression(source, place, changed):
    text = source.curve.driver.expression
    known = expressions.read(text)
    if known is None:
        return text  # the user has written or changed the expression
    keywords = changed(known, place)
    if expressions.BY_IDENTIFIER[keywords["function"]].follows:
        if keywords["source"] == source.path:
            keywords["source"] = place.path
        history.check(place.holder, keywords["source"], keywords["source_index"])
    return expressions.compose(keywords)


def moved_on(keywords, frames):
    """Keywords of the same motion, so many frames later."""
    return keywords | {name: keywords[name] + frames for name in ("start", "frame_start", "frame_end") if name in keywords}
