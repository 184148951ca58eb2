"""Remove what attach.py has created for an owner; the own transforms, keys and constraints of the owner and its members stay.

The owner is the object whose settings a system solves. Hubs are hidden objects whose meshes carry a solver's driver and results. Sinks
are constraints, drivers and modifiers that apply the results. Proxies are hidden empties that bring a result to a bone or object. The
outlet is a custom property of the owner that repeats the solver's outputs. Markers are custom properties by which the evaluated copies
of a datablock are told apart.
"""

import bpy

from ...blender import drivers
from ...declare import groups_of, is_owner, of_owner, systems
from ...declare.forgetting import drop_dead_copy
from ...evaluated import copies
from ..hubs import outbox, sharing
from ..sinks import finding, property_sink, proxy_sink
from . import override_drivers, overrides, solver_driver, waiting


def unwire(system, owner, parts):
    """Remove the hubs, sinks, outlet and proxies of an owner, and the markers of the datablocks that the owner read or drove.

    The outlet is a custom property that repeats the outputs; proxies are hidden empties that bring a result to a bone or object; markers
    are custom properties by which evaluated copies are told apart. The owner keeps its own markers, since it is usually wired again at
    once; release() removes them. parts: all Parts of the owner, also those whose hub object was deleted and of which only the hub's mesh
    remains.
    """
    settings = of_owner(system, owner)
    drop_dead_copy(owner)
    override_drivers.drop_stand_ins(owner)
    meshes, held = [part.mesh for part in parts], sharing.held_meshes(parts)
    for obj in finding.remove_all(system, owner, parts):
        overrides.unmark(system, obj)
    property_sink.remove(system, held)
    strange = [mesh for mesh in meshes if mesh not in held]
    groups = groups_of(system, owner) if strange else ()
    for mesh in strange:
        property_sink.remove_copies(system, owner, groups, mesh)
    settings.hub = None
    settings.more_hubs.clear()
    read = set().union(*map(solver_driver.marked_by, held))
    for mesh in held:
        sharing.leave(system, mesh)
    _unmark(read)
    proxy_sink.release(settings)
    waiting.release_proxy(settings)
    own = solver_driver.wait_key(system), outbox.out_key(system)
    drivers.remove_where(owner, lambda path: path.startswith((f'["{own[0]}"]', f'["{own[1]}')))
    for key in own:
        owner.pop(key, None)
    settings.is_active = False
    settings.wired = ""
    drivers.drop_empty_animation(owner)
    owner.update_tag()


def release(system, owner):
    """Remove the markers of an owner that will not be wired again.

    Markers are the custom properties by which evaluated copies are told apart and by which lost wiring of overrides is detected.
    """
    overrides.unmark(system, owner)
    if not _is_wired(owner) and not _is_read(owner):
        copies.release(owner)
    override_drivers.align(owner)


def _unmark(datablocks):
    """Remove the custom property that tells a datablock's evaluated copies apart, from each datablock that no solver reads any more."""
    for datablock in datablocks:
        if not _is_read(datablock) and not _is_wired(datablock):
            copies.unmark(datablock)


def _is_read(datablock):
    """Whether a solver reads a datablock by the custom property that tells its evaluated copies apart."""
    return any(datablock in solver_driver.marked_by(mesh) for mesh in bpy.data.meshes if outbox.is_hub(mesh))


def _is_wired(datablock):
    """Whether a datablock is an owner of any system."""
    return isinstance(datablock, bpy.types.Object) and any(is_owner(one, datablock) for one in systems())
