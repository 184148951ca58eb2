"""Remove what attach.py has created for an owner; the own transforms, keys and constraints of the owner and its members stay.

The owner is the object whose settings a system solves. Hubs are hidden objects whose meshes carry a solver's driver and results. Sinks
are constraints, drivers and modifiers that apply the results. Proxies are hidden empties that bring a result to a bone or object. The
outlet is a custom property of the owner that repeats the solver's outputs. Markers are custom properties by which the evaluated copies
of a datablock are told apart.
"""

import bpy

from ...blender import drivers
from ...declare import is_owner, of_owner, systems
from ...declare.forgetting import drop_dead_copy
from ...evaluated import copies
from ..hubs import hub_lookup, outbox
from ..sinks import finding, property_sink, proxy_sink
from . import override_drivers, overrides, sharing, signature, solver_driver, waiting


def unwire(system, owner):
    """Remove the hubs, sinks, outlet and proxies of an owner, and the markers on other objects that say that they are read or driven."""
    settings = of_owner(system, owner)
    drop_dead_copy(owner)
    override_drivers.drop_stand_ins(owner)
    finding.remove(finding.sinks(system, owner))
    finding.remove_orphans(system, owner)
    for other in finding.led_by(system, owner):
        of_owner(system, other).leader = None
        overrides.unmark(system, other)
    _remove_hubs(system, owner)
    settings.hub = None
    settings.more_hubs.clear()
    proxy_sink.release(settings)
    wait_key = signature.wait_key(system)
    drivers.remove_where(owner, lambda path: path.startswith((f'["{outbox.out_key(system)}', f'["{wait_key}"]')))
    owner.pop(wait_key, None)
    owner.pop(outbox.out_key(system), None)
    overrides.unmark(system, owner)
    waiting.release_proxy(settings)
    settings.is_active = False
    settings.wired = ""
    if not any(is_owner(one, owner) for one in systems()):
        copies.release(owner)
    drivers.drop_empty_animation(owner)
    owner.update_tag()


def _remove_hubs(system, owner):
    hubs = [hub for _, hub in hub_lookup.hubs(system, owner)]
    # A damaged file may name the same hub twice.
    own = list(dict.fromkeys([hub.data for hub in hubs if hub_lookup.is_own_hub(hub, owner)] + hub_lookup.lost_hubs(system, owner)))
    property_sink.remove(system, own)
    for mesh in [hub.data for hub in hubs if hub.data not in own]:
        property_sink.remove_copies(system, owner, mesh)
    read = set()
    for mesh in own:
        read.update(solver_driver.marked_by(mesh))
        bpy.data.meshes.remove(mesh)
    shared = hub_lookup.hub_of(system, owner)
    if shared and not shared.library and outbox.is_shared(system, shared.data):
        read.update(solver_driver.marked_by(shared.data))
        sharing.leave(system, owner)
    _unmark(read)


def _unmark(datablocks):
    """Remove the markers by which evaluated copies are told apart from datablocks that no solver reads any more."""
    for datablock in datablocks:
        is_read = any(datablock in solver_driver.marked_by(mesh) for mesh in bpy.data.meshes if outbox.is_hub(mesh))
        if not is_read and not _is_wired(datablock):
            copies.unmark(datablock)


def _is_wired(datablock):
    """Whether a datablock is an owner of any system."""
    return isinstance(datablock, bpy.types.Object) and any(is_owner(one, datablock) for one in systems())
