"""What is wrong with a walk, with the names of what it is about."""

import math

import bpy

from ..core.declare import Problem
from ..core.file.pointers import pointed
from ..core.measures import scene_time
from ..core.translations import tr
from . import ground, legs, plan, solve


def found(context, owner):
    """The Plan of an original owner as it is evaluated now, or the Problem that keeps it from walking."""
    evaluated = _evaluated(context, owner)
    return plan.of(evaluated, context.scene, plan.read(evaluated.motus.walker))


def is_moved(context, owner):
    """Whether an original owner's body is known to move: of the evaluated one that is kept."""
    return plan.is_moved(_evaluated(context, owner), context.scene)


def _evaluated(context, owner):
    return owner.evaluated_get(context.evaluated_depsgraph_get())


def sentence(context, owner, problem):
    """The sentence of a Problem of an original owner, in the user's language."""
    if problem == solve.UNREACHED:
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
    """Sentence about a problem, with the name of the setting that the plan named, if the plan's problem is still this one."""
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
    """The frame of the time line that shows a time of a walk."""
    return scene_time.time_line(scene, seconds * scene_time.fps(scene))


def _unreached(context, owner, leg, first, last, reason, more):
    frames = [_frame(shown(context.scene, seconds)) for seconds in (first, last)]
    said = {
        "no_ground": lambda: tr("{foot} finds no ground within reach on frames {first}-{last}"),
        "out_of_reach": lambda: tr("{foot} is too far from its leg on frames {first}-{last}"),
        "no_length": lambda: tr("The leg of {foot} has no length"),
    }[reason]()
    entry = owner.motus.walker.legs[leg]
    told = said.format(foot=legs.label(entry), first=frames[0], last=frames[1])
    return told if more == 0 else tr("{sentence}, and {count} more footholds").format(sentence=told, count=more)


def _frame(number):
    return f"{number:.0f}" if math.isfinite(number) else "∞" if number > 0.0 else "-∞"
