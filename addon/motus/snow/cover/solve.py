"""Snow that lies: what its solver reads, and how deep it is at a time."""

import math

from ...core.lazy import numpy as np
from ...core.refusals import INFINITE
from ...core.system import Geometries, Points, Problem, Setting
from .. import births, flakes
from . import ground, sources, work

NO_SURFACE = Problem("Add a mesh that snow is to lie on")
NO_FACES = Problem("None of the surfaces has faces")
NO_SNOW = Problem("Add an emitter of snow that falls on the surfaces")
NOT_FINITE = Problem("A setting of the cover is not a finite number")
TOO_MANY = Problem("More than 10 million flakes fall until the end: let fewer fall, of larger lumps")
WAITING = Problem("So many flakes, or faces, take some time: press Work Out")
UNKNOWN = Problem(
    "An emitter's motion is not known ahead, and flakes are born where it stands now: record it, or key it", False)
MOVES = Problem("A surface moves: flakes have landed where it is on the present frame", False)
SOME_WITHOUT = Problem("A surface has no faces, or an emitter no mesh: they are left out", False)
UNBAKEABLE = Problem("Lying snow is computed on each frame: there is nothing to bake")
PROBLEMS = (NO_SURFACE, NO_FACES, NO_SNOW, NOT_FINITE, TOO_MANY, WAITING, UNKNOWN, MOVES, SOME_WITHOUT, work.TOO_FINE,
            flakes.NOT_FINITE, flakes.TOO_MANY, flakes.OUT_OF_RANGE)

POINTS = Points(attributes=(("depth", 'FLOAT'),), shape='FACES', capacity=4 * ground.MOST)
INPUTS = (Geometries("scenery", of=sources.scenery), Setting("influence"))
DOWN = 0.0, 0.0, -9.81
LEAST_SIDE = math.radians(15.0)
"""Of heaps, whatever slopes snow slides from: without any there would be none at edges."""
BEYOND = 250
"""Frames. After the scene's last one flakes count up to a multiple of it, so that what is computed stays for a while."""

# Of flakes, what does not change where they land.
_OF_LOOKS = {"start_size", "start_color", "random_size", "random_color", "tumble", "collision", "melt_time", "friction"}


def solve(context, scenery, influence):
    """The layer in world space."""
    settings = context.settings
    if sources.signature(settings) != settings.reads:
        context.wants_to_settle = True
    numbers = settings.lump, settings.resolution, settings.repose, settings.smoothing, settings.thinnest, influence
    if not all(abs(number) < INFINITE for number in numbers):
        return NOT_FINITE
    if influence <= 0.0:
        return None
    plan, times, fault = _plan(context, settings, scenery)
    if plan is None:
        return fault
    name = context.owner.name
    found = work.known(name, plan)
    if found is None and work.seconds(plan) > work.LONG and work.may_wait(context.depsgraph):
        work.ask(name, plan)
        return WAITING
    found = found or work.do(name, plan)
    if isinstance(found, Problem):
        return found
    _fill(context, found, times, influence)
    return fault


def _fill(context, found, times, influence):
    depths = np.zeros(found.covers[0].vertex_count, np.float32)
    for cover, time in zip(found.covers, times):
        depths += cover.heights(time)
    depths = depths[:found.ground.layer.vertex_count] * np.float32(influence)
    mesh = found.ground.layer.mesh(
        depths, context.settings.thinnest, math.tan(max(context.settings.repose, LEAST_SIDE)))
    room = context.points(len(mesh["position"]), len(mesh["edge"]), len(mesh["triangle"]))
    for name, own in (("position", "position"), ("depth", "depth"), ("edges", "edge"), ("triangles", "triangle"),
                      ("sides", "side")):
        room[name][...] = mesh[own][:len(room[name])]
    context.outputs[0] = influence * sum(cover.volume(time) for cover, time in zip(found.covers, times))
    context.outputs[1] = mesh["depth"].max(initial=0.0)


def _plan(context, settings, scenery):
    """(Plan, seconds of each emitter's time, Problem or None); (None, None, Problem) where there is none."""
    scene = context.depsgraph.scene
    # What has come into the collection since the cover was wired may not be evaluated.
    obstacles = [obj for obj in sources.surfaces(settings) if obj in scenery]
    if not obstacles:
        return None, None, NO_SURFACE
    wanted = sources.emitters(settings)
    found = {entry.object.original: entry.object for entry in settings.emitters if entry.object}
    emitters = [found[obj] for obj in wanted]
    if not emitters:
        return None, None, NO_SNOW
    lain_on = [_placed(scenery[obj]) for obj in obstacles]
    fault = SOME_WITHOUT if None in lain_on else None
    lain_on = tuple(filter(None, lain_on))
    if not lain_on:
        return None, None, NO_FACES
    shelters = {obj for emitter in emitters for obj in sources.shelters(emitter, obstacles)}
    shelters = [obj for obj in scenery if obj in shelters]
    pull = tuple(scene.gravity) if scene.use_gravity and any(scene.gravity) else DOWN
    falls, times = [], []
    for emitter in emitters:
        fall, problem = _fall(context, emitter, pull, scenery)
        if fall is None:
            return None, None, problem
        fault = problem or fault
        falls.append(fall)
        times.append((context.frame - emitter.motus.snow.start_frame) / context.fps)
    if any(_moves(scenery[obj], scene) for obj in (*obstacles, *shelters)):
        fault = fault or MOVES
    plan = work.Plan(
        lain_on, tuple(filter(None, (_placed(scenery[obj]) for obj in shelters))), settings.resolution,
        tuple(-part for part in pull), tuple(falls), settings.lump ** 3, settings.repose,
        work.rounds(settings.smoothing, settings.resolution))
    return plan, times, fault


def _placed(obj):
    """Faces of an evaluated object in the world; None where it has none."""
    found = births.faces(obj.data)
    return found and births.placed(found, obj.matrix_world)


def _moves(obj, scene):
    moved = births.track(obj, scene)
    return not moved.is_known or moved.extent is not None


def _fall(context, emitter, pull, scenery):
    """(work.Fall, Problem or None); (None, Problem) where its flakes cannot be."""
    snow, scene = emitter.motus.snow, context.depsgraph.scene
    numbers = flakes.numbers(snow)
    if isinstance(numbers, Problem):
        return None, numbers
    given = {name: value for name, value in numbers if name not in _OF_LOOKS}
    # What lies is pulled down even where nothing falls by gravity.
    given["gravity"] = given["gravity"] and scene.use_gravity and any(scene.gravity)
    last = max(scene.frame_end, BEYOND * math.ceil(context.frame / BEYOND) if context.frame > scene.frame_end else 0)
    end = (last - snow.start_frame) / context.fps
    count = births_until(snow, end)
    if not count <= work.MOST_FLAKES:
        return None, TOO_MANY
    source, faces = emitter, None
    if snow.shape == 'SURFACE':
        source = scenery.get(snow.surface and snow.surface.original)
        faces = source and births.faces(source.data)
        if faces is None:
            return None, NO_SNOW
    poses, is_known = births.over_time(
        source, scene, source.matrix_world, last, max(0.0, end), snow.start_frame, context.fps)
    if poses is None:
        return None, flakes.NOT_FINITE
    return work.Fall(tuple(given.items()), pull, poses, faces, count, end), None if is_known else UNKNOWN


def births_until(snow, seconds):
    """How many flakes an emitter lets fall until then, about."""
    since = max(0.0, seconds - snow.delay)
    return snow.rate * (since if snow.looping else min(since, snow.duration)) + snow.burst
