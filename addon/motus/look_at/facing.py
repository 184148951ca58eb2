"""Where a rig faces and what it stands along at rest, found from its skeleton, as axes of its own space."""

from mathutils import Vector

from ..core import axes
from ..core.system import has_settings, of_owner, systems
from . import names

FORWARD, UP = 'NEG_Y', 'POS_Z'
"""Blender's convention for a character."""
FORWARD_OF_UP = {
    'POS_Z': 'NEG_Y', 'NEG_Z': 'NEG_Y', 'POS_X': 'NEG_Y', 'NEG_X': 'NEG_Y', 'POS_Y': 'POS_Z', 'NEG_Y': 'NEG_Z'}
"""Where a rig faces that shows nothing of it, by what it stands along: Z of a rig with Y up, as other programs have it."""

FACE = {"nose", "snout", "muzzle", "beak", "jaw", "chin", "mouth", "lip", "lips", "teeth", "tongue"}
FEET = {"foot", "feet", "toe", "toes", "ball", "ankle", "paw", "hoof"}
LEFT, RIGHT = {"l", "left"}, {"r", "right"}
SHOWN = 0.05  # of the height of the skeleton: what lies nearer than this shows no direction
UPRIGHT = 0.7  # cosine: a direction within 45 degrees of the vertical


def find(rig, head):
    """(forward, up) of a rig at rest, as items of AXES. head: name of the bone that looks."""
    up = up_of(rig, head)
    return forward_of(rig, head, up), up


def up_of(rig, head):
    """The axis that the rig stands along: from its feet, else from the spine below its head."""
    bones = rig.data.bones
    feet = [bone.head_local for bone in bones if names.are_in(bone.name, FEET)]
    if feet:
        middle = _mean([bone.head_local for bone in bones])
        return _nearest(middle - _mean(feet), axes.IDENTIFIERS)
    spine = bones[head].head_local - (bones[head].parent_recursive or [bones[head]])[-1].head_local
    # A spine along Y is that of an animal, unless the object has been turned so that Y is up.
    is_turned = (rig.matrix_world.to_3x3() @ Vector((0.0, 1.0, 0.0))).normalized().z > UPRIGHT
    return 'POS_Y' if is_turned and spine.length and spine.normalized().y > UPRIGHT else UP


def forward_of(rig, head, up):
    """The axis that the rig faces along: by its eyes, its face, its feet, its sides, or what other systems have been told."""
    level = [name for name in axes.IDENTIFIERS if name[-1] != up[-1]]
    vertical = Vector(axes.vector(up))
    least = SHOWN * _height(rig, vertical)
    for way in _ways(rig, head, vertical):
        way = way - way.dot(vertical) * vertical
        if way.length > least:
            return _nearest(way, level)
    told = _told(rig)
    return told if told in level else FORWARD_OF_UP[up]


def turned(forward, up):
    """The next of the four axes round `up`, seen from above against the clock."""
    if forward[-1] == up[-1]:
        return FORWARD_OF_UP[up]
    return _nearest(Vector(axes.vector(up)).cross(Vector(axes.vector(forward))), axes.IDENTIFIERS)


def _ways(rig, head, vertical):
    """Directions that point ahead, from what shows it best; of any length."""
    bones = rig.data.bones
    place = bones[head].head_local
    eyes = names.eyes_of(rig, head)
    if eyes:
        yield _mean([bones[name].head_local for name in eyes]) - place
    face = [bone for bone in bones[head].children_recursive if names.are_in(bone.name, FACE)]
    if face:
        yield _mean([bone.tail_local for bone in face]) - place
    feet = [_ahead(bone) for bone in bones if names.are_in(bone.name, FEET)]
    if feet:
        yield sum(feet, Vector())
    sides = _side(bones, LEFT) - _side(bones, RIGHT)
    yield sides.cross(vertical)


def _ahead(foot):
    """From a foot to its toes; without these along the bone."""
    toes = [child for child in foot.children if names.are_in(child.name, FEET)]
    return (toes[0].head_local if toes else foot.tail_local) - foot.head_local


def _side(bones, words):
    """Middle of the bones of one side."""
    found = [bone.head_local for bone in bones if names.are_in(bone.name, words)]
    return _mean(found) if found else Vector()


def _told(rig):
    """Which axis points ahead in the settings of another system that moves the rig; "" without."""
    for system in systems():
        if has_settings(system, rig):
            settings = of_owner(system, rig)
            if settings.is_active and hasattr(settings, "forward_axis"):
                return settings.forward_axis
    return ""


def _height(rig, vertical):
    heights = [place.dot(vertical) for bone in rig.data.bones for place in (bone.head_local, bone.tail_local)]
    return max(heights) - min(heights)


def _mean(places):
    return sum(places, Vector()) / len(places)


def _nearest(way, among):
    """The axis that points most nearly in a direction; of axes that do so alike the first one of AXES."""
    listed = [name for name, *_ in axes.AXES if name in among]
    return max(listed, key=lambda name: way.dot(Vector(axes.vector(name))))
