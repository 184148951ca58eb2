"""Sentences for the panel about problems of a walk, with the names of the feet, objects and settings concerned."""

import math

import bpy

from ..core.declare import Problem
from ..core.file.pointers import pointed
from ..core.measures import scene_time
from ..core.translations import tr
from . import ground, legs, plan, solve


def found(context, owner):
    """Return the Plan of a walker as it is evaluated now, or the Problem that keeps it from walking.

    owner: original object that walks.
    """
    evaluated = _evaluated(context, owner)
    return plan.of(evaluated, context.scene, plan.read(evaluated.motus.walker))


def is_moved(context, owner):
    """Whether the world matrix of a walker is known to change over time. owner: original object, whose evaluated copy is examined."""
    return plan.is_moved(_evaluated(context, owner), context.scene)


def _evaluated(context, owner):
    return owner.evaluated_get(context.evaluated_depsgraph_get())


def sentence(context, owner, problem):
    """Return the sentence about a Problem of a walker, in the user's language. owner: original object that walks."""
    if problem in {solve.UNREACHED, solve.UNTIMED}:
        planned = found(context, owner)
        troubles = [] if isinstance(planned, Problem) else planned.walker.problems
        if troubles:
            return _unreached(context, owner, *min(troubles, key=lambda one: one[1]), len(troubles) - 1)  # type: ignore[call-arg]
    settings = owner.motus.walker
    if problem in {plan.NOT_FINITE, plan.OUT_OF_RANGE}:
        return _about_setting(settings, problem, found(context, owner))
    named = pointed(settings, "ground")
    if problem == ground.GONE and named and ground.is_walking(named):
        return tr("{object} walks itself, and is no ground").format(object=named.name)
    return tr(problem.sentence)


def _about_setting(settings, problem, planned):
    """Return the sentence about a wrong setting, with the setting's name.

    planned: Plan or Problem of the walker now. The name is left out if it differs from `problem`: the setting was changed since.
    """
    of_legs = settings.bl_rna.properties["legs"].fixed_type.properties
    declared = planned == problem and (settings.bl_rna.properties.get(planned.about) or of_legs.get(planned.about))
    if not declared:
        return tr(problem.sentence)
    said = {
        plan.NOT_FINITE: lambda: tr("{setting} is not a finite number"),
        plan.OUT_OF_RANGE: lambda: tr("{setting} is outside of what a walk can be planned by"),
    }[problem]()
    return said.format(setting=bpy.app.translations.pgettext_iface(declared.name))


def shown(scene, seconds):
    """Frame of the timeline at which a time of a walk, in seconds, is shown; the two differ under Time Stretching."""
    return scene_time.time_line(scene, seconds * scene_time.fps(scene))


def _unreached(context, owner, leg, first, last, reason, more):
    frames = [_frame(shown(context.scene, seconds)) for seconds in (first, last)]
    said = {
        "no_ground": lambda: tr("{foot} finds no ground within reach on frames {first}-{last}"),
        "out_of_reach": lambda: tr("{foot} is too far from its leg on frames {first}-{last}"),
        "no_length": lambda: tr("The leg of {foot} has no length"),
        "no_touch": lambda: tr("{foot} cannot land on frame {first}: its steps before leave no room"),
        "no_lift": lambda: tr("{foot} cannot lift on frame {first}: its step has no room, or is the last one"),
        "left_out": lambda: tr("{foot} takes no step on frame {first}, where it was changed: it still stands where it is held"),
    }[reason]()
    entry = owner.motus.walker.legs[leg]
    told = said.format(foot=legs.label(entry), first=frames[0], last=frames[1])
    return told if more == 0 else tr("{sentence}, and {count} more problems").format(sentence=told, count=more)


def _frame(number):
    return f"{number:.0f}" if math.isfinite(number) else "∞" if number > 0.0 else "-∞"
