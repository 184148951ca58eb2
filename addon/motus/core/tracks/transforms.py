"""Location, rotation and scale of objects and bones over time, and their world matrices, as Blender makes them."""

import functools
from typing import Any, NamedTuple

import bpy
from mathutils import Matrix

from .. import keeping
from ..animation import keys, strips
from ..animation.channel import Channel, is_driven
from ..animation.reason import Reason
from ..blender import actions
from ..evaluated import copies
from ..evaluated.question import answered
from ..lazy import numpy as np
from . import laid, rotations, solved

ROTATIONS = {'QUATERNION': ("rotation_quaternion", 4), 'AXIS_ANGLE': ("rotation_axis_angle", 4)}
DELTA_ROTATIONS = {'QUATERNION': ("delta_rotation_quaternion", 4), 'AXIS_ANGLE': None}
"""Blender has no channel for a delta by axis and angle."""
DEEPEST = 256
"""Parents above each other; of bones too. What hangs deeper is taken for a loop."""
LARGEST_CACHE = 1024  # bones of some rigs, in a viewport and a render

_keys = keeping.OfFile(
    "which channels of an object or bone have keys", "the action's stamp, beginning of the data paths, rotation mode", LARGEST_CACHE
)
_DRIVEN = keeping.OfEvaluation(
    "whether drivers set a channel of an object or bone", "beginning of the data paths, rotation mode", "one for each object or bone"
)


class Transforms(NamedTuple):
    """locations (n, 3), rotations (n, 4; w, x, y, z; unit), scales (n, 3), float64."""

    locations: Any
    rotations: Any
    scales: Any

    @property
    def matrices(self):
        """(n, 4, 4) in rows."""
        found = np.zeros((len(self.locations), 4, 4))
        found[:, :3, :3] = rotations.matrices(self.rotations) * self.scales[:, None, :]
        found[:, :3, 3] = self.locations
        found[:, 3, 3] = 1.0
        return found


PARTS = "location", "rotation", "scale"


