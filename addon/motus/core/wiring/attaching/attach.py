"""Set up a system on an owner (attach), set it up again (refresh), and remove it (detach).

The owner is the object whose settings the system solves. Setting up, called wiring, creates: a *hub* for each group of members, a
hidden mesh object that Blender evaluates with the scene, and in the hub an *outbox*, an array with slots for all results
(hubs/sharing.py); the *outlet*, a custom property of the owner that repeats the outputs in the outbox (hubs/outputs.py); on the outbox
a *solver driver* that waits for everything the solver reads (solver_driver.py); and *sinks*, the constraints, drivers or modifiers that
bring slots of the outbox to the members (sinks/stack.py). Several owners can share a hub; what one owner has of a hub is a *Part*.

At each frame Blender then evaluates, in this order: the objects that the solver reads; the solver driver, which calls motus_solve
(solving/namespace.py); the sinks, which wait for the outbox. motus_solve has the prepared Solver (solving/solving.py) call System.solve
with the settings, and writes the poses into the evaluated outbox. After an edit of a plain setting, touch() is called; after an edit of
a setting that determines what is read or driven, refresh() is called.
"""

from ...declare import groups_of, is_owner, laid_beneath, of_owner, systems
from ...evaluated import shares
from ..hubs import outputs, sharing
from ..sinks import finding, geometry_sink, property_sink, stack
from . import overrides, readers, renaming, signature, solver_driver, unwiring, waiting


def attach(system, owner):
    """Wire a system on an owner: create hubs with solvers and outboxes, and sinks on all members. An earlier wiring is replaced."""
    _wire(system, owner, {})
    refresh_others(system, owner)


def _wire(system, owner, before):
    """Wire a system on an owner, and replace the earlier wiring.

    before: {object or pose bone: positions of the owner's sinks among the constraints}, as stack.places() returned it for the earlier
    wiring. The new sinks get the same positions.
    """
    followers = _unwire(system, owner)
    settings = of_owner(system, owner)
    settings.is_active = True
    if settings.is_released:
        settings.is_released = False
    waiting.set_proxy(system, settings)
    if system.prepare is not None:
        system.prepare(owner)
    groups = groups_of(system, owner)  # only now, since groups may depend on is_active: a walker's ground, for example
    parts = sharing.provide(system, owner, groups)
    for group, part in zip(groups, parts):
        outputs.create_outlet(system, owner, part)
        solver_driver.add(system, owner, group, part)
        stack.add(system, owner, group, part)
    readers.point(system, owner, parts, followers)
    overrides.mark(system, owner, groups)
    stack.order(system, owner, groups, before)
    for part in parts:
        if part.partner:
            _wire_anew(system, part.partner)


def _unwire(system, owner):
    """Remove the wiring of an owner; returns the Readers: the drivers, not made by Motus, that read the owner's outputs.

    readers.point() later makes these drivers read the outputs of the next wiring.
    """
    parts = sharing.all_parts(system, owner)
    followers = readers.of(system, owner, parts)
    unwiring.unwire(system, owner, parts)
    shares.forget()
    return followers


def detach(system, owner):
    """Remove everything that attach() made on an owner.

    The own transforms, keys and constraints of the owner and of its members stay.
    """
    readers.point(system, owner, (), _unwire(system, owner))
    if system.has_modifier:
        geometry_sink.remove(system, owner)
    unwiring.release(system, owner)
    refresh_others(system, owner)


def touch(system, owner):
    """Have an owner solved again after a script has changed the owner's settings.

    The owner is wired again in three cases: the owner is a copy that still uses the hubs of the object from which it was copied, the owner
    can no longer share its hub, or the number of the owner's members has changed.
    """
    parts = sharing.parts(system, owner)
    if signature.has_strange_carriers(system, owner, parts) or not sharing.store_settings(system, owner, parts):
        refresh(system, owner)


def refresh(system, owner):
    """Wire an owner again, because targets, members or channels in the owner's settings have changed.

    Nothing happens if the object is linked or if the system is not set up on it.
    """
    if owner.library or not is_owner(system, owner):
        return
    _wire_anew(system, owner)
    refresh_others(system, owner)


def _wire_anew(system, owner):
    if system.groups is not None:
        renaming.follow(system, owner)
    _wire(system, owner, stack.places(system, owner))


def refresh_others(system, owner):
    """Wire the other systems of an owner again if they depend on this system.

    A system that starts from poses of this system is always wired again, since this system's hubs are new. Any other system is wired again
    only if its groups have changed.
    """
    if system.entries is None:
        return
    for other in systems():
        if other is not system and other.entries is not None and is_owner(other, owner):
            # Solvers that start from poses of this system wait for its hubs, and these hubs are new now.
            (refresh if system in laid_beneath(other) else refresh_changed)(other, owner)


def refresh_changed(system, owner):
    """Wire an owner again if its groups have changed, or if bones that the owner does not drive have copies of its sinks.

    Returns whether the owner was wired again.
    """
    is_same = of_owner(system, owner).wired == signature.of(system, owner, groups_of(system, owner))
    if is_same and not finding.has_strays(system, owner):
        return False
    _wire_anew(system, owner)
    return True


def refresh_edited(system, owner):
    """Wire an owner again after bones were edited, if bones that the owner drives or reads were renamed, or if its groups have changed.

    System.bone_renamed informs the system about the new names of renamed bones. Returns whether the owner was wired again.
    """
    if not renaming.renamed(system, owner):
        return refresh_changed(system, owner)
    _wire_anew(system, owner)
    return True


def set_muted(system, owner, muted):
    """Mute or unmute the sinks of an owner.

    Sinks that are constraints are muted. Sinks that are drivers of properties are removed if `muted` is true, and added again if not; the
    list of these properties stays in the hub.
    """
    for _, constraint in finding.sinks(system, owner):
        constraint.mute = muted
    for group in groups_of(system, owner) if system.groups is not None else ():
        part = sharing.part_of(system, owner, group.key)
        if part and part.is_own:
            property_sink.remove(system, [part.mesh])
            property_sink.add(system, owner, group, part.hub, is_off=muted)
