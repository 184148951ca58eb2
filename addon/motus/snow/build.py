"""Making emitters and taking them away."""

import math

import bpy
from mathutils import Euler

from ..core import wiring
from ..core.blender import datablocks
from ..core.declare import Group, Transform, is_owner, registered
from ..core.declare.forgetting import forget
from ..core.translations import tr
from . import colliders, landings, look, view

DOWN = Euler((math.pi, 0.0, 0.0))
# Edges that show where an emitter is and to where flakes leave: a square and an arrow. Edges are not rendered.
MARK = (
    [
        (-0.5, -0.5, 0.0),
        (0.5, -0.5, 0.0),
        (0.5, 0.5, 0.0),
        (-0.5, 0.5, 0.0),
        (0.0, 0.0, 0.0),
        (0.0, 0.0, 0.6),
        (0.1, 0.0, 0.45),
        (-0.1, 0.0, 0.45),
    ],
    [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (5, 7)],
    [],
)


def system():
    """The registered System."""
    return registered["snow"]


def is_emitter(obj):
    """Whether an object has snow, which it is not given by asking."""
    return is_owner(system(), obj)


def groups(owner):
    """Group of the solver's additional inputs: cameras bound to timeline markers, if flakes are born in the camera's view.

    Blender evaluates these cameras before the solver runs.
    """
    cameras = {camera for scene in owner.users_scene for camera in view.cameras(owner.motus.snow, scene)}
    return (Group(inputs=tuple(Transform(camera) for camera in sorted(cameras, key=lambda one: one.name))),)


def rebuild(emitter):
    """Wire an emitter anew, with the materials and objects that its flakes show."""
    wiring.refresh(system(), emitter)
    look.dress(emitter)


def new_emitter(context, place):
    """Create a snow emitter that faces down, with all settings at their defaults; returns the object.

    The object is linked to the active collection. place: location in the world, metres.
    """
    name = tr("Snow")
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(*MARK)
    emitter = bpy.data.objects.new(name, mesh)
    emitter.location, emitter.rotation_euler = place, DOWN
    (context.collection or context.scene.collection).objects.link(emitter)
    emitter.motus.snow.has_made_emitter = True
    return emitter


def wire(emitter):
    """Let an emitter with its settings snow."""
    _note_reads(emitter)
    wiring.attach(system(), emitter)
    look.dress(emitter)


def settle(emitter):
    """Wire an emitter again whose markers bind other cameras than it was wired for, and go on with what its solver has left."""
    if _note_reads(emitter):
        wiring.refresh(system(), emitter)
    landings.settle()


def _note_reads(emitter):
    """Whether other cameras count than those that the solver was wired for, which is noted."""
    settings = emitter.motus.snow
    reads = view.names(settings, emitter.users_scene)
    is_new = reads != settings.reads
    if is_new:
        settings.reads = reads
    return is_new


def remove(emitter, keeps_object):
    """Take the snow off an emitter, and the emitter away where it was made for it."""
    was_made = emitter.motus.snow.has_made_emitter
    look.drop(emitter)
    colliders.forget(emitter)
    wiring.detach(system(), emitter)
    forget(system(), emitter)
    if not was_made or keeps_object:
        return
    datablocks.remove_objects([emitter])
