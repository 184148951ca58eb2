"""Solver of a snow cover: it collects surfaces and emitters, and computes the depth of the lying snow at a frame.

A Problem is a sentence that the panel shows.
"""

import math
from typing import NamedTuple

from ...core import wiring
from ...core.declare import Geometries, Points, Problem, Setting, registered
from ...core.evaluated.shares import share_of, waits_for_all
from ...core.file.pointers import pointed
from ...core.lazy import numpy as np
from ...core.measures import scene_time
from ...core.refusals import INFINITE
from ...core.scenery import meshes, seen, stillness
from .. import births, clock, colliders, flakes, view
from . import ground, marks, painted, sources, work

NO_SURFACE = Problem("Add a mesh that snow is to lie on")
NO_FACES = Problem("None of the surfaces has faces")
NO_SNOW = Problem("Add an emitter of snow that falls on the surfaces")
NOT_FINITE = Problem("A setting of the cover is not a finite number")
TOO_MANY = Problem("More than 10 million flakes fall until the end: let fewer flakes fall, and raise Snow per Flake", False)
WAITING = Problem("So many flakes, or faces, take some time: press Calculate Snow", False)
UNKNOWN = Problem("An emitter's motion, wind, rate or time is not known ahead, and counts as it is now: record it, or key it", False)
MOVES = Problem("A surface moves: flakes have landed where it is on the present frame", False)
NO_GROUP = Problem("No surface has the vertex group or attribute that Depth Group names: snow lies everywhere", False)
SOME_WITHOUT = Problem("A surface has no faces, or an emitter no mesh: they are left out", False)
UNBAKEABLE = Problem("Lying snow is computed on each frame: there is nothing to bake")
PROBLEMS = (
    *colliders.PROBLEMS,
    *view.PROBLEMS,
    NO_SURFACE,
    NO_FACES,
    NO_SNOW,
    NOT_FINITE,
    TOO_MANY,
    WAITING,
    UNKNOWN,
    MOVES,
    SOME_WITHOUT,
    NO_GROUP,
    marks.UNKNOWN,
    work.TOO_FINE,
    work.LESS_SMOOTH,
    flakes.NOT_FINITE,
    flakes.TOO_MANY,
    flakes.OUT_OF_RANGE,
)

POINTS = Points(attributes=(("depth", 'FLOAT'),), shape='FACES', capacity=4 * ground.MOST)
INPUTS = (Geometries("scenery", of=sources.scenery), Setting("influence"))
DOWN = 0.0, 0.0, -9.81
LEAST_SIDE = math.radians(15.0)
"""Smallest angle of the sides of heaps, in radians, whatever the setting Slope is: at an angle of 0 no snow could lie near edges."""
BEYOND = 250
"""Number of frames: on a frame after the scene's end flakes count up to the next multiple of it.

So the cover need not be computed anew on each of these frames.
"""

# Keywords of the flakes that have no effect on where flakes land.
_OF_LOOKS = {"start_size", "start_color", "random_size", "random_color", "tumble", "collision", "melt_time", "friction"}


class _Present(NamedTuple):
    """What the shown depth depends on beside the computed cover.

    times: {full name of the emitter: seconds of its own time}. painted: for each surface its painted.Painted, or None. frame: of the scene.
    """

    times: dict
    painted: tuple
    frame: float


def solve(context, scenery, influence):
    """Compute the layer of snow at the frame of the context, in world space, as the mesh of the cover; returns a Problem to show, or None.

    scenery: input only so that Blender evaluates the surfaces and colliders first; empty if there are none. influence: share of the depth
    that is shown.
    """
    settings = context.settings
    context.outputs[:] = 0.0
    if sources.signature(settings) != settings.reads:
        context.wants_to_settle = True
    numbers = settings.lump, settings.resolution, settings.repose, settings.smoothing, settings.thinnest, settings.packed, influence
    if not all(abs(number) < INFINITE for number in numbers):
        return NOT_FINITE
    if influence <= 0.0:
        return None
    plan, present, fault = _plan(context, settings, wiring.waited_for(settings) if scenery else {})
    name = context.owner.name
    found = fault if plan is None else _work(context, name, plan)
    if isinstance(found, Problem):
        # The snow that was computed last is shown until the problem is solved.
        before = None if found.blocking else work.latest(name)
        if before:
            _fill(context, *before, present, influence)  # type: ignore[call-arg]
        return found
    _fill(context, plan, found, present, influence)
    return fault or found.fault