class Own:
    """The transform that the channels of an Object or PoseBone make, delta transforms included: below parents and constraints.

    parts: those that count; for the others the present value may stand at all times.
    """

    def __init__(self, thing, parts=PARTS):
        self._thing, self._counting = thing, frozenset(parts)
        self._id = thing.id_data
        self._prefix = "" if thing == self._id else f"{thing.path_from_id()}."
        self._mode = thing.rotation_mode

    price = 10
    """As Track.price: of location, rotation and scale."""

    @functools.cached_property
    def channels(self):
        """{property: its Channels} of the properties that have an effect in the bone's or object's rotation mode."""
        return {name: [Channel(self._id, self._prefix + name, index) for index in range(size)] for name, size in self._names().items()}

    @functools.cached_property
    def reason(self):
        """The Reason of the first channel that has one; None if all are known."""
        if self._is_simple:
            changes_mode = self._keys_at[1]
        else:
            changes_mode = not Channel(self._id, f"{self._prefix}rotation_mode", -1).is_constant
        if changes_mode:
            return Reason(Reason.MODE, thing=self._thing.name)
        if self._is_simple:
            return None
        return next((one.reason for one in self._counted if one.reason), None)

    @property
    def _counted(self):
        """The Channels that count."""
        return [one for name, group in self.channels.items() if any(part in name for part in self._counting) for one in group]

    @property
    def stamp(self):
        """Hashable value that changes whenever the values of the channels may change; None if changes cannot be detected."""
        if not self._id.is_evaluated:
            return None
        if not self._is_simple:
            return strips.together((self._mode, *(one.stamp for one in self._counted)))
        return strips.together((self._mode, self._prefix, self._action, *self._still_values()))

    def values(self, times):
        """Transforms at times (n,)."""
        if self._is_simple:
            return self._combined({name: self._keyed(name, size, times) for name, size in self._names().items()})
        return self._combined({name: np.stack([one.values(times) for one in group], axis=1) for name, group in self.channels.items()})

    def _keyed(self, name, size, times):
        """(n, size) of a property that at most keys of the active action animate. Transforms have no limits."""
        found = np.empty((len(times), size))
        found[:] = getattr(self._thing, name)
        for index, curve in enumerate(self._curves(name, size)):
            if curve is not None:
                found[:, index] = keys.values(curve, times)
        return found

    def _curves(self, name, size):
        curves = actions.curves_of(self._id.animation_data)
        return [strips.acting(curves, self._prefix + name, index) for index in range(size)]

    def _combined(self, found):
        locations, scales = found["location"], found["scale"]
        if self._prefix == "":
            locations = locations + found["delta_location"]
            scales = scales * found["delta_scale"]
        return Transforms(locations, self._quaternions(found), scales)

    def bounds(self, first, last):
        """Rising frames from first to last, between which the values are smooth."""
        if self._is_simple:
            found = [curve for name, size in self._names().items() for curve in self._curves(name, size) if curve]
            return keys.union([[first, last], *(keys.bounds(curve, first, last) for curve in found)])
        return keys.union([[first, last], *(one.bounds(first, last) for one in self._counted)])

    @property
    def extent(self):
        """First and last frame between which the values change; None if they do not."""
        if self._is_simple:
            found = [curve for name, size in self._names().items() for curve in self._curves(name, size) if curve]
            return keys.united(map(keys.extent, found))
        return keys.united(one.extent for one in self._counted)

    @property
    def present(self):
        """A row of location, rotation and scale as they are now."""
        found = {name: np.array([[one.number.present for one in group]]) for name, group in self.channels.items()}
        return np.concatenate([part[0] for part in self._combined(found)])

    @functools.cached_property
    def _is_simple(self):
        """Whether nothing but keys of the active action animates it."""
        animation = self._id.animation_data
        if animation is None:
            return True
        if animation.use_nla and len(animation.nla_tracks):
            return False
        return not len(animation.drivers) or not self._has_drivers()

    def _has_drivers(self):
        """Whether a driver sets a channel; known for as long as Blender keeps an evaluated copy that can be told from others."""
        known = _DRIVEN.on(copies.of(self._id) if self._id.is_evaluated else None)
        place = self._prefix, self._mode
        if place not in known:
            known[place] = any(
                is_driven(self._id, self._prefix + name, index)
                for name, size in (*self._names().items(), ("rotation_mode", 1))
                for index in range(size)
            )
        return known[place]

    @functools.cached_property
    def _action(self):
        """Stamp of the action (strips.stamp_of_action); () without an action."""
        animation = self._id.animation_data
        return strips.stamp_of_action(animation) if animation and animation.action else ()

    @functools.cached_property
    def _keys_at(self):
        """({property: indices of its components without keys}, whether the rotation mode has keys).

        The properties are location, rotation and scale of the object or bone, and the delta transforms of an object.
        """
        if self._id.animation_data is None:
            return {name: range(size) for name, size in self._names().items()}, False
        place = (self._action, self._prefix, self._mode) if self._id.is_evaluated and self._action else None
        return _keys.made(place, self._find_keys) if place else self._find_keys()

    def _find_keys(self):
        still = {
            name: [index for index, curve in enumerate(self._curves(name, size)) if curve is None] for name, size in self._names().items()
        }
        return still, any(self._curves("rotation_mode", 1))

    def _still_values(self):
        """Values of the channels that nothing animates."""
        for name, indices in self._keys_at[0].items():
            values = getattr(self._thing, name)
            yield tuple([values[index] for index in indices])

    def _names(self):
        mode = self._mode
        rotation, size = ROTATIONS.get(mode, ("rotation_euler", 3))
        names = {"location": 3, rotation: size, "scale": 3}
        if self._prefix == "":
            names |= {"delta_location": 3, "delta_scale": 3}
            delta = DELTA_ROTATIONS.get(mode, ("delta_rotation_euler", 3))
            names |= dict([delta] if delta else [])
        return names

    def _quaternions(self, found):
        mode = self._mode
        if mode == 'QUATERNION':
            names = "rotation_quaternion", "delta_rotation_quaternion"
            parts = [rotations.unit(found[name]) for name in names if name in found]
        elif mode == 'AXIS_ANGLE':
            parts = [rotations.from_axis_angle(found["rotation_axis_angle"])]
        else:
            names = "rotation_euler", "delta_rotation_euler"
            parts = [rotations.from_euler(found[name], mode) for name in names if name in found]
        return parts[0] if len(parts) == 1 else rotations.product(parts[1], parts[0])


