"""Find the forward and up axes of a character at rest from the bones of its rig, as axes of the armature object's space.

Axes are named by the identifiers of AXES (core/measures/axes.py), such as 'NEG_Y'.
"""

from mathutils import Vector

from ..core.declare import has_settings, of_owner, systems
from ..core.measures import axes
from . import names

FORWARD, UP = 'NEG_Y', 'POS_Z'
"""Forward and up axes of a character by Blender's convention."""
FORWARD_OF_UP = {'POS_Z': 'NEG_Y', 'NEG_Z': 'NEG_Y', 'POS_X': 'NEG_Y', 'NEG_X': 'NEG_Y', 'POS_Y': 'POS_Z', 'NEG_Y': 'NEG_Z'}
"""{up axis: forward axis} of rigs whose bones do not show the forward direction.

If Y points up, Z points forward, as in files of programs that have Y up.
"""

SHOWN = 0.3  # sine of an angle: a direction within this angle of the vertical does not show the forward direction
UPRIGHT = 0.7  # cosine of 45 degrees: a direction within this angle of the vertical is upright
OF_THE_WORLD = 0.25  # weight of the world's up axis beside the height of the skeleton's middle above the feet, in sizes of the skeleton


def find(rig, head, given):
    """Forward and up axis of a rig at rest, {"forward": axis, "up": axis}.

    head: name of the head bone. given: {"forward": axis, "up": axis} as far as the user has given them; these axes are kept.
    """
    up = given.get("up") or up_of(rig, head)
    return {"forward": given.get("forward") or forward_of(rig, head, up), "up": up}


def up_of(rig, head):
    """Up axis of a rig at rest. head: name of the head bone.

    The axis is found from the feet if the rig has foot bones. Otherwise it is the up axis in the settings of any Motus system on
    the rig. If no system has such a setting, it is found from the bones between root and head.
    """
    bones = rig.data.bones
    upright = (rig.matrix_world.to_3x3().inverted_safe() @ Vector((0.0, 0.0, 1.0))).normalized()
    feet = [bone.head_local for bone in names.parts(bones, names.FEET)]
    return _above(feet, bones, upright) if feet else _told(rig, "up_axis") or _along_spine(bones[head], upright)


def _above(feet, bones, upright):
    """Axis along which the middle of the skeleton is highest above its feet.

    feet: positions in the rig's space. upright: unit vector of the world's Z axis in the rig's space; axes that agree with it
    are preferred.
    """
    places = [place for bone in bones for place in (bone.head_local, bone.tail_local)]
    size = max((place - places[0]).length for place in places)
    middle = _mean(places)

    def height(name):
        axis = Vector(axes.vector(name))
        # The smallest value of all feet: the hind feet of an animal lie far behind its middle, and alone would show a level axis as up.
        return min((middle - foot).dot(axis) for foot in feet) + OF_THE_WORLD * size * upright.dot(axis)

    return max(_listed(axes.IDENTIFIERS), key=height)


def _along_spine(head, upright):
    """Axis along which the bones from the root to a head bone run, if that axis is upright in the world; otherwise Z.

    The spine of an animal is level, and does not show the up axis.
    """
    lowest = head.parent_recursive[-1] if head.parent else head
    along = _nearest(head.head_local - lowest.head_local, axes.IDENTIFIERS)
    return along if upright.dot(Vector(axes.vector(along))) > UPRIGHT else UP


def forward_of(rig, head, up):
    """Forward axis of a rig at rest, perpendicular to its up axis. head: name of the head bone.

    The axis is found from the eyes, the face, the feet, or the left and right side of the skeleton. Otherwise it is the forward
    axis in the settings of any Motus system on the rig, or else the axis of FORWARD_OF_UP.
    """
    level = [name for name in axes.IDENTIFIERS if name[-1] != up[-1]]
    vertical = Vector(axes.vector(up))
    for way in _ways(rig.data.bones, head, vertical):
        across = way - way.dot(vertical) * vertical
        if across.length > SHOWN * way.length:
            return _nearest(across, level)
    told = _told(rig, "forward_axis")
    return told if told in level else FORWARD_OF_UP[up]


def turned(forward, up):
    """Forward axis after a quarter turn about the up axis, counter-clockwise as seen from above; FORWARD_OF_UP if both are parallel."""
    if forward[-1] == up[-1]:
        return FORWARD_OF_UP[up]
    return _nearest(Vector(axes.vector(up)).cross(Vector(axes.vector(forward))), axes.IDENTIFIERS)


def _ways(bones, head, vertical):
    """Yield vectors, of any length, in the direction that the rig faces, most reliable first: from eyes, face, feet, left and right side.

    bones: the armature's bones. head: name of the head bone. vertical: unit vector of the rig's up axis.
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
    """Vector from the head of a foot bone to the middle of its toes, or to the tail of the foot bone if it has no toes."""
    toes = [bone.head_local for bone in names.parts(foot.children_recursive, names.FEET)]
    return (_mean(toes) if toes else foot.tail_local) - foot.head_local


def _told(rig, name):
    """Axis in a setting, such as "up_axis", of any Motus system that is set up on the rig; "" if no system there has the setting."""
    for system in systems():
        if has_settings(system, rig):
            settings = of_owner(system, rig)
            if settings.is_active and getattr(settings, name, "") in axes.IDENTIFIERS:
                return getattr(settings, name)
    return ""


def _mean(places):
    return sum(places, Vector()) / len(places)


def _nearest(way, among):
    """Axis of `among` that is nearest to a direction; of equally near axes the first in the order of AXES."""
    return max(_listed(among), key=lambda name: way.dot(Vector(axes.vector(name))))


def _listed(among):
    """List of the given axes, sorted in the order of AXES."""
    return [name for name, *_ in axes.AXES if name in among]
