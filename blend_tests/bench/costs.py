"""What owners add to a frame: scenes with and without them take turns in one process.

What changes the machine's speed for seconds (in a virtual one: how far apart its cores are) is so the same for all that are
compared. Processor time, of all of Blender's threads, is measured beside the time on the wall: other programs lengthen the
latter far more.
"""

import statistics
import time

import bpy
import numpy as np
from table import Column

import support

FRAMES = 40
FEWEST_ROUNDS, SECONDS = 7, 5.0

COLUMNS = (Column("added", "ms", "9.4f", True), Column("added CPU", "ms", "9.4f"), Column("goal", "", "9.3f"))
"""Of a table of costs; the goal is no measure, which a comparison would look at."""


def frame_times(scene):
    """(time on the wall, processor time) of a frame, us, each the first decile of FRAMES."""
    samples = []
    for frame in range(1, FRAMES + 6):
        begin, begin_cpu = time.perf_counter(), time.process_time()
        scene.frame_set(frame)
        samples.append((time.perf_counter() - begin, time.process_time() - begin_cpu))
    # Not the median: where other programs have the processor meanwhile, most frames of several threads are cut into.
    return [statistics.quantiles(column, n=10)[0] * 1e6 for column in zip(*samples[5:])]


def rounds_of(scenes):
    """frame_times of the scenes, (rounds, scenes, 2), us."""
    begin, rounds = time.perf_counter(), []
    while len(rounds) < FEWEST_ROUNDS or time.perf_counter() - begin < SECONDS:
        rounds.append([frame_times(scene) for scene in scenes])
    return np.array(rounds)


def nothing(_made):
    """A way to add nothing to what was made."""


def costs(make, *ways):
    """(bare, added), ms: frames of what `make` makes, (rounds, 2), and what each of the ways adds to them, (ways, rounds, 2).

    The last axis: time on the wall, processor time.
    """
    support.empty_scene()
    scenes = []
    for add in (nothing, *ways):
        scenes.append(bpy.data.scenes.new("Bench"))
        bpy.context.window.scene = scenes[-1]
        add(make())
    taken = np.moveaxis(rounds_of(scenes), 1, 0) / 1e3
    return taken[0], taken[1:] - taken[0]


def report(table, rows):
    """Rows (name, make, add, goal) of a table of COLUMNS."""
    for name, make, add, goal in rows:
        with table.guarded(name):
            _, (added,) = costs(make, add)
            table.row(name, added[:, 0], added[:, 1], goal)
