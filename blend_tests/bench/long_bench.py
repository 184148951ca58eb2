"""What a frame costs in long shots: frames near the end of shots of growing length, whose keys go on to the end. Run by ./motus bench.

The first frame is evaluated with nothing kept, as a process of a render farm evaluates it; those after it as playback does.
"""

import statistics
import sys
import time
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from sample_scenes import new_curve, new_object  # noqa: E402  (found by the line above)
from table import Column, Table  # noqa: E402

import support  # noqa: E402

LENGTHS = 250, 10_000, 100_000
"""Frames of the shots."""
APART = 25
"""Frames from key to key."""
PLAYED = 40
"""Frames that are played at the end of a shot."""


def keyed(obj, length):
    """An object that goes to and fro by keys to the end of a shot."""
    support.key_places(obj, {frame: (0.1 * frame / length, 2.0 * (frame // APART % 2), 0.0) for frame in range(1, length + 1, APART)})
    return obj


def path(length):
    follower = new_object("Follower")
    bpy.ops.motus.path_follow_add(object=follower.name, curve=new_curve().name, timing='SPEED', speed=0.5, extend='LOOP')
    settings = follower.motus.path
    for frame in range(1, length + 1, APART):
        settings.speed = 0.5 + 0.2 * (frame // APART % 3)
        follower.keyframe_insert("motus.path.speed", frame=frame)


def dynamics(length):
    bpy.ops.motus.dynamics_add(object=keyed(new_object("Ball"), length).name, channels={'LOCATION'}, style='BOUNCY')


def snow(length):
    bpy.ops.motus.snow_add(rate=200.0, lifetime=5.0, use_steering=True)
    keyed(bpy.context.object, length)


def walker(length):
    from walker import walker_cases

    land, spider = walker_cases.grid("Land", walker_cases.waves, half=3.0), walker_cases.spider(ahead=0.0, location=(0.0, 0.0, 0.0))
    bpy.ops.motus.walker_remove(object=spider.name)
    keyed(spider, length)
    bpy.ops.motus.walker_add(object=spider.name, ground=land.name)


def pendulum(_length):
    bpy.ops.motus.pendulum_add(kind='DOUBLE', angle1=2.0, angle2=1.0)


SYSTEMS = {"path, keyed speed": path, "dynamics": dynamics, "snow, moving emitter": snow, "walker": walker, "double pendulum": pendulum}


def milliseconds(scene, frame):
    begin = time.perf_counter()
    scene.frame_set(frame)
    return 1e3 * (time.perf_counter() - begin)


def report(wanted):
    table = Table("Frames at the end of long shots", Column("first", "ms"), Column("then", "ms"), rows="system and length")
    for name, make in SYSTEMS.items():
        for length in LENGTHS:
            row = f"{name}, {length} frames"
            if wanted and not any(part in row for part in wanted):
                continue
            with table.guarded(row):
                support.empty_scene()
                scene = bpy.context.scene
                scene.frame_start, scene.frame_end = 1, length
                make(length)
                support.addon("core.keeping").forget_file()
                first = milliseconds(scene, length - PLAYED)
                table.row(row, first, statistics.median(milliseconds(scene, length - PLAYED + frame) for frame in range(1, PLAYED)))


if __name__ == "__main__":
    support.enable()
    report(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
