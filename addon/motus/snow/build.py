"""Create, wire and remove emitters of snow."""

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
# Mesh of an emitter (vertices, edges, faces): a square at its place, and an arrow along which flakes leave. Edges are not rendered.
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
    """Return the System of snow from the registry of systems."""
    return registered["snow"]


def is_emitter(obj):
    """Whether an object is an emitter of snow. The question does not create settings on an object that has none."""
    return is_owner(system(), obj)


def groups(owner):
    """Return the Group of an emitter, whose inputs are the cameras bound to timeline markers, if flakes are born in a camera's view.

    Blender evaluates these cameras before the solver runs.
    """
    cameras = {camera for scene in owner.users_scene for camera in view.cameras(owner.motus.snow, scene)}
    return (Group(inputs=tuple(Transform(camera) for camera in sorted(cameras, key=lambda one: one.name))),)


def rebuild(emitter):
    """Make an emitter's modifier and drivers anew, and the materials and objects that its flakes are shown with."""
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
    """Make the modifier and drivers of a new emitter, as its settings require, so that flakes fall."""
    _note_reads(emitter)
    wiring.attach(system(), emitter)
    look.dress(emitter)


def settle(emitter):
    """Update an emitter's drivers if timeline markers bind different cameras than before, and continue the search for landing places."""
    if _note_reads(emitter):
        wiring.refresh(system(), emitter)
    landings.settle()


def _note_reads(emitter):
    """Write the names of the cameras that an emitter's solver waits for into its settings; returns whether they have changed."""
    settings = emitter.motus.snow
    reads = view.names(settings, emitter.users_scene)
    is_new = reads != settings.reads
    if is_new:
        settings.reads = reads
    return is_new


def remove(emitter, keeps_object):
    """Remove the snow from an emitter, and the emitter object too if Motus has made it.

    keeps_object: whether the emitter object stays in any case.
    """
    was_made = emitter.motus.snow.has_made_emitter
    look.drop(emitter)
    colliders.forget(emitter)
    wiring.detach(system(), emitter)
    forget(system(), emitter)
    if not was_made or keeps_object:
        return
    datablocks.remove_objects([emitter])