def _work(context, name, plan):
    """Return the Work (computed cover) of a plan, or the Problem that keeps it from being computed now.

    name: name of the cover's object. If the computation takes long, the viewport waits for an operator.
    """
    if work.is_too_fine(plan):
        return work.TOO_FINE
    found = work.known(name, plan)
    if found is None and work.may_wait(context.depsgraph, context.owner) and work.remaining(name, plan) > work.LONG * _share(context):
        work.ask(name, plan)
        return WAITING
    return found or work.do(name, plan)


def _share(context):
    return share_of(registered["snow_cover"], context.owner, context.depsgraph)


def _fill(context, plan, found, present, influence):
    fallen = marks.heights(found.ground, found.covers, [present.times.get(fall.emitter, fall.end) for fall in plan.falls])
    shares = painted.spread(plan, found.ground, present.painted)
    shares = np.full_like(fallen, influence) if shares is None else shares * np.float32(influence)
    left = marks.left(plan, found.marks, present.frame, fallen, shares)
    depths = fallen * shares
    mesh = found.ground.layer.mesh(depths, context.settings.thinnest, math.tan(max(context.settings.repose, LEAST_SIDE)), left)
    room = context.points(len(mesh["position"]), len(mesh["edge"]), len(mesh["triangle"]))
    for name, own in (("position", "position"), ("depth", "depth"), ("edges", "edge"), ("triangles", "triangle"), ("sides", "side")):
        room[name][...] = mesh[own][: len(room[name])]
    lying = depths if left is None else depths * left
    context.outputs[0] = np.dot(lying.astype(float), found.covers[0].areas[: len(lying)])
    context.outputs[1] = mesh["depth"].max(initial=0.0)


def _plan(context, settings, scenery):
    """Collect all that a cover is computed from; returns (work.Plan, _Present, Problem to show or None).

    The Plan is None if the cover cannot be computed. scenery: {original object: evaluated object}.
    """
    scene, present = context.depsgraph.scene, _Present({}, (), context.frame)
    # Objects that were added to the collection after the cover was wired may not be evaluated yet.
    surfaces = [one for one in sources.surfaces(settings) if all(obj in scenery for obj in (one.object, *one.instancers))]
    if not surfaces:
        return None, present, NO_SURFACE
    found = {one.original: one for one in (pointed(entry, "object") for entry in settings.emitters) if one}
    emitters = [found[obj] for obj in sources.emitters(settings)]
    for emitter in emitters:
        present.times[emitter.name_full] = clock.read(emitter, context.fps)[0].seconds(context.frame)
    if not emitters:
        return None, present, NO_SNOW
    lain_on = [meshes.placed(scenery[one.object], seen.matrix(one, scenery)) for one in surfaces]
    fault = SOME_WITHOUT if any(one is None for one in lain_on) else None
    group = settings.depth_group
    shares = tuple(painted.of(scenery[one.object], group) if group else None for one, faces in zip(surfaces, lain_on) if faces is not None)
    lain_on = tuple(one for one in lain_on if one is not None)  # type: ignore[assignment]
    if not lain_on:
        return None, present, NO_FACES
    present = present._replace(painted=shares)
    if group and not any(shares):
        fault = fault or NO_GROUP
    if any(stillness.moves(scenery[obj], scene) for one in surfaces for obj in (one.object, *one.instancers)):
        fault = fault or MOVES
    pull = tuple(scene.gravity) if scene.use_gravity and any(scene.gravity) else DOWN
    falls, shelters, clocks, last = [], {}, [], _last(context)
    for emitter in emitters:
        fall, problem = _fall(context, emitter, pull, scenery, last)
        if problem is SOME_WITHOUT:
            fault = fault or problem
            continue
        if fall is None:
            return None, present, problem
        sheltering, unsure = colliders.parts(emitter.motus.snow, scene, {one.object for one in surfaces})
        shelters |= dict.fromkeys(sheltering)
        fault = problem or unsure or fault
        falls.append(fall)
        clocks.append(clock.read(emitter, context.fps)[0])
    if not falls:
        return None, present, NO_SNOW
    movers = [scenery[obj] for obj in sources.movers(settings) if obj in scenery]
    pressing, problem = marks.collected(settings, movers, scene, clocks, last) if movers else (None, None)
    fault = fault or problem
    resolution = settings.resolution if waits_for_all(context.depsgraph) else max(settings.resolution, settings.viewport_resolution)
    rounds = work.rounds(settings.smoothing, resolution)
    plan = work.Plan(
        lain_on,
        tuple(shelters),
        resolution,
        tuple(-part for part in pull),
        tuple(falls),
        settings.lump**3,
        settings.repose,
        rounds,
        work.share_of_smoothing(lain_on, resolution, rounds * len(falls), _share(context)),
        pressing,
    )
    return plan, present, fault


