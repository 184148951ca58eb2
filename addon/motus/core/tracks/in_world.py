"""World matrices over time of objects and bones, through all their parents, as Blender computes them."""

import functools

import bpy
from mathutils import Matrix

from .. import keeping
from ..animation import keys, strips
from ..animation.reason import Reason
from ..evaluated import copies
from ..evaluated.question import answered
from ..lazy import numpy as np
from . import laid, rotations, solved
from .transforms import Own

DEEPEST = 256
"""Most parents above each other that are followed, of objects and of bones. A longer chain of parents is taken for a loop."""

_ANSWERS = keeping.OfEvaluation(
    "whether and when an object moves that nothing but keys moves: answers of its track",
    "stamp of its action; the question",
    "three for each object",
)


class World:
    """World matrix over time of an Object or PoseBone, computed from its channels and from all parents that it hangs on.

    scene: the scene whose frame rate counts for systems that drive it. beneath: a System whose effect on the bone is left out, or None.
    """

    def __init__(self, thing, scene, beneath=None):
        self._thing, self._scene, self._beneath = thing, scene, beneath
        self._is_bone = isinstance(thing, bpy.types.PoseBone)

    @functools.cached_property
    def _links(self):
        """Links of the chain of parents, one for each object, the topmost parent first."""
        found, obj = [], self._thing.id_data
        bone = self._thing if self._is_bone else None
        while obj is not None and len(found) < DEEPEST:
            link = _Link(obj, bone, self._scene, None if found else self._beneath)
            found.insert(0, link)
            bone = _parent_bone(obj)
            obj = obj.parent
        return found

    @functools.cached_property
    def reason(self):
        """Reason why the world matrix is unknown at frames other than the present one; None if it is known."""
        return self._answer(
            "reason",
            lambda: next(filter(None, (self._of(link, "reason", lambda link=link: link.reason) for link in reversed(self._links))), None),
        )

    @property
    def rests_on_keys(self):
        """As Own.rests_on_keys. False for bones, and for objects with a parent, a constraint or a rigid body."""
        return self._kept is not None

    @functools.cached_property
    def _kept(self):
        """Dictionary of answers that stay true for as long as the evaluated copy and its keys do; None if there are no such answers."""
        obj = self._thing
        if self._is_bone or obj.parent is not None or len(obj.constraints) or obj.rigid_body is not None:
            return None
        copy, stamp = copies.of(obj), strips.stamp_of(obj.animation_data)
        if copy is None or stamp is None:
            return None
        known = _ANSWERS.on(copy)
        if stamp not in known:
            known.clear()
            known[stamp] = {} if Own(obj).rests_on_keys else None
        return known[stamp]

    def _answer(self, question, make):
        """Return make(), the answer to a question: kept, if possible with the evaluated copy, else while the outermost question is answered."""
        kept = self._kept
        if kept is None:
            return answered((self, question), make)
        if question not in kept:
            kept[question] = make()
        return kept[question]

    @property
    def solvers(self):
        """Labels of the systems of Motus that compute parts of the world matrix."""
        return list(dict.fromkeys(one.label for link in self._links for one in link.all_solved))

    def _of(self, link, *question_and_answer):
        """Answer to a question about one link of the chain of parents, computed once for all things that share the link.

        question_and_answer: hashable words of the question, and last a function that computes the answer.
        """
        *question, answer = question_and_answer
        return answered((link.key, *question), answer)

    def values(self, times):
        """World matrices (n, 4, 4), for column vectors, at times, (n,) frames of the scene."""
        marks = times.tobytes()
        return answered((self, "values", marks), lambda: self._values(times, marks))

    def _values(self, times, marks):
        found = None
        for link in self._links:
            found = self._of(link, "values", marks, lambda link=link, above=found: link.matrices(times, above))
        return found

    def poses(self, times):
        """Poses (n, 4, 4) of the bone in armature space at times, (n,) frames of the scene. Only for a PoseBone."""
        link = self._links[-1]
        return np.broadcast_to(self._of(link, "poses", times.tobytes(), lambda: link.poses(times)), (len(times), 4, 4))

    def bounds(self, first, last):
        """Rising frames from first to last, between which the world matrix changes smoothly."""
        return answered(
            (self, "bounds", first, last),
            lambda: keys.union([self._of(link, "bounds", first, last, lambda link=link: link.bounds(first, last)) for link in self._links]),
        )

    @property
    def extent(self):
        """(first, last) frame between which the world matrix changes, infinite if it goes on changing; None if it is constant."""
        return self._answer(
            "extent", lambda: keys.united([self._of(link, "extent", lambda link=link: link.extent) for link in self._links])
        )

    @property
    def price(self):
        """Cost of the world matrix at one time, in units of core/measures/bounds.py (about a microsecond)."""
        return sum(link.price for link in self._links)

    @property
    def stamp(self):
        """Hashable value that changes whenever the world matrix may change at any time; None if changes cannot be detected."""
        return self._answer(
            "stamp", lambda: strips.together([self._of(link, "stamp", lambda link=link: link.stamp) for link in self._links])
        )

    @property
    def present(self):
        """Sample for a recording, (12,): the evaluated world matrix without its last row, row by row."""
        thing = self._thing
        matrix = thing.id_data.matrix_world @ thing.matrix if self._is_bone else thing.matrix_world
        return np.array(matrix)[:3].ravel()


