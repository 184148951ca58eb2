"""Create, wire and remove snow covers. A cover is the object that shows the layer of lying snow."""

import bpy

from ...core import wiring
from ...core.blender import datablocks
from ...core.declare import Group, Transform, registered
from ...core.declare.forgetting import forget
from ...core.translations import tr
from . import look, sources


def system():
    """Return the System of snow covers from the registry of systems."""
    return registered["snow_cover"]


def groups(owner):
    """Return the Group of a cover, whose inputs are the transforms of all objects that the solver reads. owner: cover.

    Blender evaluates these objects before the solver runs.
    """
    return (Group(inputs=tuple(Transform(obj) for obj in sources.placed(owner.motus.snow_cover)), outputs=OUTPUTS),)


OUTPUTS = "volume", "deepest"


def new_cover(context):
    """Create the object of a new snow cover in the active collection, with an empty mesh and default settings; returns the object."""
    name = tr("Snow Cover")
    cover = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    (context.collection or context.scene.collection).objects.link(cover)
    return cover


def wire(cover):
    """Make the modifier and drivers of a new cover, as its settings require, and give it its material."""
    settings = cover.motus.snow_cover
    settings.reads = sources.signature(settings)
    wiring.attach(system(), cover)
    look.dress(cover)


def settle(cover):
    """Update a cover's drivers if it reads different objects than before, for example after a change of a collection."""
    settings = cover.motus.snow_cover
    reads = sources.signature(settings)
    if reads != settings.reads:
        settings.reads = reads
        wiring.refresh(system(), cover)


def remove(cover):
    """Remove a cover: its material, drivers, settings, and the object itself."""
    look.drop(cover)
    wiring.detach(system(), cover)
    forget(system(), cover)
    datablocks.remove_objects([cover])
