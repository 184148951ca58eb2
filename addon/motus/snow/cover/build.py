"""Making covers and taking them away."""

import bpy

from ...core import wiring
from ...core.blender import datablocks
from ...core.declare import Group, Transform, registered
from ...core.declare.forgetting import forget
from ...core.translations import tr
from . import look, sources


def system():
    """The System of snow covers in the registry of systems."""
    return registered["snow_cover"]


def groups(owner):
    """What the solver waits for: the places of all that it reads."""
    return (Group(inputs=tuple(Transform(obj) for obj in sources.placed(owner.motus.snow_cover)), outputs=OUTPUTS),)


OUTPUTS = "volume", "deepest"


def new_cover(context):
    """An object without settings that is to show snow."""
    name = tr("Snow Cover")
    cover = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    (context.collection or context.scene.collection).objects.link(cover)
    return cover


def wire(cover):
    """Let snow lie as the settings say."""
    settings = cover.motus.snow_cover
    settings.reads = sources.signature(settings)
    wiring.attach(system(), cover)
    look.dress(cover)


def settle(cover):
    """Wire a cover again that reads other objects than it was wired for."""
    settings = cover.motus.snow_cover
    reads = sources.signature(settings)
    if reads != settings.reads:
        settings.reads = reads
        wiring.refresh(system(), cover)


def remove(cover):
    """Take a cover away."""
    look.drop(cover)
    wiring.detach(system(), cover)
    forget(system(), cover)
    datablocks.remove_objects([cover])
