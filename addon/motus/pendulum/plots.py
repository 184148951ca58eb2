"""Plots of a pendulum's motion around the present frame, drawn in its panel: angles and energy over time, and the phase portrait."""

from typing import Any, NamedTuple

from ..core.declare import Problem
from ..core.file.choices import chosen
from ..core.interface import ui
from ..core.interface.view import graph
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from . import clock, directions, pivot_motion, solve

SECONDS = 4.0
"""Span of the pendulum's own time that a plot shows, before and after the present moment."""
COUNT = 641


class Plot(NamedTuple):
    """One plot. values: its main line, (n,). marks: list of further lines, drawn behind it. unit: written behind the heights.

    across: places of each line's points, in degrees, if they are not evenly spaced in time; empty if they are.
    """

    values: Any
    marks: list
    unit: str
    across: list


def draw(layout, context, pivot):
    """Draw the plot that the pendulum's settings choose, or the reason why there is none."""
    if not ui.draw_native_status(layout):
        return
    found = motion(context, pivot)
    if isinstance(found, Problem):
        ui.draw_message(layout, found.sentence, 'INFO')
        return
    swing, times, states, present = found
    settings = pivot.motus.pendulum
    plot = PLOTS[chosen(settings, "plot")](settings, swing, states, solve.gravity_of(settings, context.scene))
    lines = plot.values, *plot.marks
    heights = {height: f"{height:.4g}{plot.unit}" for height in graph.ticks(min(map(np.min, lines)), max(map(np.max, lines)))}
    if plot.across:
        columns = graph.ticks(min(map(np.min, plot.across)), max(map(np.max, plot.across)))
        texts = [f"{columns[place]:.4g}°" for place in (0, graph.TICKS // 2, -1)]
        across = [(one - columns[0]) / (columns[-1] - columns[0]) for one in plot.across]
    else:
        texts, across = [f"{time:.4g} s" for time in (times[0], 0.5 * (times[0] + times[-1]), times[-1])], []
    graph.draw(layout, "pendulum", plot.values, heights, texts, plot.marks, across=across, dot=present)


def motion(context, pivot):
    """Return (Swing, times (n,), states (n, m) of the first pendulum, index of the present time) to plot; a Problem if they are unknown.

    times: in seconds of the pendulum's own time. pivot: original object.
    """
    settings, scene = pivot.motus.pendulum, context.scene
    swing = solve.swing_of(settings, scene)
    if isinstance(swing, Problem):
        return swing
    now = clock.read(pivot, settings, scene_time.present(scene), scene_time.fps(scene))
    felt = pivot_motion.felt(pivot, scene, now.rate, swing.is_spherical)[0] if settings.use_pivot_motion else {}
    first, last = max(now.seconds - SECONDS, 0.0), now.seconds + SECONDS
    if now.seconds < 0.0:
        first, last = now.seconds - SECONDS, min(now.seconds + SECONDS, 0.0)
    if swing.takes_too_long(max(abs(first), abs(last)), pivot, context.view_layer.depsgraph):
        return solve.FAN_TOO_FAR
    times = np.linspace(first, last, COUNT)
    try:
        states = swing.way(times, **felt)
    except ValueError:
        return solve.unknown(now.seconds)
    return swing, times, states, int(np.abs(times - now.seconds).argmin())


def angles(_settings, swing, states, _gravity):
    """Plot the angles of the rods, of the lower one in front."""
    rows = np.degrees(_angles(swing, states)[0])
    return Plot(rows[-1], list(rows[:-1]), "°", [])


def energy(settings, swing, states, gravity):
    """Plot the energy, which is 0 for bobs at rest at the pivot's height, and its kinetic and potential part.

    Of a pendulum with one rod it is the energy of each kilogram.
    """
    kinetic, potential = energies(settings, swing, states, gravity)
    return Plot(kinetic + potential, [kinetic, potential], " J" if swing.each == 2 else " J/kg", [])


def phase(_settings, swing, states, _gravity):
    """Plot the angular velocity of each rod over its angle, that of the lower rod in front."""
    places, rates = (np.degrees(one) for one in _angles(swing, states))
    return Plot(rates[-1], list(rates[:-1]), "°/s", list(places[::-1]))


PLOTS = {'ANGLE': angles, 'ENERGY': energy, 'PHASE': phase}


def energies(settings, swing, states, gravity):
    """Return the (kinetic, potential) energy (n,) of a pendulum in states (n, m), in J; of a pendulum with one rod for 1 kg."""
    if swing.is_spherical:
        speeds = (states[:, 3:] ** 2).sum(axis=1)
        return 0.5 * settings.length1**2 * speeds, gravity * settings.length1 * states[:, 2]
    rods, rates = _angles(swing, states)
    lengths = settings.length1, settings.length2
    masses = (settings.mass1, settings.mass2) if swing.each == 2 else (1.0,)
    places, velocities = np.zeros((2, len(states))), np.zeros((2, len(states)))
    kinetic, potential = np.zeros(len(states)), np.zeros(len(states))
    for mass, length, angle, rate in zip(masses, lengths, rods, rates):
        way = np.stack((np.sin(angle), -np.cos(angle)))
        across = np.stack((np.cos(angle), np.sin(angle)))
        places, velocities = places + length * way, velocities + length * rate * across
        kinetic += 0.5 * mass * (velocities**2).sum(axis=0)
        potential += mass * gravity * places[1]
    return kinetic, potential


def _angles(swing, states):
    """Return (angles, angular velocities) of the rods, each (rods, n), in radians; of a spherical pendulum those from straight down."""
    if swing.is_spherical:
        found = np.array([directions.angles(state) for state in states.tolist()])
        return found[:, 0][None], found[:, 2][None]
    return states[:, : swing.each].T, states[:, swing.each :].T
