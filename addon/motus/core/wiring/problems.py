"""Find what keeps an owner's systems from working, as a Problem with a sentence for the panel.

Problems come from the status that solvers write, and from faults in the wiring, such as a missing hub or a driven property that is
gone.
"""

from ..declare import Problem, groups_of, of_owner
from ..file.stored import Damaged, Newer
from ..translations import tr
from .hubs import outbox, sharing
from .sinks import property_sink

_DAMAGED_PROBLEM = Problem("The data of this system in the file is damaged: press Refresh, or set it up again")
_NEWER_PROBLEM = Problem("Made by a newer version of Motus, whose data this one cannot read: update Motus, or press Refresh")
_INTERNAL_PROBLEM = Problem("Motus could not compute this: see the system console")
_PROPERTY_PROBLEM = Problem(
    "A property that is to be driven is gone, has another driver, or is another file's; what is left is driven", blocking=False
)
_SILENT_PROBLEM = Problem("Not evaluated: the add-on's driver functions are not available in this file yet")
_FULL_PROBLEM = Problem("There are more points than there is room for: only the first ones are shown", blocking=False)
_NOT_FINITE_PROBLEM = Problem("A setting, or what comes of it, is no number, or too large: look through the settings")
_OWN_PROBLEMS = {
    outbox.INTERNAL: _INTERNAL_PROBLEM,
    outbox.SILENT: _SILENT_PROBLEM,
    outbox.DAMAGED: _DAMAGED_PROBLEM,
    outbox.NEWER: _NEWER_PROBLEM,
    outbox.FULL: _FULL_PROBLEM,
    outbox.NOT_FINITE: _NOT_FINITE_PROBLEM,
}


def problem(system, owner, depsgraph):
    """Return the Problem that keeps a system from working on an owner; None if there is none. A blocking Problem takes precedence.

    The status is read from the evaluated meshes of the owner's hubs. If no hub is left although the owner is set up, the Problem is that of
    damaged data. A system that declares groups also reports properties that are no longer driven.
    """
    parts = sharing.parts(system, owner)
    if not parts:
        is_bereft = of_owner(system, owner).is_active and groups_of(system, owner)
        return _DAMAGED_PROBLEM if is_bereft else None
    problems = (_problem_of(system, part, depsgraph) for part in parts)
    found = sorted(filter(None, problems), key=lambda one: not one.blocking)
    if found:
        return found[0]
    if system.groups is not None:
        are_driven = of_owner(system, owner).is_baked or all(property_sink.are_driven(system, owner, part.mesh) for part in parts)
        return None if are_driven else _PROPERTY_PROBLEM
    return None


def report_problems(operator, context, system, owners):
    """Make an operator report a warning for each Problem that a system has on these owners.

    Owners that the view layer of the context does not evaluate are left out. A problem that several owners have is reported once.
    """
    context.view_layer.update()
    depsgraph = context.view_layer.depsgraph
    found = {problem(system, owner, depsgraph) for owner in owners if owner.evaluated_get(depsgraph).is_evaluated}
    for sentence in sorted(one.sentence for one in found if one):
        operator.report({'WARNING'}, tr(sentence))


def _problem_of(system, part, depsgraph):
    try:
        status = sharing.status_of(system, part, part.mesh.evaluated_get(depsgraph))
    except Newer:
        return _NEWER_PROBLEM
    except Damaged:
        return _DAMAGED_PROBLEM
    if status in _OWN_PROBLEMS:
        return _OWN_PROBLEMS[status]
    known = (None, *system.problems)
    return known[int(status)] if 0.0 <= status < len(known) else _DAMAGED_PROBLEM
