"""Whether an object may have a different place or shape on another frame.

Constraints, drivers, physics and modifiers that depend on the time count as motion, since their results at other frames are unknown.
"""

import bpy

from .. import tracks
from ..blender import actions, node_groups
from ..evaluated.question import answered

_OVER_TIME = {
    'BUILD',
    'CLOTH',
    'DYNAMIC_PAINT',
    'EXPLODE',
    'FLUID',
    'MESH_CACHE',
    'MESH_SEQUENCE_CACHE',
    'OCEAN',
    'PARTICLE_INSTANCE',
    'PARTICLE_SYSTEM',
    'SOFT_BODY',
    'WAVE',
}
"""Types of modifiers whose result depends on the time."""
_TIME_NODES = "GeometryNodeInputSceneTime", "GeometryNodeSimulation"
"""Beginnings of the bl_idname of geometry nodes whose result depends on the time."""
DEEPEST = 64
"""Most parents above each other that are checked one by one; beyond, the world matrix over time is checked as a whole."""


def moves(obj, scene, seen=None):
    """Whether an evaluated object may have a different place or shape on another frame.

    seen: set of objects and node groups that were examined before; they are not examined again. None if there are none.
    """
    seen = set() if seen is None else seen
    if obj in seen:
        return False
    seen.add(obj)
    return _goes(obj, scene) or _changes_shape(obj, scene, seen)


def deforms(obj, scene):
    """Whether an evaluated object may have a different shape on another frame; it may go from place to place as it is."""
    return _changes_shape(obj, scene, {obj})


def _changes_shape(obj, scene, seen):
    # The data of the original: Blender may have freed the evaluated data if nothing depends on the object's geometry.
    return _is_animated(obj.original.data) or _is_deformed(obj, scene, seen)


def _goes(obj, scene):
    for _ in range(DEEPEST):
        parent = obj.parent
        is_plain = parent is None or (obj.parent_type == 'OBJECT' and parent.type != 'CURVE')
        if not is_plain or obj.animation_data is not None or obj.constraints or obj.rigid_body is not None:
            break
        if parent is None:
            return False
        obj = parent
    return answered((hash(obj), hash(scene), "goes"), lambda: _is_moved(obj, scene))


def _is_moved(obj, scene):
    track = tracks.world_track(obj, scene)
    # With a single key the first and last frame of change are equal, and the object does not move.
    return not track.is_known or (track.extent is not None and track.extent[0] != track.extent[1])


def _is_animated(data):
    """Whether keys, NLA strips or drivers animate a datablock or its shape keys."""
    if data is None:
        return False
    animation = getattr(data, "animation_data", None)
    if animation is not None and (animation.action or animation.nla_tracks or animation.drivers):
        return True
    return _is_animated(getattr(data, "shape_keys", None))


def _is_deformed(obj, scene, seen):
    if obj.parent is not None and obj.parent_type in {'ARMATURE', 'LATTICE', 'CURVE'} and _deforms(obj.parent, scene, seen):
        return True
    modifiers = obj.modifiers
    if not modifiers:
        return False
    # Keys of modifiers' properties are in the object's action.
    return _has_keys_of_modifiers(obj) or any(_changes(one, obj, scene, seen) for one in modifiers)


def _has_keys_of_modifiers(obj):
    animation = obj.animation_data
    if animation is None:
        return False
    if animation.nla_tracks:
        return True
    paths = [curve.data_path for curve in animation.drivers]
    if animation.action:
        paths += [curve.data_path for group in actions.all_fcurves(animation.action) for curve in group]
    return any(path.startswith("modifiers[") for path in paths)


def _changes(modifier, owner, scene, seen):
    if modifier.type in _OVER_TIME:
        return True
    if modifier.type == 'NODES' and _nodes_change(modifier.node_group, scene, seen):
        return True
    return any(_deforms(one, scene, seen) for one in _read(modifier) if one != owner)


def _read(modifier):
    """List of the objects that a modifier reads, directly or through collections."""
    found = [
        obj
        for prop in modifier.bl_rna.properties
        if prop.type == 'POINTER' and prop.fixed_type.identifier in {"Object", "Collection"}
        for obj in _objects_of(getattr(modifier, prop.identifier))
    ]
    if modifier.type == 'NODES' and modifier.node_group is not None:
        for value in node_groups.inputs_of(modifier):
            found += _objects_of(value)
    return found


def _objects_of(value):
    if isinstance(value, bpy.types.Object):
        return [value]
    return list(value.all_objects) if isinstance(value, bpy.types.Collection) else []


def _deforms(obj, scene, seen):
    """Whether an object that a modifier or node reads may change the result on another frame; for an armature its bones count too."""
    if obj.type == 'ARMATURE' and (_is_animated(obj) or any(len(bone.constraints) for bone in obj.pose.bones)):
        return True
    return moves(obj, scene, seen)


def _nodes_change(group, scene, seen):
    if group is None or group in seen:
        return False
    seen.add(group)
    if _is_animated(group):
        return True
    for node in group.nodes:
        if node.bl_idname.startswith(_TIME_NODES):
            return True
        if node.bl_idname == "GeometryNodeGroup" and _nodes_change(node.node_tree, scene, seen):
            return True
        for socket in node.inputs:
            value = getattr(socket, "default_value", None) if socket.type in {'OBJECT', 'COLLECTION'} else None
            if any(_deforms(one, scene, seen) for one in _objects_of(value)):
                return True
    return False