class World:
    """The world matrix of an Object or PoseBone, from the channels of it and of all that it hangs on."""

    def __init__(self, thing, scene, beneath=None):
        self._thing, self._scene, self._beneath = thing, scene, beneath
        self._is_bone = isinstance(thing, bpy.types.PoseBone)

    @functools.cached_property
    def _links(self):
        """The objects from the topmost parent down."""
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
        """The Reason for which the values are not known at other frames; None if they are known."""
        return answered(
            (self, "reason"),
            lambda: next(filter(None, (self._of(link, "reason", lambda link=link: link.reason) for link in reversed(self._links))), None),
        )

    @property
    def solvers(self):
        """Labels of the systems that are asked for the values."""
        return list(dict.fromkeys(one.label for link in self._links for one in link.all_solved))

    def _of(self, link, *question_and_answer):
        """Result for a link of the chain of parents, found once for all things that share the link."""
        *question, answer = question_and_answer
        return answered((link.key, *question), answer)

    def values(self, times):
        """(n, 4, 4) in rows."""
        marks = times.tobytes()
        return answered((self, "values", marks), lambda: self._values(times, marks))

    def _values(self, times, marks):
        found = None
        for link in self._links:
            found = self._of(link, "values", marks, lambda link=link, above=found: link.matrices(times, above))
        return found

    def poses(self, times):
        """(n, 4, 4) of a bone in the space of its rig."""
        link = self._links[-1]
        return np.broadcast_to(self._of(link, "poses", times.tobytes(), lambda: link.poses(times)), (len(times), 4, 4))

    def bounds(self, first, last):
        """Rising frames from first to last, between which the values are smooth."""
        return answered(
            (self, "bounds", first, last),
            lambda: keys.union([self._of(link, "bounds", first, last, lambda link=link: link.bounds(first, last)) for link in self._links]),
        )

    @property
    def extent(self):
        """First and last frame between which the values change; None if they do not."""
        return answered(
            (self, "extent"), lambda: keys.united([self._of(link, "extent", lambda link=link: link.extent) for link in self._links])
        )

    @property
    def price(self):
        """Price of the values for each time (see core/measures/bounds.py)."""
        return sum(link.price for link in self._links)

    @property
    def stamp(self):
        """Hashable value that changes whenever the world matrix may change at any time; None if changes cannot be detected."""
        return answered(
            (self, "stamp"), lambda: strips.together([self._of(link, "stamp", lambda link=link: link.stamp) for link in self._links])
        )

    @property
    def present(self):
        """The evaluated matrix, without its last row, in one row."""
        thing = self._thing
        matrix = thing.id_data.matrix_world @ thing.matrix if self._is_bone else thing.matrix_world
        return np.array(matrix)[:3].ravel()


class _Link:
    """An object, and the bone of it that the next one hangs on, or None for the object itself."""

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
        """The Solved of the system that drives the object; None without one, or if something else drives the object too."""
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
                if constraint.type in {'IK', 'SPLINE_IK'} and not names.isdisjoint(_turned_by(bone, constraint)):
                    return Reason(Reason.SOLVED_BONE, thing=self._bone.name, bone=bone.name, name=constraint.name)
        return None

    @functools.cached_property
    def _turning(self):
        """{name of a bone: the Solved of the system that drives it}."""
        found = {bone.name: solved.of_bone(bone, self._scene, self._beneath) for bone in self._bones if len(bone.constraints)}
        return {name: one for name, one in found.items() if one}

    @property
    def _is_posed(self):
        return self._bone is not None and self._object.data.pose_position != 'REST'

    @property
    def _driving(self):
        """The Solved of the systems that drive the object and the bones, on top of poses laid over the bones."""
        return [*([self.solved] if self.solved else []), *(self._turning.values() if self._is_posed else ())]

    @property
    def all_solved(self):
        """The Solved of all systems that drive the object and the bones."""
        laying = [one for own in self._posed for one in getattr(own, "solved", ())] if self._is_posed else []
        return [*laying, *self._driving]

    def matrices(self, times, parent):
        """World matrices (n, 4, 4) of the bone or object at times (n,). parent: world matrices of its parent, or None."""
        obj = self._object
        found = self._own.values(times).matrices
        if parent is not None:
            found = rotations.chained(rotations.chained(parent, parent_offset(obj)), found)
        if self.solved:
            found = self.solved.applied(times, found)
        return rotations.chained(found, self.poses(times)) if self._bone else found

    def poses(self, times):
        """Matrices of the bone in the rig's space."""
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
        bones = tuple(
            (
                _numbers(bone.bone.matrix_local),
                bone.bone.inherit_scale,
                bone.bone.use_inherit_rotation,
                bone.bone.use_local_location,
                bone.bone.use_connect,
                bone.bone.use_relative_parent,
                bone.bone.length,
            )
            for bone in self._bones
        )
        pose = obj.data.pose_position if bones else ""
        return strips.together((*(part.stamp for part in self._parts), obj.parent_type, _numbers(obj.matrix_parent_inverse), bones, pose))


