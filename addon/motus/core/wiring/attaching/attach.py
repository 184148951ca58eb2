"""The way of a setting to a pose, and how an owner is put on it and taken off.

Wiring makes, once: a *hub* for each group, a mesh that Blender evaluates with the scene (hubs/hub_lookup.py); in the hub an *outbox*, an
array with room for all that is solved (hubs/outbox.py); on the outbox a *solver driver* that waits for what is read (solver_driver.py);
and *sinks*, constraints, drivers or modifiers that bring slots of the outbox to the members (sinks/stack.py).

Blender then evaluates, at each frame: what the solver reads; the solver driver, which calls motus_solve (solving/namespace.py); that
has the prepared Solver (solving/solving.py) call System.solve with the settings, and write its poses into the evaluated outbox; the
sinks, which wait for the outbox. A setting that is edited calls touch(), one that says what is read or driven calls refresh().
"""

from ...declare import groups_of, is_owner, of_owner, systems
from ...evaluated import copies
from ..hubs import hub_lookup, outbox, outputs
from ..sinks import attribute_sink, finding, geometry_sink, property_sink, stack
from . import override_drivers, overrides, readers, renaming, sharing, signature, solver_driver, unwiring


def attach(system, owner):
    """Wire `system` on `owner`: hubs with solvers and outboxes, and sinks on all members. What was wired before is replaced."""
    _wire(system, owner, {})
    refresh_others(system, owner)


def _wire(system, owner, before):
    """before: what stack.places() said of the owner's last wiring; things that had sinks then have them at these places again."""
    followers = readers.of(system, owner)
    unwiring.unwire(system, owner)
    settings = of_owner(system, owner)
    settings.is_active = True
    if settings.is_released:
        settings.is_released = False
    solver_driver.prepare(system, owner)
    groups = groups_of(system, owner)
    place = sharing.join(system, owner, lambda mesh: solver_driver.reads_the_same(system, owner, mesh))
    if place:
        _wire_row(system, owner, groups[0], place)
    else:
        for group in groups:
            _wire_group(system, owner, group)
    readers.point(system, owner, followers)
    overrides.mark(system, owner, groups)
    stack.order(system, owner, groups, before)
    solver_driver.call_again(system, owner)
    if place and place.partner:
        _wire_anew(system, place.partner)


def _wire_group(system, owner, group):
    """Give a group a hub of its own, and let its members follow that."""
    hub = hub_lookup.make_hub(system, owner, group)
    stack.prepare(system, owner, group, hub)
    outbox.create(system, hub.data, group, attribute_sink.serves(system))
    copies.mark(hub.data)
    if signature.wants_outlet(system, owner):
        outputs.create_outlet(system, owner, hub.data)
    solver_driver.add(system, owner, group, hub)
    stack.add(system, owner, group, hub)


def _wire_row(system, owner, group, place):
    """Let an owner that drives itself alone follow its row of a shared hub."""
    outputs.create_outlet(system, owner, place.hub.data)
    if place.partner:  # the hub is new
        solver_driver.add(system, owner, group, place.hub)
    stack.add_constraints(system, owner, group, place.hub, place.row)


def detach(system, owner):
    """Remove everything attach() made; the owner's and members' own transforms, keys and constraints stay."""
    followers = readers.of(system, owner)
    unwiring.unwire(system, owner)
    readers.point(system, owner, followers)
    if system.has_modifier:
        geometry_sink.remove(system, owner)
    override_drivers.align(owner)
    refresh_others(system, owner)


def touch(system, owner):
    """Have the owner solved with settings that were changed from Python; wired anew if it is a copy, or a member was deleted."""
    if signature.has_strange_carriers(system, owner) or not solver_driver.call_again(system, owner):
        refresh(system, owner)


def refresh(system, owner):
    """Wire again after a change of what is driven or read: targets, members, channels. What is linked stays as it is."""
    if owner.library or not is_owner(system, owner):
        return
    _wire_anew(system, owner)
    refresh_others(system, owner)


def _wire_anew(system, owner):
    if system.groups is not None:
        renaming.follow(system, owner)
    _wire(system, owner, stack.places(system, owner))


def refresh_others(system, owner):
    """Wire the owner's other systems again whose groups depend on what has changed in this one."""
    if system.entries is None:
        return
    for other in systems():
        if other is not system and other.entries is not None and is_owner(other, owner):
            # The solvers of all other systems wait for the hubs of one that lays poses, which are new ones now.
            (refresh if system.lays_pose else refresh_changed)(other, owner)


def refresh_changed(system, owner):
    """Wire again if the groups are others than those wired, or their sinks have copies; returns whether they were."""
    is_same = of_owner(system, owner).wired == signature.of(system, owner, groups_of(system, owner))
    if is_same and not finding.has_strays(system, owner):
        return False
    _wire_anew(system, owner)
    return True


def refresh_edited(system, owner):
    """Wire again if bones have other names now, which the system is told, or more has changed."""
    if renaming.renamed(system, owner):
        _wire_anew(system, owner)
    else:
        refresh_changed(system, owner)


def set_muted(system, owner, muted):
    """Switch the sinks off or on, leaving all else in place."""
    for _, constraint in finding.sinks(system, owner):
        constraint.mute = muted
    for group in groups_of(system, owner) if system.groups is not None else ():
        hub = hub_lookup.hub_of(system, owner, group.key)
        if hub and hub_lookup.is_own_hub(hub, owner):
            property_sink.remove(system, [hub.data])
            property_sink.add(system, owner, group, hub, is_off=muted)
