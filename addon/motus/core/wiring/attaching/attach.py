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
from ..hubs import outputs, sharing
from ..sinks import finding, geometry_sink, property_sink, stack
from . import overrides, readers, renaming, signature, solver_driver, unwiring, waiting


def attach(system, owner):
    """Wire `system` on `owner`: create hubs with solvers and outboxes, and sinks on all members; an earlier wiring is replaced."""
    _wire(system, owner, {})
    refresh_others(system, owner)


def _wire(system, owner, before):
    """Wire a system on an owner, and replace the earlier wiring.

    before: result of stack.places() for the earlier wiring; things that had sinks get the new sinks at these places in their constraint
    stacks.
    """
    followers = _unwire(system, owner)
    settings = of_owner(system, owner)
    settings.is_active = True
    if settings.is_released:
        settings.is_released = False
    waiting.set_proxy(system, settings)
    groups = groups_of(system, owner)  # after the owner counts as one: what it moves is no ground of a walker, for example
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
    """Remove the wiring of an owner; returns the users' drivers that read its outputs, which readers.point() makes read the new ones."""
    parts = sharing.all_parts(system, owner)
    followers = readers.of(system, owner, parts)
    unwiring.unwire(system, owner, parts)
    return followers


def detach(system, owner):
    """Remove everything that attach() made on an owner; the own transforms, keys and constraints of the owner and its members stay."""
    readers.point(system, owner, (), _unwire(system, owner))
    if system.has_modifier:
        geometry_sink.remove(system, owner)
    unwiring.release(system, owner)
    refresh_others(system, owner)


def touch(system, owner):
    """Have an owner solved again after its settings were changed from Python.

    The owner is wired again if it is a copy that uses another owner's hubs, or if the number of members has changed.
    """
    parts = sharing.parts(system, owner)
    if signature.has_strange_carriers(system, owner, parts) or not sharing.store_settings(system, owner, parts):
        refresh(system, owner)


def refresh(system, owner):
    """Wire an owner again after a change of what is driven or read: targets, members or channels.

    Nothing happens if the object is linked or is no owner of the system.
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
    """Wire the owner's other systems again if their groups depend on what has changed in this system."""
    if system.entries is None:
        return
    for other in systems():
        if other is not system and other.entries is not None and is_owner(other, owner):
            # Solvers that start from poses of this system wait for its hubs, and these hubs are new now.
            (refresh if system in laid_beneath(other) else refresh_changed)(other, owner)


def refresh_changed(system, owner):
    """Wire an owner again if its groups have changed, or if undriven bones have copies of its sinks; returns whether it was wired."""
    is_same = of_owner(system, owner).wired == signature.of(system, owner, groups_of(system, owner))
    if is_same and not finding.has_strays(system, owner):
        return False
    _wire_anew(system, owner)
    return True


def refresh_edited(system, owner):
    """Wire an owner again after bones were edited, if bones that it uses were renamed or its groups have changed.

    The system is told of renamed bones.
    """
    if renaming.renamed(system, owner):
        _wire_anew(system, owner)
    else:
        refresh_changed(system, owner)


def set_muted(system, owner, muted):
    """Mute or unmute the sinks of an owner.

    The constraints are muted. The drivers of properties, which are sinks too, are removed if `muted`, and added if not; the list of the
    properties stays in the hub.
    """
    for _, constraint in finding.sinks(system, owner):
        constraint.mute = muted
    for group in groups_of(system, owner) if system.groups is not None else ():
        part = sharing.part_of(system, owner, group.key)
        if part and part.is_own:
            property_sink.remove(system, [part.mesh])
            property_sink.add(system, owner, group, part.hub, is_off=muted)