def _array(matrix):
    """The matrix as an array, (1, 4, 4)."""
    return np.array(matrix, float)[None]


def _numbers(matrix):
    return tuple(map(tuple, matrix))


def constrained(thing, beneath=None):
    """Why a constraint makes it unknown; None without one that acts. beneath: a System whose sinks do not count."""
    found = solved.acting_on(thing, beneath) if len(thing.constraints) else ()
    return Reason(Reason.CONSTRAINED, thing=thing.name, name=found[0].name) if found else None


def _chain(bone):
    """The bone and all above it, the topmost first."""
    return [*reversed(bone.parent_recursive), bone]


def _turned_by(bone, constraint):
    """Names of the bones that Blender's own solver turns."""
    if constraint.mute:
        return []
    chain = ([bone] if getattr(constraint, "use_tail", True) else []) + bone.parent_recursive
    return [one.name for one in chain[: constraint.chain_count or None]]


def parent_of(obj):
    """The Object or PoseBone that an object hangs on, or None."""
    return _parent_bone(obj) or obj.parent


def _parent_bone(obj):
    if obj.parent and obj.parent_type == 'BONE' and obj.parent.pose:
        return obj.parent.pose.bones.get(obj.parent_bone)
    return None


def of_parent(obj):
    """The Reason for which nobody knows where an object hangs on its parent; None where that is plain, or there is none."""
    parent = obj.parent
    if parent is None:
        return None
    if obj.parent_type in {'VERTEX', 'VERTEX_3'}:
        return Reason(Reason.VERTICES, thing=obj.name, name=parent.name)
    if obj.parent_type == 'OBJECT' and parent.type == 'CURVE' and parent.original.data.use_path:
        return Reason(Reason.ALONG_CURVE, thing=obj.name, name=parent.name)
    return None


def parent_offset(obj):
    """(1, 4, 4): from the matrix of what an object hangs on to the space that its own channels are in."""
    bone, inverse = _parent_bone(obj), _array(obj.matrix_parent_inverse)
    if bone is None:
        return inverse
    if bone.bone.use_relative_parent:
        return rotations.chained(_array(bone.bone.matrix_local.inverted_safe()), inverse)
    return rotations.chained(_array(Matrix.Translation((0.0, bone.bone.length, 0.0))), inverse)


def posed(bone, transforms, parent):
    """Poses in the rig's space (n, 4, 4) of a PoseBone with these own Transforms, by those of its parent, or None."""
    if bone.bone.use_connect:
        transforms = transforms._replace(locations=np.zeros_like(transforms.locations))
    return _posed(bone.bone, transforms.matrices, parent)


def _posed(bone, basis, parent):
    """Poses in the rig's space of a bone (n, 4, 4), by those of its parent, or None."""
    above = bone.parent
    is_plain = (bone.inherit_scale == 'FULL' and bone.use_inherit_rotation) or above is None
    if is_plain and bone.use_local_location:
        if above is None:
            return rotations.chained(_array(bone.matrix_local), basis)
        below = _array(above.matrix_local.inverted_safe() @ bone.matrix_local)
        return rotations.chained(parent, rotations.chained(below, basis))
    # Whatever else a bone inherits, Blender itself says by matrices in single precision.
    parents = [None] * len(basis) if parent is None else parent
    return np.array([_converted(bone, above, *pair) for pair in zip(basis, parents)])


def _converted(bone, above, basis, parent):
    more = {} if above is None else {"parent_matrix": Matrix(parent), "parent_matrix_local": above.matrix_local}
    return bone.convert_local_to_pose(Matrix(basis), bone.matrix_local, **more)
