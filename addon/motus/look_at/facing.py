"""Where a rig faces and what it stands along at rest, found from its skeleton, as axes of its own space."""

from mathutils import Vector

from ..core.declare import has_settings, of_owner, systems
from ..core.measures import axes
from . import names

FORWARD, UP = 'NEG_Y', 'POS_Z'
"""Blender's convention for a character."""
FORWARD_OF_UP = {'POS_Z': 'NEG_Y', 'NEG_Z': 'NEG_Y', 'POS_X': 'NEG_Y', 'NEG_X': 'NEG_Y', 'POS_Y': 'POS_Z', 'NEG_Y': 'NEG_Z'}
"""Where a rig faces whose skeleton shows no forward, by its up axis: with Y up along Z, as in files of other programs."""

SHOWN = 0.3  # sine: a direction that leans less than this away from the vertical shows no forward
UPRIGHT = 0.7  # cosine: a direction within 45 degrees of the vertical
OF_THE_WORLD = 0.25  # what the world's up counts, in sizes of the skeleton, beside the height of the middle above the feet


def find(rig, head, given):
    """{"forward": item of AXES, "up": another one} of a rig at rest. head: name of the bone that looks; given: what is known of these."""
    up = given.get("up") or up_of(rig, head)
    return {"forward": given.get("forward") or forward_of(rig, head, up), "up": up}


def up_of(rig, head):
    """The axis that the rig stands along: by its feet, else as other systems have been told, else by the spine below its head."""
    bones = rig.data.bones
    upright = (rig.matrix_world.to_3x3().inverted_safe() @ Vector((0.0, 0.0, 1.0))).normalized()
    feet = [bone.head_local for bone in names.parts(bones, names.FEET)]
    return _above(feet, bones, upright) if feet else _told(rig, "up_axis") or _along_spine(bones[head], upright)


def _above(feet, bones, upright):
    """The axis along which the skeleton is above its feet. upright: what is up in the world, seen from the rig."""
    places = [place for bone in bones for place in (bone.head_local, bone.tail_local)]
    size = max((place - places[0]).length for place in places)
    middle = _mean(places)

    def height(name):
        axis = Vector(axes.vector(name))
        # The least of all feet: an animal's hind feet alone lie far behind its middle.
        return min((middle - foot).dot(axis) for foot in feet) + OF_THE_WORLD * size * upright.dot(axis)

    return max(_listed(axes.IDENTIFIERS), key=height)


def _along_spine(head, upright):
    """The axis that the spine runs along if it is upright in the world: an animal's is level. Else Z."""
    lowest = head.parent_recursive[-1] if head.parent else head
    along = _nearest(head.head_local - lowest.head_local, axes.IDENTIFIERS)
    return along if upright.dot(Vector(axes.vector(along))) > UPRIGHT else UP


def forward_of(rig, head, up):
    """The axis that the rig faces along: by its eyes, its face, its feet, its sides, or as other systems have been told."""
    level = [name for name in axes.IDENTIFIERS if name[-1] != up[-1]]
    vertical = Vector(axes.vector(up))
    for way in _ways(rig.data.bones, head, vertical):
        across = way - way.dot(vertical) * vertical
        if across.length > SHOWN * way.length:
            return _nearest(across, level)
    told = _told(rig, "forward_axis")
    return told if told in level else FORWARD_OF_UP[up]


def turned(forward, up):
    """The next of the four axes round `up`, counter-clockwise as seen from above."""
    if forward[-1] == up[-1]:
        return FORWARD_OF_UP[up]
    return _nearest(Vector(axes.vector(up)).cross(Vector(axes.vector(forward))), axes.IDENTIFIERS)


def _ways(bones, head, vertical):
    """Yield vectors of any length that point to where the rig faces, the most reliable first: by eyes, face, feet, then the two sides.

    bones: of the armature. head: name of the head bone. vertical: unit vector of the rig's up axis.
    """
    place = bones[head].head_local
    eyes = names.eyes_of(bones, head)
    if eyes:
        yield _mean([bones[name].head_local for name in eyes]) - place
    face = names.parts(bones[head].children_recursive, names.FACE)
    if face:
        yield _mean([bone.tail_local for bone in face]) - place
    yield sum(map(_ahead, names.topmost(names.parts(bones, names.FEET))), Vector())
    left, right = ([bone.head_local for bone in names.parts(bones, words)] for words in (names.LEFT, names.RIGHT))
    if left and right:
        yield (_mean(left) - _mean(right)).cross(vertical)


def _ahead(foot):
    """Direction from a foot to its toes; along the foot's bone if it has no toes."""
    toes = [bone.head_local for bone in names.parts(foot.children_recursive, names.FEET)]
    return (_mean(toes) if toes else foot.tail_local) - foot.head_local


def _told(rig, name):
    """The axis in a setting, such as "up_axis", of any Motus system that is set up on the rig; "" if none has the setting."""
    for system in systems():
        if has_settings(system, rig):
            settings = of_owner(system, rig)
            if settings.is_active and getattr(settings, name, "") in axes.IDENTIFIERS:
                return getattr(settings, name)
    return ""


def _mean(places):
    return sum(places, Vector()) / len(places)


def _nearest(way, among):
    """The axis that points most nearly in a direction; of axes that do so alike the first one of AXES."""
    return max(_listed(among), key=lambda name: way.dot(Vector(axes.vector(name))))


def _listed(among):
    """The given axes in the order of AXES."""
    return [name for name, *_ in axes.AXES if name in among]