def _last(context):
    """Frame until which flakes fall that count: the scene's last one, or on later frames a multiple of BEYOND."""
    end = scene_time.last(context.depsgraph.scene)
    return max(end, BEYOND * math.ceil(context.frame / BEYOND) if context.frame > end else 0)


def _fall(context, emitter, pull, scenery, last):
    """Collect all that the flakes of one emitter are computed from; returns (work.Fall, Problem to show or None).

    (None, Problem) if its flakes cannot be computed. pull: acceleration, m/s^2, of gravity. scenery: {original object: evaluated object}.
    last: frame until which flakes count.
    """
    snow, scene = emitter.motus.snow, context.depsgraph.scene
    numbers = flakes.numbers(snow)
    if isinstance(numbers, Problem):
        return None, numbers
    given = {name: value for name, value in numbers if name not in _OF_LOOKS}
    # Gravity counts for lying snow in any case; for flakes only if it is switched on for the emitter and the scene.
    given["gravity"] = given["gravity"] and scene.use_gravity and any(scene.gravity)
    own, is_time_known = clock.read(emitter, context.fps)
    end = own.seconds(last)
    rate, is_rate_known = births.rate_of(emitter, last, own)
    if rate is None:
        return None, flakes.NOT_FINITE
    count = births_until(snow, rate, end)
    if not count <= work.MOST_FLAKES:
        return None, TOO_MANY
    source, faces, angles = sources.source(emitter), None, None
    if snow.shape == 'SURFACE':
        source = scenery.get(source and source.original)
        faces = source and meshes.faces(source)
        if faces is None:
            return None, SOME_WITHOUT
    elif snow.shape == 'CAMERA':
        angles = view.angles(source, source and source.matrix_world, scene)
        if isinstance(angles, Problem):
            return None, angles
    span = last, max(0.0, end), own
    poses, is_known = births.over_time(source, scene, source.matrix_world, *span)
    wind, is_sure = births.winds(emitter, *span)
    if poses is None or wind is None:
        return None, flakes.NOT_FINITE
    unseen = view.lens_problem(source.data) if angles is not None else None
    are_known = is_known and is_sure and is_rate_known and is_time_known
    return work.Fall(tuple(given.items()), pull, poses, wind, rate, faces, angles, count, end, emitter.name_full), (
        unseen if are_known else UNKNOWN
    )


def births_until(snow, rate, seconds):
    """Approximate number of flakes that an emitter has released by a time. rate: births.Rates or a number. seconds: own time."""
    last = seconds if snow.looping else min(seconds, snow.delay + snow.duration)
    if isinstance(rate, births.Rates):
        return rate.until(last) - rate.until(snow.delay) + snow.burst
    return rate * max(0.0, last - snow.delay) + snow.burst