class _Link:
    """One link of a chain of parents: an object, and the bone of the object on which the next link hangs.

    bone: PoseBone; in the last link, the bone whose world matrix is wanted. None if the object itself is the parent or is wanted.
    """

    def __init__(self, obj, bone, scene, beneath):
        self._object, self._bone, self._scene, self._beneath = obj, bone, scene, beneath
        self.key = hash(obj), bone and bone.name, hash(scene), beneath and beneath.name
        self._own = Own(obj)
        self._bones = _chain(bone) if bone else []
        self._posed = [laid.over(Own(one), one) for one in self._bones]

    @functools.cached_property
    def reason(self):
        return (
            of_parent(self._object)
            or self._of_object()
            or self._of_bones()
            or next((own.reason for own in (self._own, *self._posed) if own.reason), None)
        )

    def _of_object(self):
        if self._object.rigid_body:
            return Reason(Reason.PHYSICS, thing=self._object.name)
        return self.solved.reason if self.solved else constrained(self._object)

    @functools.cached_property
    def solved(self):
        """Result over time of the system that drives the object, as a Solved; None if no system drives the object alone."""
        return solved.of(self._object, self._scene) if len(self._object.constraints) else None

    def _of_bones(self):
        if not self._is_posed:
            return None
        for bone in self._bones:
            turning = self._turning.get(bone.name)
            found = turning.reason if turning else constrained(bone, self._beneath)
            if found:
                return found
        names = {bone.name for bone in self._bones}
        for bone in self._object.pose.bones:
            for constraint in bone.constraints:
                if constraint.type in {'IK', 'SPLINE_IK'} and not names.isdisjoint(turned_by(bone, constraint)):
                    return Reason(Reason.SOLVED_BONE, thing=self._bone.name, bone=bone.name, name=constraint.name)
        return None

    @functools.cached_property
    def _turning(self):
        """Results over time of systems that drive bones of the object in this link of a chain of parents: {name of a bone: Solved}."""
        found = {bone.name: solved.of_bone(bone, self._scene, self._beneath) for bone in self._bones if len(bone.constraints)}
        return {name: one for name, one in found.items() if one}

    @property
    def _is_posed(self):
        return self._bone is not None and self._object.data.pose_position != 'REST'

    @property
    def _driving(self):
        """Results over time, as Solved, of the systems that drive the object and its bones; without those that lay poses over the bones."""
        return [*([self.solved] if self.solved else []), *(self._turning.values() if self._is_posed else ())]

    @property
    def all_solved(self):
        """Results over time, as Solved, of all systems that drive the object and its bones, first those that lay poses over the bones."""
        laying = [one for own in self._posed for one in getattr(own, "solved", ())] if self._is_posed else []
        return [*laying, *self._driving]

    def matrices(self, times, parent):
        """World matrices (n, 4, 4) of the bone, or of the object if there is no bone, at times, (n,) frames of the scene.

        parent: world matrices (n, 4, 4) of the link above, or None if the object has no parent.
        """
        obj = self._object
        found = self._own.values(times).matrices
        if parent is not None:
            found = rotations.chained(rotations.chained(parent, parent_offset(obj)), found)
        if self.solved:
            found = self.solved.applied(times, found)
        return rotations.chained(found, self.poses(times)) if self._bone else found

    def poses(self, times):
        """Poses (n, 4, 4), or (1, 4, 4) if constant, of the bone in armature space at times, (n,) frames of the scene."""
        if self._object.data.pose_position == 'REST':
            return _array(self._bone.bone.matrix_local)
        found = None
        for bone, own in zip(self._bones, self._posed):
            turning, transforms = self._turning.get(bone.name), own.values(times)
            found = posed(bone, turning.applied(times, transforms) if turning else transforms, found)
        return found

    @property
    def _parts(self):
        return [self._own, *self._posed, *self._driving]

    def bounds(self, first, last):
        return keys.union([part.bounds(first, last) for part in self._parts])

    @property
    def price(self):
        return sum(part.price for part in self._parts)

    @property
    def extent(self):
        return keys.united(part.extent for part in self._parts)

    @property
    def stamp(self):
        obj = self._object
        bones = tuple(map(rest_stamp, self._bones))
        pose = obj.data.pose_position if bones else ""
        return strips.together((*(part.stamp for part in self._parts), obj.parent_type, _numbers(obj.matrix_parent_inverse), bones, pose))


