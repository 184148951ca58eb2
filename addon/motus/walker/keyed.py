"""Settings of a walker's gait that are keyed: the gait itself, duty, stride and cadence, over all frames of the plan."""

import hashlib
from dataclasses import replace

from ..core import native, tracks
from ..core.animation.channel import Channel
from ..core.animation.strips import together
from ..core.declare import Problem
from ..core.evaluated import copies
from ..core.lazy import numpy as np
from .properties import GAITS

KEYED = "gait", "duty", "stride", "cadence"
"""Names of the settings that the plan is made from, and that may be keyed."""
UNKNOWN = Problem("A setting of the gait is not known ahead, and its feet do not step: key it, without drivers")
NAMES = {number: identifier for identifier, *_, number in GAITS}
"""Integer value of a gait, which keys hold -> its identifier."""


def names(owner):
    """Names of the settings among KEYED that something animates, as a tuple. owner: evaluated object that walks."""
    if not copies.has_moving_settings(owner):
        return ()
    return tuple(name for name in KEYED if not channel(owner, name).is_constant)


def channel(owner, name):
    """The Channel (value over time) of a setting of the object that walks. name: one of KEYED."""
    return Channel(owner, f"motus.walker.{name}", -1)


def over(owner, names_of, frames, digest):
    """Return ({name: values (k,)}, digest of all values) of keyed settings at frames (k,), or the Problem that one is not known ahead.

    owner: evaluated object that walks. names_of: result of names(). digest: hash that differs for different frames.
    """
    channels = {name: channel(owner, name) for name in names_of}
    for name, one in channels.items():
        if one.reason:
            return replace(UNKNOWN, about=name)
    stamp = together((digest, *(one.stamp for one in channels.values())))
    return tracks.kept_by(stamp, ("walker gait", names_of), lambda: _sampled(channels, frames))


def _sampled(channels, frames):
    found = {name: one.values(frames) for name, one in channels.items()}
    digest = hashlib.blake2b(digest_size=16)
    for values in found.values():
        digest.update(np.ascontiguousarray(values))
    return found, digest.digest()


def keywords(numbers, values):
    """Keywords of the native Walker for the gait: phases and duty, and how they, stride and cadence change over time.

    numbers: plan.Numbers. values: {name: values (k,)} of the keyed settings at the samples. Lengths are before the body's scale.
    """
    gaits = [NAMES.get(int(gait), GAITS[0][0]) for gait in values["gait"]] if "gait" in values else [numbers.gait]
    usual = {gait: _usual(numbers, gait) for gait in set(gaits)}

    def pattern(sample):
        phases, duty = usual[gaits[sample]]
        if numbers.has_duty or gaits[sample] == 'OWN':
            duty = values["duty"][sample] if "duty" in values else numbers.value("duty")
        return phases, duty

    phases, duty = pattern(0)
    changed = [sample for sample in range(1, len(gaits)) if gaits[sample] != gaits[sample - 1]]
    found = {"phases": phases, "duty": duty, "transition": numbers.value("transition")}
    found["changes"] = [(sample, *pattern(sample)) for sample in changed]
    if "duty" in values and (numbers.has_duty or set(gaits) == {'OWN'}):
        found["duties"] = values["duty"]
    if "cadence" not in values:
        found["cadence"] = numbers.value("cadence")
    return found | {f"{name}s": values[name] for name in ("stride", "cadence") if name in values}


def _usual(numbers, gait):
    """(phases of the legs, usual duty) of a gait; those of Custom are settings of the legs, and its duty is one too."""
    if gait == 'OWN':
        return numbers.phases, 0.0
    return native.module.walker_gait(gait.lower(), np.array(numbers.rest), numbers.forward, numbers.up)