def _array(matrix):
    """A mathutils.Matrix as an array of float64, (1, 4, 4)."""
    return np.array(matrix, float)[None]


def _numbers(matrix):
    return tuple(map(tuple, matrix))


def constrained(thing, beneath=None):
    """Reason that a constraint acts on an Object or PoseBone, so that its transform is unknown at other frames; None if none acts.

    beneath: a System whose constraints do not count, or None. Constraints of systems that lay poses never count.
    """
    found = solved.acting_on(thing, beneath) if len(thing.constraints) else ()
    return Reason(Reason.CONSTRAINED, thing=thing.name, name=found[0].name) if found else None


def _chain(bone):
    """List of a bone and all its parents, the topmost parent first."""
    return [*reversed(bone.parent_recursive), bone]


def turned_by(bone, constraint):
    """Names of the bones that an IK or Spline IK constraint on `bone` moves; none if the constraint is muted."""
    if constraint.mute:
        return []
    chain = ([bone] if getattr(constraint, "use_tail", True) else []) + bone.parent_recursive
    return [one.name for one in chain[: constraint.chain_count or None]]


def parent_of(obj):
    """The PoseBone or Object that is the parent of an object; None if there is none."""
    return _parent_bone(obj) or obj.parent


def _parent_bone(obj):
    if obj.parent and obj.parent_type == 'BONE' and obj.parent.pose:
        return obj.parent.pose.bones.get(obj.parent_bone)
    return None


def of_parent(obj):
    """Reason why the place of an object relative to its parent is unknown at other frames; None if it is known, or there is no parent.

    Unknown are objects on vertices of their parent, and objects that follow their parent's curve.
    """
    parent = obj.parent
    if parent is None:
        return None
    if obj.parent_type in {'VERTEX', 'VERTEX_3'}:
        return Reason(Reason.VERTICES, thing=obj.name, name=parent.name)
    if obj.parent_type == 'OBJECT' and parent.type == 'CURVE' and parent.original.data.use_path:
        return Reason(Reason.ALONG_CURVE, thing=obj.name, name=parent.name)
    return None


def parent_offset(obj):
    """Matrix (1, 4, 4) from the matrix of an object's parent to the space of the object's own channels.

    It consists of the parent inverse matrix and, for a parent bone, the offset to the bone's tail or rest pose.
    """
    bone, inverse = _parent_bone(obj), _array(obj.matrix_parent_inverse)
    if bone is None:
        return inverse
    if bone.bone.use_relative_parent:
        return rotations.chained(_array(bone.bone.matrix_local.inverted_safe()), inverse)
    return rotations.chained(_array(Matrix.Translation((0.0, bone.bone.length, 0.0))), inverse)


def rest_stamp(bone):
    """Hashable value that changes whenever the rest pose of a PoseBone, or how the bone inherits from its parent, changes."""
    rest = bone.bone
    return (
        _numbers(rest.matrix_local),
        rest.inherit_scale,
        rest.use_inherit_rotation,
        rest.use_local_location,
        rest.use_connect,
        rest.use_relative_parent,
        rest.length,
    )


def posed(bone, transforms, parent):
    """Poses (n, 4, 4) in armature space of a PoseBone with given own Transforms.

    parent: poses (n, 4, 4) of the parent bone, or None if the bone has no parent.
    """
    if bone.bone.use_connect:
        transforms = transforms._replace(locations=np.zeros_like(transforms.locations))
    return _posed(bone.bone, transforms.matrices, parent)


def _posed(bone, basis, parent):
    """Poses (n, 4, 4) in armature space of a Bone from own transforms `basis`, (n, 4, 4).

    parent: poses (n, 4, 4) of the parent bone, or None if the bone has no parent.
    """
    above = bone.parent
    is_plain = (bone.inherit_scale == 'FULL' and bone.use_inherit_rotation) or above is None
    if is_plain and bone.use_local_location:
        if above is None:
            return rotations.chained(_array(bone.matrix_local), basis)
        below = _array(above.matrix_local.inverted_safe() @ bone.matrix_local)
        return rotations.chained(parent, rotations.chained(below, basis))
    # All different ways to inherit are left to Blender's own function, which computes in single precision.
    parents = [None] * len(basis) if parent is None else parent
    return np.array([_converted(bone, above, *pair) for pair in zip(basis, parents)])


def _converted(bone, above, basis, parent):
    more = {} if above is None else {"parent_matrix": Matrix(parent), "parent_matrix_local": above.matrix_local}
    return bone.convert_local_to_pose(Matrix(basis), bone.matrix_local, **more)
